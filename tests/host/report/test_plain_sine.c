/* The sine that currents are compared with is the same for solving, drawing and simulating: the one that is
 * held, or the one in phase with the positive sequence of the back-EMF's fundamental. */
#include <math.h>
#include <string.h>

#include "hci/host/simulate/simulate.h"
#include "hci/host/solve/solve.h"
#include "host/plot/plot.h"
#include "support/reference.h"
#include "unity.h"

static hci_machine_data machine;
static hci_solution solution;
static hci_wave unequal[64];

static hci_target_order smooth[1];
static const hci_target TARGET = {smooth, 1};

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&solution, 0, sizeof solution);
    smooth[0] = (hci_target_order){{0.0, 0.0, 8.0}, 1.0};
}

void tearDown(void)
{
    hci_solution_release(&solution);
    hci_machine_release(&machine);
}

static void read_machine(const char *folder)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(folder, &machine, &note), note.text);
}

/* Phases of unequal strength: the fundamental has a negative sequence too, behind all others. */
static void make_unequal(void)
{
    const size_t count = machine.model.back_emf_count;
    TEST_ASSERT_TRUE(count < sizeof unequal / sizeof *unequal);
    memcpy(unequal, machine.model.back_emf, count * sizeof *unequal);
    unequal[count] = hci_wave_polar(1.0, -1, 0.02, 1.0);
    machine.model.back_emf = unequal;
    machine.model.back_emf_count = count + 1;
}

/* i in phase with e makes 3/2 |e| |i| on average. */
static hci_wave expected(double mean_Nm)
{
    for (size_t k = 0; k < machine.model.back_emf_count; ++k) {
        const hci_wave e = machine.model.back_emf[k];
        const double scale = mean_Nm / (1.5 * (e.sine * e.sine + e.cosine * e.cosine));
        if (e.order == 1.0 && e.sequence == 1) return (hci_wave){1.0, 1, scale * e.sine, scale * e.cosine};
    }
    TEST_FAIL_MESSAGE("no fundamental");
    return (hci_wave){0};
}

static void assert_drawn(hci_wave plain)
{
    for (int k = 0; k < 12; ++k) {
        const double theta_rad = 2.0 * REF_PI * k / 12.0;
        hci_plot_point point;
        hci_plot_solution_point(&solution, theta_rad, &point);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, plain.sine * sin(theta_rad) + plain.cosine * cos(theta_rad),
                                  point.plain_A);
    }
}

static void solve(const hci_wave *held)
{
    const hci_solve_options options = {.target = &TARGET, .held = held};
    hci_note note = {{0}};
    const hci_status status = hci_solve(&machine, &options, &solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
}

/* Their currents have no part in proportion to the torque, as with a fundamental that is held; but none is.
 */
static void test_interior_magnets_are_compared_with_the_sine(void)
{
    hci_plot_facts facts;
    read_machine("data/machine_c");
    solve(NULL);
    TEST_ASSERT_NULL(solution.per_Nm);
    assert_drawn(expected(8.0));
    hci_plot_solution_facts(&solution, &facts);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(facts.baseline, "a plain sine of"), facts.baseline);
}

static void test_unequal_phases_are_compared_with_the_positive_sequence(void)
{
    read_machine("data/machine_a");
    make_unequal();
    solve(NULL);
    assert_drawn(expected(8.0));
}

static void test_braking_turns_the_sine(void)
{
    read_machine("data/machine_a");
    smooth[0].torque_Nm.cosine = -2.0;
    solve(NULL);
    assert_drawn(expected(-2.0));
}

static void test_what_is_held_is_what_others_are_compared_with(void)
{
    const hci_wave held = hci_wave_polar(1.0, 1, 30.0, 0.3);
    hci_plot_facts facts;
    read_machine("data/machine_a");
    solve(&held);
    assert_drawn(held);
    hci_plot_solution_facts(&solution, &facts);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(facts.baseline, "the held fundamental of 30 A"), facts.baseline);
}

static void test_a_simulated_drive_is_compared_with_the_positive_sequence(void)
{
    const hci_simulate_options options = {0};
    hci_scenario scenario;
    hci_simulation s;
    hci_note note = {{0}};
    read_machine("data/machine_a");
    make_unequal();
    hci_scenario_init(&scenario);
    scenario.duration_s = 0.05;
    scenario.prescribed_speed_rad_per_s = 100.0;
    scenario.torque_reference_Nm = 2.0;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_simulate(&machine, &scenario, &options, &s, &note), note.text);
    const hci_wave plain = expected(s.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, hypot(plain.sine, plain.cosine), s.plain_amplitude_A);
    hci_simulation_release(&s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_interior_magnets_are_compared_with_the_sine);
    RUN_TEST(test_unequal_phases_are_compared_with_the_positive_sequence);
    RUN_TEST(test_braking_turns_the_sine);
    RUN_TEST(test_what_is_held_is_what_others_are_compared_with);
    RUN_TEST(test_a_simulated_drive_is_compared_with_the_positive_sequence);
    return UNITY_END();
}
