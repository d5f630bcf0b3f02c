/* Who watches a simulation: the plan before the first step, every step in the order of time, and nothing
 * after an error of their own. */
#include <math.h>
#include <string.h>

#include "hci/host/simulate/simulate.h"
#include "unity.h"

static hci_machine_data machine;
static hci_scenario scenario;

void setUp(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine, &note), note.text);
    hci_scenario_init(&scenario);
    scenario.duration_s = 0.01;
    scenario.step_s = 1e-4;
    scenario.prescribed_speed_rad_per_s = 40.0;
    scenario.torque_reference_Nm = 3.0;
    scenario.settle_s = 0.004;
}

void tearDown(void)
{
    hci_machine_release(&machine);
}

typedef struct {
    hci_simulation_plan plan;
    hci_status answer; /* of begin */
    int begun;
    size_t steps;
    double last_time_s, torque_sum_Nm, largest_error_rad;
} witness;

static hci_status begin(void *context, const hci_simulation_plan *plan, hci_note *note)
{
    witness *w = context;
    TEST_ASSERT_EQUAL_UINT64(0, w->steps);
    ++w->begun;
    w->plan = *plan;
    return w->answer ? hci_note_set(note, w->answer, "no room to watch from") : HCI_OK;
}

static void see(void *context, const hci_simulation_step *step)
{
    witness *w = context;
    TEST_ASSERT_TRUE(step->time_s > w->last_time_s);
    w->last_time_s = step->time_s;
    w->largest_error_rad =
        fmax(w->largest_error_rad, fabs(step->theta_e_rad - machine.pole_pairs * 40.0 * step->time_s));
    w->torque_sum_Nm += step->torque_Nm;
    ++w->steps;
}

static hci_status watch(witness *w, hci_simulation *s, hci_note *note)
{
    const hci_simulation_observer observer = {begin, see, w};
    const hci_simulate_options options = {.observer = &observer};
    w->last_time_s = -1.0;
    return hci_simulate(&machine, &scenario, &options, s, note);
}

static void test_every_step_is_shown_once(void)
{
    witness w = {.answer = HCI_OK};
    hci_simulation s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, watch(&w, &s, &note), note.text);
    TEST_ASSERT_EQUAL_INT(1, w.begun);
    TEST_ASSERT_EQUAL_UINT64(100, w.plan.steps);
    TEST_ASSERT_EQUAL_UINT64(w.plan.steps + 1, w.steps); /* those before the evaluation too */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, w.last_time_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, w.largest_error_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, w.torque_sum_Nm / (double)w.steps); /* ideal currents */
    hci_simulation_release(&s);
}

static void test_the_plan_says_of_what_the_steps_consist(void)
{
    witness w = {.answer = HCI_OK};
    hci_simulation s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_OK, watch(&w, &s, &note));
    TEST_ASSERT_EQUAL_DOUBLE(1e-4, w.plan.step_s);
    TEST_ASSERT_EQUAL_DOUBLE(0.004, w.plan.settle_s);
    TEST_ASSERT_EQUAL_INT(machine.pole_pairs, w.plan.pole_pairs);
    TEST_ASSERT_TRUE(w.plan.has_command && !w.plan.has_voltage && !w.plan.has_sensors);
    TEST_ASSERT_TRUE(isnan(w.plan.temperature_C));
    hci_simulation_release(&s);
    memset(&w, 0, sizeof w);
    scenario.current_control = HCI_CURRENT_PI;
    scenario.current_offset_a_A = 0.1;
    scenario.magnet_temperature_C = 60.0;
    TEST_ASSERT_EQUAL(HCI_OK, watch(&w, &s, &note));
    TEST_ASSERT_TRUE(w.plan.has_voltage && w.plan.has_sensors);
    TEST_ASSERT_EQUAL_DOUBLE(60.0, w.plan.temperature_C);
    hci_simulation_release(&s);
}

static void test_an_error_of_the_observer_ends_the_simulation(void)
{
    witness w = {.answer = HCI_ERROR_OUTPUT};
    hci_simulation s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, watch(&w, &s, &note));
    TEST_ASSERT_EQUAL_STRING("no room to watch from", note.text);
    TEST_ASSERT_EQUAL_UINT64(0, w.steps);
    TEST_ASSERT_NULL(s.spectrum_Nm);
}

/* A scenario that cannot be simulated is refused before anyone is told. */
static void test_a_wrong_scenario_is_not_shown(void)
{
    witness w = {.answer = HCI_OK};
    hci_simulation s;
    hci_note note = {{0}};
    scenario.duration_s = NAN;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, watch(&w, &s, &note));
    TEST_ASSERT_EQUAL_INT(0, w.begun);
}

static void test_watching_changes_nothing(void)
{
    const hci_simulate_options alone = {0};
    witness w = {.answer = HCI_OK};
    hci_simulation watched, unwatched;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_OK, watch(&w, &watched, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_simulate(&machine, &scenario, &alone, &unwatched, &note));
    TEST_ASSERT_EQUAL_DOUBLE(unwatched.torque_Nm.rms, watched.torque_Nm.rms);
    TEST_ASSERT_EQUAL_DOUBLE(unwatched.current_A.mean, watched.current_A.mean);
    hci_simulation_release(&watched);
    hci_simulation_release(&unwatched);
}

/* A tenth of the sampling of the controller, 1 us of a hysteresis, 2048 steps of an electrical turn at a
 * known speed, else 10 us. */
static void test_steps_that_are_not_given(void)
{
    static const struct {
        hci_current_loop control;
        double sample_s, speed_rad_per_s, step_s;
    } CASE[] = {{HCI_CURRENT_PI, 2e-4, 40.0, 2e-5},
                {HCI_CURRENT_PI, NAN, 40.0, 1e-5},
                {HCI_CURRENT_HYSTERESIS, NAN, 40.0, 1e-6},
                {HCI_CURRENT_IDEAL, NAN, 40.0, 2.0 * 3.14159265358979323846 / (40.0 * 2048.0)},
                {HCI_CURRENT_IDEAL, NAN, -40.0, 2.0 * 3.14159265358979323846 / (40.0 * 2048.0)},
                {HCI_CURRENT_IDEAL, NAN, 0.0, 1e-5}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        witness w = {.answer = HCI_ERROR_OUTPUT}; /* the plan is enough */
        hci_simulation s;
        hci_note note = {{0}};
        scenario.step_s = NAN;
        scenario.current_control = CASE[k].control;
        scenario.current_sample_time_s = CASE[k].sample_s;
        scenario.prescribed_speed_rad_per_s = CASE[k].speed_rad_per_s;
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_OUTPUT, watch(&w, &s, &note), note.text);
        const double expected = CASE[k].control == HCI_CURRENT_IDEAL && CASE[k].speed_rad_per_s != 0.0
                                    ? CASE[k].step_s / machine.model.pole_pairs
                                    : CASE[k].step_s;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * expected, expected, w.plan.step_s);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_step_is_shown_once);
    RUN_TEST(test_the_plan_says_of_what_the_steps_consist);
    RUN_TEST(test_an_error_of_the_observer_ends_the_simulation);
    RUN_TEST(test_a_wrong_scenario_is_not_shown);
    RUN_TEST(test_watching_changes_nothing);
    RUN_TEST(test_steps_that_are_not_given);
    return UNITY_END();
}
