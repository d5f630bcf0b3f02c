/* Files of a folder of results by the checksums in its summary.json: each that was edited, is gone, or is in
 * a folder within. */
#include "host/currents/own_files.h"

#include <string.h>

#include "host/base/checksum.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_note note;

void setUp(void)
{
    files_begin();
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    (void)hci_memory_was_short();
    files_end();
}

/* The summary of a folder ("" or "x/") with the checksums of a.csv and b.csv as they are. */
static void summarise(const char *folder)
{
    char sum[2][HCI_CHECKSUM_SIZE], name[64], text[512];
    for (int k = 0; k < 2; ++k) {
        snprintf(name, sizeof name, "%s%c.csv", folder, 'a' + k);
        TEST_ASSERT_TRUE(hci_checksum_file(files_path(name), sum[k]));
    }
    snprintf(text, sizeof text, "{\"checksums\": {\"a.csv\": \"%s\", \"b.csv\": \"%s\"}}\n", sum[0], sum[1]);
    snprintf(name, sizeof name, "%ssummary.json", folder);
    files_write(files_path(name), text);
}

static void fill(const char *folder)
{
    char name[64];
    for (int k = 0; k < 2; ++k) {
        snprintf(name, sizeof name, "%s%c.csv", folder, 'a' + k);
        files_write(files_path(name), k ? "two\n" : "one\n");
    }
    summarise(folder);
}

static hci_status check_folder(void)
{
    memset(&note, 0, sizeof note);
    return hci_own_folder_check(files_root, "write it again", &note);
}

static void is_refused(hci_status status, const char *begins, const char *words)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, status);
    text_has(begins, note.text);
    text_has(words, note.text);
    text_has("; write it again", note.text);
}

static void test_all_files_of_a_folder(void)
{
    fill("");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    files_write(files_path("other.csv"), "not of the set\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    for (int k = 0; k < 2; ++k) {
        const char *name = k ? "b.csv" : "a.csv";
        fill("");
        files_write(files_path(name), "edited\n");
        is_refused(check_folder(), name, ": found a file with the checksum ");
        remove(files_path(name));
        is_refused(check_folder(), name, ": cannot be read (No such file or directory), expected the file");
    }
}

/* The folder itself needs one with checksums. */
static void test_a_folder_without_a_summary(void)
{
    fill("");
    remove(files_path("summary.json"));
    is_refused(check_folder(), "/summary.json", ": found none with the checksums of the files beside it");
    files_write(files_path("summary.json"), "{\"checksums\": 3}\n");
    is_refused(check_folder(), "/summary.json", ": found none with the checksums of the files beside it");
    is_refused(hci_own_folder_check(files_path("none"), "write it again", &note), "/summary.json",
               "found none");
}

/* Folders within that have a summary are looked into, however deep; those without, hidden ones and links are
 * not. */
static void test_folders_within(void)
{
    fill("");
    mkdir(files_path("x"), 0700);
    mkdir(files_path("x/y"), 0700);
    mkdir(files_path(".h"), 0700);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    fill("x/y/");
    fill(".h/");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    files_write(files_path(".h/a.csv"), "edited\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    TEST_ASSERT_EQUAL_INT(0, symlink("x", files_path("link")));
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check_folder(), note.text);
    files_write(files_path("x/y/b.csv"), "edited\n");
    is_refused(check_folder(), "x/y/b.csv", ": found a file with the checksum ");
    fill("x/y/");
    fill("x/");
    files_write(files_path("x/a.csv"), "edited\n");
    is_refused(check_folder(), "x/a.csv", ": found a file with the checksum ");
}

/* One file: what its summary does not name, and what is not there, is for others to say. */
static void test_one_file(void)
{
    char path[512];
    fill("");
    snprintf(path, sizeof path, "%s", files_path("a.csv"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_own_file_check_beside(path, "write it again", &note));
    files_write(path, "edited\n");
    is_refused(hci_own_file_check_beside(path, "write it again", &note), "a.csv",
               "as summary.json beside it");
    remove(path);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_own_file_check_beside(path, "write it again", &note));
    files_write(files_path("c.csv"), "not named\n");
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_own_file_check_beside(files_path("c.csv"), "write it again", &note));
    files_write(path, "edited\n");
    remove(files_path("summary.json"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_own_file_check_beside(path, "write it again", &note));
}

static void test_paths_that_are_too_long(void)
{
    static char folder[4096 + 64];
    memset(folder, 'f', sizeof folder - 1);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_own_folder_check(folder, "write it again", &note));
    text_has("…: the path is too long", note.text);
}

/* Memory that fails is said, and nothing is taken for well or for another file. */
static void test_memory(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    fill("");
    for (long k = 0; status != HCI_OK && k < 100; ++k) {
        hci_memory_fail_after(k);
        status = check_folder();
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_TRUE(k > 0 || status == HCI_ERROR_MEMORY);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_files_of_a_folder);
    RUN_TEST(test_a_folder_without_a_summary);
    RUN_TEST(test_folders_within);
    RUN_TEST(test_one_file);
    RUN_TEST(test_paths_that_are_too_long);
    RUN_TEST(test_memory);
    return UNITY_END();
}
