/* What is said of a reluctance torque that a machine does not declare, and how a finding of its own goes
 * before all others. */
#include "host/check/finding.c"

#include <math.h>

#include "unity.h"

static hci_check check;
static char text[512];

void setUp(void)
{
    memset(&check, 0, sizeof check);
    check.verdict = HCI_CHECK_CONSISTENT;
    check.saliency_H = 1.23e-3;
    check.saliency_at_load_H = 0.98e-3;
    check.scale_left_open = 0.05;
}

void tearDown(void)
{
}

#define BEGIN                                                                                                \
    "a reluctance torque that no inductance of the machine declares is in the torques, as of "               \
    "L_q - L_d = 0.0012 H (0.00098 H at the largest i_q)"

static void test_words_of_a_saliency(void)
{
    check.saliency_H = (double)NAN;
    TEST_ASSERT_EQUAL_STRING("", hci_check_saliency_words(&check, text, sizeof text));
    check.saliency_H = 1.23e-3;
    TEST_ASSERT_EQUAL_STRING(
        BEGIN "; beside it the torque per ampere is that of the tables within 5 %, and another scale is none "
              "that is needed",
        hci_check_saliency_words(&check, text, sizeof text));
    check.verdict = HCI_CHECK_SLIPS;
    TEST_ASSERT_EQUAL_STRING(BEGIN ", if nothing is read wrongly",
                             hci_check_saliency_words(&check, text, sizeof text));
}

/* From 9 % on a scale is left open. */
static void test_a_scale_that_is_left_open(void)
{
    static const double OPEN[] = {0.0899, 0.0901, 0.42};
    for (int k = 0; k < 3; ++k) {
        check.scale_left_open = OPEN[k];
        hci_check_saliency_words(&check, text, sizeof text);
        TEST_ASSERT_EQUAL(k > 0, strstr(text, "are left open") != NULL);
        TEST_ASSERT_EQUAL(k == 2, strstr(text, "(42 % of it are left open)") != NULL);
    }
}

/* A text that has no room for what follows ends where its room does. */
static void test_little_room(void)
{
    TEST_ASSERT_EQUAL_INT(19, (int)strlen(hci_check_saliency_words(&check, text, 20)));
    TEST_ASSERT_EQUAL_STRING(BEGIN, hci_check_saliency_words(&check, text, sizeof BEGIN));
    TEST_ASSERT_EQUAL_STRING(BEGIN ";", hci_check_saliency_words(&check, text, sizeof BEGIN + 1));
}

/* ---- findings */

static void put(const char *slip)
{
    const hci_check_finding f = {.slip = slip};
    hci_check_put_first(&check, &f);
}

/* Each goes before those that there are, which all stay; of as many as there may be the last one leaves. */
static void test_what_is_proved_comes_first(void)
{
    static char name[HCI_CHECK_MOST_FINDINGS + 2][8];
    check.probability_as_declared = 1.0;
    for (size_t k = 0; k < HCI_CHECK_MOST_FINDINGS + 2; ++k) {
        snprintf(name[k], sizeof name[k], "s%zu", k);
        put(name[k]);
        const size_t count = k + 1 < HCI_CHECK_MOST_FINDINGS ? k + 1 : HCI_CHECK_MOST_FINDINGS;
        TEST_ASSERT_EQUAL_UINT64(count, check.findings);
        for (size_t j = 0; j < count; ++j)
            TEST_ASSERT_EQUAL_STRING(name[k - j], check.finding[j].slip);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * pow(1e-3, (double)k + 1.0), pow(1e-3, (double)k + 1.0),
                                  check.probability_as_declared);
    }
}

static void test_names_of_paths(void)
{
    TEST_ASSERT_EQUAL_STRING("a.csv", hci_check_name_of("runs/x/a.csv"));
    TEST_ASSERT_EQUAL_STRING("a.csv", hci_check_name_of("a.csv"));
    TEST_ASSERT_EQUAL_STRING("", hci_check_name_of("runs/"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_words_of_a_saliency);
    RUN_TEST(test_a_scale_that_is_left_open);
    RUN_TEST(test_little_room);
    RUN_TEST(test_what_is_proved_comes_first);
    RUN_TEST(test_names_of_paths);
    return UNITY_END();
}
