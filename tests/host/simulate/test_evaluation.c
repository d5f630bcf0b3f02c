/* Figures of steps that are written down here, whose means over whole periods are known: of what repeats with
 * the angle the trapezoidal rule makes no error, and of what runs straight neither. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/simulate/evaluation.h"
#include "support/plant_machine.h"
#include "unity.h"

enum {
    POINTS = 512,
    TURNS = 2,
    P = 2,
    STEPS = 400 /* of a period */,
    WHOLE = 3,
    REST = 37,
    MOST_STEPS = 2000
};

static const double SPEED = 40.0, FROM_S = 0.3, R_OHM = 0.6, B_NMS = 2e-3, COULOMB_NM = 0.04, J_KGM2 = 3e-3;

static pm_lists lists;
static hci_setup setup;
static hci_simulation simulation;
static hci_simulation_step step[MOST_STEPS];
static hci_note note;
static double rows[12 * (POINTS + 1)], step_s;

void setUp(void)
{
    memset(&setup, 0, sizeof setup);
    memset(&simulation, 0, sizeof simulation);
    memset(step, 0, sizeof step);
    pm_list(&PM_SMOOTH, &lists);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_plant_table_fill(&lists.machine, &lists.given, POINTS, rows, &setup.drive.plant.table));
    setup.machine = &lists.machine;
    setup.drive.control.table = &setup.drive.plant.table;
    setup.drive.control.loop = HCI_CURRENT_PI;
    setup.drive.control.current_every = 2;
    setup.drive.plant.resistance_ohm = R_OHM;
    setup.drive.plant.viscous_Nms = B_NMS;
    setup.drive.plant.coulomb_Nm = COULOMB_NM;
    setup.drive.plant.inertia_kgm2 = J_KGM2;
    setup.period_turns = TURNS;
    setup.highest_order = 6;
    setup.has_inductance = true;
}

void tearDown(void)
{
    hci_memory_free(simulation.spectrum_Nm);
}

/* Steps of the same length, `steps` to a period; speed below 0: backward. */
static void steps_make(size_t count, double steps, double speed)
{
    step_s = 2.0 * REF_PI * TURNS / (P * fabs(speed)) / steps;
    setup.drive.control.step_s = step_s;
    for (size_t k = 0; k < count; ++k) {
        hci_simulation_step *r = &step[k];
        r->time_s = FROM_S + step_s * (double)k;
        r->theta_e_rad = 0.7 + P * speed * step_s * (double)k;
        r->speed_rad_per_s = speed;
        r->counts = (hci_simulation_counts){10 + 3 * k, 4 + k, 1 + 2 * k, 7 + 5 * k};
    }
}

static void evaluate(size_t count)
{
    hci_evaluation *e = hci_evaluation_new(&setup);
    for (size_t k = 0; k < count; ++k)
        hci_evaluation_add(e, &step[k]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_evaluation_finish(e, &simulation, &note));
    hci_evaluation_free(e);
}

/* ---- what repeats ---- */

static double torque_Nm(double theta)
{
    return 5.0 + 0.3 * sin(1.5 * theta) - 0.2 * cos(2.0 * theta) + 0.4 * cos(0.5 * theta) -
           0.1 * sin(6.0 * theta);
}

static void waves_make(double speed)
{
    steps_make(STEPS * WHOLE + REST, STEPS, speed);
    for (size_t k = 0; k < STEPS * WHOLE + REST; ++k) {
        const double theta = step[k].theta_e_rad, length_A = sqrt(1.5) * (4.0 + 0.5 * cos(theta));
        step[k].torque_Nm = torque_Nm(theta);
        step[k].i_A[0] = length_A * cos(theta + 0.4);
        step[k].i_A[1] = length_A * sin(theta + 0.4);
    }
}

/* Mean, mean square and extremes of something at each step: means of the whole periods, extremes of all. */
typedef struct {
    double mean, square, most, least;
} figures;

static figures figures_of(double (*value)(const hci_simulation_step *))
{
    figures f = {0.0, 0.0, -INFINITY, INFINITY};
    for (size_t k = 0; k < STEPS * WHOLE + REST; ++k) {
        const double x = value(&step[k]);
        f.most = fmax(f.most, x);
        f.least = fmin(f.least, x);
        if (k >= STEPS * WHOLE) continue;
        f.mean += x / (STEPS * WHOLE);
        f.square += x * x / (STEPS * WHOLE);
    }
    return f;
}

static void expect(const figures *wanted, const hci_statistics *found, double tolerance)
{
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, wanted->mean, found->mean);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, sqrt(wanted->square), found->rms);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, wanted->most, found->most);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, wanted->least, found->least);
}

static double torque_at(const hci_simulation_step *r)
{
    return r->torque_Nm;
}

static double speed_at(const hci_simulation_step *r)
{
    return r->speed_rad_per_s;
}

static double length_at(const hci_simulation_step *r)
{
    return 4.0 + 0.5 * cos(r->theta_e_rad);
}

/* √(2/3 Σ e_s²) times the length, over √(3/2 · 2/3): e in the plane is as long as all three phases. */
static double dqx_at(const hci_simulation_step *r)
{
    double sum = 0.0;
    for (int s = 0; s < 3; ++s)
        sum += pm_emf(&PM_SMOOTH, s, r->theta_e_rad) * pm_emf(&PM_SMOOTH, s, r->theta_e_rad);
    return sqrt(sum) * length_at(r);
}

static double phase_at(const hci_simulation_step *r)
{
    double most = 0.0;
    for (int s = 0; s < 3; ++s)
        most = fmax(most, fabs(length_at(r) * cos(r->theta_e_rad + 0.4 - 2.0 * REF_PI * s / 3.0)));
    return most;
}

static void test_means_and_extremes(void)
{
    waves_make(SPEED);
    for (size_t k = 0; k < STEPS * WHOLE + REST; ++k)
        step[k].speed_rad_per_s = SPEED + 2.0 * sin(step[k].theta_e_rad) + cos(0.5 * step[k].theta_e_rad);
    evaluate(STEPS * WHOLE + REST);
    const figures torque = figures_of(torque_at), speed = figures_of(speed_at),
                  length = figures_of(length_at), dqx = figures_of(dqx_at), phase = figures_of(phase_at);
    expect(&torque, &simulation.torque_Nm, 1e-9);
    expect(&speed, &simulation.speed_rad_per_s, 1e-9);
    expect(&length, &simulation.current_A, 1e-9);
    expect(&dqx, &simulation.current_dqx_A, 1e-5); /* interpolated in the table */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, phase.most, simulation.peak_phase_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 100.0 * (torque.most - torque.least) / 5.0, simulation.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 100.0 * sqrt(0.5 * (0.09 + 0.04 + 0.16 + 0.01)) / 5.0,
                              simulation.F_ripple_percent);
}

static void test_losses_beside_a_plain_sine(void)
{
    const double square = 16.0 + 0.125, plain_A = 5.0 / (1.5 * 0.892);
    waves_make(SPEED);
    evaluate(STEPS * WHOLE + REST);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5 * R_OHM * square, simulation.copper_W);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, plain_A, simulation.plain_amplitude_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, square / (plain_A * plain_A), simulation.loss_to_plain);
}

/* Forward and backward the same torque over the angle. */
static void test_the_spectrum_of_the_torque(void)
{
    static const double SINE[13] = {[3] = 0.3, [12] = -0.1}, COSINE[13] = {[0] = 5.0, [1] = 0.4, [4] = -0.2};
    for (int back = 0; back < 2; ++back) {
        tearDown();
        setUp();
        waves_make(back ? -SPEED : SPEED);
        setup.drive.control.loop = HCI_CURRENT_IDEAL; /* of which no balance is known */
        evaluate(STEPS * WHOLE + REST);
        TEST_ASSERT_EQUAL_UINT64(13, simulation.spectrum_count);
        for (size_t n = 0; n < 13; ++n) {
            TEST_ASSERT_EQUAL_DOUBLE(0.5 * (double)n, simulation.spectrum_Nm[n].order);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, SINE[n], simulation.spectrum_Nm[n].sine);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, COSINE[n], simulation.spectrum_Nm[n].cosine);
        }
        TEST_ASSERT_EQUAL_STRING("", simulation.remark.text);
    }
}

/* Of thirty steps to a period, as many orders of it have four steps as seven, and of electrical orders half
 * as many. */
static void test_orders_with_few_steps_are_left_out(void)
{
    steps_make(61, 30.0, SPEED);
    for (size_t k = 0; k < 61; ++k)
        step[k].torque_Nm = torque_Nm(step[k].theta_e_rad);
    evaluate(61);
    TEST_ASSERT_EQUAL_UINT64(8, simulation.spectrum_count);
    TEST_ASSERT_EQUAL_STRING(
        "the spectrum ends at order 3.5, above which a period has fewer than 4 steps; what the "
        "torque has there folds onto the orders below, so give a smaller step",
        strstr(simulation.remark.text, "the spectrum"));
}

/* ---- what runs straight ---- */

/* ½ iᵀL i gains so much a second: ½ (0.02·9 − 2·0.012·6 − 0.01·4). */
static const double GAINED_W = -0.002;

/* Torque, currents and voltages that stay, and a magnetic energy that grows in proportion to time; steps that
 * do not meet the ends of periods. */
static void straight_make(double voltage_V)
{
    steps_make(STEPS * WHOLE, 300.7, SPEED);
    for (size_t k = 0; k < STEPS * WHOLE; ++k) {
        hci_simulation_step *r = &step[k];
        r->torque_Nm = 5.0;
        r->load_Nm = 4.2;
        r->i_A[0] = 3.0;
        r->i_A[1] = -2.0;
        r->v_V[0] = voltage_V;
        r->v_V[1] = -30.0;
        r->point.shaft_Nm = 0.07;
        r->point.magnetic.cogging_Nm = 0.2;
        r->point.inductance_H[0] = 0.01 * (1.0 + 2.0 * (r->time_s - FROM_S));
        r->point.inductance_H[1] = 0.004 * (1.0 + 3.0 * (r->time_s - FROM_S));
        r->point.inductance_H[2] = 0.02 * (1.0 - 0.5 * (r->time_s - FROM_S));
    }
}

static const double PERIODS_S = 3.0 * 2.0 * REF_PI * TURNS / (P * 40.0); /* of three */

static void test_energies(void)
{
    straight_make(60.0);
    evaluate(STEPS * WHOLE);
    const hci_energies *j = &simulation.energy_J;
    const double copper_J = R_OHM * 13.0 * PERIODS_S, stored_J = (GAINED_W - 0.2 * SPEED) * PERIODS_S;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, (180.0 + 60.0) * PERIODS_S, j->electrical);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, copper_J, j->copper);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, stored_J, j->stored);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5.0 * SPEED * PERIODS_S, j->mechanical);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.2 * SPEED * PERIODS_S, j->load);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, (B_NMS * SPEED + 0.07 + COULOMB_NM) * SPEED * PERIODS_S, j->friction);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, j->kinetic);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, j->electrical - copper_J - stored_J - j->mechanical, j->residual);
}

static void test_what_was_evaluated(void)
{
    straight_make(60.0);
    evaluate(STEPS * WHOLE);
    TEST_ASSERT_EQUAL_DOUBLE(step_s, simulation.step_s);
    TEST_ASSERT_EQUAL_DOUBLE(FROM_S, simulation.from_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, FROM_S + PERIODS_S, simulation.to_s);
    TEST_ASSERT_EQUAL_UINT64(WHOLE, simulation.periods);
    TEST_ASSERT_EQUAL_UINT64(TURNS, simulation.period_turns);
}

/* Counts are those of the step in which the last period ends, less those at the first. */
static void test_counts(void)
{
    const size_t last = 903; /* 3 · 300.7 = 902.1 */
    straight_make(60.0);
    setup.drive.control.loop = HCI_CURRENT_HYSTERESIS;
    evaluate(STEPS * WHOLE);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0 * (double)last / (6.0 * PERIODS_S),
                              simulation.switching_frequency_Hz);
    TEST_ASSERT_EQUAL_UINT64(451, simulation.samples);
    TEST_ASSERT_EQUAL_UINT64(last, simulation.without_current);
    TEST_ASSERT_EQUAL_UINT64(2 * last, simulation.limited);
    TEST_ASSERT_EQUAL_UINT64(5 * last, simulation.voltage_limited);
    TEST_ASSERT_EQUAL_UINT64(4 + STEPS * WHOLE - 1, simulation.without_current_from_start);
    TEST_ASSERT_EQUAL_UINT64(1 + 2 * (STEPS * WHOLE - 1), simulation.limited_from_start);
    setup.drive.control.loop = HCI_CURRENT_PI;
    setup.drive.control.current_every = 0;
    hci_memory_free(simulation.spectrum_Nm);
    evaluate(STEPS * WHOLE);
    TEST_ASSERT_TRUE(isnan(simulation.switching_frequency_Hz));
    TEST_ASSERT_EQUAL_UINT64(902, simulation.samples);
}

/* A shaft that gains speed: ½ J (ω_1² − ω_0²). */
static void test_the_kinetic_energy(void)
{
    straight_make(60.0);
    for (size_t k = 0; k < STEPS * WHOLE; ++k)
        step[k].speed_rad_per_s = sqrt(900.0 + 500.0 * (step[k].time_s - FROM_S));
    evaluate(STEPS * WHOLE);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * J_KGM2 * 500.0 * PERIODS_S, simulation.energy_J.kinetic);
}

/* Friction brakes backward as well. */
static void test_friction_backward(void)
{
    straight_make(60.0);
    for (size_t k = 0; k < STEPS * WHOLE; ++k) {
        step[k].speed_rad_per_s = -SPEED;
        step[k].theta_e_rad = -step[k].theta_e_rad;
        step[k].point.shaft_Nm = -0.07;
    }
    evaluate(STEPS * WHOLE);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, (B_NMS * SPEED + 0.07 + COULOMB_NM) * SPEED * PERIODS_S,
                              simulation.energy_J.friction);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -5.0 * SPEED * PERIODS_S, simulation.energy_J.mechanical);
}

static void test_what_is_not_known_of_energies(void)
{
    straight_make(60.0);
    setup.prescribed = true;
    setup.has_inductance = false;
    setup.drive.control.loop = HCI_CURRENT_IDEAL;
    evaluate(STEPS * WHOLE);
    const hci_energies *j = &simulation.energy_J;
    TEST_ASSERT_TRUE(isnan(j->electrical) && isnan(j->stored) && isnan(j->load) && isnan(j->friction) &&
                     isnan(j->kinetic) && isnan(j->residual));
    TEST_ASSERT_FALSE(isnan(j->copper) || isnan(j->mechanical));
    TEST_ASSERT_TRUE(simulation.energy_balances);
}

/* ---- remarks ---- */

/* A residual of a hundredth of the energies: (v − 0.01(v + rest))·i = what goes elsewhere. */
static void test_an_energy_that_does_not_balance(void)
{
    const double copper_W = R_OHM * 13.0, stored_W = GAINED_W - 0.2 * SPEED, shaft_W = 5.0 * SPEED;
    for (int balances = 0; balances < 2; ++balances) {
        const double share = balances ? 0.0099 : 0.0101;
        const double electrical_W =
            (copper_W + stored_W + shaft_W + share * (copper_W + shaft_W)) / (1.0 - share);
        tearDown();
        setUp();
        straight_make((electrical_W - 60.0) / 3.0);
        evaluate(STEPS * WHOLE);
        TEST_ASSERT_EQUAL(balances, simulation.energy_balances);
        TEST_ASSERT_EQUAL_STRING(
            balances ? ""
                     : "the energy does not balance within 1 %, so these figures mean nothing; "
                       "give a smaller step",
            simulation.remark.text);
    }
}

static void test_a_speed_that_was_not_asked_for(void)
{
    for (int k = 0; k < 4; ++k) {
        tearDown();
        setUp();
        straight_make((7.8 + GAINED_W - 8.0 + 200.0 - 60.0) / 3.0); /* balances */
        setup.drive.control.speed_controlled = k != 3;
        setup.set_point = SPEED / (k == 0 ? 1.0099 : k == 1 ? 1.0101 : k == 2 ? 0.9899 : 0.5);
        evaluate(STEPS * WHOLE);
        TEST_ASSERT_EQUAL_STRING(k == 1   ? "the speed is 381.97 rpm on average, not the 378.15 rpm asked for"
                                 : k == 2 ? "the speed is 381.97 rpm on average, not the 385.87 rpm asked for"
                                          : "",
                                 simulation.remark.text);
    }
}

/* ---- torques with hardly a mean ---- */

/* A hundredth of the swing is a mean that a ripple is measured by; so is none beside which it is rounding of
 * the cogging torque of 0.2 N·m. */
static void test_a_mean_that_is_no_measure(void)
{
    for (int k = 0; k < 4; ++k) {
        const double mean_Nm = k == 0 ? 0.0202 : k == 1 ? -0.0198 : k == 2 ? 8e-13 : 6e-13;
        tearDown();
        setUp();
        lists.cogging[1] = (hci_harmonic){12.0, 0.3, 0.4};
        lists.machine.cogging_count = 2; /* of 0.2 and 0.5 N·m */
        steps_make(STEPS + 1, STEPS, SPEED);
        for (size_t j = 0; j <= STEPS; ++j)
            step[j].torque_Nm = mean_Nm + (k < 2 ? sin(step[j].theta_e_rad - 0.7) : 0.0);
        evaluate(STEPS + 1);
        TEST_ASSERT_EQUAL(k % 2, isnan(simulation.T_ripple_percent));
        TEST_ASSERT_EQUAL(k % 2, isnan(simulation.F_ripple_percent));
        TEST_ASSERT_EQUAL(k % 2, isnan(simulation.loss_to_plain));
        TEST_ASSERT_DOUBLE_WITHIN(k < 2 ? 1e-9 : 1e-15, k == 3 ? 0.0 : mean_Nm, simulation.torque_Nm.mean);
    }
}

/* ---- less than a period ---- */

/* All of the time counts then, and there is no spectrum. */
static void test_less_than_a_period(void)
{
    steps_make(100, STEPS, SPEED);
    for (size_t k = 0; k < 100; ++k)
        step[k].torque_Nm = 2.0 + 3.0 * (double)k;
    evaluate(100);
    TEST_ASSERT_EQUAL_UINT64(0, simulation.periods);
    TEST_ASSERT_EQUAL_UINT64(0, simulation.spectrum_count);
    TEST_ASSERT_NULL(simulation.spectrum_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 + 3.0 * 49.5, simulation.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, FROM_S + 99.0 * step_s, simulation.to_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_and_extremes);
    RUN_TEST(test_losses_beside_a_plain_sine);
    RUN_TEST(test_the_spectrum_of_the_torque);
    RUN_TEST(test_orders_with_few_steps_are_left_out);
    RUN_TEST(test_energies);
    RUN_TEST(test_what_was_evaluated);
    RUN_TEST(test_counts);
    RUN_TEST(test_the_kinetic_energy);
    RUN_TEST(test_friction_backward);
    RUN_TEST(test_what_is_not_known_of_energies);
    RUN_TEST(test_an_energy_that_does_not_balance);
    RUN_TEST(test_a_speed_that_was_not_asked_for);
    RUN_TEST(test_a_mean_that_is_no_measure);
    RUN_TEST(test_less_than_a_period);
    return UNITY_END();
}
