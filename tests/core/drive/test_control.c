/* Controllers and the closed loop against closed forms; plant_machine.h has the machines. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "hci/drive/control.h"
#include "hci/machine/frames.h"
#include "hci/machine/torque.h"
#include "support/plant_machine.h"
#include "support/reference.h"
#include "unity.h"

enum { POINTS = 16384 };

static double rows[12 * (POINTS + 1)];
static pm_lists lists;
static hci_drive drive;
static hci_drive_state state;
static hci_current_source source;

static const double RESISTANCE_ohm = 1.5;

/* A drive with ideal currents and no limit; tests change what they need. */
static void use_machine(const pm_machine *m, size_t points)
{
    pm_list(m, &lists);
    memset(&drive, 0, sizeof drive);
    memset(&state, 0, sizeof state);
    source = (hci_current_source){.strategy = HCI_STRATEGY_ID0};
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_plant_table_fill(&lists.machine, &lists.given, points, rows, &drive.plant.table));
    drive.plant.resistance_ohm = RESISTANCE_ohm;
    drive.plant.inertia_kgm2 = 0.01;
    drive.control.table = &drive.plant.table;
    drive.control.step_s = 1e-5;
    drive.control.dc_link_V = 311.0;
    drive.control.torque_limit_Nm = INFINITY;
    drive.control.sources = &source;
    drive.control.source_count = 1;
    drive.control.id_limit = drive.control.iq_limit = drive.control.peak_limit_A = INFINITY;
}

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- PI ---- */

static void test_pi_ramps_limits_and_comes_back(void)
{
    const hci_pi pi = {2.0, 10.0};
    double integral = 0.0;
    for (int k = 0; k < 10; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2.0 * 0.5 + 10.0 * 0.5 * 0.01 * k,
                                  hci_pi_step(&pi, &integral, 0.5, 99.0, 0.01));
    /* Limited for a long time the integral settles at limit: k_p ε − (k_p ε + I − limit) = 0. */
    for (int k = 0; k < 5000; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(3.0, hci_pi_step(&pi, &integral, 50.0, 3.0, 0.01));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, integral);
    /* so that the first error of the other sign leaves the limit at once */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, hci_pi_step(&pi, &integral, -0.5, 3.0, 0.01));
    for (int k = 0; k < 5000; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(-3.0, hci_pi_step(&pi, &integral, -50.0, 3.0, 0.01));
}

static void test_integral_control_alone_does_not_wind_up(void)
{
    const hci_pi pi = {0.0, 10.0};
    double integral = 0.0;
    for (int k = 0; k < 10; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 10.0 * 0.5 * 0.01 * k, hci_pi_step(&pi, &integral, 0.5, 3.0, 0.01));
    for (int k = 0; k < 1000; ++k)
        hci_pi_step(&pi, &integral, 1.0, 3.0, 0.01);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 3.0, integral);
    for (int k = 0; k < 5; ++k)
        hci_pi_step(&pi, &integral, -1.0, 3.0, 0.01);
    TEST_ASSERT_TRUE(integral < 3.0);
}

/* J dω/dt = T with ideal currents: (ω* − ω)/ω* = e^{−σt}(cos ω_d t − σ/ω_d sin ω_d t), σ = k_p/2J, ω_n² =
 * k_i/J. */
static double speed_deviation(double step_s, unsigned every)
{
    const double j = 0.01, sigma = 0.2 / (2.0 * j), wd = sqrt(20.0 / j - sigma * sigma);
    double most = 0.0;
    use_machine(&PM_SINE, 4096);
    drive.control.step_s = step_s;
    drive.control.speed_controlled = true;
    drive.control.speed = (hci_pi){0.2, 20.0};
    drive.control.speed_every = every;
    for (int k = 0; k < (int)(0.3 / step_s); ++k) {
        const double t = step_s * k;
        const double error = 5.0 * exp(-sigma * t) * (cos(wd * t) - sigma / wd * sin(wd * t));
        most = fmax(most, fabs(state.plant.speed_rad_per_s - (5.0 - error)));
        hci_drive_step(&drive, &state, 5.0, 0.0);
    }
    return most;
}

/* Sampling delays the torque by half a sample, which is an error of the first order in the sample time. */
static void test_speed_loop_is_of_second_order(void)
{
    const double coarse = speed_deviation(1e-4, 1), fine = speed_deviation(5e-5, 1);
    TEST_ASSERT_TRUE(fine < 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 2.0, coarse / fine);
    /* a sample every 8 steps is a slower sample, whatever the step */
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 4.0, speed_deviation(5e-5, 8) / coarse);
}

static void test_speed_loop_holds_the_load(void)
{
    use_machine(&PM_INTERIOR, 2048);
    source.strategy = HCI_STRATEGY_MTPA;
    drive.control.speed_controlled = true;
    drive.control.speed = (hci_pi){2.0, 20.0};
    for (int k = 0; k < 200000; ++k)
        hci_drive_step(&drive, &state, 8.0, 6.0);
    /* the current is held while the rotor moves on by 1.6e-4 rad, where the torque of a held current is off
     * by some 1e-3 */
    TEST_ASSERT_DOUBLE_WITHIN(2e-4, 8.0, state.plant.speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 6.0, state.control.torque_Nm);
}

/* ---- PI current control ---- */

/* Fixed speed; (L s + R)/(L s² + (R + k_p)s + k_i) from a unit step to its error, that is
 * e^{−σt}(cos ω_d t + (R/L − σ)/ω_d sin ω_d t). */
static double closed_error(double l, double kp, double ki, double t)
{
    const double sigma = (RESISTANCE_ohm + kp) / (2.0 * l), wd = sqrt(ki / l - sigma * sigma);
    return exp(-sigma * t) * (cos(wd * t) + (RESISTANCE_ohm / l - sigma) / wd * sin(wd * t));
}

/* Largest deviation of i_q from the closed form after a step of 1 N·m, and of i_d from zero. */
static void current_step(double step_s, double speed, bool decoupled, double l_q, double deviation[2])
{
    const double kp = 6.0, ki = 6000.0, iq = 1.0 / (1.5 * 0.9);
    deviation[0] = deviation[1] = 0.0;
    drive.control.step_s = step_s;
    drive.control.loop = HCI_CURRENT_PI;
    drive.control.current = (hci_current_pi){.pi = {{kp, ki}, {kp, ki}}, .decoupled = decoupled};
    drive.plant.inertia_kgm2 = INFINITY;
    state.plant.theta_m_rad = 0.7;
    state.plant.speed_rad_per_s = speed;
    for (int k = 0; k < (int)(0.02 / step_s); ++k) {
        double abc[3];
        hci_plane_to_abc(state.plant.i, abc);
        const hci_dq dq = hci_park(hci_clarke(abc), 3.0 * hci_plant_angle_rad(&state.plant));
        deviation[0] = fmax(deviation[0], fabs(dq.q - iq * (1.0 - closed_error(l_q, kp, ki, step_s * k))));
        deviation[1] = fmax(deviation[1], fabs(dq.d));
        hci_drive_step(&drive, &state, 1.0, 0.0);
    }
}

static void test_current_loop_at_rest_is_of_second_order(void)
{
    double coarse[2], fine[2];
    use_machine(&PM_SINE, 4096);
    current_step(2e-5, 0.0, 0, 0.02, coarse);
    use_machine(&PM_SINE, 4096);
    current_step(1e-5, 0.0, 0, 0.02, fine);
    TEST_ASSERT_TRUE(fine[0] < 0.003);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 2.0, coarse[0] / fine[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, fine[1]);
}

/* Decoupled, a salient machine in motion answers as one at rest, to the first order of the sample; without
 * it, it does not. */
static void test_decoupling_removes_motion(void)
{
    const hci_plant_inductance salient = {NULL, 0, 0.01, 0.02};
    double with[2][2], without[2];
    for (int k = 0; k < 2; ++k) {
        use_machine(&PM_SINE, 4096);
        TEST_ASSERT_EQUAL_INT(HCI_OK,
                              hci_plant_table_fill(&lists.machine, &salient, 4096, rows, &drive.plant.table));
        current_step(k ? 1e-5 : 2e-5, 60.0, 1, 0.02, with[k]);
    }
    TEST_ASSERT_TRUE(with[1][0] < 0.003 && with[1][1] < 0.003);
    /* Half a sample of delay in the feedback is an error of the first order, and half a sample of phase is
     * compensated. */
    TEST_ASSERT_DOUBLE_WITHIN(0.3, 2.0, with[0][0] / with[1][0]);
    use_machine(&PM_SINE, 4096);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_plant_table_fill(&lists.machine, &salient, 4096, rows, &drive.plant.table));
    current_step(1e-5, 60.0, 0, 0.02, without);
    TEST_ASSERT_TRUE(without[0] > 0.1 && without[1] > 0.1);
}

/* One sample late, in steps of the sample; and turned ahead by one and a half samples of rotation. */
static void test_pwm_delay_is_one_sample(void)
{
    double undelayed[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
    const double way = 3.0 * 2.0 * 4e-5;
    for (int delayed = 0; delayed < 2; ++delayed) {
        use_machine(&PM_SINE, 256);
        drive.control.loop = HCI_CURRENT_PI;
        drive.control.current_every = 4;
        drive.control.current =
            (hci_current_pi){.pi = {{6.0, 0.0}, {6.0, 0.0}}, .delay_steps = delayed ? 4 : 0};
        hci_measurement m = {{0.0, 0.0, 0.0}, 0.3, 2.0};
        for (int k = 0; k < 12; ++k) {
            hci_control_step(&drive.control, &state.control, &m, 1.0 + (k >= 4));
            const double *v = state.control.v;
            if (!delayed && k % 4 == 0 && k < 8) memcpy(undelayed[k / 4], v, sizeof undelayed[0]);
            if (!delayed) continue;
            if (k < 4) TEST_ASSERT_EQUAL_DOUBLE(0.0, v[0]);
            if (k < 4) continue;
            const double *u = undelayed[k / 4 - 1];
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, cos(way) * u[0] - sin(way) * u[1], v[0]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, sin(way) * u[0] + cos(way) * u[1], v[1]);
        }
    }
}

/* Through a low-pass of a share f the PI sees 1 − (1 − f)^k of a current that is there from the first sample
 * on. */
static void test_filter_of_the_current(void)
{
    static const double SHARE[] = {0.0, 0.25, 0.6, 1.0};
    double unseen[2], seen[2];
    for (int n = 0; n < 6; ++n) {
        use_machine(&PM_SINE, 256);
        drive.control.loop = HCI_CURRENT_PI;
        drive.control.current = (hci_current_pi){.pi = {{5.0, 0.0}, {6.0, 0.0}}};
        if (n > 1) drive.control.current.filter = SHARE[n - 2];
        hci_measurement m = {{1.0, -0.3, -0.7}, 0.3, 0.0};
        if (n == 0) memset(m.i_abc, 0, sizeof m.i_abc);
        for (int k = 1; k <= 9; ++k) {
            hci_control_step(&drive.control, &state.control, &m, 1.0);
            const double *v = state.control.v, share = n > 1 && SHARE[n - 2] > 0.0 ? SHARE[n - 2] : 1.0;
            if (n < 2) memcpy(n == 0 ? unseen : seen, v, sizeof seen);
            for (int a = 0; a < 2 && n > 1; ++a)
                TEST_ASSERT_DOUBLE_WITHIN(
                    1e-12, unseen[a] + (1.0 - pow(1.0 - share, k)) * (seen[a] - unseen[a]), v[a]);
        }
        TEST_ASSERT_TRUE(n != 1 || hypot(seen[0] - unseen[0], seen[1] - unseen[1]) > 1.0);
    }
}

/* A delay of a part of a sample: the voltage changes so many steps after its sample. */
static void test_delay_in_steps(void)
{
    use_machine(&PM_SINE, 256);
    drive.control.loop = HCI_CURRENT_PI;
    drive.control.current_every = 4;
    drive.control.current = (hci_current_pi){.pi = {{6.0, 0.0}, {6.0, 0.0}}, .delay_steps = 3};
    const hci_measurement m = {{0.0, 0.0, 0.0}, 0.3, 0.0};
    double last = 0.0;
    for (int k = 0; k < 16; ++k) {
        hci_control_step(&drive.control, &state.control, &m, 1.0 + k / 4);
        const double v = hypot(state.control.v[0], state.control.v[1]);
        TEST_ASSERT_EQUAL_INT(k % 4 == 3, v != last);
        last = v;
    }
}

/* ---- dead time ---- */

/* Each phase loses U t/T against its current: a third of the dc link's share in the sum of a long current. */
static void test_dead_time_is_against_each_phase_current(void)
{
    const hci_dead_time dead = {.voltage_V = 3.0, .crossing_A = 0.5};
    for (double theta = 0.0; theta < 6.3; theta += 0.01) {
        const double abc[3] = {2.0 * sin(theta), 2.0 * sin(theta - 2.0 * REF_PI / 3.0),
                               2.0 * sin(theta + 2.0 * REF_PI / 3.0)};
        double i[2], v[2] = {0.0, 0.0}, found[3], expected[3], mean = 0.0;
        hci_plane_from_abc(abc, i);
        hci_inverter_dead_time(&dead, i, -1.0, v);
        hci_plane_to_abc(v, found);
        for (int s = 0; s < 3; ++s) {
            expected[s] = fabs(abc[s]) < 0.5 ? -6.0 * abc[s] : abc[s] > 0.0 ? -3.0 : 3.0;
            mean += expected[s] / 3.0;
        }
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[s] - mean, found[s]);
    }
}

/* Without a crossing it has the sign of the current, and no current has none. */
static void test_dead_time_of_no_current(void)
{
    const hci_dead_time dead = {3.0, 0.0};
    const double none[2] = {0.0, 0.0}, a[2] = {2.0, 0.0};
    double v[2] = {1.0, -3.0};
    hci_inverter_dead_time(&dead, none, -1.0, v);
    TEST_ASSERT_TRUE(v[0] == 1.0 && v[1] == -3.0);
    hci_inverter_dead_time(&dead, a, -1.0, v); /* a against b and c: 4/3 of it in a, −2/3 in b and c */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 - sqrt(1.5) * 4.0, v[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -3.0, v[1]);
    double small[2] = {30.0, -40.0}; /* within what there is nothing is taken away */
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_inverter_sinusoidal(120.0, small));
    TEST_ASSERT_TRUE(small[0] == 30.0 && small[1] == -40.0);
}

/* With the current that flows known, the compensation leaves nothing of it. */
static void test_dead_time_is_compensated(void)
{
    double error[3] = {0.0, 0.0, 0.0};
    for (int how = 0; how < 3; ++how) { /* without dead time, with it, compensated */
        double clean = 0.0;
        use_machine(&PM_SINE, 4096);
        drive.plant.inertia_kgm2 = INFINITY;
        drive.control.loop = HCI_CURRENT_PI;
        drive.control.current_every = 10;
        drive.control.current =
            (hci_current_pi){.pi = {{40.0, 3000.0}, {40.0, 3000.0}}, .decoupled = true, .delay_steps = 10};
        if (how > 0) drive.dead_time = (hci_dead_time){6.0, 0.05};
        if (how > 1) drive.control.current.dead_time = drive.dead_time;
        state.plant.speed_rad_per_s = 5.0;
        for (int k = 0; k < 120000; ++k) {
            hci_drive_step(&drive, &state, 2.7, 0.0);
            if (k > 60000) clean = fmax(clean, fabs(state.torque_Nm - 2.7));
        }
        error[how] = clean;
    }
    TEST_ASSERT_TRUE(error[0] < 1e-5);
    TEST_ASSERT_TRUE(error[1] > 0.01);
    TEST_ASSERT_TRUE(error[2] < 0.01 * error[1]);
}

static void test_sinusoidal_modulation_ends_at_half_the_link(void)
{
    for (double theta = 0.0; theta < 6.3; theta += 0.05) {
        double v[2] = {100.0 * cos(theta), 100.0 * sin(theta)}, abc[3];
        const double factor = hci_inverter_sinusoidal(120.0, v);
        hci_plane_to_abc(v, abc);
        const double most = fmax(fabs(abc[0]), fmax(fabs(abc[1]), fabs(abc[2])));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 60.0, most);
        TEST_ASSERT_TRUE(factor < 1.0);
    }
}

/* Shortened to √(3/2) U/√3 in the plane, in its direction; what is within it stays. */
static void test_a_circle_shortens_the_vector(void)
{
    for (double theta = 0.0; theta < 6.3; theta += 0.05) {
        double v[2] = {100.0 * cos(theta), 100.0 * sin(theta)}, within[2] = {0.84 * v[0], 0.84 * v[1]};
        const double factor = hci_inverter_limit(HCI_MODULATION_CIRCLE, 120.0, v);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 120.0 / sqrt(2.0), hypot(v[0], v[1]));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, v[0] * sin(theta) - v[1] * cos(theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.2 / sqrt(2.0), factor);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_inverter_limit(HCI_MODULATION_CIRCLE, 120.0, within));
    }
}

/* ---- code ---- */

static void ask_for(void *context, const hci_measurement *measured, double torque_Nm, hci_reference_dq *r)
{
    const double *wanted = context;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, measured->theta_m_rad);
    r->i_A[0] = wanted[0];
    r->i_A[1] = wanted[1] * torque_Nm;
    r->v_V[0] = wanted[2];
    r->v_V[1] = wanted[3];
}

/* What code asks for is in the rotor frame; its voltage goes on top of the controller's. */
static void test_code_gives_current_and_voltage(void)
{
    double wanted[4] = {1.5, 2.0, 5.0, -3.0};
    const hci_reference_code code = {ask_for, wanted};
    const hci_measurement m = {{0.0, 0.0, 0.0}, 0.3, 0.0};
    const double theta = 3 * 0.3;
    double abc[3];
    use_machine(&PM_SINE, 256);
    source.code = &code;
    drive.control.loop = HCI_CURRENT_PI;
    drive.control.current.pi[0] = drive.control.current.pi[1] = (hci_pi){6.0, 0.0};
    hci_control_step(&drive.control, &state.control, &m, 0.5);
    hci_plane_to_abc(state.control.reference, abc);
    const hci_dq i = hci_park(hci_clarke(abc), theta);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, i.d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, i.q);
    hci_plane_to_abc(state.control.v, abc);
    const hci_dq v = hci_park(hci_clarke(abc), theta);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0 * 1.5 + 5.0, v.d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0 * 1.0 - 3.0, v.q);
}

/* At the hexagon the integrals must not grow: a step that needs more voltage than there is overshoots no more
 * than a small one. */
static void test_current_loop_does_not_wind_up(void)
{
    double most = 0.0;
    use_machine(&PM_SINE, 4096);
    drive.control.dc_link_V = 60.0;
    drive.control.loop = HCI_CURRENT_PI;
    drive.control.current =
        (hci_current_pi){.pi = {{12.0, 900.0}, {12.0, 900.0}},
                         .decoupled = true}; /* k_i/k_p = R/L: first order, no overshoot */
    drive.plant.inertia_kgm2 = INFINITY;
    for (int k = 0; k < 20000; ++k) {
        hci_drive_step(&drive, &state, 27.0, 0.0);
        most = fmax(most, hypot(state.plant.i[0], state.plant.i[1]) * sqrt(2.0 / 3.0));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 20.0, hypot(state.plant.i[0], state.plant.i[1]) * sqrt(2.0 / 3.0));
    TEST_ASSERT_TRUE(most < 20.0 * 1.02);
}

/* ---- hysteresis ---- */

static void test_hold_follows_from_the_frequency(void)
{
    TEST_ASSERT_EQUAL_UINT(25, hci_hysteresis_hold(20e3, 1e-6));
    TEST_ASSERT_EQUAL_UINT(3, hci_hysteresis_hold(20e3, 1e-5));
    TEST_ASSERT_EQUAL_UINT(0, hci_hysteresis_hold(INFINITY, 1e-6));
}

static void test_legs_switch_at_the_edges_of_the_band(void)
{
    const hci_hysteresis hysteresis = {0.2, 3};
    hci_hysteresis_state h = {0};
    const double none[3] = {0.0, 0.0, 0.0}, low[3] = {-0.11, 0.11, -0.09}, high[3] = {0.11, -0.11, 0.09};
    TEST_ASSERT_EQUAL_UINT(1, hci_hysteresis_step(&hysteresis, &h, none, low));
    TEST_ASSERT_EQUAL_UINT(1 + 2, hci_hysteresis_step(&hysteresis, &h, none, high)); /* a rests, b was free */
    TEST_ASSERT_EQUAL_UINT(1 + 2, hci_hysteresis_step(&hysteresis, &h, none, high));
    TEST_ASSERT_EQUAL_UINT(2, hci_hysteresis_step(&hysteresis, &h, none, high)); /* the third step after */
    TEST_ASSERT_EQUAL_UINT64(3, h.switchings);
}

static void test_legs_rest_at_the_very_edges(void)
{
    const hci_hysteresis hysteresis = {0.25, 0};
    hci_hysteresis_state h = {0};
    const double none[3] = {0.0, 0.0, 0.0}, edge[3] = {-0.125, 0.125, -0.125}, below[3] = {-0.2, -0.2, 0.0};
    TEST_ASSERT_EQUAL_UINT(0, hci_hysteresis_step(&hysteresis, &h, none, edge));
    TEST_ASSERT_EQUAL_UINT(1 + 2, hci_hysteresis_step(&hysteresis, &h, none, below));
    TEST_ASSERT_EQUAL_UINT(1 + 2, hci_hysteresis_step(&hysteresis, &h, none, edge));
}

typedef struct {
    double worst_A;
    int least_steps; /* between two switchings of a leg */
    double share_inside;
} band_result;

/* Runs loaded at constant speed after the transient; errors against the reference of the controller's own
 * step. */
static band_result run_hysteresis(double band_A, unsigned hold, int steps)
{
    band_result result = {0.0, steps, 0.0};
    unsigned legs = 0;
    int since[3] = {0, 0, 0}, inside = 0, seen = 0;
    use_machine(&PM_INTERIOR, 2048);
    drive.plant.inertia_kgm2 = INFINITY;
    state.plant.speed_rad_per_s = 8.0;
    drive.control.step_s = 1e-6;
    drive.control.loop = HCI_CURRENT_HYSTERESIS;
    drive.control.hysteresis = (hci_hysteresis){band_A, hold};
    for (int k = 0; k < steps; ++k) {
        hci_drive_step(&drive, &state, 8.0, 0.0);
        const unsigned now = state.control.hysteresis.legs;
        double reference[3];
        hci_plane_to_abc(state.control.reference, reference);
        for (int s = 0; s < 3; ++s) {
            ++since[s];
            if ((now ^ legs) >> s & 1u) {
                if (k > steps / 10 && since[s] < result.least_steps) result.least_steps = since[s];
                since[s] = 0;
            }
            if (k < steps / 10) continue;
            const double error = fabs(state.measured.i_abc[s] - reference[s]);
            result.worst_A = fmax(result.worst_A, error);
            inside += error <= 0.5 * band_A;
            ++seen;
        }
        legs = now;
    }
    result.share_inside = (double)inside / seen;
    return result;
}

/* The most that a phase current can move in a step: the largest line voltage's share (2/3 V_dc) and 30 V
 * of EMF and L'i over the least inductance of the plane, 0.08 H. The error reaches twice half the band at
 * most, as the star point floats. */
static void test_hysteresis_keeps_the_band(void)
{
    const double slew_A = (2.0 / 3.0 * 311.0 + 30.0) / 0.08 * 1e-6;
    const band_result free_legs = run_hysteresis(0.03, 0, 400000), held = run_hysteresis(0.03, 25, 400000);
    TEST_ASSERT_TRUE(free_legs.worst_A <= 0.03 + slew_A);
    TEST_ASSERT_TRUE(free_legs.share_inside > 0.85);
    TEST_ASSERT_TRUE(free_legs.least_steps < 25); /* so the limit below has work to do */
    TEST_ASSERT_TRUE(held.least_steps >= 25);
    TEST_ASSERT_TRUE(held.worst_A <= 0.03 + 26.0 * slew_A);
}

/* ---- references ---- */

/* The reference of `cancel` at 100 angles and either torque in the frame dq_x as frames.h has it. */
static void references(hci_dqx x[100])
{
    memset(&state, 0, sizeof state);
    for (int k = 0; k < 100; ++k) {
        const hci_measurement m = {{0.0, 0.0, 0.0}, 0.031 * k, 0.0};
        double e[3], abc[3];
        hci_control_step(&drive.control, &state.control, &m, k % 2 ? 8.0 : -8.0);
        hci_waves_at(lists.emf, PM_INTERIOR.emf_count, 2.0 * 0.031 * k, e);
        hci_plane_to_abc(state.control.reference, abc);
        x[k] = hci_dqx_from_abc(hci_dqx_frame_of(e), abc);
    }
}

/* T·per_Nm(θ) + fixed(θ), each with as many harmonics, or one of them alone. */
static void test_reference_of_waves(void)
{
    const hci_wave per_Nm = hci_wave_polar(1.0, 1, 0.7, 0.2), fixed = hci_wave_polar(5.0, -1, 0.3, -0.4);
    use_machine(&PM_SINE, 64);
    const int p = drive.plant.table.pole_pairs;
    for (int which = 1; which < 4; ++which) {
        source = (hci_current_source){.strategy = HCI_STRATEGY_MTPA,
                                      .per_Nm = &per_Nm,
                                      .per_Nm_count = which & 1 ? 1 : 0,
                                      .fixed = &fixed,
                                      .fixed_count = which & 2 ? 1 : 0};
        memset(&state, 0, sizeof state);
        for (int k = 0; k < 20; ++k) {
            const hci_measurement m = {{0.0, 0.0, 0.0}, 0.3 * k, 0.0};
            double abc[3];
            hci_control_step(&drive.control, &state.control, &m, 4.0);
            hci_plane_to_abc(state.control.reference, abc);
            for (int s = 0; s < 3; ++s) {
                const double x = p * 0.3 * k - 2.0 * REF_PI * s / 3.0;
                const double expected = (which & 1 ? 4.0 * 0.7 * sin(x + 0.2) : 0.0) +
                                        (which & 2 ? 0.3 * sin(5.0 * x - 0.4) : 0.0);
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, abc[s]);
            }
        }
    }
}

/* Each axis by itself; one that is within its limit stays as it is. */
static void test_current_limits(void)
{
    hci_dqx whole[100], x[100];
    unsigned beyond = 0;
    use_machine(&PM_INTERIOR, POINTS);
    source.strategy = HCI_STRATEGY_CANCEL;
    references(whole);
    TEST_ASSERT_EQUAL_UINT64(0, state.control.limited);
    drive.control.iq_limit = 5.0;
    drive.control.id_limit = 0.6;
    references(x);
    TEST_ASSERT_EQUAL_UINT64(100, state.control.limited);
    for (int k = 0; k < 100; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, k % 2 ? 5.0 : -5.0, x[k].q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, fmax(-0.6, fmin(0.6, whole[k].d)), x[k].d);
        beyond += fabs(whole[k].d) > 0.6;
    }
    TEST_ASSERT_TRUE(beyond > 10 && beyond < 90);
    drive.control.iq_limit = INFINITY;
    references(x);
    TEST_ASSERT_EQUAL_UINT64(beyond, state.control.limited);
    for (int k = 0; k < 100; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, whole[k].q, x[k].q);
    drive.control.peak_limit_A = 3.0;
    for (int k = 0; k < 100; ++k) {
        const hci_measurement m = {{0.0, 0.0, 0.0}, 0.031 * k, 0.0};
        hci_control_step(&drive.control, &state.control, &m, 8.0);
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-12, 3.0, sqrt(2.0 / 3.0) * hypot(state.control.reference[0], state.control.reference[1]));
    }
}

static void test_torque_command_is_limited(void)
{
    const hci_measurement m = {{0.0, 0.0, 0.0}, 0.1, 0.0};
    use_machine(&PM_SINE, 256);
    drive.control.torque_limit_Nm = 2.0;
    hci_control_step(&drive.control, &state.control, &m, 5.0);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, state.control.torque_Nm);
    hci_control_step(&drive.control, &state.control, &m, -5.0);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, state.control.torque_Nm);
}

/* With ideal currents `cancel` and `mtpa` are ripple-free to the table's error, i_d = 0 is not; the second
 * source begins with the step at its time. */
static void test_strategies_change_in_time(void)
{
    const hci_current_source sources[3] = {{0.0, HCI_STRATEGY_ID0, NULL, 0, NULL, 0, NULL},
                                           {0.01, HCI_STRATEGY_CANCEL, NULL, 0, NULL, 0, NULL},
                                           {0.02, HCI_STRATEGY_MTPA, NULL, 0, NULL, 0, NULL}};
    double off[3] = {0.0, 0.0, 0.0}, square[3] = {0.0, 0.0, 0.0};
    use_machine(&PM_INTERIOR, POINTS);
    drive.control.sources = sources;
    drive.control.source_count = 3;
    drive.plant.inertia_kgm2 = INFINITY;
    state.plant.speed_rad_per_s = 100.0 * REF_PI; /* one electrical turn in 0.01 s */
    for (int k = 0; k < 3000; ++k) {
        const int part = k / 1000;
        hci_drive_step(&drive, &state, 8.0, 0.0);
        TEST_ASSERT_EQUAL_INT(part, (int)state.control.source);
        const double *x = state.control.reference;
        /* the torque of the formulas, not of the plant's table */
        double abc[3];
        hci_plane_to_abc(x, abc);
        const double torque = hci_torque_at(&lists.machine, 2.0 * state.measured.theta_m_rad, abc);
        off[part] = fmax(off[part], fabs(torque - 8.0));
        square[part] += x[0] * x[0] + x[1] * x[1];
    }
    TEST_ASSERT_TRUE(off[0] > 0.3);
    TEST_ASSERT_TRUE(off[1] < 1e-6);
    TEST_ASSERT_TRUE(off[2] < 1e-6);
    TEST_ASSERT_TRUE(square[2] < square[1]);
    TEST_ASSERT_EQUAL_UINT64(0, state.control.unreached);
}

/* No i_d cancels the cogging torque at i_q = 0 where L'_d T_cog > 0. */
static void test_unreached_samples_are_counted(void)
{
    use_machine(&PM_INTERIOR, 2048);
    source.strategy = HCI_STRATEGY_CANCEL;
    drive.plant.inertia_kgm2 = INFINITY;
    state.plant.speed_rad_per_s = 100.0 * REF_PI;
    for (int k = 0; k < 1000; ++k)
        hci_drive_step(&drive, &state, 0.0, 0.0);
    TEST_ASSERT_TRUE(state.control.unreached > 200 && state.control.unreached < 800);
}

static void test_waves_scale_with_torque(void)
{
    const ref_wave per_Nm = {1, 1, 0.7, 0.2}, fixed[2] = {{5, -1, 0.3, 1.0}, {7, 1, 0.2, -0.4}};
    hci_wave list[3];
    use_machine(&PM_SINE, 256);
    list[0] = hci_wave_polar(1, 1, 0.7, 0.2);
    list[1] = hci_wave_polar(5, -1, 0.3, 1.0);
    list[2] = hci_wave_polar(7, 1, 0.2, -0.4);
    source = (hci_current_source){0.0, HCI_STRATEGY_ID0, list, 1, list + 1, 2, NULL};
    for (int k = 0; k < 50; ++k) {
        const hci_measurement m = {{0.0, 0.0, 0.0}, 0.1 * k, 0.0};
        double abc[3];
        hci_control_step(&drive.control, &state.control, &m, 4.0);
        hci_plane_to_abc(state.control.reference, abc);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12, 4.0 * ref_wave_at(&per_Nm, s, 0.3 * k) + ref_waves_at(fixed, 2, s, 0.3 * k), abc[s]);
    }
}

/* With one wave, of either kind, no strategy is asked. */
static void test_one_wave_is_all_the_reference(void)
{
    const ref_wave ref = {5, -1, 0.3, 1.0};
    hci_wave wave;
    use_machine(&PM_SINE, 256);
    wave = hci_wave_polar(5, -1, 0.3, 1.0);
    for (int fixed = 0; fixed < 2; ++fixed) {
        source = (hci_current_source){0.0, HCI_STRATEGY_ID0, &wave, !fixed, &wave, (size_t)fixed, NULL};
        for (int k = 0; k < 10; ++k) {
            const hci_measurement m = {{0.0, 0.0, 0.0}, 0.1 * k, 0.0};
            double abc[3];
            hci_control_step(&drive.control, &state.control, &m, 4.0);
            hci_plane_to_abc(state.control.reference, abc);
            for (int s = 0; s < 3; ++s)
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, (fixed ? 1.0 : 4.0) * ref_wave_at(&ref, s, 0.3 * k), abc[s]);
        }
    }
}

/* Samples over one mechanical turn at constant speed, at angles that are points of the table, have exactly
 * the spectrum that torque.c predicts in closed form: mutual, reluctance and cogging torque, orders k/2
 * included. */
static void test_imposed_currents_have_the_predicted_spectrum(void)
{
    enum { COUNT = 1024, ORDERS_MOST = 400 };
    static double torque[COUNT], orders[ORDERS_MOST];
    static hci_harmonic predicted[ORDERS_MOST];
    const hci_harmonic cogging[3] = {hci_harmonic_polar(0.5, 0.05, 0.2), hci_harmonic_polar(12, 0.157, 3.1),
                                     hci_harmonic_polar(24, 0.122, 3.2)};
    const hci_wave waves[4] = {hci_wave_polar(1, 1, 6.0, 0.3), hci_wave_polar(11, -1, 0.8, 1.0),
                               hci_wave_polar(13, 1, 0.5, -2.0), hci_wave_polar(2.5, 1, 0.2, 0.7)};
    size_t count;
    use_machine(&PM_INTERIOR, 256);
    lists.machine.cogging = cogging;
    lists.machine.cogging_count = 3;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_plant_table_fill(&lists.machine, &lists.given, COUNT, rows, &drive.plant.table));
    TEST_ASSERT_EQUAL_INT(2, drive.plant.table.turns);
    source = (hci_current_source){0.0, HCI_STRATEGY_ID0, NULL, 0, waves, 4, NULL};
    drive.plant.inertia_kgm2 = INFINITY;
    state.plant.speed_rad_per_s = 2.0 * REF_PI / COUNT / 1e-5;
    for (int k = 0; k < COUNT; ++k) {
        hci_drive_step(&drive, &state, 0.0, 0.0);
        torque[k] = state.torque_Nm;
    }
    TEST_ASSERT_TRUE(hci_torque_orders_capacity(&lists.machine, 4) <= ORDERS_MOST);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_orders(&lists.machine, waves, 4, orders, ORDERS_MOST, &count));
    hci_torque_spectrum(&lists.machine, waves, 4, orders, count, predicted);
    double square = 0.0, predicted_square = 0.0;
    for (size_t n = 0; n < count; ++n) {
        double s = 0.0, c = 0.0;
        const double scale = orders[n] == 0.0 ? 1.0 / COUNT : 2.0 / COUNT;
        for (int k = 0; k < COUNT; ++k) {
            const double x = orders[n] * 2.0 * 2.0 * REF_PI * k / COUNT;
            s += scale * torque[k] * sin(x);
            c += scale * torque[k] * cos(x);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, predicted[n].sine, s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, predicted[n].cosine, c);
        predicted_square += (orders[n] == 0.0 ? 1.0 : 0.5) * (s * s + c * c);
    }
    for (int k = 0; k < COUNT; ++k)
        square += torque[k] * torque[k] / COUNT;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, square, predicted_square); /* nothing at any other order */
}

/* ---- closed loop with sensors ---- */

static void test_sensors_stand_between(void)
{
    hci_sensor sensors[HCI_SENSE_COUNT] = {{0}};
    sensors[HCI_SENSE_IA].offset = 0.5;
    sensors[HCI_SENSE_IB].offset = -0.25;
    sensors[HCI_SENSE_IC].offset = 0.125;
    sensors[HCI_SENSE_ANGLE].offset = 0.01;
    sensors[HCI_SENSE_SPEED].gain_error = 0.1;
    sensors[HCI_SENSE_TORQUE].offset = -1.0;
    use_machine(&PM_SINE, 4096);
    drive.sensors = sensors;
    state.plant.speed_rad_per_s = 10.0;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        hci_sensor_start(&sensors[k], &state.sensors[k], NULL, 1, 0.0);
    hci_drive_step(&drive, &state, 2.0, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, state.measured.i_abc[0]);
    TEST_ASSERT_EQUAL_DOUBLE(-0.25, state.measured.i_abc[1]);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, state.measured.i_abc[2]);
    TEST_ASSERT_EQUAL_DOUBLE(0.01, state.measured.theta_m_rad);
    TEST_ASSERT_EQUAL_DOUBLE(11.0, state.measured.speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(state.torque_Nm - 1.0, state.torque_measured_Nm);
    /* a current that leads by three times 0.01 rad makes the cosine of it */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * cos(0.03), state.torque_Nm);
}

static void test_noisy_runs_repeat_to_the_bit(void)
{
    static hci_drive_state first;
    double rings[HCI_SENSE_COUNT][2];
    hci_sensor sensors[HCI_SENSE_COUNT];
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        sensors[k] = (hci_sensor){.noise = 1e-3, .quantum = 1e-4, .delay_steps = 2};
    for (int run = 0; run < 2; ++run) {
        use_machine(&PM_INTERIOR, 1024);
        drive.sensors = sensors;
        drive.control.loop = HCI_CURRENT_HYSTERESIS;
        drive.control.hysteresis = (hci_hysteresis){0.1, 3};
        for (int k = 0; k < HCI_SENSE_COUNT; ++k)
            hci_sensor_start(&sensors[k], &state.sensors[k], rings[k], (uint64_t)k, 0.0);
        for (int k = 0; k < 20000; ++k)
            hci_drive_step(&drive, &state, 3.0, 2.0);
        if (run == 0) first = state;
    }
    TEST_ASSERT_EQUAL_MEMORY(&first.plant, &state.plant, sizeof state.plant);
    TEST_ASSERT_EQUAL_MEMORY(&first.measured, &state.measured, sizeof state.measured);
    TEST_ASSERT_EQUAL_UINT64(first.control.hysteresis.switchings, state.control.hysteresis.switchings);
    TEST_ASSERT_TRUE(state.control.hysteresis.switchings > 100);
}

/* Without a limit each axis integrates its own error: a sample adds k_i T times it to the voltage, in the
 * plane √(3/2) of that. */
static void test_each_axis_integrates_its_own_error(void)
{
    const hci_measurement m = {{1.0, -0.3, -0.7}, 0.3, 0.0};
    const hci_dq i = hci_park(hci_clarke(m.i_abc), 3.0 * 0.3);
    for (int axis = 0; axis < 2; ++axis) {
        const double gain[2] = {axis == 0 ? 50.0 : 0.0, axis == 1 ? 50.0 : 0.0};
        double before[2];
        use_machine(&PM_SINE, 256);
        drive.control.loop = HCI_CURRENT_PI;
        drive.control.current = (hci_current_pi){.pi = {{1.0, gain[0]}, {1.0, gain[1]}}};
        for (int k = 0; k < 5; ++k) {
            const double *v = state.control.v;
            hci_control_step(&drive.control, &state.control, &m, 0.0);
            if (k > 0)
                TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                                          sqrt(1.5) * 50.0 * drive.control.step_s * fabs(axis ? i.q : i.d),
                                          hypot(v[0] - before[0], v[1] - before[1]));
            memcpy(before, v, sizeof before);
        }
    }
    TEST_ASSERT_TRUE(fabs(i.d) > 0.1 && fabs(i.q) > 0.1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_pi_ramps_limits_and_comes_back);
    RUN_TEST(test_integral_control_alone_does_not_wind_up);
    RUN_TEST(test_speed_loop_is_of_second_order);
    RUN_TEST(test_speed_loop_holds_the_load);
    RUN_TEST(test_current_loop_at_rest_is_of_second_order);
    RUN_TEST(test_decoupling_removes_motion);
    RUN_TEST(test_pwm_delay_is_one_sample);
    RUN_TEST(test_filter_of_the_current);
    RUN_TEST(test_delay_in_steps);
    RUN_TEST(test_dead_time_is_against_each_phase_current);
    RUN_TEST(test_dead_time_of_no_current);
    RUN_TEST(test_dead_time_is_compensated);
    RUN_TEST(test_sinusoidal_modulation_ends_at_half_the_link);
    RUN_TEST(test_a_circle_shortens_the_vector);
    RUN_TEST(test_code_gives_current_and_voltage);
    RUN_TEST(test_current_loop_does_not_wind_up);
    RUN_TEST(test_hold_follows_from_the_frequency);
    RUN_TEST(test_legs_switch_at_the_edges_of_the_band);
    RUN_TEST(test_legs_rest_at_the_very_edges);
    RUN_TEST(test_hysteresis_keeps_the_band);
    RUN_TEST(test_reference_of_waves);
    RUN_TEST(test_current_limits);
    RUN_TEST(test_torque_command_is_limited);
    RUN_TEST(test_strategies_change_in_time);
    RUN_TEST(test_unreached_samples_are_counted);
    RUN_TEST(test_waves_scale_with_torque);
    RUN_TEST(test_one_wave_is_all_the_reference);
    RUN_TEST(test_imposed_currents_have_the_predicted_spectrum);
    RUN_TEST(test_sensors_stand_between);
    RUN_TEST(test_noisy_runs_repeat_to_the_bit);
    RUN_TEST(test_each_axis_integrates_its_own_error);
    return UNITY_END();
}
