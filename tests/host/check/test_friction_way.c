/* The current that overcomes friction, of two slow turns: forward less back, beside the whole current. */
#include "host/check/relations/relations.h"

#include "support/made_up_motor.h"
#include "unity.h"

static check_data data;

/* Slow turns forward and back without a torque sensor, with so much i_q for friction and a weight beside an
 * i_d. */
static void record(double friction_A, double weight_A, double d_A)
{
    data = motor_data();
    data.runs = 2;
    memset(motor_run, 0, sizeof motor_run);
    for (int k = 0; k < 2; ++k) {
        const double q_A = (k ? -friction_A : friction_A) + weight_A;
        motor_run[k].count = MOTOR_SAMPLES;
        motor_run[k].has_dq = motor_run[k].has_speed = true;
        motor_run[k].speed = k ? -1.0 : 1.0;
        motor_run[k].dq = (check_vector){d_A, q_A};
        motor_run[k].current_square = d_A * d_A + q_A * q_A;
    }
}

static double value_of(const char *relation, const check_interpretation *as)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (strcmp(hci_check_relation(k)->name, relation) == 0)
            return hci_check_relation_value(&data, hci_check_relation(k), as).found;
    TEST_FAIL_MESSAGE(relation);
    return NAN;
}

static double friction_way(void)
{
    const check_interpretation as = hci_check_as_declared();
    return value_of("friction_way", &as);
}

void setUp(void)
{
}

void tearDown(void)
{
}

/* Plain from a fifth of the rms current on, be that milliamperes or hundreds of amperes. */
static void test_a_fifth_of_the_current_is_plain(void)
{
    for (double size_A = 0.01; size_A < 2e3; size_A *= 100.0)
        for (int sign = -1; sign <= 1; sign += 2) {
            record(sign * 0.1 * size_A, 0.0, size_A * sqrt(0.99));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, sign * 0.5, friction_way());
            record(sign * 0.3 * size_A, 0.0, size_A);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, sign * 1.0, friction_way());
        }
}

/* A weight is in both alike. */
static void test_a_weight_is_no_friction(void)
{
    record(0.0, 4.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, friction_way());
    record(0.4, 4.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.4 / (0.2 * hypot(4.0, 0.4)), friction_way());
}

/* One direction tells none of it, nor do fast turns. */
static void test_what_does_not_tell(void)
{
    record(1.0, 0.0, 0.0);
    motor_run[1].speed = 1.0;
    TEST_ASSERT_FALSE(isfinite(friction_way()));
    record(1.0, 0.0, 0.0);
    motor_run[0].speed = 30.0;
    TEST_ASSERT_FALSE(isfinite(friction_way()));
    record(1.0, 0.0, 0.0);
    motor_run[0].has_torque = true;
    TEST_ASSERT_FALSE(isfinite(friction_way()));
}

/* Of files in which i_q accelerates the shaft, or brakes it: the mean of 1 and -1, and its opposite where
 * currents are counted the other way. */
static void test_the_way_that_accelerates(void)
{
    for (int first = -1; first <= 1; first += 2)
        for (int second = -1; second <= 1; second += 2)
            for (int sign = -1; sign <= 1; sign += 2) {
                check_interpretation as = hci_check_as_declared();
                record(1.0, 0.0, 0.5);
                motor_run[0].current_way = first, motor_run[1].current_way = second;
                as.current = sign;
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * sign * (first + second), value_of("motion_way", &as));
            }
}

/* Torque back less that forward, half, of a shaft that another machine turns: 1 where it brakes, by more than
 * a fifth of what the torque varies by; a zero of the sensor is in both alike. */
static double drag_way(double drag_Nm, double zero_Nm, double rms_Nm)
{
    const check_interpretation as = hci_check_as_declared();
    record(0.0, 0.0, 0.0);
    data.no_current_A = 0.3;
    for (int k = 0; k < 2; ++k) {
        motor_run[k].has_torque = true;
        motor_run[k].torque_mean = zero_Nm + (k ? drag_Nm : -drag_Nm);
        motor_run[k].torque_variance = rms_Nm * rms_Nm;
    }
    return value_of("drag_way", &as);
}

static void test_the_drag_of_a_shaft_that_is_turned(void)
{
    for (double size_Nm = 1e-3; size_Nm < 2e3; size_Nm *= 1e3)
        for (int sign = -1; sign <= 1; sign += 2) {
            TEST_ASSERT_EQUAL_DOUBLE(sign, drag_way(sign * 0.21 * size_Nm, 3.0 * size_Nm, size_Nm));
            TEST_ASSERT_FALSE(isfinite(drag_way(sign * 0.19 * size_Nm, 3.0 * size_Nm, size_Nm)));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_fifth_of_the_current_is_plain);
    RUN_TEST(test_a_weight_is_no_friction);
    RUN_TEST(test_what_does_not_tell);
    RUN_TEST(test_the_way_that_accelerates);
    RUN_TEST(test_the_drag_of_a_shaft_that_is_turned);
    return UNITY_END();
}
