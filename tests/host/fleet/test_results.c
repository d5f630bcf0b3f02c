/* Results of motors in one folder: what a row has in its cells, how it appears, is known again, is checked
 * and forgotten, and what is said of a folder of another command, of other words or of another motor. */
#include "hci/host/fleet/results.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/checksum.h"
#include "host/base/memory.h"
#include "host/fleet/row.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_fleet_list list;
static hci_fleet_results results;
static hci_fleet_digest digest;
static hci_note note;
static char row[HCI_FLEET_ROW_SIZE], folder[64];

static const hci_fleet_outcome DONE = {.state = HCI_FLEET_DONE, .exit_code = 0},
                               LATE = {.state = HCI_FLEET_LATE,
                                       .exit_code = -1,
                                       .reason = "too long; \"it\"\nhung"};

void setUp(void)
{
    static const char *const WORDS[] = {"solve", "--auto", NULL};
    files_begin();
    snprintf(folder, sizeof folder, "%s", files_root);
    memset(&note, 0, sizeof note);
    files_write(files_path("list.csv"), "motor,serial,batch,date,target\nm1,007,\"A,1\",2026-01-02,t.csv\n"
                                        "m2,,,,t.csv\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_list_read(files_path("list.csv"), &list, &note),
                                  note.text);
    results = (hci_fleet_results){.folder = folder, .command = HCI_FLEET_SOLVE, .list = &list};
    digest = hci_fleet_digest_of("1.0", WORDS);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    (void)hci_memory_was_short();
    hci_fleet_list_release(&list);
    files_end();
}

/* A result as `solve` leaves it, in the part folder of a motor. */
static void leave_result(size_t motor)
{
    char part[256], name[300], sum[HCI_CHECKSUM_SIZE], text[512];
    mkdir(files_path("motors"), 0700);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fleet_part(&results, motor, part, sizeof part, &note));
    mkdir(part, 0700);
    snprintf(name, sizeof name, "%s/currents.csv", part);
    files_write(name, "one\n");
    TEST_ASSERT_TRUE(hci_checksum_file(name, sum));
    snprintf(name, sizeof name, "%s/summary.json", part);
    snprintf(
        text, sizeof text,
        "{\"reached\": true, \"torque\": {\"mean_Nm\": 2.5, \"worst_error_Nm\": 0.125, \"worst_order\": 6},"
        " \"current\": {\"peak_phase_A\": 11, \"loss_ratio_to_plain\": 1.25}, "
        "\"checksums\": {\"currents.csv\": \"%s\"}}\n",
        sum);
    files_write(name, text);
}

static void end(size_t motor, const hci_fleet_outcome *outcome)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_end(&results, motor, outcome, &digest, row, &note),
                                  note.text);
}

static hci_status known(size_t motor, bool *is_done)
{
    memset(&note, 0, sizeof note);
    return hci_fleet_known(&results, motor, &digest, row, is_done, &note);
}

#define HEADER                                                                                               \
    "motor,serial,batch,date,state,exit_code,verdict,reason,mean_Nm,worst_error_Nm,worst_order,peak_phase_"  \
    "A,"                                                                                                     \
    "loss_ratio_to_plain,words_digest"

static void test_a_row_of_a_result(void)
{
    char expected[HCI_FLEET_ROW_SIZE + 600];
    leave_result(0);
    end(0, &DONE);
    snprintf(expected, sizeof expected, "m1,007,\"A,1\",2026-01-02,done,0,reached,,2.5,0.125,6,11,1.25,%s",
             digest.text);
    TEST_ASSERT_EQUAL_STRING(expected, row);
    snprintf(expected, sizeof expected, HEADER "\n%s\n", row);
    TEST_ASSERT_EQUAL_STRING(expected, files_read(files_path("motors/m1/motor.csv")));
    TEST_ASSERT_EQUAL_INT(1, files_count(files_path("motors")));
    TEST_ASSERT_EQUAL_INT(HCI_FLEET_DONE, hci_fleet_row_state(row));
}

/* What a motor without a result has left goes; its reason is one line, quoted. */
static void test_a_row_without_a_result(void)
{
    char expected[HCI_FLEET_ROW_SIZE + 600], reason[HCI_FLEET_REASON_SIZE];
    leave_result(1);
    end(1, &LATE);
    snprintf(expected, sizeof expected, "m2,,,,late,,,\"too long; \"\"it\"\" hung\",,,,,,%s", digest.text);
    TEST_ASSERT_EQUAL_STRING(expected, row);
    TEST_ASSERT_EQUAL_INT(1, files_count(files_path("motors/m2")));
    TEST_ASSERT_EQUAL_INT(HCI_FLEET_LATE, hci_fleet_row_state(row));
    hci_fleet_row_reason(row, reason);
    TEST_ASSERT_EQUAL_STRING("too long; \"it\" hung", reason);
    leave_result(0);
    end(0, &DONE);
    hci_fleet_row_reason(row, reason);
    TEST_ASSERT_EQUAL_STRING("", reason);
}

/* ---- what is done already ---- */

static void test_what_is_known(void)
{
    bool is_done = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, known(0, &is_done));
    TEST_ASSERT_FALSE(is_done);
    leave_result(0);
    end(0, &DONE);
    row[0] = '\0';
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, known(0, &is_done), note.text);
    TEST_ASSERT_TRUE(is_done);
    TEST_ASSERT_EQUAL_STRING_LEN("m1,007,", row, 7);
}

static void is_other(size_t motor, const char *words)
{
    bool is_done = true;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, known(motor, &is_done));
    TEST_ASSERT_FALSE(is_done);
    text_has("/motor.csv: ", note.text);
    text_has(words, note.text);
}

static void test_what_is_of_another_one(void)
{
    static const char *const OTHER[] = {"solve", "--best", NULL};
    leave_result(0);
    end(0, &DONE);
    const hci_fleet_digest before = digest;
    digest = hci_fleet_digest_of("1.0", OTHER);
    is_other(0, "this motor was done with other words, or by another version");
    digest = before;
    results.command = HCI_FLEET_FIT;
    is_other(0, "found a row of another command or version");
    results.command = HCI_FLEET_SOLVE;
    TEST_ASSERT_EQUAL_INT(0, rename(files_path("motors/m1"), files_path("motors/m2")));
    is_other(1, "found the row of another motor");
}

/* A file that is not two whole lines is a row of another version. */
static void test_a_row_that_is_torn(void)
{
    static const char *const TORN[] = {"", HEADER, HEADER "\n", HEADER "\nm1,7", HEADER "\nm1,7\nmore\n"};
    mkdir(files_path("motors"), 0700);
    mkdir(files_path("motors/m1"), 0700);
    for (size_t k = 0; k < sizeof TORN / sizeof *TORN; ++k) {
        files_write(files_path("motors/m1/motor.csv"), TORN[k]);
        is_other(0, "found a row of another command or version");
    }
}

/* Each word and the version count, and where one word ends. */
static void test_digests(void)
{
    static const char *const WORDS[][4] = {
        {"a", "bc", NULL}, {"ab", "c", NULL}, {"a", "bc", "", NULL}, {"a", NULL}, {NULL}};
    enum { CASES = sizeof WORDS / sizeof *WORDS };
    for (size_t k = 0; k < CASES; ++k) {
        const hci_fleet_digest one = hci_fleet_digest_of("1.0", WORDS[k]),
                               next = hci_fleet_digest_of("1.1", WORDS[k]);
        TEST_ASSERT_EQUAL_UINT64(16, strspn(one.text, "0123456789abcdef"));
        TEST_ASSERT_TRUE(strcmp(one.text, next.text) != 0);
        TEST_ASSERT_EQUAL_STRING(one.text, hci_fleet_digest_of("1.0", WORDS[k]).text);
        for (size_t j = 0; j < k; ++j)
            TEST_ASSERT_TRUE(strcmp(one.text, hci_fleet_digest_of("1.0", WORDS[j]).text) != 0);
    }
}

/* ---- whether results are whole ---- */

static hci_status check(size_t motor)
{
    memset(&note, 0, sizeof note);
    return hci_fleet_check(&results, motor, &digest, row, &note);
}

static void test_results_that_are_whole(void)
{
    leave_result(0);
    end(0, &DONE);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check(0), note.text);
    char kept[HCI_FLEET_ROW_SIZE];
    strcpy(kept, row);
    *strstr(row, "2.5") = '3';
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, check(0));
    text_has("/motors/m1/motor.csv: found other figures than the files beside it have", note.text);
    text_has("; this motor is done again", note.text);
    strcpy(row, kept);
    files_write(files_path("motors/m1/currents.csv"), "two\n");
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, check(0));
    text_has("currents.csv: found a file with the checksum", note.text);
}

/* A motor without a result has no files that could be. */
static void test_results_that_are_none(void)
{
    mkdir(files_path("motors"), 0700);
    end(1, &LATE);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, check(1), note.text);
}

static void test_a_motor_that_is_forgotten(void)
{
    bool is_done = true;
    leave_result(0);
    end(0, &DONE);
    leave_result(0); /* and what a process that was killed has left */
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_forget(&results, 0, &note), note.text);
    TEST_ASSERT_EQUAL_INT(0, files_count(files_path("motors")));
    TEST_ASSERT_EQUAL_INT(HCI_OK, known(0, &is_done));
    TEST_ASSERT_FALSE(is_done);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_fleet_forget(&results, 0, &note));
    text_has("/motors/m1: cannot be removed: No such file or directory", note.text);
}

/* One that cannot get its name keeps that of another. */
static void test_a_name_that_is_taken(void)
{
    leave_result(0);
    end(0, &DONE);
    leave_result(0);
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_fleet_end(&results, 0, &DONE, &digest, row, &note));
    text_has("/motors/m1: cannot be made: ", note.text);
}

/* ---- the folder ---- */

static void test_one_process_at_a_time(void)
{
    void *lock, *again;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_fleet_lock(&results, &lock, &note), note.text);
    TEST_ASSERT_NOT_NULL(lock);
    TEST_ASSERT_EQUAL_INT(0, files_count(files_path("motors")));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fleet_lock(&results, &again, &note));
    hci_fleet_unlock(again);
    hci_fleet_unlock(lock);
    hci_fleet_unlock(NULL);
}

static void test_paths_that_are_too_long(void)
{
    static char name[4096];
    char part[256];
    void *lock = &lock;
    size_t length = 4096 - 16 - 2 - strlen("//motors/");
    memset(name, 'a', sizeof name - 1);
    results.folder = name;
    name[length + 1] = '\0';
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_fleet_begin(&results, 0, &note));
    text_has("…: the path is too long", note.text);
    memset(&note, 0, sizeof note);
    name[length + 1] = 'a', name[4095] = '\0';
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_fleet_lock(&results, &lock, &note));
    TEST_ASSERT_NULL(lock);
    text_has("…: the path is too long", note.text);
    results.folder = folder;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fleet_part(&results, 0, part, sizeof part, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fleet_part(&results, 0, part, strlen(part) + 1, &note));
    text_has("/motors/.m1.part", part);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_fleet_part(&results, 0, part, strlen(part), &note));
}

/* ---- cells ---- */

static void test_cells_of_a_row(void)
{
    char cell[8];
    static const char ROW[] = "a,\"b,\"\"c\",,long text,e";
    static const char *const EXPECTED[] = {"a", "b,\"c", "", "long te", "e"};
    static const char *const COLUMNS[] = {"v", "w", "x", "y", "z"};
    for (size_t k = 0; k < 5; ++k) {
        hci_fleet_row_cell(ROW, "v,w,x,y,z", COLUMNS[k], cell, sizeof cell);
        TEST_ASSERT_EQUAL_STRING(EXPECTED[k], cell);
    }
    hci_fleet_row_cell(ROW, "v,w,x,y,z", "none", cell, sizeof cell);
    TEST_ASSERT_EQUAL_STRING("", cell);
    hci_fleet_row_cell("a,b", "v,w,x", "x", cell, sizeof cell);
    TEST_ASSERT_EQUAL_STRING("", cell);
    TEST_ASSERT_EQUAL_STRING("7,8", hci_fleet_row_findings("1,\"2,2\",3,4,5,6,7,8"));
    TEST_ASSERT_EQUAL_STRING("", hci_fleet_row_findings("1,2,3,4,5,6"));
    TEST_ASSERT_EQUAL_INT(HCI_FLEET_CRASHED, hci_fleet_row_state("m,,,,nonsense,"));
}

/* What a diagnosis has added and left ambiguous, joined; of `tune` in the folder of its diagnosis. */
static void test_effects_of_a_row(void)
{
    static const char EFFECTS[] = "effect,parameter,verdict\ncogging,sine,added\nfriction,coulomb,none\n"
                                  "back_emf,sine,added\nreluctance,l,ambiguous\n";
    char cell[64], header[HCI_FLEET_ROW_SIZE];
    mkdir(files_path("part"), 0700);
    mkdir(files_path("part/diagnose"), 0700);
    for (int tune = 0; tune < 2; ++tune) {
        results.command = tune ? HCI_FLEET_TUNE : HCI_FLEET_DIAGNOSE;
        remove(files_path("part/effects.csv"));
        remove(files_path("part/diagnose/effects.csv"));
        files_write(files_path(tune ? "part/diagnose/effects.csv" : "part/effects.csv"), EFFECTS);
        hci_fleet_row_make(&results, 0, &DONE, &digest, files_path("part"), row);
        hci_fleet_header(results.command, header);
        hci_fleet_row_cell(row, header, "effects", cell, sizeof cell);
        TEST_ASSERT_EQUAL_STRING("cogging+back_emf", cell);
        hci_fleet_row_cell(row, header, "ambiguous", cell, sizeof cell);
        TEST_ASSERT_EQUAL_STRING("reluctance", cell);
        hci_fleet_row_make(&results, 0, &LATE, &digest, files_path("part"), row);
        hci_fleet_row_cell(row, header, "effects", cell, sizeof cell);
        TEST_ASSERT_EQUAL_STRING("", cell);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_row_of_a_result);
    RUN_TEST(test_a_row_without_a_result);
    RUN_TEST(test_what_is_known);
    RUN_TEST(test_what_is_of_another_one);
    RUN_TEST(test_a_row_that_is_torn);
    RUN_TEST(test_digests);
    RUN_TEST(test_results_that_are_whole);
    RUN_TEST(test_results_that_are_none);
    RUN_TEST(test_a_motor_that_is_forgotten);
    RUN_TEST(test_a_name_that_is_taken);
    RUN_TEST(test_one_process_at_a_time);
    RUN_TEST(test_paths_that_are_too_long);
    RUN_TEST(test_cells_of_a_row);
    RUN_TEST(test_effects_of_a_row);
    return UNITY_END();
}
