/* Sets of output files: whole or not at all, whatever goes wrong on the way. */
#include "hci/host/base/output.h"

#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/memory.h"
#include "support/files.h"
#include "unity.h"

static int first_free;

void setUp(void)
{
    first_free = files_next_descriptor();
    files_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
    TEST_ASSERT_EQUAL_MESSAGE(first_free, files_next_descriptor(), "a file is left open");
}

static void assert_holds(const char *path, const char *text)
{
    TEST_ASSERT_EQUAL_STRING(text, files_read(path));
}

static hci_output *open_set(const char *folder)
{
    hci_note note = {0};
    hci_output *output;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_open(folder, &output, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", note.text);
    return output;
}

static void start(hci_output *output, const char *name, const char *text)
{
    hci_note note = {0};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_file(output, name, &note), note.text);
    hci_output_text(output, "%s", text);
}

static hci_output *two_files(const char *folder)
{
    hci_output *output = open_set(folder);
    start(output, "a.csv", "new a\n");
    start(output, "b.csv", "new b\n");
    return output;
}

/* ---- what succeeds ---- */

static void test_a_set_appears_at_the_commit(void)
{
    hci_note note = {0};
    hci_output *output = two_files(files_path("out"));
    TEST_ASSERT_EQUAL(-1, access(files_path("out/a.csv"), F_OK));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_commit(output, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", note.text);
    assert_holds(files_path("out/a.csv"), "new a\n");
    assert_holds(files_path("out/b.csv"), "new b\n");
    TEST_ASSERT_EQUAL(2, files_count(files_path("out")));
}

static void test_older_files_are_replaced(void)
{
    files_write(files_path("a.csv"), "a much longer old text\n");
    files_write(files_path("c.csv"), "other\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(two_files(files_root), NULL));
    assert_holds(files_path("a.csv"), "new a\n");
    assert_holds(files_path("c.csv"), "other\n");
    TEST_ASSERT_EQUAL(3, files_count(files_root));
}

static void test_folders_are_made_with_their_parents(void)
{
    static const char *const spelling[] = {"p/q/r", "p2/q/", "p3//q///r//", "./p4/../p5/q"};
    for (size_t k = 0; k < sizeof spelling / sizeof *spelling; k++) {
        char file[256];
        TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(two_files(files_path(spelling[k])), NULL));
        snprintf(file, sizeof file, "%s/a.csv", files_path(spelling[k]));
        assert_holds(file, "new a\n");
    }
}

static void test_a_relative_folder_is_below_the_current_one(void)
{
    char before[1024];
    TEST_ASSERT_NOT_NULL(getcwd(before, sizeof before));
    TEST_ASSERT_EQUAL(0, chdir(files_root));
    const hci_status here = hci_output_commit(two_files("."), NULL);
    const hci_status below = hci_output_commit(two_files("x/y"), NULL);
    TEST_ASSERT_EQUAL(0, chdir(before));
    TEST_ASSERT_EQUAL(HCI_OK, here);
    TEST_ASSERT_EQUAL(HCI_OK, below);
    assert_holds(files_path("b.csv"), "new b\n");
    assert_holds(files_path("x/y/b.csv"), "new b\n");
}

static void test_files_have_the_mode_of_ordinary_files(void)
{
    struct stat status;
    const mode_t old = umask(027);
    hci_output *output = two_files(files_root);
    umask(old);
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(output, NULL));
    TEST_ASSERT_EQUAL(0, stat(files_path("a.csv"), &status));
    TEST_ASSERT_EQUAL_HEX(0640, status.st_mode & 0777);
}

static void test_folders_have_the_mode_of_ordinary_folders(void)
{
    struct stat status;
    const mode_t old = umask(027);
    const hci_status committed = hci_output_commit(two_files(files_path("m/n")), NULL);
    umask(old);
    TEST_ASSERT_EQUAL(HCI_OK, committed);
    TEST_ASSERT_EQUAL(0, stat(files_path("m"), &status));
    TEST_ASSERT_EQUAL_HEX(0750, status.st_mode & 07777);
}

static void test_numbers_come_with_their_separator(void)
{
    hci_output *output = open_set(files_root);
    start(output, "n.csv", "order,amplitude_V\n");
    hci_output_number(output, 1, ',');
    hci_output_number(output, 0.1 + 0.2, '\n');
    hci_output_number(output, -DBL_MAX, ',');
    hci_output_number(output, 1e-7, '\n');
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(output, NULL));
    assert_holds(files_path("n.csv"),
                 "order,amplitude_V\n1,0.30000000000000004\n-1.7976931348623157e308,1e-7\n");
}

static void collect(void *context, const char *name, const char *checksum)
{
    char *text = context;
    snprintf(text + strlen(text), 256 - strlen(text), "%s %s;", name, checksum);
}

/* Expected: what the command cksum prints. */
static void test_checksums_are_those_of_cksum(void)
{
    char text[256] = "";
    hci_note note = {0};
    hci_output *output = open_set(files_root);
    start(output, "a.csv", "123456789");
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_without(output, "gone.csv", &note));
    start(output, "b.csv", "");
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_checksums(output, collect, text, &note));
    TEST_ASSERT_EQUAL_STRING("a.csv 930766865 9;b.csv 4294967295 0;", text);
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(output, &note));
}

static void test_an_empty_set_leaves_its_folder(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(open_set(files_path("out")), NULL));
    TEST_ASSERT_EQUAL(0, files_count(files_path("out")));
}

/* ---- what is taken back ---- */

static void test_a_discarded_set_leaves_nothing(void)
{
    hci_output_discard(NULL);
    hci_output_discard(two_files(files_path("p/q/r")));
    TEST_ASSERT_EQUAL(0, files_count(files_root));
    files_write(files_path("a.csv"), "old a\n");
    hci_output_discard(two_files(files_root));
    assert_holds(files_path("a.csv"), "old a\n");
    TEST_ASSERT_EQUAL(1, files_count(files_root));
}

static void test_only_own_and_empty_folders_are_removed(void)
{
    TEST_ASSERT_EQUAL(0, mkdir(files_path("p"), 0777));
    hci_output *output = two_files(files_path("p/q/r"));
    files_write(files_path("p/q/theirs"), "");
    hci_output_discard(output);
    TEST_ASSERT_EQUAL(1, files_count(files_path("p")));
    TEST_ASSERT_EQUAL(1, files_count(files_path("p/q")));
    hci_output_discard(two_files(files_path("p/s")));
    TEST_ASSERT_EQUAL(1, files_count(files_path("p")));
}

/* The second rename of the commit fails: the first is undone, be its target old or new. */
static void test_a_failed_rename_undoes_those_before(void)
{
    for (int old = 0; old < 2; old++) {
        char expected[256];
        hci_note note = {0};
        if (old) files_write(files_path("a.csv"), "old a\n");
        hci_output *output = two_files(files_root);
        TEST_ASSERT_EQUAL(0, mkdir(files_path("b.csv"), 0777));
        TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_output_commit(output, &note));
        snprintf(expected, sizeof expected,
                 "%s: cannot be written: found a folder of this name; remove or rename it",
                 files_path("b.csv"));
        TEST_ASSERT_EQUAL_STRING(expected, note.text);
        if (old) assert_holds(files_path("a.csv"), "old a\n");
        TEST_ASSERT_EQUAL(1 + old, files_count(files_root));
        TEST_ASSERT_EQUAL(0, rmdir(files_path("b.csv")));
    }
}

/* The temporary file of b.csv vanishes, so that its rename fails after its older target has been set aside.
 */
static void test_a_rename_that_fails_by_itself_keeps_the_older_file(void)
{
    files_write(files_path("a.csv"), "old a\n");
    files_write(files_path("b.csv"), "old b\n");
    char temporary[256];
    hci_note note = {0};
    hci_output *output = two_files(files_root);
    snprintf(temporary, sizeof temporary, "%s/.hci-%ld-1.tmp", files_root, (long)getpid());
    TEST_ASSERT_EQUAL(0, unlink(temporary));
    TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_output_commit(output, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "b.csv: cannot be written: No such file or directory"));
    assert_holds(files_path("a.csv"), "old a\n");
    assert_holds(files_path("b.csv"), "old b\n");
    TEST_ASSERT_EQUAL(2, files_count(files_root));
}

/* What a process has left that was killed: temporary files go, a backup may be the only copy of a file. */
static void test_left_over_files(void)
{
    char temporary[256], backup[256];
    files_write(files_path("a.csv"), "old a\n");
    snprintf(temporary, sizeof temporary, "%s/.hci-7-0.tmp", files_root);
    snprintf(backup, sizeof backup, "%s/.hci-%ld-0.old", files_root, (long)getpid());
    files_write(temporary, "left over\n");
    files_write(backup, "precious\n");
    hci_output *output = open_set(files_root);
    TEST_ASSERT_EQUAL(-1, access(temporary, F_OK));
    start(output, "a.csv", "new a\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_output_commit(output, NULL));
    assert_holds(backup, "precious\n");
    assert_holds(files_path("a.csv"), "old a\n");
}

/* A journal by hand, as it stands in the folder when a process is killed behind the first of three steps. */
static void leave_a_journal(void)
{
    files_write(files_path("a.csv"), "new a\n");
    files_write(files_path("b.csv"), "old b\n");
    files_write(files_path("c.csv"), "old c\n");
    files_write(files_path(".hci-7-0.old"), "old a\n");
    files_write(files_path(".hci-7-1.tmp"), "new b\n");
    files_write(files_path(".hci-7-2.tmp"), "");
    files_write(files_path(".hci-journal"), "rename\t.hci-7-0.tmp\t.hci-7-0.old\ta.csv\n"
                                            "rename\t.hci-7-1.tmp\t.hci-7-1.old\tb.csv\n"
                                            "remove\t.hci-7-2.tmp\t.hci-7-2.old\tc.csv\n");
}

/* A process that was killed while it wrote its journal has done nothing yet; a link in its place is not
 * followed. */
static void test_a_journal_that_was_not_begun_is_nothing(void)
{
    for (int is_link = 0; is_link < 2; is_link++) {
        const char *draft = files_path(".hci-journal.tmp");
        hci_output *output = two_files(files_root);
        files_write(files_path("precious"), "precious\n");
        if (is_link)
            TEST_ASSERT_EQUAL(0, symlink("precious", draft));
        else
            files_write(draft, "remove\t.hci-7-0.tmp\t.hci-7-0.old\tprecious\n");
        TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(output, NULL));
        assert_holds(files_path("a.csv"), "new a\n");
        assert_holds(files_path("b.csv"), "new b\n");
        assert_holds(files_path("precious"), "precious\n");
        TEST_ASSERT_EQUAL(3, files_count(files_root));
    }
}

static void assert_is_ended(void)
{
    assert_holds(files_path("a.csv"), "new a\n");
    assert_holds(files_path("b.csv"), "new b\n");
    TEST_ASSERT_EQUAL(2, files_count(files_root));
}

static void test_a_set_that_was_interrupted_is_ended(void)
{
    leave_a_journal();
    hci_output_finish_interrupted(files_root);
    assert_is_ended();
    leave_a_journal();
    hci_output_discard(open_set(files_root));
    assert_is_ended();
    hci_output_finish_interrupted(files_root);
    assert_is_ended();
}

/* Nothing outside of the folder is touched, and no file that is not ours is renamed. */
static void test_a_journal_of_others_is_not_followed(void)
{
    static const char *const STEP[] = {"rename\t.hci-7-0.tmp\t.hci-7-0.old\t../b.csv\n",
                                       "rename\tprecious\t.hci-7-0.old\tb.csv\n",
                                       "remove\t.hci-7-0.tmp\tprecious\tb.csv\n",
                                       "remove\tto/.hci-7-0.tmp\tto/.hci-7-0.old\tto/precious\n",
                                       "remove\t/.hci-7-0.tmp\t/.hci-7-0.old\t/precious\n",
                                       "remove\t./.hci-7-0.tmp\t./.hci-7-0.old\t./precious\n",
                                       "rename\n",
                                       "\n"};
    TEST_ASSERT_EQUAL(0, symlink(".", files_path("to")));
    for (size_t k = 0; k < sizeof STEP / sizeof *STEP; k++) {
        files_write(files_path("precious"), "precious\n");
        files_write(files_path(".hci-7-0.tmp"), "new\n");
        files_write(files_path(".hci-journal"), STEP[k]);
        hci_output_finish_interrupted(files_root);
        TEST_ASSERT_EQUAL_MESSAGE(4, files_count(files_root), STEP[k]);
    }
}

/* A folder within goes along, and whoever comes to it first ends the set. */
static void test_a_set_with_a_folder_within_is_ended(void)
{
    for (int k = 0; k < 2; k++) {
        TEST_ASSERT_EQUAL(0, mkdir(files_path("m"), 0777));
        files_write(files_path("a.csv"), "old a\n");
        files_write(files_path(".hci-7-0.tmp"), "new a\n");
        files_write(files_path("m/b.csv"), "old b\n");
        files_write(files_path("m/.hci-7-0.tmp"), "new b\n");
        files_write(files_path(".hci-journal"), "rename\tm/.hci-7-0.tmp\tm/.hci-7-0.old\tm/b.csv\n"
                                                "rename\t.hci-7-0.tmp\t.hci-7-0.old\ta.csv\n");
        if (k == 0) hci_output_finish_interrupted(files_path("m"));
        if (k == 1) hci_output_discard(open_set(files_path("m")));
        assert_holds(files_path("a.csv"), "new a\n");
        assert_holds(files_path("m/b.csv"), "new b\n");
        TEST_ASSERT_EQUAL(2, files_count(files_root));
        files_remove(files_path("m"));
    }
}

static hci_output *set_of(const char *folder, const char *name)
{
    hci_output *output = open_set(folder);
    start(output, name, "new\n");
    return output;
}

static void test_sets_appear_together_or_not_at_all(void)
{
    for (int fails = 1; fails >= 0; fails--) {
        hci_output *set[2];
        set[1] = set_of(files_root, "a.csv");
        set[0] = set_of(files_path("m"), "b.csv");
        if (fails) TEST_ASSERT_EQUAL(0, mkdir(files_path("a.csv"), 0777));
        TEST_ASSERT_EQUAL(fails ? HCI_ERROR_OUTPUT : HCI_OK, hci_output_commit_together(set, 2, NULL));
        TEST_ASSERT_EQUAL(fails ? 1 : 2, files_count(files_root));
        if (fails) TEST_ASSERT_EQUAL(0, rmdir(files_path("a.csv")));
    }
    assert_holds(files_path("a.csv"), "new\n");
    assert_holds(files_path("m/b.csv"), "new\n");
}

static char journal_path[256];
static int renamed, journal_stood;

/* In place of that of the C library: whether a journal stands while a file of a set takes its place. */
int rename(const char *from, const char *to)
{
    if (strcmp(to + strlen(to) - 4, ".csv") == 0) {
        renamed++;
        journal_stood += access(journal_path, F_OK) == 0;
    }
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

/* Two files in two folders need the journal as two files in one do: between both a process may be killed. */
static void test_sets_of_one_file_have_a_journal(void)
{
    hci_output *set[2];
    TEST_ASSERT_EQUAL(0, mkdir(files_path("m"), 0777));
    files_write(files_path("a.csv"), "old\n");
    files_write(files_path("m/b.csv"), "old\n");
    snprintf(journal_path, sizeof journal_path, "%s/.hci-journal", files_root);
    set[1] = set_of(files_root, "a.csv");
    set[0] = set_of(files_path("m"), "b.csv");
    renamed = journal_stood = 0;
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit_together(set, 2, NULL));
    TEST_ASSERT_EQUAL(2, renamed);
    TEST_ASSERT_EQUAL(2, journal_stood);
    assert_holds(files_path("m/b.csv"), "new\n");
    TEST_ASSERT_EQUAL(2, files_count(files_root)); /* and is gone */
}

/* What had no memory may be missing in it. */
static void test_a_set_for_which_memory_was_short_is_not_written(void)
{
    hci_note note = {0};
    hci_output *output = two_files(files_root);
    hci_memory_fail_once_after(0);
    TEST_ASSERT_NULL(hci_memory_new(1, 1));
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_output_commit(output, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "out of memory"));
    TEST_ASSERT_EQUAL(0, files_count(files_root));
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(two_files(files_root), NULL));
}

/* A pipe that nobody writes into would hold the process up, behind signals that wait. */
static void test_a_journal_that_is_no_plain_file_is_left(void)
{
    for (int kind = 0; kind < 2; kind++) {
        const char *journal = files_path(".hci-journal");
        TEST_ASSERT_EQUAL(0, kind ? symlink("/dev/zero", journal) : mkfifo(journal, 0666));
        alarm(5);
        hci_output_finish_interrupted(files_root);
        TEST_ASSERT_EQUAL(0, access(files_path(".hci-journal"), F_OK));
        hci_output *output = open_set(files_root);
        start(output, "a.csv", "new a\n");
        start(output, "b.csv", "new b\n");
        TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(output, NULL));
        alarm(0);
        TEST_ASSERT_EQUAL(2, files_count(files_root));
    }
}

/* ---- what is refused ---- */

static void assert_refused(const char *folder, const char *name, hci_status expected, const char *reason)
{
    hci_note note = {0};
    hci_output *output = NULL;
    hci_status status = hci_output_open(folder, &output, &note);
    TEST_ASSERT_TRUE((status == HCI_OK) == (output != NULL));
    if (status == HCI_OK) status = hci_output_file(output, name, &note);
    hci_output_discard(output);
    TEST_ASSERT_EQUAL_MESSAGE(expected, status, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, reason), note.text);
}

static void test_folders_that_cannot_be_are_refused(void)
{
    files_write(files_path("file"), "old\n");
    TEST_ASSERT_EQUAL(0, symlink("nowhere", files_path("dangling")));
    assert_refused(files_path("file"), "a", HCI_ERROR_OUTPUT, "File exists; give a folder that can be made");
    assert_refused(files_path("file/x/y"), "a", HCI_ERROR_OUTPUT, "cannot be written");
    assert_refused(files_path("dangling"), "a", HCI_ERROR_OUTPUT, "cannot be written");
    assert_refused(files_path("new/../file/x"), "a", HCI_ERROR_OUTPUT, "cannot be written");
    assert_refused("", "a", HCI_ERROR_OUTPUT, "the folder has no name; name one, or . for this one");
    assert_holds(files_path("file"), "old\n");
    TEST_ASSERT_EQUAL(2, files_count(files_root));
}

static void test_only_plain_files_are_replaced(void)
{
    TEST_ASSERT_EQUAL(0, mkdir(files_path("folder"), 0777));
    TEST_ASSERT_EQUAL(0, mkfifo(files_path("pipe"), 0666));
    TEST_ASSERT_EQUAL(0, symlink("/dev/null", files_path("link")));
    assert_refused(files_root, "folder", HCI_ERROR_OUTPUT,
                   "found a folder of this name; remove or rename it");
    assert_refused(files_root, "pipe", HCI_ERROR_OUTPUT, "found something that is not a plain file");
    assert_refused(files_root, "link", HCI_ERROR_OUTPUT, "found something that is not a plain file");
    TEST_ASSERT_EQUAL(3, files_count(files_root));
}

static void test_names_have_no_folder_part(void)
{
    static const char *const names[] = {"", ".", "..", "a/b", "/etc/a", "../a", "a/"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        assert_refused(files_root, names[k], HCI_ERROR_ARGUMENT,
                       "expected the name of a new output file without a folder");
    }
    hci_output *output = two_files(files_root);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_output_file(output, "a.csv", NULL));
    hci_output_discard(output);
    TEST_ASSERT_EQUAL(0, files_count(files_root));
}

/* The super-user may write everywhere, so the test steps down for a moment. */
static void test_write_protection_is_respected(void)
{
    const bool super = geteuid() == 0;
    files_write(files_path("a.csv"), "old a\n");
    TEST_ASSERT_EQUAL(0, chmod(files_path("a.csv"), 0444));
    TEST_ASSERT_EQUAL(0, chmod(files_root, 0777));
    if (super) TEST_ASSERT_EQUAL(0, seteuid(65534));
    assert_refused(files_root, "a.csv", HCI_ERROR_OUTPUT, "Permission denied; make the file writable");
    if (super) TEST_ASSERT_EQUAL(0, seteuid(0));
    TEST_ASSERT_EQUAL(0, chmod(files_root, 0555));
    if (super) TEST_ASSERT_EQUAL(0, seteuid(65534));
    assert_refused(files_root, "b.csv", HCI_ERROR_OUTPUT, "Permission denied; check the folder");
    assert_refused(files_path("below"), "b.csv", HCI_ERROR_OUTPUT,
                   "Permission denied; give a folder that can be made");
    if (super) TEST_ASSERT_EQUAL(0, seteuid(0));
    TEST_ASSERT_EQUAL(0, chmod(files_root, 0777));
    assert_holds(files_path("a.csv"), "old a\n");
    TEST_ASSERT_EQUAL(1, files_count(files_root));
}

static void test_a_number_that_is_not_finite_is_not_written(void)
{
    const double values[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t k = 0; k < 3; k++) {
        hci_note note = {0};
        hci_output *output = two_files(files_path("out"));
        hci_output_number(output, values[k], '\n');
        TEST_ASSERT_EQUAL(HCI_ERROR_NOT_FINITE, hci_output_commit(output, &note));
        TEST_ASSERT_NOT_NULL(
            strstr(note.text, "out/b.csv: not written: a result is infinite or not a number"));
        TEST_ASSERT_EQUAL(0, files_count(files_root));
    }
}

/* A limit on the size of files stands for a full disk: the write fails with EFBIG. */
static void set_size_limit(rlim_t bytes)
{
    struct rlimit limit;
    TEST_ASSERT_EQUAL(0, getrlimit(RLIMIT_FSIZE, &limit));
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    TEST_ASSERT_EQUAL(0, setrlimit(RLIMIT_FSIZE, &limit));
}

/* What has been said may be small enough to wait in a buffer until the file is closed, or may not. The full
 * file may be the last one or not. */
static void test_a_full_disk_leaves_nothing(void)
{
    static const size_t lines[] = {5, 500, 50000};
    signal(SIGXFSZ, SIG_IGN);
    for (size_t k = 0; k < 6; k++) {
        hci_note note = {0};
        files_write(files_path("a.csv"), "old a\n");
        hci_output *output = open_set(files_root);
        start(output, "a.csv", "new a\n");
        set_size_limit(16);
        for (size_t n = 0; n < lines[k / 2]; n++)
            hci_output_number(output, 1.0 / 3, '\n');
        if (k % 2) start(output, "b.csv", "b\n");
        const hci_status status = hci_output_commit(output, &note);
        set_size_limit(RLIM_INFINITY);
        TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, status);
        TEST_ASSERT_NOT_NULL_MESSAGE(
            strstr(note.text,
                   "a.csv: cannot be written: File too large; free some space or name another folder"),
            note.text);
        assert_holds(files_path("a.csv"), "old a\n");
        TEST_ASSERT_EQUAL(1, files_count(files_root));
    }
}

static hci_status write_set(hci_note *note)
{
    hci_output *output;
    hci_status status = hci_output_open(files_path("p/q"), &output, note);
    if (status == HCI_OK) status = hci_output_file(output, "a.csv", note);
    if (status == HCI_OK) hci_output_text(output, "new a\n");
    if (status == HCI_OK) status = hci_output_file(output, "b.csv", note);
    if (status == HCI_OK) return hci_output_commit(output, note);
    hci_output_discard(output);
    return status;
}

static void test_every_allocation_may_fail(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    long failures = 0;
    for (; status != HCI_OK; failures++) {
        hci_note note = {0};
        hci_memory_fail_after(failures);
        status = write_set(&note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_TRUE(status == HCI_OK || strstr(note.text, "out of memory") != NULL);
        TEST_ASSERT_EQUAL(status == HCI_OK ? 1 : 0, files_count(files_root));
    }
    assert_holds(files_path("p/q/a.csv"), "new a\n");
    TEST_ASSERT_TRUE(failures > 8);
}

/* ---- signals ---- */

static void assert_no_signal_waits(void)
{
    sigset_t held;
    TEST_ASSERT_EQUAL(0, sigprocmask(SIG_BLOCK, NULL, &held));
    TEST_ASSERT_FALSE(sigismember(&held, SIGINT) || sigismember(&held, SIGTERM));
}

/* What a handler of Ctrl-C leaves: sets inside one another, in folders of their own and in one that was
 * there. */
static void test_abandoned_sets_leave_nothing(void)
{
    hci_note note = {0};
    files_write(files_path("a.csv"), "old\n");
    hci_output *done = two_files(files_path("done"));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_commit(done, &note), note.text);
    hci_output *here = two_files(files_root), *outer = two_files(files_path("made/for/it"));
    hci_output *gone = two_files(files_path("made/gone")),
               *inner = two_files(files_path("made/for/it/machine"));
    hci_output_discard(gone);
    assert_no_signal_waits();
    hci_output_abandon();
    TEST_ASSERT_EQUAL(-1, files_count(files_path("made")));
    TEST_ASSERT_EQUAL(2, files_count(files_path("done")));
    TEST_ASSERT_EQUAL(2, files_count(files_root)); /* a.csv and done */
    assert_holds(files_path("a.csv"), "old\n");
    hci_output_discard(inner);
    hci_output_discard(here);
    hci_output_discard(outer);
    assert_no_signal_waits();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_set_appears_at_the_commit);
    RUN_TEST(test_older_files_are_replaced);
    RUN_TEST(test_folders_are_made_with_their_parents);
    RUN_TEST(test_a_relative_folder_is_below_the_current_one);
    RUN_TEST(test_files_have_the_mode_of_ordinary_files);
    RUN_TEST(test_folders_have_the_mode_of_ordinary_folders);
    RUN_TEST(test_numbers_come_with_their_separator);
    RUN_TEST(test_checksums_are_those_of_cksum);
    RUN_TEST(test_an_empty_set_leaves_its_folder);
    RUN_TEST(test_a_discarded_set_leaves_nothing);
    RUN_TEST(test_only_own_and_empty_folders_are_removed);
    RUN_TEST(test_a_failed_rename_undoes_those_before);
    RUN_TEST(test_a_rename_that_fails_by_itself_keeps_the_older_file);
    RUN_TEST(test_left_over_files);
    RUN_TEST(test_a_journal_that_was_not_begun_is_nothing);
    RUN_TEST(test_a_set_that_was_interrupted_is_ended);
    RUN_TEST(test_a_journal_of_others_is_not_followed);
    RUN_TEST(test_a_set_for_which_memory_was_short_is_not_written);
    RUN_TEST(test_a_set_with_a_folder_within_is_ended);
    RUN_TEST(test_sets_appear_together_or_not_at_all);
    RUN_TEST(test_sets_of_one_file_have_a_journal);
    RUN_TEST(test_a_journal_that_is_no_plain_file_is_left);
    RUN_TEST(test_folders_that_cannot_be_are_refused);
    RUN_TEST(test_only_plain_files_are_replaced);
    RUN_TEST(test_names_have_no_folder_part);
    RUN_TEST(test_write_protection_is_respected);
    RUN_TEST(test_a_number_that_is_not_finite_is_not_written);
    RUN_TEST(test_a_full_disk_leaves_nothing);
    RUN_TEST(test_every_allocation_may_fail);
    RUN_TEST(test_abandoned_sets_leave_nothing);
    return UNITY_END();
}
