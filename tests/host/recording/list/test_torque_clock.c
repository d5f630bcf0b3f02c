/* A torque of a logger of its own, moved in time beside the angle of its recordings. */
#include "host/recording/list/torque_clock.c"

#include <string.h>

#include "support/draws.h"
#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { RUNS = 4, ROWS = 8000 };

#define STEP_S 1e-3

static hci_run run[RUNS];
static hci_note note;

/* What the shaft has at an angle under a load, without noise. */
static double on_shaft_Nm(double theta_m, double load_Nm)
{
    return load_Nm * (1.0 + 0.02 * sin(30.0 * theta_m + 1.0)) + 0.008 * sin(60.0 * theta_m + 0.7) +
           0.003 * sin(12.0 * theta_m) + 0.002 * cos(10.0 * theta_m);
}

static void make(size_t r, double load_Nm, double speed_rad_per_s, double late_s)
{
    uint64_t seed = 7 + r;
    rec_release(&run[r]);
    run[r] = rec_make(ROWS);
    for (size_t k = 0; k < ROWS; ++k) {
        const double time_s = STEP_S * (double)k, theta = 0.4 + speed_rad_per_s * time_s;
        run[r].time_s[k] = time_s;
        run[r].theta_m_rad[k] = theta;
        run[r].torque_Nm[k] =
            on_shaft_Nm(theta - speed_rad_per_s * late_s, load_Nm) + 1e-3 * ref_normal(&seed);
    }
}

static void make_all(double late_s)
{
    make(0, 0.0, 3.1, late_s);
    make(1, 0.2, 3.1, late_s);
    make(2, 0.3, -3.1, late_s);
    make(3, 0.3, 5.0, late_s);
}

void setUp(void)
{
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    for (size_t r = 0; r < RUNS; ++r)
        rec_release(&run[r]);
}

static void is_in_time(const hci_run *x, double load_Nm, double most_Nm)
{
    double sum = 0.0;
    for (size_t k = 0; k < x->count; ++k)
        sum += pow(x->torque_Nm[k] - on_shaft_Nm(x->theta_m_rad[k], load_Nm), 2.0);
    TEST_ASSERT_TRUE(sqrt(sum / (double)x->count) < most_Nm);
}

/* To the next row; the rows at the end, or at the beginning, have none. */
static void test_a_late_and_an_early_torque_are_moved(void)
{
    static const double LOAD_Nm[RUNS] = {0.0, 0.2, 0.3, 0.3};
    for (int sign = -1; sign <= 1; sign += 2) {
        make_all(0.0502 * sign);
        TEST_ASSERT_EQUAL(HCI_OK, hci_torque_clock_align(run, RUNS, &note));
        for (size_t r = 0; r < RUNS; ++r) {
            TEST_ASSERT_TRUE(run[r].count > ROWS - 60 && run[r].count < ROWS - 48);
            is_in_time(&run[r], LOAD_Nm[r], 1.2e-3);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign > 0 ? 0.0 : 0.051, run[r].time_s[0]);
        }
        text_has(sign > 0 ? "is read 0.0502 s late beside the angle"
                          : "is read 0.0502 s early beside the angle",
                 run[0].remark.text);
    }
}

static void stays(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_clock_align(run, RUNS, &note));
    for (size_t r = 0; r < RUNS; ++r) {
        TEST_ASSERT_EQUAL_UINT64(ROWS, run[r].count);
        TEST_ASSERT_EQUAL_STRING("", run[r].remark.text);
    }
}

/* In time, or late by little, which the diagnosis finds. */
static void test_a_torque_in_time_stays(void)
{
    make_all(0.0);
    stays();
    make_all(4e-3);
    stays();
}

/* A tenth is left, and another delay leaves three times as much. */
static void test_how_much_tells_a_delay(void)
{
    const hci_common_delay good = {
        .delay_s = -0.02, .turned_rad = 2.0, .before = 1000.0, .left = 90.0, .other = 280.0, .freedom = 39.0};
    hci_common_delay d = good;
    TEST_ASSERT_TRUE(is_told(&d));
    d.left = 110.0, d.other = 400.0;
    TEST_ASSERT_FALSE(is_told(&d));
    d = good;
    d.other = 260.0;
    TEST_ASSERT_FALSE(is_told(&d));
    d = good;
    d.freedom = 41.0;
    TEST_ASSERT_FALSE(is_told(&d));
    d = good;
    d.turned_rad = 0.6;
    TEST_ASSERT_FALSE(is_told(&d));
}

/* One speed; ripples that are the same after another delay too. */
static void test_what_tells_no_delay(void)
{
    make_all(0.0502);
    make(2, 0.3, 3.1, 0.0502);
    make(3, 0.3, 3.1, 0.0502);
    stays();
    for (int r = 0; r < RUNS; ++r) {
        const double way = r % 2 ? -3.1 : 3.1;
        make((size_t)r, 0.0, way, 0.0);
        for (size_t k = 0; k < ROWS; ++k) {
            const double angle = way * (run[r].time_s[k] - 0.04);
            run[r].torque_Nm[k] = 0.01 * sin(60.0 * angle) + 0.02 * sin(30.0 * angle);
        }
    }
    stays();
}

/* Two recordings may as well have angles that begin elsewhere. */
static void test_two_recordings_are_too_few(void)
{
    make_all(0.0502);
    run[0].torque_source = run[1].torque_source = HCI_TORQUE_NONE;
    stays();
}

/* A recording whose speed is no steady one has no say and is moved all the same; what has no time is not. */
static void test_others_are_moved_too(void)
{
    make_all(0.0502);
    for (size_t k = 0; k < ROWS; ++k)
        run[3].theta_m_rad[k] = 0.4 + 5.0 * run[3].time_s[k] * run[3].time_s[k] / 8.0;
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_clock_align(run, RUNS, &note));
    TEST_ASSERT_TRUE(run[3].count < ROWS - 48);
    make_all(0.0502);
    run[3].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_clock_align(run, RUNS, &note));
    TEST_ASSERT_TRUE(run[0].count < ROWS - 48);
    TEST_ASSERT_EQUAL_UINT64(ROWS, run[3].count);
}

/* Nothing is read over a gap. */
static void test_a_gap_in_the_time(void)
{
    make_all(0.0502);
    for (size_t k = ROWS / 2; k < ROWS; ++k) {
        run[1].time_s[k] += 7.0;
        run[1].theta_m_rad[k] += 7.0 * 3.1;
    }
    for (size_t k = ROWS / 2; k < ROWS; ++k)
        run[1].torque_Nm[k] = on_shaft_Nm(run[1].theta_m_rad[k] - 3.1 * 0.0502, 0.2);
    run[1].gap_s = 0.1;
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_clock_align(run, RUNS, &note));
    TEST_ASSERT_TRUE(run[1].count < ROWS - 96);
    is_in_time(&run[1], 0.2, 1.2e-3);
}

static void test_memory(void)
{
    make_all(0.0502);
    for (long n = 0; n < 3; ++n) {
        hci_memory_fail_after(n);
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_torque_clock_align(run, RUNS, &note));
        hci_memory_fail_after(-1);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_late_and_an_early_torque_are_moved);
    RUN_TEST(test_a_torque_in_time_stays);
    RUN_TEST(test_how_much_tells_a_delay);
    RUN_TEST(test_what_tells_no_delay);
    RUN_TEST(test_two_recordings_are_too_few);
    RUN_TEST(test_others_are_moved_too);
    RUN_TEST(test_a_gap_in_the_time);
    RUN_TEST(test_memory);
    return UNITY_END();
}
