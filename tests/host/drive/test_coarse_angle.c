/* The mean torque of a table that is read at the counts of a coarse encoder, against its closed form. */
#include "host/drive/coarse_angle.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { ORDERS = 2, PAIRS = 2 };

static const double K_NM_PER_A = 0.2; /* of a phase */

static const hci_wave emf = {1.0, 1, K_NM_PER_A, 0.0};
static const uint16_t orders[ORDERS] = {0, 1};
static const hci_loop_range ranges[ORDERS] = {{1e6f, 2e6f}, {1e6f, 2e6f}};
static hci_loop_wave waves[2 * ORDERS];
static hci_loop_f32 loop;
static hci_machine machine;

/* i_q = mean + wave cos 6θ at a torque of 1 N·m, twice that at 2 N·m, whatever the speed. */
static void make(double mean_A, double wave_A)
{
    for (int level = 0; level < 2; ++level) {
        waves[level] = (hci_loop_wave){.current_A = {{0.0f, 0.0f}, {(float)((level + 1) * mean_A), 0.0f}}};
        waves[2 + level] =
            (hci_loop_wave){.current_A = {{0.0f, 0.0f}, {(float)((level + 1) * wave_A), 0.0f}}};
    }
    loop = (hci_loop_f32){.waves = waves,
                          .orders = orders,
                          .ranges = ranges,
                          .order_count = ORDERS,
                          .levels = 2,
                          .points = 96,
                          .repeats = 6,
                          .period_turns = 1,
                          .base_order = 6.0f,
                          .torque_low_Nm = 1.0f,
                          .torque_high_Nm = 2.0f,
                          .resistance_ohm = 0.7f,
                          .inductance_H = {2e-3f, 3e-3f},
                          .proportional_ohm = {5.0f, 4.0f},
                          .integral_ohm_per_s = {1400.0f, 900.0f},
                          .sample_s = 1e-4f,
                          .delay_s = 1.5e-4f,
                          .whole_rad_per_s = 1e6f};
    loop.crc32 = hci_loop_crc32(&loop);
    machine = (hci_machine){.pole_pairs = PAIRS, .back_emf = &emf, .back_emf_count = 1};
}

void setUp(void)
{
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

static double mean_Nm(double counts, double torque_Nm)
{
    return hci_coarse_mean_Nm(&loop, &machine, NULL, counts, torque_Nm);
}

/* A current that is held over a count makes less of its torque by sin(x)/x, x half a count in electrical
 * angle. */
static double held_share(double counts)
{
    const double x = REF_PI * PAIRS / counts;
    return sin(x) / x;
}

static void test_a_sine(void)
{
    static const double COUNTS[] = {6.0, 12.0, 40.0, 500.0};
    make(3.0, 0.0);
    for (int k = 0; k < 4; ++k) {
        const double whole_Nm = 1.5 * K_NM_PER_A * 3.0 * held_share(COUNTS[k]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5 * whole_Nm, whole_Nm, mean_Nm(COUNTS[k], 1.0));
        TEST_ASSERT_DOUBLE_WITHIN(4e-5 * whole_Nm, 2.0 * whole_Nm, mean_Nm(COUNTS[k], 2.0));
    }
}

/* Six counts to an electrical turn see order 6 at one phase alone, which is a mean; twelve at two that
 * cancel. */
static void test_an_order_that_acts_as_a_mean(void)
{
    make(3.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 1.5 * K_NM_PER_A * 3.5 * held_share(6 * PAIRS), mean_Nm(6 * PAIRS, 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 1.5 * K_NM_PER_A * 3.0 * held_share(12 * PAIRS),
                              mean_Nm(12 * PAIRS, 1.0));
}

/* Cogging torque has no mean, and a friction takes of it what it does at any angle. */
static void test_effects_are_added(void)
{
    const hci_effect_type *brake = hci_effect_type_find("friction");
    hci_effect_term term = {0, 0.0, 0.05, NAN};
    const hci_effect effect = {brake, &term, 1};
    const hci_effects effects = {&effect, 1};
    make(3.0, 0.0);
    const double without_Nm = mean_Nm(24.0, 1.0);
    const hci_sample still = {.theta_m_rad = 0.3, .temperature_C = NAN};
    const double brakes_Nm = hci_effects_torque(&machine, &effects, &still, NULL).torque_Nm;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, without_Nm + brakes_Nm,
                              hci_coarse_mean_Nm(&loop, &machine, &effects, 24.0, 1.0));
}

static void test_which_are_coarse(void)
{
    TEST_ASSERT_TRUE(hci_angle_is_coarse(47.0, 2, 12.0));
    TEST_ASSERT_FALSE(hci_angle_is_coarse(48.0, 2, 12.0));
    TEST_ASSERT_FALSE(hci_angle_is_coarse(0.0, 2, 12.0));
}

static void test_without_memory(void)
{
    make(3.0, 0.0);
    hci_memory_fail_after(0);
    TEST_ASSERT_TRUE(isnan(mean_Nm(24.0, 1.0)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sine);
    RUN_TEST(test_an_order_that_acts_as_a_mean);
    RUN_TEST(test_effects_are_added);
    RUN_TEST(test_which_are_coarse);
    RUN_TEST(test_without_memory);
    return UNITY_END();
}
