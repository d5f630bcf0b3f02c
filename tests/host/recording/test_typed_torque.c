/* One torque in every row of recordings at other currents: typed, or the end of the sensor. Of a motor of
 * hundredths of an ampere and of a newton metre. */
#include "host/recording/computed_torque.h"

#include <math.h>
#include <string.h>

#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { RUNS = 3, P = 2 };

static hci_run run[RUNS];

void setUp(void)
{
    memset(run, 0, sizeof run);
}

void tearDown(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        rec_release(&run[r]);
}

/* So many rows of one i_q and one torque. */
static void record(size_t r, size_t rows, double iq_A, double torque_Nm)
{
    static const char *const NAMES[RUNS] = {"logs/a.csv", "logs/b.csv", "logs/c.csv"};
    rec_release(&run[r]);
    run[r] = rec_make(rows);
    strcpy(run[r].name, NAMES[r]);
    run[r].pole_pairs = P;
    run[r].torque_source = HCI_TORQUE_MEASURED;
    for (size_t k = 0; k < rows; ++k) {
        run[r].theta_m_rad[k] = 0.1 * (double)k;
        rec_phases(0.003, iq_A, P * run[r].theta_m_rad[k], run[r].i_A + 3 * k);
        run[r].torque_Nm[k] = torque_Nm;
    }
}

static void is_typed(size_t r, bool typed, double torque_Nm)
{
    TEST_ASSERT_EQUAL(typed, run[r].torque_is_typed);
    TEST_ASSERT_EQUAL(typed ? HCI_TORQUE_NONE : HCI_TORQUE_MEASURED, run[r].torque_source);
    TEST_ASSERT_EQUAL(typed, run[r].torque_Nm == NULL);
    if (typed) TEST_ASSERT_EQUAL_DOUBLE(torque_Nm, run[r].torque_typed_Nm);
}

/* Forward and back, whichever is first; the third has another torque. */
static void test_one_number_at_other_currents(void)
{
    for (int first = 0; first < 2; ++first) {
        record(0, 20, first ? 0.02 : 0.04, 0.015);
        record(1, 20, first ? -0.04 : -0.02, 0.015);
        record(2, 20, 0.03, 0.014);
        hci_torques_typed_leave(run, RUNS);
        is_typed(0, true, 0.015);
        is_typed(1, true, 0.015);
        is_typed(2, false, 0.0);
        text_has("the torque is 0.015 N·m in every row, as in other recordings: typed", run[0].remark.text);
        TEST_ASSERT_EQUAL_STRING("", run[2].remark.text);
    }
}

/* Another current differs by a tenth of the largest of the list, which may be in a third recording. */
static void test_what_another_current_is(void)
{
    for (int apart = 0; apart < 2; ++apart) {
        record(0, 20, 0.02, 0.015);
        record(1, 20, apart ? 0.0241 : 0.0239, 0.015);
        record(2, 20, -0.04, 0.014);
        hci_torques_typed_leave(run, RUNS);
        is_typed(0, apart, 0.015);
        is_typed(1, apart, 0.015);
    }
}

/* To nine digits it is one number. */
static void test_what_one_number_is(void)
{
    for (int other = 0; other < 2; ++other) {
        record(0, 20, 0.02, 0.015);
        record(1, 20, 0.04, 0.015 * (1.0 + (other ? 1.5e-9 : 0.5e-9)));
        hci_torques_typed_leave(run, 2);
        is_typed(0, !other, 0.015);
    }
}

/* What another one proves to be typed is typed at any current. */
static void test_a_third_at_the_same_current(void)
{
    record(0, 20, 0.02, 0.015);
    record(1, 20, 0.04, 0.015);
    record(2, 20, 0.04, 0.015);
    hci_torques_typed_leave(run, RUNS);
    for (size_t r = 0; r < RUNS; ++r)
        is_typed(r, true, 0.015);
}

/* 16 rows over an angle, not all 0, and none that differs; of torques that were measured. */
static void test_what_is_not_asked(void)
{
    for (int which = 0; which < 6; ++which) {
        record(0, which == 0 ? 15 : 16, 0.02, which == 1 ? 0.0 : 0.015);
        record(1, 16, 0.04, which == 1 ? 0.0 : 0.015);
        if (which == 2) run[0].torque_Nm[15] += 1e-6;
        if (which == 3) run[0].torque_Nm[1] -= 1e-6;
        if (which == 4) run[0].torque_source = HCI_TORQUE_HOLDING;
        hci_torques_typed_leave(run, 2);
        TEST_ASSERT_EQUAL(which == 5, run[0].torque_is_typed);
        TEST_ASSERT_EQUAL(which >= 4, run[1].torque_is_typed);
    }
}

/* Both ends of a sensor, ±0.02 N·m, at two currents; of one current, of 0 or of other numbers it is no end.
 */
static void test_the_end_of_a_sensor(void)
{
    static const struct {
        double iq_A, torque_Nm;
        bool is_typed, is_end;
    } CASES[] = {{0.04, -0.02, true, true},       {0.04, 0.02, true, true}, {0.04, 0.02, false, false},
                 {0.0201, 0.02, true, false},     {0.04, 0.0, true, false}, {0.04, 0.0199999, true, false},
                 {0.04, 0.02 + 1e-13, true, true}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        record(0, 20, 0.02, 0.02);
        record(1, 20, 0.02, 0.03);
        record(2, 20, CASES[k].iq_A, 0.01);
        run[0].torque_is_typed = run[1].torque_is_typed = true;
        run[2].torque_is_typed = CASES[k].is_typed;
        run[0].torque_typed_Nm = CASES[k].torque_Nm == 0.0 ? 0.0 : 0.02;
        run[1].torque_typed_Nm = 0.03;
        run[2].torque_typed_Nm = CASES[k].torque_Nm;
        hci_torques_at_one_end_tell(run, RUNS);
        TEST_ASSERT_EQUAL(CASES[k].is_end, run[0].torque_is_clipped);
        TEST_ASSERT_FALSE(run[1].torque_is_clipped);
        TEST_ASSERT_EQUAL(CASES[k].is_end, run[2].torque_is_clipped);
        if (CASES[k].is_end) text_has("a.csv has the torque 0.02 N·m at another current", run[2].remark.text);
        if (k == 0) text_has("c.csv has the torque -0.02 N·m at another current", run[0].remark.text);
    }
}

/* k_t i_q of currents that vary by a hundredth, in 16 rows, of milliamperes; not where nothing flows. */
static void test_a_torque_of_the_current(void)
{
    double iq_A[16], torque_Nm[16], constant = 0.0;
    for (size_t k = 0; k < 16; ++k) {
        iq_A[k] = 0.003 + 0.001 * sin(0.7 * (double)k);
        torque_Nm[k] = 0.04 * iq_A[k];
    }
    TEST_ASSERT_TRUE(hci_torque_is_of_current(torque_Nm, iq_A, 16, &constant));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.04, constant);
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque_Nm, iq_A, 15, &constant));
    for (size_t k = 0; k < 16; ++k)
        iq_A[k] = 0.0;
    TEST_ASSERT_FALSE(hci_torque_is_of_current(torque_Nm, iq_A, 16, &constant));
    TEST_ASSERT_FALSE(hci_torque_is_of_current(iq_A, torque_Nm, 16, &constant));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_number_at_other_currents);
    RUN_TEST(test_what_another_current_is);
    RUN_TEST(test_what_one_number_is);
    RUN_TEST(test_a_third_at_the_same_current);
    RUN_TEST(test_what_is_not_asked);
    RUN_TEST(test_the_end_of_a_sensor);
    RUN_TEST(test_a_torque_of_the_current);
    return UNITY_END();
}
