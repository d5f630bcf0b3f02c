/* Recordings that were interpolated onto other rows are read at the points that were measured. */
#include <math.h>

#include "host/base/memory.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

enum { POINTS = 900, MORE = 4 };

static const hci_run_options PLAIN = {.pole_pairs = 2, .inertia_kgm2 = NAN};
static double torque_Nm[POINTS];

void setUp(void)
{
    run_file_begin();
    uint64_t draws = 5;
    for (int k = 0; k < POINTS; ++k)
        torque_Nm[k] = 1.0 + 0.3 * sin(1.1 * k) + 0.01 * ref_normal(&draws);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    run_file_end();
}

/* The true angle at a time in points. */
static double angle_rad(double at)
{
    return 0.04 * at;
}

static double torque_at(double at)
{
    const int k = (int)at;
    return torque_Nm[k] + (at - k) * (torque_Nm[k + 1] - torque_Nm[k]);
}

/* An angle from 0 to 2 pi: as the drive wrote it, or along lines over its jumps, too. */
static double wrapped(double at, bool along_lines)
{
    const double turn = 2.0 * REF_PI;
    if (!along_lines) return fmod(angle_rad(at), turn);
    const double from = fmod(angle_rad(floor(at)), turn), to = fmod(angle_rad(floor(at) + 1.0), turn);
    return from + (at - floor(at)) * (to - from);
}

/* Points of 1 ms at rows of 1/MORE ms that begin between two. */
static void write_rows(bool angle_along_lines)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs("time_s,theta_m_rad,iq_A,torque_Nm\n", file);
    for (int k = 0; k < MORE * (POINTS - 2); ++k) {
        const double at = 0.13 + (double)k / MORE;
        fprintf(file, "%.7f,%.7f,%.5f,%.7f\n", 1e-3 * at, wrapped(at, angle_along_lines), 5.0, torque_at(at));
    }
    fclose(file);
}

static void read_rows(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &PLAIN, &run, &note), note.text);
}

static void points_are_there(size_t least)
{
    TEST_ASSERT_TRUE(run.count >= least && run.count <= POINTS);
    for (size_t k = 0; k < run.count; ++k) {
        const double at = 1e3 * run.time_s[k];
        TEST_ASSERT_DOUBLE_WITHIN(0.03, round(at), at);
        TEST_ASSERT_DOUBLE_WITHIN(3e-3, angle_rad(round(at)), run.theta_m_rad[k]);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, torque_Nm[lround(at)], run.torque_Nm[k]);
    }
}

static void test_a_torque_along_lines_beside_an_angle_that_is_not(void)
{
    write_rows(false);
    read_rows();
    points_are_there(POINTS - 12); /* but for some of the five jumps of the angle */
    text_has("straight lines between points 4 rows apart", run.remark.text);
}

static void test_all_columns_along_lines(void)
{
    write_rows(true);
    read_rows();
    points_are_there(POINTS - 4);
}

static void test_each_row_counts_where_holes_are_refused(void)
{
    const hci_run_options strict = {.pole_pairs = 2, .inertia_kgm2 = NAN, .strict = true};
    write_rows(false);
    TEST_ASSERT_EQUAL(HCI_OK, hci_run_read(path, &strict, &run, &note));
    TEST_ASSERT_EQUAL_UINT64(MORE * (POINTS - 2), run.count);
}

static void test_memory_that_is_short_is_told(void)
{
    write_rows(true);
    for (long at = 0, ended = 0; !ended; at += 7) {
        hci_memory_fail_once_after(at);
        const hci_status status = hci_run_read(path, &PLAIN, &run, &note);
        ended = !hci_memory_was_short();
        TEST_ASSERT_EQUAL(ended ? HCI_OK : HCI_ERROR_MEMORY, status);
        if (!ended) hci_run_release(&run);
        hci_memory_fail_after(-1);
    }
    points_are_there(POINTS - 4);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_torque_along_lines_beside_an_angle_that_is_not);
    RUN_TEST(test_all_columns_along_lines);
    RUN_TEST(test_each_row_counts_where_holes_are_refused);
    RUN_TEST(test_memory_that_is_short_is_told);
    return UNITY_END();
}
