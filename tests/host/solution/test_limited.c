/* Currents within limits, on machines whose answer has a closed form: a sinusoidal machine at its peak, its
 * rms current, its copper, with an open phase, and in field weakening. And what any answer has to be: within
 * its limits between the angles too, with gains that are the slopes of what they are said of. */
#include "hci/host/solve/solve.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/limit/voltage.h"
#include "support/reference.h"
#include "unity.h"

#define K_E 0.2 /* V·s/rad */

static hci_machine_data machine;
static hci_wave emf[5];
static hci_harmonic cogging[2];
static hci_target target;
static hci_target_order order[2];
static hci_component component[16];
static hci_set name[16];
static hci_component_set set;
static hci_solve_options options;
static hci_solution solution;

static void use(size_t count, const hci_component *c)
{
    memcpy(component, c, count * sizeof *c);
    for (size_t k = 0; k < count; ++k)
        name[k] = c[k].sequence > 0 ? HCI_SET_POS : HCI_SET_NEG;
    set = (hci_component_set){component, name, count, {{0}}};
    options.set = &set;
}

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    emf[0] = (hci_wave){1.0, 1, K_E, 0.0};
    machine.model = (hci_machine){.pole_pairs = 3, .back_emf = emf, .back_emf_count = 1, .cogging = cogging};
    machine.pole_pairs = 3.0;
    machine.resistance_ohm = 0.4;
    machine.inductance_d_H = machine.inductance_q_H = 2e-3;
    machine.dc_link_voltage_V = machine.max_current_A = machine.rated_current_A = NAN;
    order[0] = (hci_target_order){{0.0, 0.0, 3.0}, 1.0};
    target = (hci_target){order, 1};
    options.target = &target;
    use(1, (const hci_component[]){{1.0, 1}});
}

void tearDown(void)
{
    hci_solution_release(&solution);
}

static void solve(hci_status expected)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(expected, hci_solve(&machine, &options, &solution, &note), note.text);
}

static double mean_Nm(void)
{
    return solution.order[0].torque_Nm.cosine;
}

static const hci_limit *limit(hci_limit_kind kind)
{
    for (size_t k = 0; k < solution.limit_count; ++k)
        if (solution.limit[k].kind == kind) return &solution.limit[k];
    TEST_FAIL_MESSAGE("the limit is not listed");
    return NULL;
}

/* ---- one limit at a time, a sinusoidal machine ---- */

/* 3 N·m take 10 A: 8 A make 1.5·0.2·8, and 1 A more makes 0.3 N·m more. */
static void test_a_sine_at_its_peak(void)
{
    options.limit_current_A = 8.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_TORQUE, solution.limit_cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.4, mean_Nm());
    TEST_ASSERT_TRUE(solution.within_limits && solution.peak_phase_current_A <= 8.0);
    TEST_ASSERT_TRUE(limit(HCI_LIMIT_CURRENT)->binds);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.3, limit(HCI_LIMIT_CURRENT)->gain);
    TEST_ASSERT_EQUAL_UINT64(6, limit(HCI_LIMIT_CURRENT)->touch_count);
}

static void test_braking(void)
{
    order[0].torque_Nm.cosine = -3.0;
    options.limit_current_A = 8.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, -2.4, mean_Nm());
}

static void test_a_wide_limit_changes_nothing(void)
{
    hci_wave free_A;
    solve(HCI_OK);
    free_A = solution.current.wave[0];
    options.limit_current_A = 10.001;
    solve(HCI_OK);
    TEST_ASSERT_EQUAL(HCI_COST_NONE, solution.limit_cost);
    TEST_ASSERT_EQUAL_DOUBLE(free_A.sine, solution.current.wave[0].sine);
    TEST_ASSERT_NOT_NULL(solution.per_Nm);
}

/* 10 A beside a rated sine of 8 A; each limit silences what is said of its kind. */
static void test_beyond_the_rated_current(void)
{
    machine.rated_current_A = 8.0;
    solve(HCI_OK);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0 / sqrt(2.0), solution.rms_phase_current_A);
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "7.071 A, is that of a sine of 10 A"));
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "the peak, 10 A, is above rated_current, 8 A"));
    options.limit_current_A = 11.0;
    solve(HCI_OK);
    TEST_ASSERT_NULL(strstr(solution.remark.text, "the peak"));
    options.limits.rms_A[0] = options.limits.rms_A[1] = options.limits.rms_A[2] = 7.1;
    solve(HCI_OK);
    TEST_ASSERT_EQUAL_STRING("", solution.remark.text);
}

static void test_within_the_rated_current(void)
{
    machine.rated_current_A = 10.0;
    solve(HCI_OK);
    TEST_ASSERT_EQUAL_STRING("", solution.remark.text);
}

static void test_rms(void)
{
    for (int s = 0; s < 3; ++s)
        options.limits.rms_A[s] = 6.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.3 * 6.0 * sqrt(2.0), mean_Nm());
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.3 * sqrt(2.0), limit(HCI_LIMIT_RMS)->gain);
}

/* 40 W in 0.4 Ω are 100 A² of all phases: √(100/1.5) A. */
static void test_copper(void)
{
    options.limits.copper_W = 40.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.3 * sqrt(100.0 / 1.5), mean_Nm());
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.3 * sqrt(1.0 / 1.5) / 20.0, limit(HCI_LIMIT_COPPER)->gain);
    TEST_ASSERT_EQUAL_INT(-1, limit(HCI_LIMIT_COPPER)->phase); /* of all phases */
    options.limits.copper_W = 0.0;
    options.limits.copper_ratio = 0.81;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.9 * 3.0, mean_Nm());
}

/* With i_a = 0, i_b = −i_c = I cos θ, e_b − e_c = −√3 K_E cos θ: half of the torque is mean, half of order 2.
 */
static void test_an_open_phase(void)
{
    use(2, (const hci_component[]){{1.0, 1}, {1.0, -1}});
    options.limits.is_open[0] = true;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.0, mean_Nm());
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3.0, solution.worst_error_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, solution.worst_order);
    for (double theta = 0.0; theta < 6.0; theta += 0.37) {
        double i[3];
        hci_waves_at(solution.current.wave, solution.current.count, theta, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, i[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, -6.0 / (sqrt(3.0) * K_E) * cos(theta), i[1]);
    }
}

/* A cogging torque of 0.06 N·m swings by 4 % of 3 N·m, until components take it away. */
static void test_the_ripple_before_and_after(void)
{
    cogging[0] = (hci_harmonic){6.0, 0.06, 0.0};
    machine.model.cogging_count = 1;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 4.0, solution.T_ripple_before_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, solution.T_ripple_before_percent, solution.T_ripple_percent);
    hci_solution_release(&solution);
    use(3, (const hci_component[]){{1.0, 1}, {5.0, -1}, {7.0, 1}});
    solve(HCI_OK);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 4.0, solution.T_ripple_before_percent);
    TEST_ASSERT_TRUE(solution.T_ripple_percent < 1e-9);
}

static size_t told;
static double told_share;

static void tell(void *context, const char *what, double share)
{
    (void)context;
    if (strcmp(what, "keeping limits") != 0) return;
    TEST_ASSERT_TRUE(share > told_share && share < 1.0);
    told_share = share;
    ++told;
}

/* Of periods of many turns each program takes seconds. */
static void test_progress_is_told_within_limits(void)
{
    told = 0;
    told_share = 0.0;
    options.progress = tell;
    options.limit_current_A = 5.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(told >= 2);
}

static size_t asked, stop_at;

static bool stop(void *context)
{
    (void)context;
    return ++asked >= stop_at;
}

/* Each program may take seconds: whether to end is asked before every one, and nothing is kept. */
static void test_a_stop_within_limits(void)
{
    told = asked = 0;
    told_share = 0.0;
    stop_at = (size_t)-1;
    options.progress = tell;
    options.stop = stop;
    options.limit_current_A = 5.0;
    solve(HCI_NOT_REACHED);
    const size_t all = asked;
    TEST_ASSERT_TRUE(all >= told);
    for (stop_at = 1; stop_at <= all; ++stop_at) {
        asked = 0;
        told_share = 0.0;
        solve(HCI_ERROR_STOPPED);
        TEST_ASSERT_TRUE(asked >= stop_at && solution.order == NULL);
    }
}

/* Braking, the current takes voltage off the two phases that carry it and half as much off those with the
 * open one, whose terminal shows more than the inverter has to make. */
static void test_an_open_phase_shows_a_voltage_that_is_not_limited(void)
{
    use(2, (const hci_component[]){{1.0, 1}, {1.0, -1}});
    machine.inductance_d_H = machine.inductance_q_H = 1e-6;
    order[0].torque_Nm.cosine = -3.0;
    options.limits.is_open[0] = true;
    options.speed_rad_per_s = 200.0;
    options.limit_voltage_V = 60.0;
    solve(HCI_NOT_REACHED);
    const double emf_V = sqrt(3.0) * K_E * 200.0, current_A = 6.0 / (sqrt(3.0) * K_E);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -3.0, mean_Nm());
    TEST_ASSERT_TRUE(solution.within_limits);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, emf_V - 2.0 * 0.4 * current_A, solution.peak_line_voltage_V);
    TEST_ASSERT_TRUE(solution.peak_open_voltage_V > 60.0 && solution.peak_open_voltage_V < emf_V);
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "it has to be disconnected"));
    TEST_ASSERT_FALSE(limit(HCI_LIMIT_VOLTAGE)->binds);
}

/* Without R: U/√3 = p ω_m √((ψ + L i_d)² + (L i_q)²), ψ = K_E/p, and 3 N·m take i_q = 10 A. */
static void test_field_weakening(void)
{
    const double speed = 200.0, omega = 3.0 * speed, psi = K_E / 3.0, l = 2e-3, reach = 36.0 / omega;
    double i_d;
    machine.resistance_ohm = 0.0;
    options.speed_rad_per_s = speed;
    options.limit_voltage_V = 36.0 * sqrt(3.0) / 0.9;
    options.limits.voltage_reserve = 0.06;
    options.limits.dead_time_s = 2e-6;
    options.limits.pwm_frequency_Hz = 1e4;
    solve(HCI_OK);
    i_d = -solution.current.wave[0].cosine;
    TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, (sqrt(reach * reach - l * l * 100.0) - psi) / l, i_d);
    TEST_ASSERT_TRUE(i_d < -1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3.0, mean_Nm());
    TEST_ASSERT_TRUE(solution.within_limits);
}

/* No current keeps 1 A and the back-EMF of 40 V peak behind 10 V: all limits are widened alike. */
static void test_limits_that_nothing_keeps(void)
{
    options.speed_rad_per_s = 200.0;
    options.limit_voltage_V = 10.0;
    options.limit_current_A = 1.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_LIMITS, solution.limit_cost);
    TEST_ASSERT_FALSE(solution.within_limits);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, solution.limit[0].value / solution.limit[0].limit,
                              solution.limit[1].value / solution.limit[1].limit);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.0 + solution.exceeded_share,
                              solution.limit[0].value / solution.limit[0].limit);
}

/* The same with the heat of one phase, and of all, instead of a peak. */
static void test_heat_that_nothing_keeps(void)
{
    options.speed_rad_per_s = 200.0;
    options.limit_voltage_V = 10.0;
    for (int is_copper = 0; is_copper < 2; ++is_copper) {
        options.limits.copper_W = is_copper ? 0.6 : 0.0; /* 1.5·0.4 Ω·(1 A)² */
        for (int s = 0; s < 3; ++s)
            options.limits.rms_A[s] = is_copper ? 0.0 : sqrt(0.5);
        solve(HCI_NOT_REACHED);
        const hci_limit *u = limit(HCI_LIMIT_VOLTAGE),
                        *heat = limit(is_copper ? HCI_LIMIT_COPPER : HCI_LIMIT_RMS);
        const double share = heat->value / heat->limit;
        TEST_ASSERT_EQUAL(HCI_COST_LIMITS, solution.limit_cost);
        TEST_ASSERT_TRUE(solution.exceeded_share > 0.5);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.0 + solution.exceeded_share, u->value / u->limit);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0 + solution.exceeded_share, is_copper ? sqrt(share) : share);
    }
}

/* ---- what is declared ---- */

static void test_ratings(void)
{
    machine.rated_current_A = 5.0; /* of a sine for long: no limit */
    solve(HCI_OK);
    machine.max_current_A = 8.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(limit(HCI_LIMIT_CURRENT)->is_declared);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.4, mean_Nm());
    options.limit_current_A = 9.0; /* what is asked for goes first */
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.7, mean_Nm());
    options.limit_current_A = 0.0;
    options.limits.ignore_ratings = true;
    solve(HCI_OK);
}

/* At standstill a line voltage is √3 R i: half of that of 10 A leaves 5 A, which make 1.5·0.2·5. */
static void test_a_declared_dc_link_at_standstill(void)
{
    machine.dc_link_voltage_V = 0.5 * sqrt(3.0) * 0.4 * 10.0;
    machine.inductance_d_H = machine.inductance_q_H = NAN; /* induces nothing there */
    solve(HCI_OK);                                         /* at no speed in particular it is no limit */
    options.at_speed = true;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(limit(HCI_LIMIT_VOLTAGE)->is_declared && solution.within_limits);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.5, mean_Nm());
    options.limits.ignore_ratings = true;
    solve(HCI_OK);
}

/* ---- contradictions ---- */

static void refused(const char *words)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_solve(&machine, &options, &solution, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
}

static void test_contradictions(void)
{
    options.limits.is_open[0] = options.limits.is_open[2] = true;
    refused("two phases are limited to 0 A");
    options.limits.is_open[1] = true;
    refused("all three phases");
    memset(&options.limits, 0, sizeof options.limits);
    options.limits.current_A[1] = -2.0;
    refused("negative");
    options.limits.current_A[1] = 0.0;
    options.limits.voltage_reserve = 1.2;
    refused("reserve and dead time take 1.2");
    options.limits.voltage_reserve = 0.0;
    options.limits.dead_time_s = 1e-6;
    refused("--pwm-frequency");
}

/* ---- any answer ---- */

static uint64_t seed;

static double draw(double low, double high)
{
    return ref_uniform(&seed, low, high);
}

/* A balanced machine with harmonics and cogging, and a set that may or may not do. */
static void make_random(void)
{
    static const hci_component ALL[] = {{1.0, 1}, {5.0, -1}, {7.0, 1}, {11.0, -1}, {13.0, 1}, {17.0, -1}};
    for (int k = 1; k < 5; ++k)
        emf[k] = hci_wave_polar(ALL[k].order, ALL[k].sequence, draw(0.0, 0.3) * K_E, draw(-3.0, 3.0));
    machine.model.back_emf_count = 5;
    cogging[0] = hci_harmonic_polar(6.0, draw(0.0, 0.4), draw(-3.0, 3.0));
    cogging[1] = hci_harmonic_polar(12.0, draw(0.0, 0.2), draw(-3.0, 3.0));
    machine.model.cogging_count = 2;
    use((size_t)ref_integer(&seed, 2, 6), ALL);
    options.limit_current_A = draw(8.0, 14.0);
}

static double peak_A(void)
{
    double peak = 0.0;
    for (int k = 0; k < 20000; ++k) {
        double i[3];
        hci_waves_at(solution.current.wave, solution.current.count, 2.0 * REF_PI * k / 20000.0, i);
        peak = fmax(peak, fmax(fabs(i[0]), fmax(fabs(i[1]), fabs(i[2]))));
    }
    return peak;
}

static hci_status try_random(void)
{
    hci_note note = {{0}};
    const hci_status status = hci_solve(&machine, &options, &solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    return status;
}

static void test_peaks_are_kept_between_the_angles(void)
{
    static const hci_minimise WHAT[] = {HCI_MINIMISE_WORST, HCI_MINIMISE_PEAK_TO_PEAK, HCI_MINIMISE_RMS};
    for (uint64_t k = 1; k <= 60; ++k) {
        seed = k;
        make_random();
        options.minimise = WHAT[k % 3];
        try_random();
        TEST_ASSERT_TRUE(solution.within_limits);
        TEST_ASSERT_TRUE(peak_A() <= options.limit_current_A);
        hci_solution_release(&solution);
    }
}

/* The three measures of the same torque, each at most what the currents for another one make of it. */
static double measure(hci_minimise what)
{
    double worst = 0.0, sum = 0.0, high = -HUGE_VAL, low = HUGE_VAL;
    for (size_t k = 1; k < solution.order_count; ++k) {
        worst = fmax(worst, solution.order[k].error_Nm);
        sum += solution.order[k].error_Nm * solution.order[k].error_Nm;
    }
    for (int k = 0; k < 4000; ++k) {
        double error_Nm = 0.0;
        for (size_t j = 1; j < solution.order_count; ++j)
            error_Nm += hci_harmonics_at(&solution.order[j].torque_Nm, 1, 2.0 * REF_PI * k / 4000.0);
        high = fmax(high, error_Nm);
        low = fmin(low, error_Nm);
    }
    return what == HCI_MINIMISE_WORST ? worst : what == HCI_MINIMISE_RMS ? sqrt(sum) : high - low;
}

static void test_each_ripple_is_smallest_by_its_own_measure(void)
{
    static const hci_minimise WHAT[] = {HCI_MINIMISE_WORST, HCI_MINIMISE_PEAK_TO_PEAK, HCI_MINIMISE_RMS};
    size_t compared = 0;
    for (uint64_t k = 1; k <= 25; ++k) {
        double made[3][3];
        bool has_mean = true;
        for (int wish = 0; wish < 3; ++wish) {
            seed = k;
            make_random();
            options.minimise = WHAT[wish];
            try_random();
            has_mean = has_mean && fabs(mean_Nm() - 3.0) < 1e-6;
            for (int q = 0; q < 3; ++q)
                made[wish][q] = measure(WHAT[q]);
            hci_solution_release(&solution);
        }
        for (int wish = 0; wish < 3 && has_mean; ++wish)
            for (int other = 0; other < 3; ++other, ++compared)
                TEST_ASSERT_TRUE(made[wish][wish] <= made[other][wish] + 1e-5);
    }
    TEST_ASSERT_TRUE(compared > 60);
}

static void test_gain_is_the_slope_of_the_ripple(void)
{
    size_t compared = 0;
    options.minimise = HCI_MINIMISE_WORST;
    for (uint64_t k = 1; k <= 40; ++k) {
        double ripple_Nm[2], gain = 0.0;
        bool is_ripple = true;
        for (int side = 0; side < 2; ++side) {
            seed = k;
            make_random();
            options.limit_current_A *= side == 0 ? 1.0 : 1.0 + 1e-4;
            try_random();
            is_ripple = is_ripple && solution.limit_cost == HCI_COST_RIPPLE;
            ripple_Nm[side] = solution.minimised_Nm;
            if (side == 0) gain = limit(HCI_LIMIT_CURRENT)->gain;
            hci_solution_release(&solution);
        }
        if (!is_ripple) continue;
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * gain + 1e-3,
                                  (ripple_Nm[0] - ripple_Nm[1]) / (1e-4 * options.limit_current_A), gain);
        ++compared;
    }
    TEST_ASSERT_TRUE(compared > 10);
}

/* Order 5 is wanted and no component reaches it: what is left of the others is what it is without order 5. */
static void test_an_order_out_of_reach_hides_no_other(void)
{
    static const hci_minimise WHAT[] = {HCI_MINIMISE_WORST, HCI_MINIMISE_RMS};
    for (int wish = 0; wish < 2; ++wish) {
        double ripple_Nm[2];
        for (size_t wanted = 1; wanted <= 2; ++wanted) {
            seed = 3;
            make_random();
            options.minimise = WHAT[wish];
            options.limit_current_A = 11.0;
            order[1] = (hci_target_order){{5.0, 2.0, 0.0}, 1.0};
            target.count = wanted;
            solve(HCI_NOT_REACHED);
            TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
            ripple_Nm[wanted - 1] = solution.minimised_Nm;
        }
        TEST_ASSERT_TRUE(ripple_Nm[0] > 0.01);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, ripple_Nm[0], ripple_Nm[1]);
    }
}

/* What goes in is heat, torque times speed, and what is stored, which has no mean: mean v·i = R mean i·i +
 * ω_m T. */
/* The mirror image of a machine (e(θ) becomes −e(−θ)) with the negative torque turns the other way: S is the
 * same, C its negative. A generator needs less voltage than a motor by twice R i, and its torque is not the
 * same task. */
static void test_the_other_direction_is_a_mirror_image(void)
{
    static const hci_component SET[] = {{1.0, 1}, {5.0, -1}, {7.0, 1}};
    hci_wave both[2] = {{1.0, 1, K_E, 0.0}, {5.0, -1, 0.04 * K_E, 0.07 * K_E}};
    hci_wave forward[3];
    use(3, SET);
    machine.model.back_emf = both;
    machine.model.back_emf_count = 2;
    options.speed_rad_per_s = 200.0;
    options.limit_voltage_V = 66.0;
    options.limit_current_A = 11.5;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
    memcpy(forward, solution.current.wave, sizeof forward);
    both[1].cosine *= -1.0;
    order[0].torque_Nm.cosine *= -1.0;
    solve(HCI_OK); /* the same direction, braking */
    options.speed_rad_per_s *= -1.0;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
    for (size_t k = 0; k < 3; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, -forward[k].sine, solution.current.wave[k].sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, forward[k].cosine, solution.current.wave[k].cosine);
    }
}

static void test_power_balance_of_the_voltage(void)
{
    hci_voltage_model model;
    hci_note note = {{0}};
    double in_W = 0.0, heat_W = 0.0, torque_Nm = 0.0;
    machine.inductance_q_H = 5e-3; /* L' of L_d and L_q makes torque of its own */
    options.speed_rad_per_s = 70.0;
    TEST_ASSERT_EQUAL(HCI_OK, hci_voltage_model_make(&machine, &options, &model, &note));
    for (int k = 0; k < 256; ++k) {
        const double theta = 2.0 * REF_PI * k / 256.0, i_d = -4.0, i_q = 9.0, root = sqrt(1.5);
        const double s = sin(theta), c = cos(theta);
        const hci_plane_current i = {{root * (i_q * s - i_d * c), root * (-i_q * c - i_d * s)},
                                     {root * (i_q * c + i_d * s), root * (i_q * s - i_d * c)}};
        double v[2];
        hci_voltage_at(&model, theta, &i, v);
        in_W += (v[0] * i.x[0] + v[1] * i.x[1]) / 256.0;
        heat_W += machine.resistance_ohm * (i.x[0] * i.x[0] + i.x[1] * i.x[1]) / 256.0;
        torque_Nm = 1.5 * (K_E * i_q + 3.0 * (machine.inductance_d_H - machine.inductance_q_H) * i_d * i_q);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * in_W, in_W, heat_W + 70.0 * torque_Nm);
}

/* ---- memory ---- */

static void test_memory_runs_out(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    options.limit_current_A = 8.0;
    for (long k = 0; status && status != HCI_NOT_REACHED && k < 4000; ++k) {
        hci_note note = {{0}};
        hci_memory_fail_after(k);
        status = hci_solve(&machine, &options, &solution, &note);
        hci_memory_fail_after(-1);
        if (status == HCI_NOT_REACHED) break;
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_MEMORY, status, note.text);
        TEST_ASSERT_TRUE(note.text[0] != '\0');
    }
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, status);
}

/* Without a wanted torque no current would flow, but the back-EMF of 20 V is above the 30/√3 V of the dc
 * link. A current i_d that keeps it: (R i_d)² + (E + ω L i_d)² = V²; where the torque does not count the
 * least is (E − V)/|R + jω L|. */
static void test_a_voltage_limit_without_torque(void)
{
    const double volt = 30.0 / sqrt(3.0), r = 0.4, x = 0.6;
    order[0].torque_Nm.cosine = 0.0;
    options.speed_rad_per_s = 100.0;
    options.limit_voltage_V = 30.0;
    solve(HCI_OK);
    TEST_ASSERT_DOUBLE_WITHIN(
        1e-4, (20.0 * x - sqrt(400.0 * x * x - (r * r + x * x) * (400.0 - volt * volt))) / (r * r + x * x),
        solution.peak_phase_current_A);
    order[0].weight = 0.0;
    solve(HCI_OK);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, (20.0 - volt) / hypot(r, x), solution.peak_phase_current_A);
    options.limit_current_A = 2.0; /* both are exceeded by the same share */
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 20.0 / (volt + 2.0 * hypot(r, x)) - 1.0, solution.exceeded_share);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sine_at_its_peak);
    RUN_TEST(test_braking);
    RUN_TEST(test_a_wide_limit_changes_nothing);
    RUN_TEST(test_beyond_the_rated_current);
    RUN_TEST(test_within_the_rated_current);
    RUN_TEST(test_rms);
    RUN_TEST(test_copper);
    RUN_TEST(test_the_ripple_before_and_after);
    RUN_TEST(test_progress_is_told_within_limits);
    RUN_TEST(test_a_stop_within_limits);
    RUN_TEST(test_an_open_phase);
    RUN_TEST(test_an_open_phase_shows_a_voltage_that_is_not_limited);
    RUN_TEST(test_field_weakening);
    RUN_TEST(test_limits_that_nothing_keeps);
    RUN_TEST(test_heat_that_nothing_keeps);
    RUN_TEST(test_ratings);
    RUN_TEST(test_a_declared_dc_link_at_standstill);
    RUN_TEST(test_contradictions);
    RUN_TEST(test_peaks_are_kept_between_the_angles);
    RUN_TEST(test_each_ripple_is_smallest_by_its_own_measure);
    RUN_TEST(test_gain_is_the_slope_of_the_ripple);
    RUN_TEST(test_an_order_out_of_reach_hides_no_other);
    RUN_TEST(test_power_balance_of_the_voltage);
    RUN_TEST(test_the_other_direction_is_a_mirror_image);
    RUN_TEST(test_memory_runs_out);
    RUN_TEST(test_a_voltage_limit_without_torque);
    return UNITY_END();
}
