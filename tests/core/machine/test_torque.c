/* The torque model against its own formula, a brute-force Fourier transform and the laws of energy. */
#include "hci/machine/torque.h"

#include <stdbool.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { MAX_EMF = 4, MAX_COGGING = 3, MAX_SLOPES = 3, MAX_CURRENTS = 4, MAX_ORDERS = 256, TRIALS = 800 };

/* One torque and one spectrum sum over 256 samples round to about 256·2⁻⁵³ of the largest torque at worst. */
#define RELATIVE_ROUNDING 1e-13

/* S sin(mθ) + C cos(mθ) of a full 3×3 matrix. */
typedef struct {
    double order, sine[3][3], cosine[3][3];
} ref_matrix;

/* A machine and its currents in both descriptions. */
typedef struct {
    int turns;
    hci_machine machine;
    size_t current_count;
    hci_wave emf[MAX_EMF], current[MAX_CURRENTS];
    hci_harmonic cogging[MAX_COGGING];
    hci_inductance_slope slope[MAX_SLOPES];
    ref_wave emf_formula[MAX_EMF], current_formula[MAX_CURRENTS], cogging_formula[MAX_COGGING];
    ref_matrix slope_formula[MAX_SLOPES];
    double scale; /* bound of |T| */
} trial;

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_wave draw_wave(ref_wave *formula, int highest, int turns, uint64_t *seed)
{
    const int sequence = ref_integer(seed, -1, 1);
    const double order = (double)ref_integer(seed, 0, highest * turns) / turns;
    *formula = (ref_wave){order, sequence, ref_uniform(seed, -2, 2), ref_uniform(seed, -4, 4)};
    return hci_wave_polar(order, sequence, formula->amplitude, formula->phase);
}

static hci_harmonic draw_cogging(ref_wave *formula, int turns, uint64_t *seed)
{
    const double order = (double)ref_integer(seed, 0, 20 * turns) / turns;
    *formula = (ref_wave){order, 0, ref_uniform(seed, -2, 2),
                          order == 0.0 ? REF_PI / 2.0 : ref_uniform(seed, -4, 4)};
    return hci_harmonic_polar(order, formula->amplitude, formula->phase);
}

/* Where the entry in storage order stands in the matrix: AA, BB, CC, AB, BC, CA. */
static const int PLACE[HCI_PHASE_MATRIX][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

static hci_inductance_slope draw_slope(ref_matrix *formula, double order, uint64_t *seed)
{
    hci_inductance_slope slope = {order, {0}, {0}};
    formula->order = order;
    for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
        const int r = PLACE[q][0], c = PLACE[q][1];
        slope.sine[q] = formula->sine[r][c] = formula->sine[c][r] = ref_uniform(seed, -0.5, 0.5);
        slope.cosine[q] = formula->cosine[r][c] = formula->cosine[c][r] = ref_uniform(seed, -0.5, 0.5);
    }
    return slope;
}

/* Highest product order 6 + 5 + 5 in quarters: bin 64 of 128; cogging: bin 80. */
static void draw(trial *t, uint64_t *seed)
{
    t->turns = ref_integer(seed, 1, 4);
    t->current_count = (size_t)ref_integer(seed, 0, MAX_CURRENTS);
    t->machine = (hci_machine){ref_integer(seed, 1, 8),
                               t->emf,
                               (size_t)ref_integer(seed, 0, MAX_EMF),
                               t->cogging,
                               (size_t)ref_integer(seed, 0, MAX_COGGING),
                               t->slope,
                               (size_t)ref_integer(seed, 0, MAX_SLOPES)};
    for (size_t k = 0; k < t->machine.back_emf_count; ++k)
        t->emf[k] = draw_wave(&t->emf_formula[k], 12, t->turns, seed);
    for (size_t k = 0; k < t->current_count; ++k)
        t->current[k] = draw_wave(&t->current_formula[k], 5, t->turns, seed);
    for (size_t k = 0; k < t->machine.cogging_count; ++k)
        t->cogging[k] = draw_cogging(&t->cogging_formula[k], t->turns, seed);
    for (size_t k = 0; k < t->machine.slope_count; ++k)
        t->slope[k] =
            draw_slope(&t->slope_formula[k], (double)ref_integer(seed, 0, 6 * t->turns) / t->turns, seed);
    const double i = ref_amplitude_sum(t->current_formula, t->current_count);
    t->scale = 1.0 + 3.0 * ref_amplitude_sum(t->emf_formula, t->machine.back_emf_count) * i +
               ref_amplitude_sum(t->cogging_formula, t->machine.cogging_count) +
               4.5 * (double)t->machine.slope_count * i * i;
}

static double matrix_at(const ref_matrix *list, size_t count, int r, int c, double theta)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += list[k].sine[r][c] * sin(list[k].order * theta) +
               list[k].cosine[r][c] * cos(list[k].order * theta);
    return sum;
}

/* T = Σ_s e_s i_s + ½ Σ_rc i_r L'_rc i_c + T_cog */
static double torque_formula(const trial *t, double theta, const double i[3])
{
    double torque = ref_waves_at(t->cogging_formula, t->machine.cogging_count, 0, theta);
    for (int r = 0; r < 3; ++r) {
        torque += ref_waves_at(t->emf_formula, t->machine.back_emf_count, r, theta) * i[r];
        for (int c = 0; c < 3; ++c)
            torque += 0.5 * i[r] * matrix_at(t->slope_formula, t->machine.slope_count, r, c, theta) * i[c];
    }
    return torque;
}

static void currents_formula(const trial *t, double theta, double i[3])
{
    for (int s = 0; s < 3; ++s)
        i[s] = ref_waves_at(t->current_formula, t->current_count, s, theta);
}

static void test_torque_at_is_the_formula(void)
{
    static trial t;
    uint64_t seed = 31;
    for (int k = 0; k < 3000; ++k) {
        const double theta = ref_uniform(&seed, -7, 7);
        const double i[3] = {ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2)};
        draw(&t, &seed);
        /* |T| < 120, arguments of the sines below 20·7 */
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, torque_formula(&t, theta, i), hci_torque_at(&t.machine, theta, i));
    }
}

/* Torque and gradient are those of the two functions above; by the angle a fourth-order difference, whose
 * error is h⁴/30 of a fifth derivative: (20 p)⁵ |T| h⁴/30. */
static void test_slopes_are_derivatives(void)
{
    static trial t;
    uint64_t seed = 35;
    for (int k = 0; k < 300; ++k) {
        const double theta = ref_uniform(&seed, -7, 7), h = 1e-4;
        const double i[3] = {ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2)};
        double gradient[3], at[5];
        draw(&t, &seed);
        const hci_torque_slopes x = hci_torque_slopes_at(&t.machine, theta, i);
        hci_torque_gradient_at(&t.machine, theta, i, gradient);
        for (int j = 0; j < 5; ++j)
            at[j] = torque_formula(&t, theta + (j - 2) * h, i);
        const double by_theta = (8.0 * (at[3] - at[1]) - (at[4] - at[0])) / (12.0 * h);
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, at[2], x.torque_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, t.machine.pole_pairs * by_theta, x.by_angle);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, gradient[s], x.by_current[s]);
    }
}

/* The parts at an angle serve all currents, to the last bit. */
static void test_parts_do_not_depend_on_the_currents(void)
{
    static trial t;
    uint64_t seed = 36;
    hci_torque_parts parts;
    for (int k = 0; k < 300; ++k) {
        const double theta = ref_uniform(&seed, -7, 7);
        const double i[3] = {ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2)};
        if (k % 3 == 0) draw(&t, &seed);
        hci_torque_parts_at(&t.machine, theta, &parts);
        const hci_torque_slopes a = hci_torque_slopes_at(&t.machine, theta, i),
                                b = hci_torque_slopes_of(&parts, i);
        TEST_ASSERT_EQUAL_DOUBLE(theta, parts.theta_rad);
        TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
    }
}

/* T is quadratic in i, so that a central difference of any width is its derivative. */
static void test_gradient_is_the_difference_of_the_torque(void)
{
    static trial t;
    uint64_t seed = 32;
    for (int k = 0; k < 3000; ++k) {
        const double theta = ref_uniform(&seed, -7, 7);
        const double i[3] = {ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2)};
        double gradient[3];
        draw(&t, &seed);
        hci_torque_gradient_at(&t.machine, theta, i, gradient);
        for (int s = 0; s < 3; ++s) {
            double more[3], less[3];
            memcpy(more, i, sizeof more);
            memcpy(less, i, sizeof less);
            more[s] += 0.5;
            less[s] -= 0.5;
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-11, torque_formula(&t, theta, more) - torque_formula(&t, theta, less), gradient[s]);
        }
    }
}

static size_t spectrum_of(const trial *t, hci_harmonic *spectrum)
{
    double orders[MAX_ORDERS];
    size_t count = 0;
    TEST_ASSERT_TRUE(hci_torque_orders_capacity(&t->machine, t->current_count) <= MAX_ORDERS);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_torque_orders(&t->machine, t->current, t->current_count, orders, MAX_ORDERS, &count));
    hci_torque_spectrum(&t->machine, t->current, t->current_count, orders, count, spectrum);
    for (size_t k = 0; k < count; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(orders[k], spectrum[k].order);
    return count;
}

static void transform(const trial *t, ref_spectrum *out)
{
    double samples[REF_SAMPLES];
    for (size_t j = 0; j < REF_SAMPLES; ++j) {
        const double theta = ref_theta(j, t->turns);
        double i[3];
        currents_formula(t, theta, i);
        samples[j] = torque_formula(t, theta, i);
    }
    ref_transform(samples, out);
}

/* Every bin is compared: what hci_torque_orders does not list must be zero in the transform. */
static void test_spectrum_is_the_transformed_torque(void)
{
    static trial t;
    uint64_t seed = 33;
    for (int k = 0; k < TRIALS; ++k) {
        hci_harmonic spectrum[MAX_ORDERS];
        ref_spectrum reference;
        draw(&t, &seed);
        transform(&t, &reference);
        const size_t count = spectrum_of(&t, spectrum);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, 0.0,
                                  ref_distance(&reference, spectrum, count, t.turns, NULL));
    }
}

static void test_torque_at_orders_not_listed_is_left_out(void)
{
    static trial t;
    uint64_t seed = 34;
    for (int k = 0; k < TRIALS; ++k) {
        hci_harmonic all[MAX_ORDERS], some[MAX_ORDERS];
        double orders[MAX_ORDERS];
        size_t kept = 0;
        draw(&t, &seed);
        const size_t count = spectrum_of(&t, all);
        for (size_t j = 0; j < count; ++j) {
            if (ref_uniform(&seed, 0, 1) < 0.5) continue;
            all[kept] = all[j];
            orders[kept++] = all[j].order;
        }
        hci_torque_spectrum(&t.machine, t.current, t.current_count, orders, kept, some);
        for (size_t j = 0; j < kept; ++j) {
            TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, all[j].sine, some[j].sine);
            TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, all[j].cosine, some[j].cosine);
        }
    }
}

static void test_orders_ascend_and_begin_with_the_mean(void)
{
    static trial t;
    uint64_t seed = 35;
    for (int k = 0; k < TRIALS; ++k) {
        hci_harmonic spectrum[MAX_ORDERS];
        draw(&t, &seed);
        const size_t count = spectrum_of(&t, spectrum);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, spectrum[0].order);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, spectrum[0].sine);
        for (size_t j = 1; j < count; ++j)
            TEST_ASSERT_TRUE(spectrum[j].order - spectrum[j - 1].order > HCI_ORDER_TOLERANCE);
    }
}

static void test_too_little_capacity_is_said_and_nothing_written(void)
{
    static trial t;
    uint64_t seed = 36;
    for (int k = 0; k < 100; ++k) {
        double orders[MAX_ORDERS] = {-1.0};
        size_t count = 77;
        draw(&t, &seed);
        const size_t capacity = hci_torque_orders_capacity(&t.machine, t.current_count);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_CAPACITY, hci_torque_orders(&t.machine, t.current, t.current_count,
                                                                    orders, capacity - 1, &count));
        TEST_ASSERT_EQUAL_DOUBLE(-1.0, orders[0]);
        TEST_ASSERT_EQUAL_UINT64(77, count);
        TEST_ASSERT_EQUAL_INT(
            HCI_OK, hci_torque_orders(&t.machine, t.current, t.current_count, orders, capacity, &count));
        TEST_ASSERT_TRUE(count <= capacity);
    }
}

static void test_a_machine_without_anything_has_no_torque(void)
{
    const hci_machine nothing = {1, NULL, 0, NULL, 0, NULL, 0};
    const double i[3] = {1, 2, 3};
    double gradient[3] = {1, 1, 1}, orders[1];
    hci_harmonic spectrum;
    size_t count = 0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_torque_at(&nothing, 1.0, i));
    hci_torque_gradient_at(&nothing, 1.0, i, gradient);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, gradient[s]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_orders(&nothing, NULL, 0, orders, 1, &count));
    TEST_ASSERT_EQUAL_UINT64(1, count);
    hci_torque_spectrum(&nothing, NULL, 0, orders, 1, &spectrum);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, spectrum.cosine);
}

/* L_rc = L2 cos(2θ − (r + c)2π/3) beside a constant has L_d − L_q = 3 L2. With i_a = i_q sin θ − i_d cos θ
 * the torque is (3/2) p (L_d − L_q) i_d i_q without ripple. */
static void test_a_salient_machine_has_the_known_reluctance_torque(void)
{
    const double l2 = 0.4e-3, id = -5.0, iq = 8.0;
    const int p = 3;
    hci_inductance_slope slope = {2.0, {0}, {0}};
    const hci_wave current = {1.0, 1, iq, -id};
    const hci_machine machine = {p, NULL, 0, NULL, 0, &slope, 1};
    double orders[8];
    hci_harmonic spectrum[8];
    size_t count = 0;
    /* L'_rc = −2 p L2 sin(2θ − (r + c)2π/3) */
    for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
        const double shift = (PLACE[q][0] + PLACE[q][1]) * 2.0 * REF_PI / 3.0;
        slope.sine[q] = -2.0 * p * l2 * cos(shift);
        slope.cosine[q] = 2.0 * p * l2 * sin(shift);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_orders(&machine, &current, 1, orders, 8, &count));
    hci_torque_spectrum(&machine, &current, 1, orders, count, spectrum);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.5 * p * (3.0 * l2) * id * iq, spectrum[0].cosine);
    for (size_t k = 1; k < count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.0, hci_amplitude(spectrum[k].sine, spectrum[k].cosine));
}

/* Co-energy of the currents at one angle: W = Σ λ_s i_s + ½ iᵀ L i. λ and L are what is drawn here; e = p
 * ∂λ/∂θ and L' = p ∂L/∂θ go to the machine: (S, C) of a derivative is (−mC, mS). */
typedef struct {
    trial t;
    ref_wave flux[MAX_EMF];
    ref_matrix inductance[MAX_SLOPES];
} conservative;

static void draw_conservative(conservative *c, uint64_t *seed)
{
    trial *t = &c->t;
    draw(t, seed);
    t->machine.cogging_count = 0;
    const double p = t->machine.pole_pairs;
    for (size_t k = 0; k < t->machine.back_emf_count; ++k) {
        c->flux[k] = t->emf_formula[k];
        const double n = p * c->flux[k].order;
        t->emf[k] = hci_wave_polar(c->flux[k].order, (int)c->flux[k].shift, n * c->flux[k].amplitude,
                                   c->flux[k].phase + REF_PI / 2.0);
    }
    for (size_t k = 0; k < t->machine.slope_count; ++k) {
        ref_matrix *l = &c->inductance[k];
        draw_slope(l, t->slope[k].order, seed);
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
            t->slope[k].sine[q] = -p * l->order * l->cosine[PLACE[q][0]][PLACE[q][1]];
            t->slope[k].cosine[q] = p * l->order * l->sine[PLACE[q][0]][PLACE[q][1]];
        }
    }
}

static double flux_at(const conservative *c, int s, double theta, const double i[3])
{
    double psi = ref_waves_at(c->flux, c->t.machine.back_emf_count, s, theta);
    for (int r = 0; r < 3; ++r)
        psi += matrix_at(c->inductance, c->t.machine.slope_count, s, r, theta) * i[r];
    return psi;
}

static double coenergy_at(const conservative *c, double theta, const double i[3])
{
    double w = 0.0;
    for (int s = 0; s < 3; ++s)
        w += 0.5 * i[s] *
             (ref_waves_at(c->flux, c->t.machine.back_emf_count, s, theta) + flux_at(c, s, theta, i));
    return w;
}

/* Virtual work: T = ∂W/∂θ_m at constant currents. */
static void test_torque_is_the_slope_of_the_coenergy(void)
{
    static conservative c;
    uint64_t seed = 37;
    for (int k = 0; k < TRIALS; ++k) {
        const double theta = ref_uniform(&seed, -7, 7), h = 1e-3;
        const double i[3] = {ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2), ref_uniform(&seed, -2, 2)};
        draw_conservative(&c, &seed);
        const double slope = (8.0 * (coenergy_at(&c, theta + h, i) - coenergy_at(&c, theta - h, i)) -
                              (coenergy_at(&c, theta + 2.0 * h, i) - coenergy_at(&c, theta - 2.0 * h, i))) /
                             (12.0 * h);
        /* five-point rule: h⁴/30 of the fifth derivative, at most 12⁵·W with p·W ≤ 8·60, is 4e-6 */
        TEST_ASSERT_DOUBLE_WITHIN(4e-6, c.t.machine.pole_pairs * slope,
                                  hci_torque_at(&c.t.machine, theta, i));
    }
}

static void test_constant_currents_do_no_work_over_a_turn(void)
{
    static conservative c;
    uint64_t seed = 38;
    for (int k = 0; k < TRIALS; ++k) {
        hci_harmonic spectrum[MAX_ORDERS];
        draw_conservative(&c, &seed);
        for (size_t j = 0; j < c.t.current_count; ++j)
            c.t.current[j].order = 0.0;
        spectrum_of(&c.t, spectrum);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * c.t.machine.pole_pairs * 12.0 * c.t.scale, 0.0,
                                  spectrum[0].cosine);
    }
}

/* The field's energy is the same after a turn, so the mean of i·dψ/dθ_m (electrical power over ω_m) is the
 * mean torque. By parts it is −ψ·di/dθ_m, and the derivative of a sine formula is another one. */
static void test_mean_electrical_power_is_mean_torque_times_speed(void)
{
    static conservative c;
    uint64_t seed = 39;
    for (int k = 0; k < TRIALS; ++k) {
        hci_harmonic spectrum[MAX_ORDERS];
        ref_wave slope[MAX_CURRENTS];
        double mean = 0.0;
        draw_conservative(&c, &seed);
        for (size_t j = 0; j < c.t.current_count; ++j) {
            slope[j] = c.t.current_formula[j];
            slope[j].amplitude *= slope[j].order * c.t.machine.pole_pairs;
            slope[j].phase += REF_PI / 2.0;
        }
        for (size_t j = 0; j < REF_SAMPLES; ++j) {
            const double theta = ref_theta(j, c.t.turns);
            double i[3];
            currents_formula(&c.t, theta, i);
            for (int s = 0; s < 3; ++s)
                mean -=
                    flux_at(&c, s, theta, i) * ref_waves_at(slope, c.t.current_count, s, theta) / REF_SAMPLES;
        }
        spectrum_of(&c.t, spectrum);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * c.t.machine.pole_pairs * 12.0 * c.t.scale, mean,
                                  spectrum[0].cosine);
    }
}

/* e is per mechanical speed: terminal power Σ (e_s ω_m) i_s of a plain machine is T ω_m at every angle. */
static void test_a_plain_machine_turns_all_its_power_into_torque(void)
{
    const double emf_V = 21.93, omega_m = 2.0 * REF_PI * 50.0 / 2.0;
    const hci_wave back_emf = hci_wave_polar(1, 1, emf_V / omega_m, 0.0);
    const ref_wave voltage = {1, 1, emf_V, 0.0}, current = {1, 1, 12.0, 0.2};
    const hci_machine machine = {2, &back_emf, 1, NULL, 0, NULL, 0};
    for (int k = 0; k < 100; ++k) {
        const double theta = 0.07 * k;
        double i[3], power_W = 0.0;
        for (int s = 0; s < 3; ++s) {
            i[s] = ref_wave_at(&current, s, theta);
            power_W += ref_wave_at(&voltage, s, theta) * i[s];
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, power_W, hci_torque_at(&machine, theta, i) * omega_m);
    }
}

/* L'(θ) i(θ) as waves is ∂T/∂i of a machine without back-EMF; a zero sequence of order 0 has no sine. */
static void test_slopes_times_currents_as_waves(void)
{
    const hci_inductance_slope slope[2] = {
        {0.0, {0.0}, {0.3, -0.2, 0.1, 0.05, 0.07, -0.04}},
        {2.0, {0.2, -0.1, 0.4, 0.15, -0.3, 0.25}, {-0.1, 0.3, 0.2, -0.05, 0.1, 0.35}}};
    const hci_wave current[3] = {{1.0, 1, 2.0, -1.0}, {2.0, 0, 0.4, 0.7}, {5.0, -1, 0.3, 0.5}};
    const hci_machine machine = {.pole_pairs = 2, .slope = slope, .slope_count = 2};
    hci_wave waves[36];
    TEST_ASSERT_EQUAL_UINT64(36, hci_slope_waves_capacity(&machine, 3));
    const size_t count = hci_slope_waves(&machine, current, 3, waves);
    for (int k = 0; k < 20; ++k) {
        double i[3], expected[3], found[3];
        hci_waves_at(current, 3, 0.37 * k, i);
        hci_torque_gradient_at(&machine, 0.37 * k, i, expected);
        hci_waves_at(waves, count, 0.37 * k, found);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, expected[s], found[s]);
    }
    for (size_t k = 0; k < count; ++k)
        TEST_ASSERT_TRUE(waves[k].order > 0.0 || waves[k].sequence != 0 || waves[k].sine == 0.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_at_is_the_formula);
    RUN_TEST(test_slopes_are_derivatives);
    RUN_TEST(test_parts_do_not_depend_on_the_currents);
    RUN_TEST(test_gradient_is_the_difference_of_the_torque);
    RUN_TEST(test_spectrum_is_the_transformed_torque);
    RUN_TEST(test_torque_at_orders_not_listed_is_left_out);
    RUN_TEST(test_orders_ascend_and_begin_with_the_mean);
    RUN_TEST(test_too_little_capacity_is_said_and_nothing_written);
    RUN_TEST(test_a_machine_without_anything_has_no_torque);
    RUN_TEST(test_a_salient_machine_has_the_known_reluctance_torque);
    RUN_TEST(test_torque_is_the_slope_of_the_coenergy);
    RUN_TEST(test_constant_currents_do_no_work_over_a_turn);
    RUN_TEST(test_mean_electrical_power_is_mean_torque_times_speed);
    RUN_TEST(test_a_plain_machine_turns_all_its_power_into_torque);
    RUN_TEST(test_slopes_times_currents_as_waves);
    return UNITY_END();
}
