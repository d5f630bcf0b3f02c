/* A journal is brought to its end by who comes next: step by step, whatever of it was done already, and not
 * where a line is not one of ours. */
#define _POSIX_C_SOURCE 200809L
#include "host/base/journal.h"

#include <errno.h>
#include <sys/stat.h>

#include "support/files.h"
#include "unity.h"

#define JOURNAL ".hci-journal"

static char folder[64];

void setUp(void)
{
    files_begin();
    snprintf(folder, sizeof folder, "%s", files_root);
    mkdir(files_path("x"), 0700);
}

void tearDown(void)
{
    files_end();
}

static bool is_there(const char *name)
{
    struct stat status;
    return lstat(files_path(name), &status) == 0;
}

static void make(const char *name, const char *text)
{
    files_write(files_path(name), text);
}

static bool finish(const char *journal)
{
    make(JOURNAL, journal);
    errno = 0;
    return hci_journal_finish(folder);
}

static void test_there_is_none(void)
{
    TEST_ASSERT_FALSE(hci_journal_exists(folder));
    TEST_ASSERT_TRUE(hci_journal_finish(folder));
    TEST_ASSERT_TRUE(hci_journal_finish(files_path("none")));
}

/* One that is written is there when it has begun, and gone when it has ended. */
static void test_written_and_finished(void)
{
    make(".hci-1", "new");
    make(".hci-b1", "backup");
    make("a.csv", "old");
    make(".hci-2", "half");
    make(".hci-b2", "backup");
    make("b.csv", "superfluous");
    FILE *journal = hci_journal_open(folder);
    TEST_ASSERT_NOT_NULL(journal);
    hci_journal_step(journal, false, ".hci-1", ".hci-b1", "a.csv");
    hci_journal_step(journal, true, ".hci-2", ".hci-b2", "b.csv");
    TEST_ASSERT_FALSE(hci_journal_exists(folder));
    TEST_ASSERT_TRUE(hci_journal_begin(folder, journal));
    TEST_ASSERT_TRUE(hci_journal_exists(folder));
    TEST_ASSERT_EQUAL_STRING("rename\t.hci-1\t.hci-b1\ta.csv\nremove\t.hci-2\t.hci-b2\tb.csv\n",
                             files_read(files_path(JOURNAL)));
    TEST_ASSERT_TRUE(hci_journal_finish(folder));
    TEST_ASSERT_EQUAL_STRING("new", files_read(files_path("a.csv")));
    TEST_ASSERT_EQUAL_INT(2, files_count(folder)); /* a.csv and x */
    TEST_ASSERT_TRUE(hci_journal_finish(folder));
}

static void test_one_that_ends_by_itself(void)
{
    FILE *journal = hci_journal_open(folder);
    hci_journal_step(journal, false, ".hci-1", ".hci-b1", "a.csv");
    TEST_ASSERT_TRUE(hci_journal_begin(folder, journal));
    hci_journal_end(folder);
    TEST_ASSERT_FALSE(hci_journal_exists(folder));
    TEST_ASSERT_EQUAL_INT(1, files_count(folder));
}

/* What was done already is passed over. */
static void test_steps_that_were_done(void)
{
    make("a.csv", "new");
    TEST_ASSERT_TRUE(finish("rename\t.hci-1\t.hci-b1\ta.csv\nremove\t.hci-2\t.hci-b2\tb.csv\n"));
    TEST_ASSERT_EQUAL_STRING("new", files_read(files_path("a.csv")));
    TEST_ASSERT_FALSE(is_there(JOURNAL));
}

/* In a folder within, all three names in it. */
static void test_a_folder_within(void)
{
    make("x/.hci-1", "new");
    make("x/.hci-b1", "backup");
    TEST_ASSERT_TRUE(finish("rename\tx/.hci-1\tx/.hci-b1\tx/a.csv\n"));
    TEST_ASSERT_EQUAL_STRING("new", files_read(files_path("x/a.csv")));
    TEST_ASSERT_EQUAL_INT(1, files_count(files_path("x")));
}

/* Names that are not ours, that lead elsewhere, or are missing: nothing is done, and the journal stays. */
static void test_lines_that_are_not_ours(void)
{
    static const char *const LINES[] = {
        "rename\ta.tmp\t.hci-b1\ta.csv\n",
        "rename\t.hci-1\tb1\ta.csv\n",
        "rename\t.hci-1\t.hci-b1\n",
        "rename\t.hci-1\t.hci-b1\t\n",
        "rename\t.hci-1\n",
        "\n",
        "rename\tx/.hci-1\t.hci-b1\ta.csv\n",
        "rename\tx/.hci-1\tx/.hci-b1\tx/\n",
        "rename\tx/.hci-1\tx/.hci-b1\tx/y/a.csv\n",
        "rename\ty/.hci-1\ty/.hci-b1\ty/a.csv\n",
        "rename\t../.hci-1\t../.hci-b1\t../a.csv\n",
        "rename\t/.hci-1\t/.hci-b1\t/a.csv\n",
        "rename\tlink/.hci-1\tlink/.hci-b1\tlink/a.csv\n",
        "rename\ta.csv/.hci-1\ta.csv/.hci-b1\ta.csv/a.csv\n",
    };
    TEST_ASSERT_EQUAL_INT(0, symlink("x", files_path("link")));
    for (size_t k = 0; k < sizeof LINES / sizeof *LINES; ++k) {
        make(".hci-1", "new");
        make("x/.hci-1", "new");
        make("a.csv", "old");
        TEST_ASSERT_FALSE_MESSAGE(finish(LINES[k]), LINES[k]);
        TEST_ASSERT_EQUAL_INT_MESSAGE(EINVAL, errno, LINES[k]);
        TEST_ASSERT_TRUE(is_there(JOURNAL) && is_there(".hci-1") && is_there("x/.hci-1"));
        TEST_ASSERT_FALSE(is_there("x/a.csv"));
        TEST_ASSERT_EQUAL_STRING("old", files_read(files_path("a.csv")));
    }
}

/* What cannot be done leaves all that follows, and the journal, for the next who tries. */
static void test_a_step_that_cannot_be_done(void)
{
    make(".hci-1", "new");
    make(".hci-2", "new");
    mkdir(files_path("a.csv"), 0700);
    make("a.csv/b", "in it");
    TEST_ASSERT_FALSE(finish("rename\t.hci-1\t.hci-b1\ta.csv\nrename\t.hci-2\t.hci-b2\tb.csv\n"));
    TEST_ASSERT_TRUE(is_there(JOURNAL) && is_there(".hci-1") && is_there(".hci-2"));
    TEST_ASSERT_FALSE(is_there("b.csv"));
    remove(files_path("a.csv/b"));
    rmdir(files_path("a.csv"));
    TEST_ASSERT_TRUE(hci_journal_finish(folder));
    TEST_ASSERT_TRUE(is_there("a.csv") && is_there("b.csv"));
}

/* A pipe is not waited for, and neither it nor a folder nor a link is a journal. */
static void test_what_is_no_file(void)
{
    TEST_ASSERT_EQUAL_INT(0, mkfifo(files_path(JOURNAL), 0600));
    errno = 0;
    TEST_ASSERT_FALSE(hci_journal_finish(folder));
    TEST_ASSERT_EQUAL_INT(EINVAL, errno);
    remove(files_path(JOURNAL));
    mkdir(files_path(JOURNAL), 0700);
    TEST_ASSERT_FALSE(hci_journal_finish(folder));
    TEST_ASSERT_EQUAL_INT(EINVAL, errno);
    rmdir(files_path(JOURNAL));
    make("a.csv", "remove\t.hci-1\t.hci-b1\ta.csv\n");
    TEST_ASSERT_EQUAL_INT(0, symlink("a.csv", files_path(JOURNAL)));
    TEST_ASSERT_FALSE(hci_journal_finish(folder));
    TEST_ASSERT_TRUE(is_there("a.csv"));
}

/* A draft that a killed process has left, even as a link, is written anew and not followed. */
static void test_a_draft_that_was_left(void)
{
    make("a.csv", "old");
    TEST_ASSERT_EQUAL_INT(0, symlink("a.csv", files_path(JOURNAL ".tmp")));
    FILE *journal = hci_journal_open(folder);
    TEST_ASSERT_NOT_NULL(journal);
    TEST_ASSERT_TRUE(hci_journal_begin(folder, journal));
    TEST_ASSERT_EQUAL_STRING("old", files_read(files_path("a.csv")));
    TEST_ASSERT_FALSE(is_there(JOURNAL ".tmp"));
    TEST_ASSERT_TRUE(hci_journal_finish(folder));
}

static void test_a_path_that_is_too_long(void)
{
    static char name[5000];
    memset(name, 'a', sizeof name - 1);
    errno = 0;
    TEST_ASSERT_NULL(hci_journal_open(name));
    TEST_ASSERT_EQUAL_INT(ENAMETOOLONG, errno);
    TEST_ASSERT_FALSE(hci_journal_finish(name));
    TEST_ASSERT_FALSE(hci_journal_exists(name));
    TEST_ASSERT_NULL(hci_journal_open(files_path("none")));
    TEST_ASSERT_EQUAL_INT(ENOENT, errno);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_there_is_none);
    RUN_TEST(test_written_and_finished);
    RUN_TEST(test_one_that_ends_by_itself);
    RUN_TEST(test_steps_that_were_done);
    RUN_TEST(test_a_folder_within);
    RUN_TEST(test_lines_that_are_not_ours);
    RUN_TEST(test_a_step_that_cannot_be_done);
    RUN_TEST(test_what_is_no_file);
    RUN_TEST(test_a_draft_that_was_left);
    RUN_TEST(test_a_path_that_is_too_long);
    return UNITY_END();
}
