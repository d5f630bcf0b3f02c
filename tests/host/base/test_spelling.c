/* The name that was probably meant, against distances by their definition. */
#include "hci/host/base/spelling.h"

#include <stdbool.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

static uint64_t seed;

void setUp(void)
{
    seed = 12;
}

void tearDown(void)
{
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Mistakes between the first i letters of one word and the first j of another, of which two neighbours may be
 * swapped. */
static int mistakes(const char *a, size_t i, const char *b, size_t j)
{
    if (i == 0 || j == 0) return (int)(i + j);
    int least = mistakes(a, i - 1, b, j - 1) + (a[i - 1] != b[j - 1]);
    least = smaller(least, mistakes(a, i - 1, b, j) + 1);
    least = smaller(least, mistakes(a, i, b, j - 1) + 1);
    if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        least = smaller(least, mistakes(a, i - 2, b, j - 2) + 1);
    return least;
}

static const char *only(const char *word, const char *name)
{
    const char *const names[] = {name, NULL};
    return hci_nearest(word, names);
}

/* Less than one mistake in three letters and one more. */
static void test_random_words(void)
{
    int near = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        char word[8] = "", name[8] = "";
        const int m = ref_integer(&seed, 2, 6), n = ref_integer(&seed, 1, 6);
        for (int k = 0; k < m; ++k)
            word[k] = (char)('a' + ref_integer(&seed, 0, 3));
        for (int k = 0; k < n; ++k)
            name[k] = (char)('a' + ref_integer(&seed, 0, 3));
        const bool begins = m > 2 && strncmp(name, word, (size_t)m) == 0;
        const bool is_near = begins || mistakes(word, (size_t)m, name, (size_t)n) < 1 + m / 3;
        near += is_near;
        TEST_ASSERT_EQUAL_MESSAGE(is_near, only(word, name) != NULL, word);
    }
    TEST_ASSERT_TRUE(near > 30 && near < 2900);
}

/* The one with fewest mistakes, of as many the first. */
static void test_the_nearest(void)
{
    static const char *const NAMES[] = {"torque", "speed", "speeds", "spend", "angle", NULL};
    TEST_ASSERT_EQUAL_STRING("speed", hci_nearest("spede", NAMES));
    TEST_ASSERT_EQUAL_STRING("speeds", hci_nearest("speedz", NAMES + 2));
    TEST_ASSERT_EQUAL_STRING("speed", hci_nearest("speef", NAMES));
    TEST_ASSERT_EQUAL_STRING("spend", hci_nearest("spent", NAMES));
    TEST_ASSERT_EQUAL_STRING("torque", hci_nearest("tor", NAMES));
    TEST_ASSERT_NULL(hci_nearest("to", NAMES));
    TEST_ASSERT_NULL(hci_nearest("t", NAMES));
    TEST_ASSERT_NULL(hci_nearest("", NAMES));
    TEST_ASSERT_NULL(hci_nearest("lamp", NAMES));
}

/* The first part of a name stands for it, for half a mistake. */
static void test_first_parts(void)
{
    static const char *const NAMES[] = {"limit-current", "limits", "link", NULL};
    TEST_ASSERT_EQUAL_STRING("limit-current", only("limti", "limit-current"));
    TEST_ASSERT_EQUAL_STRING("limit-current", hci_nearest("limti", NAMES)); /* 1 and a half, before 2 */
    TEST_ASSERT_EQUAL_STRING("limits", hci_nearest("limtis", NAMES));
    TEST_ASSERT_NULL(only("lixti", "limit-current")); /* two and a half of two */
}

/* Up to 24 letters are compared. */
static void test_long_words(void)
{
    TEST_ASSERT_NOT_NULL(only("abcdefghijklmnopqrstuvwy", "abcdefghijklmnopqrstuvwx"));
    TEST_ASSERT_NULL(only("abcdefghijklmnopqrstuvwxz", "abcdefghijklmnopqrstuvwxy"));
    TEST_ASSERT_NULL(only("abcdefghijklmnopqrstuvwy", "abcdefghijklmnopqrstuvwxy"));
    TEST_ASSERT_NOT_NULL(only("abcdefghijklmnopqrstuvwy", "abcdefghijklmnopqrstuvwx-current"));
    TEST_ASSERT_NULL(only("abcdefghijklmnopqrstuvwy", "abcdefghijklmnopqrstuvwxz-current"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_random_words);
    RUN_TEST(test_the_nearest);
    RUN_TEST(test_first_parts);
    RUN_TEST(test_long_words);
    return UNITY_END();
}
