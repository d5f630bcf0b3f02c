/* The simulated drive: what `solve` promised against what the plant does, energy, control, limits, effects,
 * failing memory. */
#include <cjson/cJSON.h>

#include "hci/host/simulate/simulate.h"
#include "support/simulating.h"
#include "support/texts.h"

void setUp(void)
{
    drives_start();
}

void tearDown(void)
{
    drives_end();
}

/* ---- promised and simulated torque ---- */

static void test_imposed_currents_keep_the_promise_of_machine_a(void)
{
    static const char *const TARGET[] = {"data/scenarios/02/target.csv", "data/scenarios/12/target.csv"};
    for (size_t k = 0; k < 2; ++k) {
        hci_solution solution = solve(&machine_a, TARGET[k], HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
        assert_promise_is_kept(&machine_a, "duration,0.05,s\nprescribed_speed,1500,rpm\nstep,7.3,us\n" TURNED,
                               &solution);
    }
}

/* Machine C has reluctance torque, and the currents of a strategy have orders without end; the other
 * strategies are in test_simulate_paper.c. */
static void test_imposed_currents_keep_the_promise_of_machine_c(void)
{
    static const hci_method METHOD[] = {HCI_METHOD_AUTO, HCI_METHOD_POINTWISE};
    files_write(files_path("target.csv"), "order,amplitude_Nm,phase_rad\n0,8,0\n");
    for (size_t k = 0; k < 2; ++k) {
        hci_solution solution = solve(&machine_c, files_path("target.csv"), METHOD[k], HCI_STRATEGY_MTPA);
        assert_promise_is_kept(&machine_c, "duration,0.8,s\nprescribed_speed,80,rpm\nstep,147.3,us\n" TURNED,
                               &solution);
    }
}

/* The torque in proportion: currents_per_Nm.csv and currents_constant.csv at another torque than the one
 * solved for. */
static void test_a_solution_is_scaled_by_the_torque(void)
{
    hci_solution solution =
        solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    hci_simulation s =
        simulate(&machine_a, "duration,0.05,s\nprescribed_speed,1500,rpm\ntorque_reference,1.3,Nm\n" TURNED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.3, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(s.T_ripple_percent < 1e-3);
    hci_simulation_release(&s);
    hci_solution_release(&solution);
}

/* An electrical turn takes 20 ms and has 42.6 steps of 0.47 ms: order 10 has four of them, order 11 has not.
 */
static void test_spectrum_ends_where_a_period_has_four_steps(void)
{
    hci_solution solution =
        solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    hci_simulation s =
        simulate(&machine_a, "duration,0.2,s\nprescribed_speed,1500,rpm\nstep,0.47,ms\n" TURNED);
    TEST_ASSERT_EQUAL_UINT64(11, s.spectrum_count);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, s.spectrum_Nm[10].order);
    text_has("the spectrum ends at order 10, above which a period has fewer than 4 steps", s.remark.text);
    hci_simulation_release(&s);
    hci_solution_release(&solution);
}

/* A rotor that its own torque shakes: at equal steps of time the angles are uneven, the spectrum over the
 * angle is the same. */
static void test_spectrum_is_over_the_angle(void)
{
    const hci_wave sine = hci_wave_polar(1.0, 1, 6.0, 0.0);
    double orders[4096];
    hci_harmonic predicted[4096];
    size_t count;
    hci_simulation s;
    files_write(files_path("sine.csv"), "order,set,amplitude_A,phase_rad\n1,pos,6,0\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_orders(&machine_c.model, &sine, 1, orders, 4096, &count));
    hci_torque_spectrum(&machine_c.model, &sine, 1, orders, count, predicted);
    s = simulate(
        &machine_c,
        "duration,1.2,s\ncurrents,sine.csv,\ninitial_speed,80,rpm\nload_torque,8.02,Nm\ninertia,0.002,kgm2\n"
        "settle,0.1,s\n");
    TEST_ASSERT_TRUE(s.periods >= 2);
    TEST_ASSERT_TRUE(s.speed_rad_per_s.most > 1.05 * s.speed_rad_per_s.least); /* it does shake */
    for (size_t k = 0; k < s.spectrum_count; ++k) {
        hci_harmonic wanted = {s.spectrum_Nm[k].order, 0.0, 0.0};
        for (size_t j = 0; j < count; ++j)
            if (fabs(orders[j] - wanted.order) < 1e-9) wanted = predicted[j];
        TEST_ASSERT_TRUE(difference(wanted, s.spectrum_Nm[k]) < 1e-6 * 8.0);
    }
    TEST_ASSERT_TRUE(fabs(s.torque_Nm.mean - s.spectrum_Nm[0].cosine) >
                     1e-4); /* the mean over time is another one */
    hci_simulation_release(&s);
}

static void test_turning_backwards_gives_the_same_spectrum(void)
{
    hci_simulation forward, backward;
    files_write(files_path("sine.csv"), "order,set,amplitude_A,phase_rad\n1,pos,6,0.3\n");
    forward = simulate(&machine_c, "duration,0.8,s\ncurrents,sine.csv,\nprescribed_speed,80,rpm\n");
    backward = simulate(&machine_c, "duration,0.8,s\ncurrents,sine.csv,\nprescribed_speed,-80,rpm\n");
    TEST_ASSERT_EQUAL_UINT64(forward.periods, backward.periods);
    for (size_t k = 0; k < forward.spectrum_count; ++k)
        TEST_ASSERT_TRUE(difference(forward.spectrum_Nm[k], backward.spectrum_Nm[k]) < 1e-9);
    hci_simulation_release(&forward);
    hci_simulation_release(&backward);
}

static void test_a_rotor_at_rest_has_no_spectrum(void)
{
    hci_simulation s =
        simulate(&machine_c, "duration,0.01,s\ntorque_reference,3,Nm\ncoulomb_friction,20,Nm\n");
    TEST_ASSERT_EQUAL_UINT64(0, s.periods);
    TEST_ASSERT_NULL(s.spectrum_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, s.torque_Nm.mean);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.speed_rad_per_s.most);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, s.to_s);
    hci_simulation_release(&s);
}

/* Cogging torque alone, and cancelled: what rounding leaves of the mean is compared with no plain sine. */
static void test_a_mean_of_rounding_is_none(void)
{
    static const char *const STRATEGY[] = {"id0", "mtpa"};
    for (size_t k = 0; k < 2; ++k) {
        char rows[128];
        snprintf(rows, sizeof rows,
                 "duration,0.05,s\nprescribed_speed,1500,rpm\ntorque_reference,0,Nm\nstrategy,%s,\n",
                 STRATEGY[k]);
        hci_simulation s = simulate(&machine_a, rows);
        const bool is_zero = s.torque_Nm.mean == 0.0 && s.plain_amplitude_A == 0.0;
        hci_simulation_release(&s);
        TEST_ASSERT_TRUE(is_zero);
    }
}

/* ---- control ---- */

/* Hysteresis at constant speed and torque, of a strategy that wants no ripple: what is left goes with the
 * band, but for what a step moves. The same against the paper's drive is in test_simulate_paper.c. */
static double ripple_of_band(const char *band)
{
    char text[512];
    snprintf(text, sizeof text,
             "duration,0.126,s\nsettle,0.005,s\nprescribed_speed,250,rpm\ntorque_reference,8,Nm\n"
             "current_control,hysteresis,\nswitching_frequency_max,1000,kHz\nstep,2,us\n"
             "hysteresis_band,%s,A\n",
             band);
    hci_simulation s = simulate(&machine_c, text);
    const double ripple = s.T_ripple_percent;
    TEST_ASSERT_TRUE(s.periods >= 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 8.0, s.torque_Nm.mean);
    hci_simulation_release(&s);
    return ripple;
}

static void test_ripple_goes_with_the_band(void)
{
    const double whole = ripple_of_band("0.1");
    TEST_ASSERT_TRUE(whole > 3.0 && whole < 5.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.5, ripple_of_band("0.05") / whole);
}

static void test_pi_control_holds_the_torque(void)
{
    hci_simulation s = simulate(
        &machine_c, "duration,0.45,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\ncurrent_control,pi,\n"
                    "settle,0.05,s\n");
    /* A bandwidth of 2000 rad/s follows an order 12 at 201 rad/s to a tenth: what is left is well below the
     * 36 % of i_d = 0. */
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 8.0, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(s.T_ripple_percent > 0.1 && s.T_ripple_percent < 12.0);
    hci_simulation_release(&s);
}

static double ripple_with_step(const char *step)
{
    char rows[256];
    snprintf(rows, sizeof rows,
             "duration,0.45,s\nprescribed_speed,300,rpm\ntorque_reference,8,Nm\ncurrent_control,pi,\n"
             "settle,0.05,s\nstep,%s,us\n",
             step);
    hci_simulation s = simulate(&machine_c, rows);
    const double ripple = s.T_ripple_percent;
    hci_simulation_release(&s);
    return ripple;
}

/* A step that does not divide the 100 µs of a sample changes no sample: 30 µs made one of 90, 40 one of 120.
 */
static void test_steps_divide_a_sample(void)
{
    const double ripple = ripple_with_step("10");
    TEST_ASSERT_DOUBLE_WITHIN(0.002 * ripple, ripple, ripple_with_step("30"));
    TEST_ASSERT_DOUBLE_WITHIN(0.002 * ripple, ripple, ripple_with_step("40"));
    TEST_ASSERT_DOUBLE_WITHIN(0.002 * ripple, ripple, ripple_with_step("70"));
}

static void test_limits_and_missing_currents_are_counted(void)
{
    /* Without reluctance torque no i_d cancels the cogging, wherever there is some. One period of 2048
     * samples. */
    hci_simulation s = simulate(
        &machine_a, "duration,0.025,s\nprescribed_speed,1500,rpm\ntorque_reference,2,Nm\nstrategy,cancel,\n");
    TEST_ASSERT_EQUAL_UINT64(2048, s.samples);
    TEST_ASSERT_TRUE(s.without_current > 2000 && s.without_current <= 2048);
    TEST_ASSERT_TRUE(s.without_current_from_start > s.without_current);
    TEST_ASSERT_EQUAL_UINT64(0, s.limited);
    hci_simulation_release(&s);
    s = simulate(
        &machine_c,
        "duration,0.4,s\nprescribed_speed,80,rpm\ntorque_reference,12,Nm\nstrategy,id0,\niq_limit,8,A\n");
    TEST_ASSERT_EQUAL_UINT64(s.samples, s.limited);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, s.current_dqx_A.mean); /* the limit is in the same normalisation */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, s.current_dqx_A.most);
    hci_simulation_release(&s);
}

/* ---- energy ---- */

/* A run over whole periods with friction and a free shaft: what goes in comes out. RK4 and the trapezoidal
 * rule leave 1e-6. */
static void test_energy_balances(void)
{
    static const char *const CONTROL[] = {"current_control,pi,\n", "current_control,hysteresis,\n"};
    for (size_t k = 0; k < 2; ++k) {
        char rows[512];
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 "duration,0.16,s\nstep,2,us\nspeed_reference,600,rpm\ninitial_speed,550,rpm\nload_torque,4,"
                 "Nm\nviscous_friction,0.01,\n"
                 "coulomb_friction,0.3,Nm\nsettle,0.05,s\nspeed_kp,0.5,\nspeed_ki,5,\n%s",
                 CONTROL[k]);
        s = simulate(&machine_c, rows);
        TEST_ASSERT_TRUE(s.periods >= 2);
        TEST_ASSERT_TRUE(s.energy_J.mechanical > 20.0 && s.energy_J.friction > 2.0 &&
                         fabs(s.energy_J.kinetic) > 0.1);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.electrical, 0.0, s.energy_J.residual);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.mechanical, s.energy_J.mechanical,
                                  s.energy_J.load + s.energy_J.friction + s.energy_J.kinetic);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, s.copper_W,
                                  1.5 * machine_c.resistance_ohm * s.current_A.rms * s.current_A.rms);
        hci_simulation_release(&s);
    }
}

/* Less than one period, so that the magnets' energy does not come back: about 0.05 J of cogging is in it. */
static void test_energy_balances_within_a_period(void)
{
    hci_simulation s =
        simulate(&machine_c, "duration,0.09,s\nprescribed_speed,80,rpm\ntorque_reference,5,Nm\n"
                             "current_control,pi,\nsettle,0.0873,s\n");
    TEST_ASSERT_EQUAL_UINT64(0, s.periods);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.electrical, 0.0, s.energy_J.residual);
    TEST_ASSERT_TRUE(fabs(s.energy_J.stored) > 1e-3 * s.energy_J.electrical);
    hci_simulation_release(&s);
}

/* ---- effects ---- */

static void test_effects_are_simulated(void)
{
    const hci_scenario scenario =
        scenario_of("duration,0.8,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\n");
    const hci_simulate_options without = {0};
    hci_effects_data effects;
    hci_simulate_options with = {0};
    hci_simulation s;
    hci_note note = {{0}};
    files_write(files_path("effects.csv"),
                "effect,parameter,value,unit,std_error\ncogging,sine_5,0.25,Nm,\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read(files_path("effects.csv"), &effects, &note),
                              note.text);
    with.effects = &effects.list;
    machine_c.has_effects = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_simulate(&machine_c, &scenario, &without, &s, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "effects.csv"));
    note.text[0] = '\0';
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_simulate(&machine_c, &scenario, &with, &s, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, s.period_turns);
    for (size_t k = 0; k < s.spectrum_count; ++k) { /* the controller does not know of it */
        const double wanted = fabs(s.spectrum_Nm[k].order - 5.0) < 1e-9 ? 0.25 : 0.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, wanted, s.spectrum_Nm[k].sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, k == 0 ? 8.0 : 0.0, s.spectrum_Nm[k].cosine);
    }
    hci_simulation_release(&s);
    hci_effects_release(&effects);
}

/* ---- failing memory ---- */

/* Lets n allocations succeed, n = 0, 1, 2, … until the run does; every failure says so and leaves no file. */
static void test_every_allocation_may_fail(void)
{
    hci_solution solution =
        solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {files_path("out"), NULL};
    cJSON_Hooks hooks = {hci_memory_malloc, hci_memory_free};
    hci_scenario scenario =
        scenario_of("duration,0.02,s\nprescribed_speed,1500,rpm\ncurrents,solution,\ntorque_reference,2,Nm\n"
                    "step,50,us\nangle_delay,100,us\ntrajectory_every,100,\n");
    hci_status status = HCI_ERROR_MEMORY;
    long n = 0;
    hci_solution_release(&solution);
    cJSON_InitHooks(&hooks);
    for (; status == HCI_ERROR_MEMORY; n += n < 100 ? 1 : 5) {
        hci_simulation s;
        hci_note note = {{0}};
        memset(&s, 0, sizeof s);
        hci_memory_fail_after(n);
        status = hci_scenario_read(files_path("scenario.csv"), &scenario, &note);
        if (!status) status = hci_simulate_to_folder(&machine_a, &scenario, &options, &where, &s, &note);
        hci_memory_fail_after(-1);
        hci_simulation_release(&s);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_MEMORY, status, note.text);
        TEST_ASSERT_TRUE(note.text[0] != '\0');
        TEST_ASSERT_TRUE(files_count(files_path("out")) <= 0);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_EQUAL_INT(3, files_count(files_path("out")));
    TEST_ASSERT_TRUE(n > 60);
    cJSON_InitHooks(NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_imposed_currents_keep_the_promise_of_machine_a);
    RUN_TEST(test_imposed_currents_keep_the_promise_of_machine_c);
    RUN_TEST(test_a_solution_is_scaled_by_the_torque);
    RUN_TEST(test_spectrum_ends_where_a_period_has_four_steps);
    RUN_TEST(test_spectrum_is_over_the_angle);
    RUN_TEST(test_turning_backwards_gives_the_same_spectrum);
    RUN_TEST(test_a_rotor_at_rest_has_no_spectrum);
    RUN_TEST(test_a_mean_of_rounding_is_none);
    RUN_TEST(test_ripple_goes_with_the_band);
    RUN_TEST(test_pi_control_holds_the_torque);
    RUN_TEST(test_steps_divide_a_sample);
    RUN_TEST(test_limits_and_missing_currents_are_counted);
    RUN_TEST(test_energy_balances);
    RUN_TEST(test_energy_balances_within_a_period);
    RUN_TEST(test_effects_are_simulated);
    RUN_TEST(test_every_allocation_may_fail);
    return UNITY_END();
}
