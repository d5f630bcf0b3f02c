/* Effects that recordings tell only where they vary the right thing: each is hidden by its own equation, and
 * found where that varies, and not named where it is not there. */
#include "host/base/memory.h"

#include "support/diagnosing.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* The value within three standard errors, which are a share of it at most. */
static void is_value(double expected, double share, const hci_effect_term *t)
{
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, expected, t->value);
    TEST_ASSERT_TRUE(t->std_error < share * fabs(expected));
}

static double sign_of(double x)
{
    return x < 0.0 ? -1.0 : 1.0;
}

/* ---- friction at low speed ---- */

static const double SPEEDS[] = {3.0, 7.0, 12.0, 25.0, 60.0, 150.0};

/* Twelve runs there and back: Coulomb and viscous friction, and an excess that fades like a Gauss curve. */
static void record_sliding(double excess_Nm)
{
    for (int k = 0; k < 12; ++k) {
        const double speed = (k % 2 ? -1.0 : 1.0) * SPEEDS[k / 2], u = speed / 15.0;
        const double brake_Nm = 0.03 + 1e-4 * fabs(speed) + excess_Nm * exp(-u * u);
        record(450, &(point){speed, k % 3 ? 2.0 : 0.0, 0.0, sign_of(speed) * brake_Nm, 0.0});
    }
}

static void test_stribeck_friction(void)
{
    record_sliding(0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("stribeck_friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, count_of(HCI_FINDING_ADDED));
    is_value(0.05, 0.05, term("stribeck_friction", "excess", 0.0));
    is_value(15.0, 0.05, term("stribeck_friction", "speed", 0.0));
    is_value(0.03, 0.05, term("friction", "coulomb", 0.0));
}

static void test_plain_friction_has_no_excess(void)
{
    record_sliding(0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("stribeck_friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
}

/* ---- a zero that creeps ---- */

/* Two currents there, two back and faster; n: samples, 300 a turn. */
static void record_creeping(size_t n, double rate_Nm_per_s)
{
    for (int k = 0; k < 4; ++k) {
        record(n, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < n; ++j)
            run[k].torque_Nm[j] += rate_Nm_per_s * (run[k].time_s[j] - run[k].time_s[0]);
    }
}

static void is_drift(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_drift")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    is_value(0.03, 0.05, term("torque_drift", "rate", 0.0));
}

static void test_drift_of_the_torque_sensor(void)
{
    record_creeping(3000, 0.03);
    is_drift();
}

/* So long that only means over turns are kept of it. */
static void test_drift_in_long_runs(void)
{
    record_creeping(9000, 0.03);
    is_drift();
}

/* A wrong zero is none, and nothing is none. */
static void test_what_stands_still_does_not_drift(void)
{
    for (int k = 0; k < 4; ++k)
        record(3000, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.02, 0.0});
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("torque_drift")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("torque_sensor")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_stribeck_friction);
    RUN_TEST(test_plain_friction_has_no_excess);
    RUN_TEST(test_drift_of_the_torque_sensor);
    RUN_TEST(test_drift_in_long_runs);
    RUN_TEST(test_what_stands_still_does_not_drift);
    return UNITY_END();
}
