/* The zero of the angle by the torques of two recordings: against the normal equations of a linear model with
 * what is known beforehand, solved by elimination, and against the probability of both torques, whose
 * covariance is what is not known of each. */
#include "host/check/relations/run_zero.h"

#include <math.h>

#include "host/check/convention_errors.h"
#include "support/made_up_motor.h"
#include "unity.h"

enum { RUNS = 2, UNKNOWNS = 5, FREE = 6 };

/* Standard deviations of what is not known: of a torque; of friction, and of the sensor's zero, in parts of
 * the torque of the largest current. */
static const double TORQUE = 0.04, FRICTION = 0.05, OFFSET = 0.03, OFFSET_TOLD = 0.01;

static const double I_D[RUNS] = {-2.0, 3.0}, I_Q[RUNS] = {10.0, 4.0};

static check_data data;
static check_interpretation as;

void setUp(void)
{
    data = motor_data();
    as = hci_check_as_declared();
    for (int k = 0; k < RUNS; ++k) {
        motor_record(&data, I_D[k], I_Q[k], true);
        motor_run[k].has_voltage = motor_run[k].has_phase_voltage = false;
        motor_run[k].torque_mean = motor_torque_Nm(I_D[k], I_Q[k]);
    }
}

void tearDown(void)
{
}

/* 3/2 i e*, of the frame whose zero is so far from that of the recording. */
static check_vector mutual_Nm(int k, double zero_rad)
{
    const double re = 1.5 * MOTOR_k_e * I_Q[k], im = -1.5 * MOTOR_k_e * I_D[k];
    return (check_vector){re * cos(zero_rad) + im * sin(zero_rad), im * cos(zero_rad) - re * sin(zero_rad)};
}

static double largest_Nm(void)
{
    double most = 0.0;
    for (int k = 0; k < RUNS; ++k)
        most = fmax(most, hypot(1.5 * MOTOR_k_e * I_Q[k], 1.5 * MOTOR_k_e * I_D[k]));
    return most;
}

/* p (L_d − L_q) i_d i_q over k_e i, at the largest current. */
static double reluctance_share(double reluctance_Nm_per_A2)
{
    return reluctance_Nm_per_A2 * largest_Nm() / (2.25 * MOTOR_k_e * MOTOR_k_e);
}

/* ---- how well it is known ---- */

/* Of the second unknown, the sine of the zero. */
static double error_by_elimination(double reluctance_unknown, double offset_unknown)
{
    const double most = largest_Nm();
    double a[UNKNOWNS][UNKNOWNS + 1] = {{0.0}};
    a[2][2] = pow(TORQUE / reluctance_unknown, 2.0);
    a[3][3] = pow(TORQUE / FRICTION, 2.0);
    a[4][4] = pow(TORQUE / offset_unknown, 2.0);
    for (int k = 0; k < RUNS; ++k) {
        const check_vector p = mutual_Nm(k, 0.0);
        const double x[UNKNOWNS] = {p.re, p.im, -p.re * p.im / most, -most, most};
        for (int i = 0; i < UNKNOWNS; ++i)
            for (int j = 0; j < UNKNOWNS; ++j)
                a[i][j] += x[i] * x[j] / (p.re * p.re + p.im * p.im);
    }
    a[1][UNKNOWNS] = 1.0;
    for (int k = 0; k < UNKNOWNS; ++k)
        for (int i = 0; i < UNKNOWNS; ++i)
            for (int j = UNKNOWNS; i != k && j >= k; --j)
                a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    return TORQUE * sqrt(a[1][UNKNOWNS] / a[1][1]);
}

/* A declared reluctance is known to 5 % of the magnets' torque and a quarter of itself, one that is not, 30
 * %. */
static void test_error_of_the_zero(void)
{
    static const double TIMES[] = {1.0, 0.3, -0.3};
    for (int k = 0; k < 4; ++k) {
        const double declared = k < 3 ? TIMES[k] * 1.5 * MOTOR_p * (MOTOR_L_d - MOTOR_L_q) : 0.0;
        data.inductance.reluctance_Nm_per_A2 = declared;
        data.torque_zero_is_told = k == 1;
        if (k == 3) {
            data.inductance.given = false;
            data.value[CHECK_inductance_d_H] = data.value[CHECK_inductance_q_H] = NAN;
        }
        for (int j = 0; j < RUNS; ++j)
            motor_run[j].torque_mean = 1.5 * MOTOR_k_e * I_Q[j] + declared * I_D[j] * I_Q[j];
        const check_run_zero zero = hci_check_run_zero(&data, &as);
        const double unknown = k < 3 ? 0.05 + 0.25 * fabs(reluctance_share(declared)) : 0.3;
        const double error = error_by_elimination(unknown, k == 1 ? OFFSET_TOLD : OFFSET);
        TEST_ASSERT_EQUAL(error < 0.25, zero.is_known);
        /* four passes from a zero without reluctance */
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * error, 0.0, zero.zero_rad);
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * error, error, zero.std_error_rad);
    }
}

/* ---- whether a saliency does as well ---- */

/* χ² of both torques at a zero, with a reluctance that is expected within so much; most_likely: out. */
static double left_by_covariance(double zero_rad, double expected, double unknown, double *most_likely)
{
    const double most = largest_Nm(), size[FREE] = {0.1, unknown, FRICTION, OFFSET, 0.1, 0.5};
    double x[RUNS][FREE], rest[RUNS], c[RUNS][RUNS];
    for (int k = 0; k < RUNS; ++k) {
        const check_vector p = mutual_Nm(k, zero_rad);
        const double q = p.re / most, d = -p.im / most;
        const double column[FREE] = {q, d * q, -1.0, 1.0, q * q * q, d * q * q * q};
        for (int j = 0; j < FREE; ++j)
            x[k][j] = column[j];
        rest[k] = motor_run[k].torque_mean / most - q - expected * d * q;
    }
    for (int k = 0; k < RUNS; ++k)
        for (int l = 0; l < RUNS; ++l) {
            const check_vector p = mutual_Nm(k, zero_rad);
            c[k][l] = k == l ? TORQUE * TORQUE * (p.re * p.re + p.im * p.im) / (most * most) : 0.0;
            for (int j = 0; j < FREE; ++j)
                c[k][l] += x[k][j] * x[l][j] * size[j] * size[j];
        }
    const double determinant = c[0][0] * c[1][1] - c[0][1] * c[1][0];
    const double a = (c[1][1] * rest[0] - c[0][1] * rest[1]) / determinant,
                 b = (c[0][0] * rest[1] - c[1][0] * rest[0]) / determinant;
    *most_likely = expected + unknown * unknown * (x[0][1] * a + x[1][1] * b);
    return rest[0] * a + rest[1] * b;
}

/* A saliency above what is declared, or of L_d > L_q, is less likely than one below. */
static double left_at(double zero_rad)
{
    const double declared = reluctance_share(data.inductance.reluctance_Nm_per_A2);
    double most_likely;
    const double left = left_by_covariance(zero_rad, declared, 2.0, &most_likely);
    return most_likely > fmax(0.0, declared)
               ? left_by_covariance(zero_rad, fmax(0.0, declared), 0.3, &most_likely)
               : left;
}

/* By degrees, to where χ² is by 1 above what it is at the zero. */
static double reach_rad(int way)
{
    int steps = 0;
    while (steps < 90 && left_at(way * (steps + 1) * REF_PI / 180.0) < left_at(0.0) + 1.0)
        ++steps;
    return steps * REF_PI / 180.0;
}

static void test_reach_of_the_zero(void)
{
    static const double TIMES[] = {1.0, 0.2, -1.0};
    for (int k = 0; k < 3; ++k) {
        const double declared = TIMES[k] * 1.5 * MOTOR_p * (MOTOR_L_d - MOTOR_L_q);
        data.inductance.reluctance_Nm_per_A2 = declared;
        for (int j = 0; j < RUNS; ++j)
            motor_run[j].torque_mean = 1.5 * MOTOR_k_e * I_Q[j] + declared * I_D[j] * I_Q[j];
        const check_run_zero at = {true, 0.0, 1e-3, false};
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, fmax(reach_rad(1), reach_rad(-1)),
                                  hci_check_zero_error(&data, &as, at));
    }
}

/* Friction stands against the motion, however slow it is. */
static void test_reach_at_a_slow_speed(void)
{
    const check_run_zero at = {true, 0.0, 1e-3, false};
    const double reach = hci_check_zero_error(&data, &as, at);
    for (int k = 0; k < RUNS; ++k) {
        TEST_ASSERT_TRUE(motor_run[k].has_speed);
        motor_run[k].speed = 0.1;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, reach, hci_check_zero_error(&data, &as, at));
    TEST_ASSERT_TRUE(reach > 0.0);
}

/* Torques of a zero that is so far off: it is told where it explains more than twice its error. */
static void test_zero_that_is_told(void)
{
    int told = 0, not_told = 0;
    for (int degrees = 5; degrees < 90; degrees += 5) {
        const double zero_rad = degrees * REF_PI / 180.0;
        for (int k = 0; k < RUNS; ++k) {
            const check_vector p = mutual_Nm(k, zero_rad);
            motor_run[k].torque_mean =
                p.re - data.inductance.reluctance_Nm_per_A2 * p.re * p.im / (2.25 * MOTOR_k_e * MOTOR_k_e);
        }
        const bool is_told = left_at(0.0) - left_at(zero_rad) > 4.0;
        TEST_ASSERT_EQUAL(is_told, hci_check_zero_is_told(&data, &as, zero_rad));
        told += is_told;
        not_told += !is_told;
    }
    TEST_ASSERT_TRUE(told > 0 && not_told > 0);
}

/* ---- by the drive ---- */

/* Currents so far ahead of the q of the recorded angle, in a machine without saliency; sign: of the torque.
 */
static void record_along(double ahead_rad, double second_rad, double sign)
{
    static const double AMPERES[RUNS] = {4.0, 9.0};
    data = motor_data();
    data.inductance.given = false;
    data.value[CHECK_inductance_d_H] = data.value[CHECK_inductance_q_H] = NAN;
    for (int k = 0; k < RUNS; ++k) {
        const double ahead = ahead_rad + (k > 0 ? second_rad : 0.0);
        motor_record(&data, -AMPERES[k] * sin(ahead), AMPERES[k] * cos(ahead), true);
        motor_run[k].has_voltage = motor_run[k].has_phase_voltage = false;
        motor_run[k].torque_mean = sign * 1.5 * MOTOR_k_e * AMPERES[k];
    }
}

static void test_currents_along_one_direction(void)
{
    for (int degrees = -170; degrees < 180; degrees += 20)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double ahead_rad = degrees * REF_PI / 180.0,
                         along_rad = sign > 0 ? ahead_rad : ahead_rad + REF_PI;
            record_along(ahead_rad, 0.0, sign);
            const check_run_zero zero = hci_check_run_zero(&data, &as);
            TEST_ASSERT_TRUE(zero.is_known && zero.is_of_drive);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, remainder(zero.zero_rad - along_rad, 2.0 * REF_PI));
            /* its cosine is that of 5 % of the back-EMF and 5 % beside */
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, acos(1.0 - hypot(0.05, 0.05)),
                                      hci_check_zero_error(&data, &as, zero));
        }
}

/* A declared saliency turns the currents of a drive, and several directions are none. */
static void test_currents_that_tell_no_zero(void)
{
    record_along(0.5, 0.0, 1.0);
    data.inductance = (check_inductance){
        .given = true, .are_slopes = true, .reluctance_Nm_per_A2 = 1.5 * MOTOR_p * (MOTOR_L_d - MOTOR_L_q)};
    TEST_ASSERT_FALSE(hci_check_run_zero(&data, &as).is_known);
    record_along(0.5, 0.0, 1.0);
    motor_run[1].has_dq = true; /* of the frame of the drive */
    TEST_ASSERT_FALSE(hci_check_run_zero(&data, &as).is_of_drive);
    record_along(0.5, 0.6, 1.0);
    TEST_ASSERT_FALSE(hci_check_run_zero(&data, &as).is_of_drive);
}

/* Behind q by so much, and before it: with i_d < 0, up to as much as i_q, as of a weakened field. */
static void test_loss_beside_q(void)
{
    static const double BESIDE[] = {-1.5, -0.4, -0.1, -0.03, 0.0, 0.03, 0.1, 0.4, 0.7, 0.9, 1.5};
    record_along(0.5, 0.0, 1.0);
    for (int k = 0; k < 11; ++k) {
        const double most = BESIDE[k] > 0.0 && BESIDE[k] < 0.25 * REF_PI ? 1.5 : 3.5;
        as.run_zero_rad = 0.5 - BESIDE[k];
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, fmin(0.5 * pow(BESIDE[k] / 0.06, 2.0), most),
                                  hci_check_beside_q_loss(&data, &as));
    }
    record_along(0.5, 0.6, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_check_beside_q_loss(&data, &as));
}

/* Driving and braking on one line, i_d has both signs: no field is weakened so. */
static void test_loss_of_both_signs(void)
{
    record_along(0.4, REF_PI, 1.0);
    motor_run[1].torque_mean = -motor_run[1].torque_mean;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.5, hci_check_beside_q_loss(&data, &as));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_along_one_direction);
    RUN_TEST(test_currents_that_tell_no_zero);
    RUN_TEST(test_loss_beside_q);
    RUN_TEST(test_loss_of_both_signs);
    RUN_TEST(test_error_of_the_zero);
    RUN_TEST(test_reach_of_the_zero);
    RUN_TEST(test_reach_at_a_slow_speed);
    RUN_TEST(test_zero_that_is_told);
    return UNITY_END();
}
