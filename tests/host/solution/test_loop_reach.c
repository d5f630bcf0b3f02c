/* What a current loop makes of the torque of currents, against a loop of first order that is integrated in
 * time in the rotor frame. */
#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/machine/torque.h"
#include "host/recording/rotor_frame.h"
#include "host/solution/loop_reach.h"
#include "support/reference.h"
#include "support/solving.h"

#define INDUCTANCE_H   0.5e-3
#define RESISTANCE_OHM 0.1

static hci_uncertainty nothing_known;

void setUp(void)
{
    solving_start("data/machine_a", 2.46);
    memset(&nothing_known, 0, sizeof nothing_known);
    options.uncertainty = &nothing_known;
}

void tearDown(void)
{
    solving_end();
}

static void solve(void)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_solve(&machine, &options, &solution, &note), note.text);
}

/* ---- the loop in time ---- */

enum { STEPS = 1 << 14, TURNS = 6 };

/* A loop at an electrical speed; inductance 0: no back-EMF acts on it. */
typedef struct {
    double bandwidth_rad_per_s, speed_rad_per_s, ahead_rad, inductance_H, resistance_ohm;
} loop;

static hci_dq reference_at(double theta)
{
    double i[3];
    hci_waves_at(solution.current.wave, solution.current.count, theta, i);
    return hci_park(hci_clarke(i), theta);
}

/* Harmonics of the back-EMF, V, in the rotor frame: those beside its fundamental. */
static hci_dq harmonics_at(const loop *l, double theta)
{
    double e[3];
    hci_waves_at(machine.model.back_emf + 1, machine.model.back_emf_count - 1, theta, e);
    hci_dq v = hci_park(hci_clarke(e), theta);
    v.d *= l->speed_rad_per_s / machine.model.pole_pairs;
    v.q *= l->speed_rad_per_s / machine.model.pole_pairs;
    return v;
}

/* An axis of the PI loop with k_p = ω_b L and k_i = ω_b R. */
typedef struct {
    double current, integral;
} axis;

static void step(const loop *l, axis *x, double reference, double disturbance, double dt)
{
    const double w = l->bandwidth_rad_per_s, error = reference - x->current;
    if (l->inductance_H == 0.0) {
        x->current += w * error * dt;
        return;
    }
    const double v = w * l->inductance_H * error + x->integral;
    x->integral += w * l->resistance_ohm * error * dt;
    x->current += (v - disturbance - l->resistance_ohm * x->current) / l->inductance_H * dt;
}

/* Peak to peak of the torque less that of the reference, in the last turn. */
static double missed_Nm(const loop *l)
{
    const double turn_rad = 2.0 * REF_PI, dt = turn_rad / STEPS / l->speed_rad_per_s;
    axis d = {0.0, 0.0}, q = {0.0, 0.0};
    double least = INFINITY, most = -INFINITY;
    d.current = reference_at(0.0).d, q.current = reference_at(0.0).q;
    d.integral = l->resistance_ohm * d.current, q.integral = l->resistance_ohm * q.current;
    for (size_t k = 0; k < TURNS * STEPS; ++k) {
        const double theta = turn_rad * (double)(k % STEPS) / STEPS;
        const hci_dq exact = reference_at(theta), asked = reference_at(theta + l->ahead_rad);
        const hci_dq e = harmonics_at(l, theta);
        double flows[3], wanted[3];
        hci_phases_of_dq((hci_dq){d.current, q.current, 0.0}, theta, flows);
        hci_phases_of_dq(exact, theta, wanted);
        const double x =
            hci_torque_at(&machine.model, theta, flows) - hci_torque_at(&machine.model, theta, wanted);
        if (k >= (TURNS - 1) * STEPS) least = fmin(least, x), most = fmax(most, x);
        step(l, &d, asked.d, e.d, dt);
        step(l, &q, asked.q, e.q, dt);
    }
    return most - least;
}

static loop loop_of(double bandwidth_Hz, double rpm)
{
    return (loop){2.0 * REF_PI * bandwidth_Hz, rpm * REF_PI / 30.0 * machine.model.pole_pairs, 0.0, 0.0, 0.0};
}

/* ---- as far as it follows ---- */

static void test_up_to_the_speed_a_tenth_of_the_plain_ripple_is_missed(void)
{
    solve();
    const double before_Nm = 0.01 * solution.T_ripple_before_percent * 2.46;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * before_Nm, 0.1 * before_Nm, solution.loop.allowed_Nm);
    const loop l = loop_of(200.0, 200.0 * solution.loop.rpm_per_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * solution.loop.allowed_Nm, solution.loop.allowed_Nm, missed_Nm(&l));
    TEST_ASSERT_TRUE(solution.loop.leaves_out_back_emf);
}

static void test_read_ahead_it_is_farther(void)
{
    solve();
    loop l = loop_of(200.0, 200.0 * solution.loop.lead_rpm_per_Hz);
    l.ahead_rad = l.speed_rad_per_s / l.bandwidth_rad_per_s;
    TEST_ASSERT_TRUE(solution.loop.lead_rpm_per_Hz > 3.0 * solution.loop.rpm_per_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * solution.loop.allowed_Nm, solution.loop.allowed_Nm, missed_Nm(&l));
}

/* ---- at a speed ---- */

static void solve_at(double bandwidth_Hz, double rpm)
{
    machine.inductance_d_H = machine.inductance_q_H = INDUCTANCE_H;
    machine.resistance_ohm = RESISTANCE_OHM;
    options.loop_bandwidth_Hz = bandwidth_Hz;
    options.speed_rad_per_s = rpm * REF_PI / 30.0;
    solve();
}

static void test_harmonics_of_the_back_EMF_act_on_a_PI_loop(void)
{
    const double rpm = 300.0;
    solve_at(320.0, rpm);
    loop l = loop_of(320.0, rpm);
    l.inductance_H = INDUCTANCE_H, l.resistance_ohm = RESISTANCE_OHM;
    const double missed = missed_Nm(&l);
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * missed, missed, solution.loop.added_Nm);
    l.ahead_rad = l.speed_rad_per_s / l.bandwidth_rad_per_s;
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * missed, missed_Nm(&l), solution.loop.lead_added_Nm);
    TEST_ASSERT_FALSE(solution.loop.leaves_out_back_emf);
}

static void test_without_recordings_nothing_is_looked_at_unless_it_is_asked(void)
{
    char words[512];
    options.uncertainty = NULL;
    solve();
    TEST_ASSERT_DOUBLE_IS_NAN(solution.loop.rpm_per_Hz);
    hci_loop_reach_words(&solution.loop, words, sizeof words);
    TEST_ASSERT_EQUAL_STRING("", words);
    solve_at(320.0, 300.0);
    TEST_ASSERT_TRUE(solution.loop.added_Nm > 0.0);
}

/* ---- in words ---- */

static void says(const hci_loop_reach *l, const char *expected)
{
    char words[512];
    hci_loop_reach_words(l, words, sizeof words);
    TEST_ASSERT_EQUAL_STRING(expected, words);
}

static void test_words_have_the_speed_and_round_it_down(void)
{
    hci_loop_reach l = {0.0, 0.0, 0.0051, 0.0987, 0.349, NAN, NAN, false};
    says(&l, "a current loop adds no more than 0.0051 N·m, a tenth of what a plain sine leaves, up to 9.8 "
             "rpm for each 100 Hz of its bandwidth (34 rpm "
             "where the table is read ahead by the delay of the loop)");
    l.bandwidth_Hz = 500.0;
    says(&l, "a current loop of 500 Hz adds no more than 0.0051 N·m, a tenth of what a plain sine leaves, up "
             "to 49 rpm (170 rpm where the table is read "
             "ahead by the delay of the loop)");
    l.speed_rpm = 300.0, l.added_Nm = 0.0311, l.lead_added_Nm = 0.0101;
    says(
        &l,
        "at 300 rpm a current loop of 500 Hz adds 0.032 N·m from peak to peak (0.011 where the table is read "
        "ahead by its delay), and no more than 0.0051 N·m, a tenth of what a plain sine leaves, up to 49 rpm "
        "(170 rpm where the table is read "
        "ahead "
        "by the delay of the loop)");
    l = (hci_loop_reach){0.0, 0.0, 0.0051, HUGE_VAL, HUGE_VAL, NAN, NAN, false};
    says(&l,
         "a current loop adds no more than 0.0051 N·m, a tenth of what a plain sine leaves, at any speed");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_up_to_the_speed_a_tenth_of_the_plain_ripple_is_missed);
    RUN_TEST(test_read_ahead_it_is_farther);
    RUN_TEST(test_harmonics_of_the_back_EMF_act_on_a_PI_loop);
    RUN_TEST(test_without_recordings_nothing_is_looked_at_unless_it_is_asked);
    RUN_TEST(test_words_have_the_speed_and_round_it_down);
    return UNITY_END();
}
