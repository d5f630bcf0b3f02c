/* Paths from one folder to a file in another. */
#include "host/base/path.h"

#include <string.h>
#include <sys/stat.h>

#include "host/base/memory.h"
#include "support/files.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
    TEST_ASSERT_EQUAL_INT(0, mkdir(files_path("a"), 0777));
    TEST_ASSERT_EQUAL_INT(0, mkdir(files_path("a/b"), 0777));
    files_write(files_path("a/x.csv"), "x\n");
    files_write(files_path("ab.csv"), "x\n");
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
}

static void is_found(const char *expected, const char *file, const char *folder)
{
    char from[4096], *relative;
    hci_note note = {{0}};
    snprintf(from, sizeof from, "%s", files_path(folder));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_path_relative(files_path(file), from, &relative, &note));
    TEST_ASSERT_EQUAL_STRING(expected, relative);
    hci_memory_free(relative);
}

static void test_relative(void)
{
    is_found("x.csv", "a/x.csv", "a");
    is_found("../x.csv", "a/x.csv", "a/b");
    is_found("../x.csv", "a/b/../x.csv", "a/b/.");
    is_found("../../ab.csv", "ab.csv", "a/b");
    is_found("../ab.csv", "ab.csv", "a"); /* a name that begins as the folder's */
}

static void test_from_the_root(void)
{
    char *relative;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_path_relative(files_path("ab.csv"), "/", &relative, &note));
    TEST_ASSERT_EQUAL_STRING(files_path("ab.csv") + 1, relative);
    hci_memory_free(relative);
}

static void test_not_there(void)
{
    char *relative;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_path_relative("nosuch.csv", "/", &relative, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "nosuch.csv"));
    TEST_ASSERT_NULL(relative);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_path_relative(files_path("ab.csv"), "/", &relative, &note));
}

/* The nearest name is one of the folder that was named. */
static void test_the_nearest_name(void)
{
    char *relative, expected[4200];
    hci_note note = {{0}};
    files_write(files_path("a/current.csv"), "x\n");
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT,
                          hci_path_relative(files_path("a/curent.csv"), "/", &relative, &note));
    snprintf(expected, sizeof expected, "did you mean `%s`?", files_path("a/current.csv"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, expected), note.text);
}

static void test_same(void)
{
    char other[4096];
    snprintf(other, sizeof other, "%s", files_path("a/b/../x.csv"));
    TEST_ASSERT_TRUE(hci_path_is_same(files_path("a/x.csv"), other));
    TEST_ASSERT_FALSE(hci_path_is_same(files_path("ab.csv"), other));
    TEST_ASSERT_FALSE(hci_path_is_same("nosuch", "nosuch"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_relative);
    RUN_TEST(test_from_the_root);
    RUN_TEST(test_not_there);
    RUN_TEST(test_the_nearest_name);
    RUN_TEST(test_same);
    return UNITY_END();
}
