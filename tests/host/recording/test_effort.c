/* Whether a current works with the motion: i_q = a·acceleration + c·sign(speed) + a weight + a wave, written
 * here. */
#include "host/recording/effort.h"

#include <math.h>

#include "support/draws.h"
#include "unity.h"

enum { N = 4000 };

static uint64_t state = 3;
static double at_s[N], speed[N], iq_A[N];

void setUp(void)
{
}

void tearDown(void)
{
}

/* A steady shaft, or one whose speed swings about its mean; noise in A. */
static hci_effort effort_of(double mean, double swing, double a, double c, double weight, double noise)
{
    for (size_t k = 0; k < N; ++k) {
        const double t = 1e-3 * (double)k;
        at_s[k] = t;
        speed[k] = mean + swing * sin(3.0 * t);
        iq_A[k] = a * swing * 3.0 * cos(3.0 * t) + c * (speed[k] > 0.0 ? 1.0 : -1.0) + weight +
                  0.3 * sin(70.0 * t) + noise * ref_normal(&state);
    }
    return hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, NULL, N});
}

static void test_a_motor_accelerates_with_its_current(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const hci_effort effort = effort_of(10.0, 8.0, 0.02 * sign, 0.0, 0.0, 0.05);
        TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
        TEST_ASSERT_TRUE(hci_effort_accelerates(&effort));
        TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.02 * sign, effort.slope);
        TEST_ASSERT_FALSE(effort.has_both_ways);
    }
}

static void test_friction_takes_a_current(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const hci_effort effort = effort_of(-40.0, 0.0, 0.0, 0.1 * sign, 0.0, 0.05);
        TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
        TEST_ASSERT_FALSE(hci_effort_accelerates(&effort));
    }
}

/* A shaft that swings within a fifth of a long window is followed by shorter ones; one that hardly varies
 * about its speed is not: a control may answer late what cogging torque makes of it. */
static void test_windows_follow_the_motion(void)
{
    for (size_t k = 0; k < N; ++k) {
        at_s[k] = 1e-3 * (double)k;
        speed[k] = 100.0 * sin(31.0 * at_s[k]);
        iq_A[k] = 0.02 * cos(31.0 * at_s[k]) + 0.004 * ref_normal(&state);
    }
    const hci_effort swing = hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, NULL, N}),
                     jitter = effort_of(100.0, 8.0, -0.02, 0.2, 0.0, 0.05);
    TEST_ASSERT_TRUE(hci_effort_accelerates(&swing));
    TEST_ASSERT_EQUAL(1, hci_effort_way(&swing));
    TEST_ASSERT_FALSE(hci_effort_accelerates(&jitter));
    TEST_ASSERT_EQUAL(1, hci_effort_way(&jitter));
}

/* Forward and back a weight is told from friction. */
static void test_a_weight_is_no_friction(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const hci_effort effort = effort_of(0.0, 8.0, 0.0, 0.15 * sign, -0.4 * sign, 0.05);
        TEST_ASSERT_TRUE(effort.has_both_ways);
        TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
    }
}

static void test_a_wave_and_noise_tell_nothing(void)
{
    const hci_effort steady = effort_of(40.0, 0.0, 0.0, 0.0, 0.0, 0.05),
                     both = effort_of(0.0, 8.0, 0.0, 0.0, -0.3, 0.05);
    TEST_ASSERT_EQUAL(0, hci_effort_way(&steady));
    TEST_ASSERT_EQUAL(0, hci_effort_way(&both));
    const hci_effort few = hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, NULL, 40});
    TEST_ASSERT_EQUAL(0, hci_effort_way(&few));
}

/* A brake, forward and back; before each way the shaft waits, its speed dithers about 0, and friction holds
 * i_q where the way before has left it. */
static void test_a_shaft_that_waits_tells_no_sign(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        for (size_t k = 0; k < N; ++k) {
            const size_t half = k % (N / 2);
            const double way = half < N / 20 ? 0.0 : k < N / 2 ? 1.0 : -1.0;
            at_s[k] = 1e-2 * (double)k;
            speed[k] = 0.6 * way + (way == 0.0 ? 0.2 : 0.05) * ref_normal(&state);
            iq_A[k] = sign * (way == 0.0 ? (k < N / 2 ? 0.0 : 0.4) : 0.4 * way) + 0.01 * ref_normal(&state);
        }
        const hci_effort effort = hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, NULL, N});
        TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
        TEST_ASSERT_TRUE(effort.has_both_ways);
    }
}

/* Two turns forward and back with an arm that takes ten to forty times what friction does, and cogging
 * torque; without friction the arm alone tells nothing. */
static hci_effort beside_an_arm(double arm_A, double friction_A)
{
    static double theta_rad[N];
    for (size_t k = 0; k < N; ++k) {
        const double way = k < N / 2 ? 1.0 : -1.0,
                     x = 4.0 * REF_PI * (k < N / 2 ? (double)k : (double)(N - k)) / (N / 2);
        at_s[k] = 1e-2 * (double)k;
        theta_rad[k] = x + 0.4;
        speed[k] = 0.63 * way + 0.05 * ref_normal(&state);
        iq_A[k] = friction_A * way + arm_A * sin(theta_rad[k] + 1.0) + 0.2 * sin(60.0 * theta_rad[k]) +
                  0.01 * ref_normal(&state);
    }
    return hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, theta_rad, N});
}

static void test_friction_is_told_beside_an_arm(void)
{
    for (int sign = -1; sign <= 1; sign += 2)
        for (int times = 5; times <= 40; times *= 2) {
            const hci_effort effort = beside_an_arm(0.1 * times, 0.1 * sign);
            TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
            TEST_ASSERT_TRUE(effort.has_both_ways);
            TEST_ASSERT_FALSE(hci_effort_accelerates(&effort));
        }
    const hci_effort none = beside_an_arm(2.0, 0.0);
    TEST_ASSERT_EQUAL(0, hci_effort_way(&none));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_motor_accelerates_with_its_current);
    RUN_TEST(test_friction_takes_a_current);
    RUN_TEST(test_windows_follow_the_motion);
    RUN_TEST(test_a_weight_is_no_friction);
    RUN_TEST(test_a_wave_and_noise_tell_nothing);
    RUN_TEST(test_a_shaft_that_waits_tells_no_sign);
    RUN_TEST(test_friction_is_told_beside_an_arm);
    return UNITY_END();
}
