/* fleet.csv of several folders and the parameters beside it: what is refused, what counts once, whose dates
 * are read. */
#include "hci/host/fleet/line.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "host/base/memory.h"
#include "host/fleet/row.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_line line;
static hci_note note;
static char header[HCI_FLEET_ROW_SIZE], all[65536], first[512], second[512];

void setUp(void)
{
    files_begin();
    memset(&line, 0, sizeof line);
    memset(&note, 0, sizeof note);
    snprintf(first, sizeof first, "%s", files_path("first"));
    snprintf(second, sizeof second, "%s", files_path("second"));
    TEST_ASSERT_TRUE(mkdir(first, 0700) == 0 && mkdir(second, 0700) == 0);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_line_release(&line);
    files_end();
}

/* Rows `motor,serial,batch,date,state` with empty cells behind them, in the folder of a name. */
static void write_fleet(const char *folder, hci_fleet_command command, const char *const *row)
{
    char path[64];
    hci_fleet_header(command, header);
    size_t commas = 0, used = (size_t)snprintf(all, sizeof all, "%s\n", header);
    for (const char *c = header; *c; ++c)
        commas += *c == ',';
    for (; *row; ++row) {
        used += (size_t)snprintf(all + used, sizeof all - used, "%s", *row);
        for (size_t k = 4; k < commas; ++k)
            all[used++] = ',';
        all[used++] = '\n';
        all[used] = '\0';
    }
    snprintf(path, sizeof path, "%s/fleet.csv", folder);
    files_write(files_path(path), all);
}

/* Parameters of a motor of a fit: cogging, and a gain of a unit; rms: of what stays. */
static void write_fit(const char *folder, const char *motor, double cogging, const char *unit, double rms)
{
    char path[128], text[400];
    snprintf(path, sizeof path, "%s/%s/motors", files_root, folder);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/%s/motors/%s", files_root, folder, motor);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/motors/%s/parameters.csv", folder, motor);
    snprintf(text, sizeof text,
             "effect,parameter,value,unit,std_error\ncogging,sine_6,%g,Nm,0.01\ntorque_"
             "gain,gain,0.5,%s,0.02\n",
             cogging, unit);
    files_write(files_path(path), text);
    snprintf(path, sizeof path, "%s/motors/%s/summary.json", folder, motor);
    snprintf(text, sizeof text, "{\n  \"rms_after_Nm\": %g\n}\n", rms);
    files_write(files_path(path), text);
}

static hci_status read_both(void)
{
    const char *const folders[] = {first, second};
    memset(&note, 0, sizeof note);
    return hci_line_read(folders, 2, &line, &note);
}

static hci_status read_first(void)
{
    const char *const folders[] = {first};
    memset(&note, 0, sizeof note);
    return hci_line_read(folders, 1, &line, &note);
}

static void refuses(hci_status status, const char *words)
{
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, status);
    text_has(words, note.text);
}

static void test_what_is_no_fleet(void)
{
    static const char *const NONE[] = {NULL};
    char words[700];
    snprintf(words, sizeof words,
             "%s/fleet.csv: cannot be read; expected fleet.csv as hci-solve batch writes it", first);
    refuses(read_first(), words);
    hci_line_release(&line);
    files_write(files_path("first/fleet.csv"), "motor,serial\nm1,1\n");
    refuses(read_first(), "fleet.csv: found another header; expected");
    hci_line_release(&line);
    write_fleet("first", HCI_FLEET_FIT, NONE);
    snprintf(words, sizeof words, "%s: no motor is done; expected", first);
    refuses(read_first(), words);
}

/* By name; a row that stands in both folders counts once, one that differs is refused. */
static void test_motors_of_two_folders(void)
{
    static const char *const A[] = {"m3,,b1,2026-10-05,done", "m1,,b2,2026-10-06,open", NULL},
                             *const B[] = {"m2,,b1,,failed", "m3,,b1,2026-10-05,done", NULL},
                             *const OTHER[] = {"m3,,b9,2026-10-05,done", NULL};
    write_fleet("first", HCI_FLEET_FIT, A);
    write_fleet("second", HCI_FLEET_FIT, B);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_both(), note.text);
    TEST_ASSERT_EQUAL_UINT64(3, line.motors);
    TEST_ASSERT_EQUAL(HCI_FLEET_FIT, line.command);
    static const char *const NAME[] = {"m1", "m2", "m3"}, *const BATCH[] = {"b2", "b1", "b1"};
    static const hci_fleet_state STATE[] = {HCI_FLEET_OPEN, HCI_FLEET_FAILED, HCI_FLEET_DONE};
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_STRING(NAME[k], line.motor[k].name);
        TEST_ASSERT_EQUAL_STRING(BATCH[k], line.motor[k].batch);
        TEST_ASSERT_EQUAL(STATE[k], line.motor[k].state);
        TEST_ASSERT_EQUAL(HCI_LINE_NONE, line.motor[k].worst);
        TEST_ASSERT_TRUE(isnan(line.motor[k].deviation));
    }
    TEST_ASSERT_EQUAL_DOUBLE(1.0, line.motor[0].day - line.motor[2].day);
    TEST_ASSERT_TRUE(isnan(line.motor[1].day));
    TEST_ASSERT_EQUAL_UINT64(0, line.dates_unread); /* an empty one is none */
    TEST_ASSERT_EQUAL_UINT64(0, line.parameters);
    hci_line_release(&line);
    write_fleet("first", HCI_FLEET_FIT, OTHER);
    write_fleet("second", HCI_FLEET_FIT, OTHER);
    TEST_ASSERT_EQUAL(HCI_OK, read_both());
    TEST_ASSERT_EQUAL_UINT64(1, line.motors);
    hci_line_release(&line);
    write_fleet("first", HCI_FLEET_FIT, A);
    refuses(read_both(), "found motor `m3` in both with different rows, expected each once");
    hci_line_release(&line);
    write_fleet("second", HCI_FLEET_SOLVE, B);
    refuses(read_both(), "second/fleet.csv: found the motors of another command than in the first folder");
}

/* 05/10 is read where another date of the line says which is the day; where two contradict each other, not.
 */
static void test_dates_say_what_others_are(void)
{
    static const struct {
        const char *other;
        size_t unread;
        double days; /* from 2026-01-01 to the first date */
    } CASE[] = {{"", 1, NAN},
                {"20/10/2026", 0, 277.0},
                {"10/20/2026", 0, 129.0},
                {"20.10.2026", 1, NAN},
                {"monday", 2, NAN}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        char row[64];
        snprintf(row, sizeof row, "m3,,,%s,done", CASE[k].other);
        const char *const rows[] = {"m1,,,05/10/2026,done", "m2,,,2026-01-01,done", row, NULL};
        write_fleet("first", HCI_FLEET_FIT, rows);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_first(), note.text);
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(CASE[k].unread, line.dates_unread, CASE[k].other);
        TEST_ASSERT_EQUAL_STRING(CASE[k].unread ? "05/10/2026" : "",
                                 line.date_unread); /* the first of them */
        const double days = line.motor[0].day - line.motor[1].day;
        TEST_ASSERT_TRUE(isnan(CASE[k].days) ? isnan(days) : days == CASE[k].days);
        hci_line_release(&line);
    }
    const char *const both[] = {"m1,,,05/10/2026,done", "m2,,,20/10/2026,done", "m3,,,10/20/2026,done", NULL};
    write_fleet("first", HCI_FLEET_FIT, both);
    TEST_ASSERT_EQUAL(HCI_OK, read_first());
    TEST_ASSERT_EQUAL_UINT64(1, line.dates_unread);
}

/* The values of each motor in its row, what stays behind them; a motor without a fit tells none. */
static void test_parameters_of_motors(void)
{
    static const char *const ROWS[] = {"m2,,,,done", "m1,,,,done", "m3,,,,failed", "m4,,,,open", NULL};
    write_fleet("first", HCI_FLEET_FIT, ROWS);
    write_fit("first", "m1", 1.5, "1", 0.25);
    write_fit("first", "m2", 2.5, "1", 0.5);
    write_fit("first", "m3", 3.5, "1", 0.75); /* failed: what stands there is of another time */
    write_fit("first", "m4", 4.5, "1", 1.0);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_first(), note.text);
    TEST_ASSERT_EQUAL_UINT64(4, line.motors);
    TEST_ASSERT_EQUAL_UINT64(3, line.parameters);
    static const char *const EFFECT[] = {"cogging", "torque_gain", "residual"}, *const UNIT[] = {"Nm", "1",
                                                                                                 "Nm"};
    for (size_t p = 0; p < 3; ++p) {
        TEST_ASSERT_EQUAL_STRING(EFFECT[p], line.parameter[p].name.effect);
        TEST_ASSERT_EQUAL_STRING(UNIT[p], line.parameter[p].name.unit);
    }
    static const double VALUE[4][3] = {{1.5, 0.5, 0.25}, {2.5, 0.5, 0.5}, {NAN, NAN, NAN}, {4.5, 0.5, 1.0}},
                        ERROR[] = {0.01, 0.02, 0.0};
    for (size_t k = 0; k < 4; ++k)
        for (size_t p = 0; p < 3; ++p) {
            const double value = line.value[3 * k + p], error = line.std_error[3 * k + p];
            TEST_ASSERT_TRUE(k == 2 ? isnan(value) && isnan(error)
                                    : value == VALUE[k][p] && error == ERROR[p]);
        }
}

static void test_parameters_of_another_make(void)
{
    static const char *const ROWS[] = {"m1,,,,done", "m2,,,,done", NULL};
    write_fleet("first", HCI_FLEET_FIT, ROWS);
    write_fit("first", "m1", 1.5, "1", 0.25);
    write_fit("first", "m2", 1.5, "%", 0.25);
    refuses(read_first(), "motor `m2` has other parameters than the first one; expected motors of one make");
}

static void test_memory_fails_anywhere(void)
{
    static const char *const ROWS[] = {"m1,,,,done", "m2,,,,done", NULL};
    write_fleet("first", HCI_FLEET_FIT, ROWS);
    write_fit("first", "m1", 1.5, "1", 0.25);
    write_fit("first", "m2", 1.5, "1", 0.25);
    hci_status status = HCI_ERROR_MEMORY;
    for (int calls = 0; status && calls < 1000; ++calls) {
        hci_memory_fail_after(calls);
        status = read_first();
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        hci_line_release(&line);
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_no_fleet);
    RUN_TEST(test_motors_of_two_folders);
    RUN_TEST(test_dates_say_what_others_are);
    RUN_TEST(test_parameters_of_motors);
    RUN_TEST(test_parameters_of_another_make);
    RUN_TEST(test_memory_fails_anywhere);
    return UNITY_END();
}
