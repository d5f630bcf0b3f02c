/* Tables of several operating points in one file: which files are, and the run of each point. */
#include "host/recording/list/torque_map.h"

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, ANGLES = 30, POINTS = 4 };

static const double POINT_A[POINTS][2] = {{0.0, 0.0}, {-5.0, 10.0}, {0.0, 20.0}, {-5.0, 20.0}};

static hci_runs runs;
static hci_note note;

void setUp(void)
{
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_runs_release(&runs);
    memset(&runs, 0, sizeof runs);
}

/* Row k of a run: angle and currents; the torque says which point and angle it is. */
static void row_set(hci_run *run, size_t k, size_t point, size_t angle)
{
    run->theta_m_rad[k] = 2.0 * REF_PI / P * (double)angle / ANGLES;
    rec_phases(POINT_A[point][0], POINT_A[point][1], P * run->theta_m_rad[k], run->i_A + 3 * k);
    run->torque_Nm[k] = 100.0 * (double)point + (double)angle;
}

static hci_run *run_add(const char *name, size_t rows)
{
    runs.run = hci_memory_resize(runs.run, runs.count + 1, sizeof *runs.run);
    runs.role = hci_memory_resize(runs.role, runs.count + 1, sizeof *runs.role);
    hci_run *run = &runs.run[runs.count];
    *run = rec_make(rows);
    hci_memory_free(run->time_s);
    run->time_s = NULL;
    run->pole_pairs = P;
    snprintf(run->name, 16, "%s", name);
    runs.role[runs.count++] = HCI_ROLE_HOLDOUT;
    return run;
}

/* Angle by angle at each point, or point by point at each angle. */
static hci_run *map_add(bool angle_first)
{
    hci_run *run = run_add("map.csv", POINTS * ANGLES);
    for (size_t k = 0; k < run->count; ++k)
        if (angle_first)
            row_set(run, k, k / ANGLES, k % ANGLES);
        else
            row_set(run, k, k % POINTS, k / POINTS);
    return run;
}

static void is_split(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_torque_maps_split(&runs, 0, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(POINTS, runs.count);
    for (size_t p = 0; p < POINTS; ++p) {
        const hci_run *run = &runs.run[p];
        TEST_ASSERT_EQUAL_UINT64(ANGLES, run->count);
        TEST_ASSERT_EQUAL_INT(HCI_ROLE_HOLDOUT, runs.role[p]);
        for (size_t k = 0; k < ANGLES; ++k) {
            TEST_ASSERT_EQUAL_DOUBLE(100.0 * (double)p + (double)k, run->torque_Nm[k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI / P * (double)k / ANGLES, run->theta_m_rad[k]);
        }
    }
}

static void stays_one(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_torque_maps_split(&runs, 0, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(1, runs.count);
    TEST_ASSERT_FALSE(runs.run[0].is_point);
}

static void test_angles_or_currents_first(void)
{
    map_add(true);
    is_split();
    TEST_ASSERT_EQUAL_STRING("map.csv (i_d -5 A; i_q 10 A)", runs.run[1].name);
    TEST_ASSERT_NOT_NULL(
        strstr(runs.run[0].remark.text, "4 operating points in one file, i_d -5 to 0 A and i_q 0 to 20 A"));
    TEST_ASSERT_EQUAL_STRING("", runs.run[1].remark.text);
    tearDown();
    map_add(false);
    is_split();
}

/* A reader that takes the fall of the angle from a point to the next for a wrapped turn goes on counting. */
static void test_turns_that_were_counted(void)
{
    hci_run *run = map_add(true);
    run->turn_known = false;
    for (size_t k = 0; k < run->count; ++k)
        run->theta_m_rad[k] += 2.0 * REF_PI / P * (double)(k / ANGLES);
    is_split();
}

static void test_others_keep_their_place(void)
{
    run_add("first.csv", 5);
    map_add(true);
    run_add("last.csv", 5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_maps_split(&runs, 0, &note));
    TEST_ASSERT_EQUAL_UINT64(POINTS + 2, runs.count);
    TEST_ASSERT_EQUAL_STRING("first.csv", runs.run[0].name);
    TEST_ASSERT_EQUAL_STRING("last.csv", runs.run[POINTS + 1].name);
}

static void test_a_log_over_time_is_none(void)
{
    hci_run *run = map_add(true);
    run->time_s = hci_memory_new(run->count, sizeof *run->time_s);
    stays_one();
}

static void test_one_point_is_none(void)
{
    hci_run *run = map_add(true);
    for (size_t k = 0; k < run->count; ++k)
        row_set(run, k, 1, k % ANGLES);
    stays_one();
}

/* Currents that follow the angle, as those of a table that is played. */
static void test_shaped_currents_are_none(void)
{
    hci_run *run = map_add(true);
    for (size_t k = 0; k < run->count; ++k)
        rec_phases(0.0, 10.0 + sin(6.0 * P * run->theta_m_rad[k]), P * run->theta_m_rad[k], run->i_A + 3 * k);
    stays_one();
}

/* Readings of one current in coarse steps: at each of them are angles here and there. */
static void test_rounded_currents_are_none(void)
{
    hci_run *run = map_add(true);
    for (size_t k = 0; k < run->count; ++k)
        row_set(run, k, k * k % 7 < 3 ? 1 : 3, k % ANGLES);
    stays_one();
}

static void test_memory_that_is_out(void)
{
    for (long after = 0; after < 40; ++after) {
        map_add(true);
        hci_memory_fail_after(after);
        const hci_status status = hci_torque_maps_split(&runs, 0, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK ? runs.count == POINTS : status == HCI_ERROR_MEMORY);
        tearDown();
        if (status == HCI_OK) return;
    }
    TEST_FAIL_MESSAGE("it never came to its end");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angles_or_currents_first);
    RUN_TEST(test_turns_that_were_counted);
    RUN_TEST(test_others_keep_their_place);
    RUN_TEST(test_a_log_over_time_is_none);
    RUN_TEST(test_one_point_is_none);
    RUN_TEST(test_shaped_currents_are_none);
    RUN_TEST(test_rounded_currents_are_none);
    RUN_TEST(test_memory_that_is_out);
    return UNITY_END();
}
