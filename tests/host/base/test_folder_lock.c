/* A folder that is locked: by this process as often as it likes, and until it was let go as often. */
#define _DEFAULT_SOURCE
#include "host/base/folder_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>

#include "host/base/memory.h"
#include "support/files.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
}

static int opened(const char *folder)
{
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY);
    TEST_ASSERT_TRUE(descriptor >= 0);
    return descriptor;
}

/* Whether another file description, as of another process, gets the lock; it is let go at once. */
static bool is_free(const char *folder)
{
    const int descriptor = opened(folder);
    const bool got = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    close(descriptor);
    return got;
}

static hci_folder_lock *take(const char *folder, bool expect_alone)
{
    bool is_alone = !expect_alone;
    hci_folder_lock *lock = hci_folder_lock_take(folder, 0, &is_alone);
    TEST_ASSERT_NOT_NULL(lock);
    TEST_ASSERT_EQUAL(expect_alone, is_alone);
    return lock;
}

static void test_it_is_kept_until_it_was_let_go_as_often(void)
{
    hci_folder_lock *lock = take(files_root, true);
    TEST_ASSERT_EQUAL_PTR(lock, take(files_root, false));
    TEST_ASSERT_EQUAL_PTR(lock, take(files_root, false));
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_FALSE(is_free(files_root));
        hci_folder_lock_release(lock);
    }
    TEST_ASSERT_TRUE(is_free(files_root));
    hci_folder_lock_release(take(files_root, true));
    TEST_ASSERT_TRUE(is_free(files_root));
}

/* Of two folders each is its own, in whatever order they are let go. */
static void test_two_folders(void)
{
    char other[512];
    snprintf(other, sizeof other, "%s", files_path("other"));
    TEST_ASSERT_EQUAL_INT(0, mkdir(other, 0700));
    for (int order = 0; order < 2; ++order) {
        hci_folder_lock *first = take(files_root, true), *second = take(other, true);
        TEST_ASSERT_TRUE(first != second);
        hci_folder_lock_release(order ? first : second);
        TEST_ASSERT_EQUAL(order, is_free(files_root));
        TEST_ASSERT_EQUAL(!order, is_free(other));
        hci_folder_lock_release(order ? second : first);
        TEST_ASSERT_TRUE(is_free(files_root) && is_free(other));
    }
}

static void test_what_another_one_holds(void)
{
    bool is_alone = true;
    const int held = opened(files_root);
    TEST_ASSERT_EQUAL_INT(0, flock(held, LOCK_EX | LOCK_NB));
    TEST_ASSERT_NULL(hci_folder_lock_take(files_root, 0, &is_alone));
    TEST_ASSERT_EQUAL_INT(EWOULDBLOCK, errno);
    TEST_ASSERT_FALSE(is_alone);
    TEST_ASSERT_NULL(hci_folder_lock_take(files_root, 15, &is_alone));
    TEST_ASSERT_EQUAL_INT(EWOULDBLOCK, errno);
    close(held);
    hci_folder_lock_release(take(files_root, true));
}

static void test_no_folder_and_no_memory(void)
{
    bool is_alone = true;
    TEST_ASSERT_NULL(hci_folder_lock_take(files_path("none"), 0, &is_alone));
    TEST_ASSERT_EQUAL_INT(ENOENT, errno);
    TEST_ASSERT_FALSE(is_alone);
    hci_memory_fail_after(0);
    TEST_ASSERT_NULL(hci_folder_lock_take(files_root, 0, &is_alone));
    TEST_ASSERT_EQUAL_INT(ENOMEM, errno);
    hci_memory_fail_after(-1);
    (void)hci_memory_was_short();
    TEST_ASSERT_TRUE(is_free(files_root));
    hci_folder_lock_release(NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_is_kept_until_it_was_let_go_as_often);
    RUN_TEST(test_two_folders);
    RUN_TEST(test_what_another_one_holds);
    RUN_TEST(test_no_folder_and_no_memory);
    return UNITY_END();
}
