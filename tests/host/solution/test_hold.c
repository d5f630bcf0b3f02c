/* What a sampled loop leaves of currents, and high orders that are priced for it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/solution/hold.h"
#include "support/solving.h"

void setUp(void)
{
    solving_start("data/machine_a", 2.46);
}

void tearDown(void)
{
    solving_end();
}

/* A sine of amplitude A and step x between two samples is missed by 1 − cos(x/2) of A between them, x²/8 of a
 * small step: here order 6 in the rotor frame, of which a sine of back-EMF makes 3/2 K of torque. */
static void test_a_sine_between_its_samples(void)
{
    const double amplitude_A = 2.0, k = 0.3, sample_rad = 0.02;
    const hci_wave emf = {1.0, 1, k, 0.0}, current = {7.0, 1, amplitude_A, 0.0};
    const hci_task task = {.gradient = &emf, .gradient_count = 1, .period_turns = 1};
    const double missed = 1.0 - cos(0.5 * 6.0 * sample_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 2.0 * 1.5 * k * amplitude_A * missed,
                              hci_hold_ripple_Nm(&task, &current, 1, sample_rad) /* order x⁴ is left out */);
}

static double ripple_Nm(double sample_rad)
{
    const hci_task task = {.gradient = machine.model.back_emf,
                           .gradient_count = machine.model.back_emf_count,
                           .period_turns = 1};
    return hci_hold_ripple_Nm(&task, solution.current.wave, solution.current.count, sample_rad);
}

static double solve(void)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_solve(&machine, &options, &solution, &note), note.text);
    return hci_waves_mean_square(solution.current.wave, solution.current.count);
}

/* 1500 rpm at 10 kHz. */
static void test_high_orders_are_priced(void)
{
    const double sample_rad = 100.0 * HCI_PI * 1e-4;
    const double copper_A2 = solve(), before_Nm = ripple_Nm(sample_rad);
    options.sample_rad = sample_rad;
    TEST_ASSERT_TRUE(solve() <= 1.5 * copper_A2 * (1.0 + 1e-9));
    TEST_ASSERT_TRUE(ripple_Nm(sample_rad) < 0.6 * before_Nm);
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "reduced: "));
}

/* Where R and L are known, of all currents with this torque those that miss least: clarabel finds 1.6 % with
 * orders up to 71. The torque stays, the copper and the dc link are kept. */
static void test_the_least_is_missed(void)
{
    const double copper_A2 = solve();
    double missed_percent = 0.0;
    machine.resistance_ohm = 0.1;
    machine.inductance_d_H = machine.inductance_q_H = 0.5e-3;
    options.sample_rad = 100.0 * HCI_PI * 1e-4;
    options.speed_rad_per_s = 50.0 * HCI_PI;
    options.limit_voltage_V = 100.0;
    TEST_ASSERT_TRUE(solve() <= 1.5 * copper_A2 * (1.0 + 1e-6));
    TEST_ASSERT_TRUE(solution.within_limits);
    TEST_ASSERT_TRUE(solution.worst_error_Nm < solution.tolerance_Nm);
    TEST_ASSERT_EQUAL_INT(
        1, sscanf(solution.remark.text, "between its samples the loop misses %lf", &missed_percent));
    TEST_ASSERT_TRUE(missed_percent < 1.8);
}

/* Machine C has reluctance, and at 3000 rpm the sampling at 10 kHz leaves orders up to 12 of the rotor frame,
 * which do not make a torque without ripple: what little freedom there is is no reason to give torque away.
 */
static void test_torque_is_not_given_away_with_reluctance(void)
{
    hci_note note = {{0}};
    solving_end();
    solving_start("data/machine_c", 8.0);
    options.sample_rad = 200.0 * HCI_PI * 1e-4;
    options.highest_rotor_order = 12.0;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_NOT_REACHED, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_TRUE(solution.newton_converged);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 8.0, solution.order[0].torque_Nm.cosine);
    TEST_ASSERT_TRUE(solution.worst_error_Nm < 0.1);
}

/* Turning the other way, the mirror image of the machine (e(θ) and T_cog(θ) become −e(−θ) and −T_cog(−θ))
 * with the negative torque takes the same, but for the angles at which the loop is looked at. */
static void test_the_other_direction_is_a_mirror_image(void)
{
    machine.resistance_ohm = 0.1;
    machine.inductance_d_H = machine.inductance_q_H = 0.5e-3;
    options.sample_rad = 200.0 / 3.0 * HCI_PI * 1e-4;
    options.speed_rad_per_s = 100.0 / 3.0 * HCI_PI;
    options.limit_voltage_V = 100.0;
    const double copper_A2 = solve();
    for (size_t k = 0; k < machine.model.back_emf_count; ++k)
        ((hci_wave *)(uintptr_t)machine.model.back_emf)[k].cosine *= -1.0;
    for (size_t k = 0; k < machine.model.cogging_count; ++k)
        ((hci_harmonic *)(uintptr_t)machine.model.cogging)[k].cosine *= -1.0;
    order[0].torque_Nm.cosine *= -1.0;
    options.speed_rad_per_s *= -1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * copper_A2, copper_A2, solve());
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "reduced: "));
}

/* Currents that a limit puts in the place of those of which the loop misses least are told of by themselves.
 */
static void test_what_limits_put_in_their_place_is_told(void)
{
    const double sample_rad = 100.0 * HCI_PI * 1e-4;
    double missed_percent = 0.0;
    options.sample_rad = sample_rad;
    solve();
    const double mean_Nm = solution.order[0].torque_Nm.cosine;
    options.limit_current_A = 0.99 * solution.peak_phase_current_A;
    hci_solution_release(&solution);
    TEST_ASSERT_TRUE(hci_solve(&machine, &options, &solution, NULL) <= HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(solution.within_limits);
    TEST_ASSERT_NULL(strstr(solution.remark.text, "reduced: "));
    const char *told = strstr(solution.remark.text, "between its samples");
    TEST_ASSERT_NOT_NULL(told);
    TEST_ASSERT_EQUAL_INT(1, sscanf(told, "between its samples the loop misses %lf", &missed_percent));
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * missed_percent, 100.0 * ripple_Nm(sample_rad) / mean_Nm, missed_percent);
}

/* At a tenth of the speed it is not worth a price. */
static void test_nothing_is_priced_where_little_is_missed(void)
{
    const double copper_A2 = solve();
    options.sample_rad = 10.0 * HCI_PI * 1e-4;
    TEST_ASSERT_EQUAL_DOUBLE(copper_A2, solve());
    TEST_ASSERT_NULL(strstr(solution.remark.text, "reduced: "));
    TEST_ASSERT_NULL(strstr(solution.remark.text, "the loop misses"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sine_between_its_samples);
    RUN_TEST(test_high_orders_are_priced);
    RUN_TEST(test_the_least_is_missed);
    RUN_TEST(test_torque_is_not_given_away_with_reluctance);
    RUN_TEST(test_the_other_direction_is_a_mirror_image);
    RUN_TEST(test_what_limits_put_in_their_place_is_told);
    RUN_TEST(test_nothing_is_priced_where_little_is_missed);
    return UNITY_END();
}
