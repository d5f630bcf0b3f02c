/* What is there and cannot be read is told once, of files of which a function goes on as if there were none.
 */
#include <errno.h>
#include <string.h>

#include "host/base/digest.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/whole_file.h"
#include "unity.h"

void setUp(void)
{
}
void tearDown(void)
{
    hci_note none = {{0}};
    (void)hci_unread_check(&none);
    (void)hci_memory_was_short();
}

static void keep(const char *path, int error)
{
    errno = error;
    hci_unread_keep(path);
}

static void test_the_first_is_told_once(void)
{
    hci_note note = {{0}};
    keep("a/effects.csv", EIO);
    keep("b/summary.json", EACCES);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_unread_check(&note));
    TEST_ASSERT_EQUAL_STRING("a/effects.csv: cannot be read: Input/output error; mend that, and call again",
                             note.text);
    TEST_ASSERT_EQUAL(HCI_OK, hci_unread_check(&note));
}

static void test_what_is_not_there_is_not_kept(void)
{
    static const int NOTHING[] = {ENOENT, ENOTDIR, ENAMETOOLONG, ELOOP};
    hci_note note = {{0}};
    struct stat info;
    uint64_t sum = HCI_DIGEST_START;
    for (size_t k = 0; k < sizeof NOTHING / sizeof *NOTHING; ++k)
        keep("none.csv", NOTHING[k]);
    TEST_ASSERT_FALSE(hci_unread_stat("none.csv", &info));
    TEST_ASSERT_FALSE(hci_digest_file("none.csv", &sum));
    TEST_ASSERT_NULL(hci_whole_file("none.csv"));
    TEST_ASSERT_NULL(hci_whole_file("."));
    TEST_ASSERT_EQUAL(HCI_OK, hci_unread_check(&note));
    TEST_ASSERT_FALSE(hci_memory_was_short());
}

/* A folder can be opened, and not read. */
static void test_what_is_no_file_has_no_digest_and_is_told(void)
{
    hci_note note = {{0}};
    uint64_t sum = HCI_DIGEST_START;
    TEST_ASSERT_FALSE(hci_digest_file(".", &sum));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_unread_check(&note));
    TEST_ASSERT_EQUAL_STRING(".: cannot be read: Is a directory; mend that, and call again", note.text);
}

static void test_memory_that_is_short_is_told_as_such(void)
{
    hci_note note = {{0}};
    keep("a/effects.csv", ENOMEM);
    TEST_ASSERT_EQUAL(HCI_OK, hci_unread_check(&note));
    TEST_ASSERT_TRUE(hci_memory_was_short());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_is_told_once);
    RUN_TEST(test_what_is_not_there_is_not_kept);
    RUN_TEST(test_what_is_no_file_has_no_digest_and_is_told);
    RUN_TEST(test_memory_that_is_short_is_told_as_such);
    return UNITY_END();
}
