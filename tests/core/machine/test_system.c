/* The closed-form system U x = h against a brute-force Fourier transform of e(θ)·i(θ). */
#include "hci/machine/system.h"

#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum {
    MAX_EMF = 6,
    MAX_COMPONENTS = 5,
    MAX_ORDERS = 2 * MAX_EMF * MAX_COMPONENTS,
    MAX_ROWS = 2 * MAX_ORDERS
};
enum { MAX_ENTRIES = 8 * MAX_EMF * MAX_COMPONENTS, TRIALS = 1500 };

/* One product e·i and one spectrum sum over 256 samples round to about 256·2⁻⁵³ of Σ|E|·Σ|I| at worst. */
#define RELATIVE_ROUNDING 1e-13

/* A machine, a set of components and values for them, in both descriptions. */
typedef struct {
    int turns;
    size_t emf_count, component_count;
    hci_wave emf[MAX_EMF], current[MAX_COMPONENTS];
    ref_wave emf_formula[MAX_EMF], current_formula[MAX_COMPONENTS];
    hci_component component[MAX_COMPONENTS];
    double x[2 * MAX_COMPONENTS]; /* I cos γ, I sin γ */
    double scale;                 /* Σ|E|·Σ|I|·3 */
    ref_spectrum torque;          /* by transform_torque */
} trial;

typedef enum { BALANCED_STAR, BALANCED_NEUTRAL, UNBALANCED } trial_kind;

void setUp(void)
{
}

void tearDown(void)
{
}

/* Whole order, different from the earlier ones, alike in each phase: Σ E sin(μ(θ − 2πs/3) + φ). */
static void draw_balanced_emf(trial *t, size_t k, uint64_t *seed)
{
    static const int sequence[3] = {0, 1, -1};
    const int order = 2 * (int)k + ref_integer(seed, 0, 1) + (k == 0);
    t->emf_formula[k] = (ref_wave){order, order, ref_uniform(seed, -2, 2), ref_uniform(seed, -4, 4)};
    t->emf[k] =
        hci_wave_polar(order, sequence[order % 3], t->emf_formula[k].amplitude, t->emf_formula[k].phase);
}

/* Any order, repeats included, of any sequence: what phases with unequal gain and angle consist of. */
static void draw_unbalanced_emf(trial *t, size_t k, uint64_t *seed)
{
    const int sequence = ref_integer(seed, -1, 1);
    const double order = (double)ref_integer(seed, 0, 12 * t->turns) / t->turns;
    t->emf_formula[k] = (ref_wave){order, sequence, ref_uniform(seed, -2, 2), ref_uniform(seed, -4, 4)};
    t->emf[k] = hci_wave_polar(order, sequence, t->emf_formula[k].amplitude, t->emf_formula[k].phase);
}

static void draw_component(trial *t, size_t k, trial_kind kind, uint64_t *seed)
{
    const int star[2] = {-1, 1};
    const int sequence = kind == BALANCED_STAR ? star[ref_integer(seed, 0, 1)] : ref_integer(seed, -1, 1);
    const double order = (double)ref_integer(seed, 0, 12 * t->turns) / t->turns;
    const double amplitude = ref_uniform(seed, -2, 2), phase = ref_uniform(seed, -4, 4);
    t->component[k] = (hci_component){order, sequence};
    t->current_formula[k] = (ref_wave){order, sequence, amplitude, phase};
    t->x[2 * k] = amplitude * cos(phase);
    t->x[2 * k + 1] = amplitude * sin(phase);
    t->current[k] = (hci_wave){order, sequence, t->x[2 * k], t->x[2 * k + 1]};
}

static void transform_torque(trial *t)
{
    double samples[REF_SAMPLES];
    for (size_t j = 0; j < REF_SAMPLES; ++j) {
        const double theta = ref_theta(j, t->turns);
        samples[j] = 0.0;
        for (int s = 0; s < 3; ++s)
            samples[j] += ref_waves_at(t->emf_formula, t->emf_count, s, theta) *
                          ref_waves_at(t->current_formula, t->component_count, s, theta);
    }
    ref_transform(samples, &t->torque);
}

/* Orders up to 12 + 12 in quarters: bin 96 of 128. */
static void draw(trial *t, uint64_t *seed)
{
    const trial_kind kind = (trial_kind)ref_integer(seed, BALANCED_STAR, UNBALANCED);
    t->turns = ref_integer(seed, 1, 4);
    t->emf_count = (size_t)ref_integer(seed, 1, MAX_EMF);
    t->component_count = (size_t)ref_integer(seed, 1, MAX_COMPONENTS);
    for (size_t k = 0; k < t->emf_count; ++k)
        (kind == UNBALANCED ? draw_unbalanced_emf : draw_balanced_emf)(t, k, seed);
    for (size_t k = 0; k < t->component_count; ++k)
        draw_component(t, k, kind, seed);
    t->scale = 3.0 * ref_amplitude_sum(t->emf_formula, t->emf_count) *
               ref_amplitude_sum(t->current_formula, t->component_count);
}

static size_t reached_orders(const trial *t, double orders[MAX_ORDERS])
{
    size_t n = 0;
    for (size_t k = 0; k < t->component_count; ++k) {
        const size_t found = hci_component_orders(t->emf, t->emf_count, t->component[k], orders + n);
        TEST_ASSERT_TRUE(found <= 2 * t->emf_count);
        n += found;
    }
    return hci_orders_sort(orders, n);
}

/* Leaves out some of the orders and marks their bins, so that the reference is not compared there. */
static size_t leave_out(double *orders, size_t count, int turns, unsigned char skip[REF_BAND], uint64_t *seed)
{
    size_t kept = 0;
    memset(skip, 0, REF_BAND);
    for (size_t k = 0; k < count; ++k) {
        if (ref_uniform(seed, 0, 1) < 0.25)
            skip[(size_t)floor(orders[k] * turns + 0.5)] = 1;
        else
            orders[kept++] = orders[k];
    }
    return kept;
}

/* Rows as the header lays them out, read back here by hand. */
static void rows_to_spectrum(const double *rows, const double *orders, size_t count, hci_harmonic *spectrum)
{
    for (size_t k = 0; k < count; ++k) {
        const int mean = k == 0 && orders[0] == 0.0;
        spectrum[k] = (hci_harmonic){orders[k], mean ? 0.0 : rows[0], rows[!mean]};
        rows += mean ? 1 : 2;
    }
}

static void dense_times_x(const trial *t, const double *orders, size_t count, hci_harmonic *spectrum)
{
    static double u[MAX_ROWS * 2 * MAX_COMPONENTS];
    double h[MAX_ROWS] = {0.0};
    const size_t rows = 2 * count - (count > 0 && orders[0] == 0.0);
    TEST_ASSERT_EQUAL_UINT64(rows, hci_orders_rows(orders, count));
    for (size_t k = 0; k < rows * 2 * t->component_count; ++k)
        u[k] = (double)NAN; /* all must be written */
    hci_system_dense(&(hci_mutual_torque){t->emf, t->emf_count, orders, count}, t->component,
                     t->component_count, u);
    for (size_t c = 0; c < 2 * t->component_count; ++c)
        for (size_t r = 0; r < rows; ++r)
            h[r] += u[r + c * rows] * t->x[c];
    rows_to_spectrum(h, orders, count, spectrum);
}

static void sparse_times_x(const trial *t, const double *orders, size_t count, hci_harmonic *spectrum)
{
    int64_t start[2 * MAX_COMPONENTS + 1], row[MAX_ENTRIES];
    double value[MAX_ENTRIES], h[MAX_ROWS] = {0.0};
    TEST_ASSERT_TRUE(hci_system_capacity(t->emf_count, t->component_count) <= MAX_ENTRIES);
    hci_system_sparse(&(hci_mutual_torque){t->emf, t->emf_count, orders, count}, t->component,
                      t->component_count, start, row, value);
    for (size_t c = 0; c < 2 * t->component_count; ++c)
        for (int64_t p = start[c]; p < start[c + 1]; ++p)
            h[row[p]] += value[p] * t->x[c];
    rows_to_spectrum(h, orders, count, spectrum);
}

static void add_torque_once(const trial *t, const double *orders, size_t count, hci_harmonic *spectrum)
{
    for (size_t k = 0; k < count; ++k)
        spectrum[k] = (hci_harmonic){orders[k], 0.0, 0.0};
    hci_system_add_torque(&(hci_mutual_torque){t->emf, t->emf_count, orders, count}, t->current,
                          t->component_count, spectrum);
}

typedef void torque_method(const trial *t, const double *orders, size_t count, hci_harmonic *spectrum);

static void compare_with_transform(torque_method *method, uint64_t seed)
{
    static trial t;
    for (int k = 0; k < TRIALS; ++k) {
        double orders[MAX_ORDERS];
        hci_harmonic spectrum[MAX_ORDERS];
        unsigned char skip[REF_BAND] = {0};
        draw(&t, &seed);
        transform_torque(&t);
        size_t count = reached_orders(&t, orders);
        if (k % 3 == 2) count = leave_out(orders, count, t.turns, skip, &seed);
        method(&t, orders, count, spectrum);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, 0.0,
                                  ref_distance(&t.torque, spectrum, count, t.turns, skip));
    }
}

static void test_dense_u_times_x_is_the_transformed_torque(void)
{
    compare_with_transform(dense_times_x, 11);
}

static void test_sparse_u_times_x_is_the_transformed_torque(void)
{
    compare_with_transform(sparse_times_x, 12);
}

static void test_add_torque_is_the_transformed_torque(void)
{
    compare_with_transform(add_torque_once, 13);
}

static void test_add_torque_adds_to_what_is_there(void)
{
    const hci_wave emf = hci_wave_polar(1, 1, 2.0, 0.0), current = hci_wave_polar(5, -1, 1.0, 0.0);
    const double orders[2] = {3, 6};
    hci_harmonic spectrum[2] = {{3, 0.25, 0.5}, {6, 0.75, 1.0}};
    hci_system_add_torque(&(hci_mutual_torque){&emf, 1, orders, 2}, &current, 1, spectrum);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, spectrum[0].sine);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, spectrum[0].cosine);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, spectrum[1].sine);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 - 3.0, spectrum[1].cosine); /* −(3/2)·1·2·cos 6θ */
}

/* One component and one back-EMF wave against A cos(mθ + ψ), worked out from theory section 4 by hand. */
static void expect_one(hci_wave emf, hci_wave current, double order, double a, double psi)
{
    double orders[2];
    hci_harmonic spectrum = {0, 0, 0};
    const hci_component component = {current.order, current.sequence};
    TEST_ASSERT_EQUAL_UINT64(1, hci_component_orders(&emf, 1, component, orders));
    TEST_ASSERT_EQUAL_DOUBLE(order, orders[0]);
    hci_system_add_torque(&(hci_mutual_torque){&emf, 1, orders, 1}, &current, 1, &spectrum);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, order == 0.0 ? 0.0 : -a * sin(psi), spectrum.sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, a * cos(psi), spectrum.cosine);
}

static void test_folding_of_the_difference(void)
{
    const double a = 1.5 * 2.0 * 0.7, phi = 0.3, gamma = 1.1;
    const hci_wave fifth = hci_wave_polar(5, -1, 2.0, phi), first = hci_wave_polar(1, 1, 2.0, phi);
    expect_one(fifth, hci_wave_polar(8, -1, 0.7, gamma), 3, a, gamma - phi);      /* n > μ */
    expect_one(fifth, hci_wave_polar(2, -1, 0.7, gamma), 3, a, phi - gamma);      /* n < μ */
    expect_one(fifth, hci_wave_polar(5, -1, 0.7, gamma), 0, a, gamma - phi);      /* n = μ */
    expect_one(first, hci_wave_polar(0, 1, 0.7, gamma), 1, a, phi - gamma);       /* constant current */
    expect_one(first, hci_wave_polar(0.25, 1, 0.7, gamma), 0.75, a, phi - gamma); /* fractional */
}

static void test_the_sum_of_opposite_sequences(void)
{
    const double a = -1.5 * 2.0 * 0.7, phi = 0.3, gamma = 1.1;
    const hci_wave fifth = hci_wave_polar(5, -1, 2.0, phi), first = hci_wave_polar(1, 1, 2.0, phi);
    expect_one(first, hci_wave_polar(5, -1, 0.7, gamma), 6, a, gamma + phi);
    expect_one(fifth, hci_wave_polar(1, 1, 0.7, gamma), 6, a, gamma + phi);
    expect_one(first, hci_wave_polar(1, -1, 0.7, gamma), 2, a, gamma + phi);
    expect_one(first, hci_wave_polar(0, -1, 0.7, gamma), 1, a, gamma + phi);
}

static void test_zero_sequences_make_both_sum_and_difference(void)
{
    const hci_wave third = hci_wave_polar(3, 0, 2.0, 0.3), ninth = hci_wave_polar(9, 0, 0.7, 1.1);
    double orders[2] = {0};
    hci_harmonic spectrum[2] = {{6, 0, 0}, {12, 0, 0}};
    TEST_ASSERT_EQUAL_UINT64(2, hci_component_orders(&third, 1, (hci_component){9, 0}, orders));
    TEST_ASSERT_EQUAL_UINT64(2, hci_orders_sort(orders, 2));
    hci_system_add_torque(&(hci_mutual_torque){&third, 1, orders, 2}, &ninth, 1, spectrum);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2.1 * cos(0.8), spectrum[0].cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, -2.1 * sin(0.8), spectrum[0].sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, -2.1 * cos(1.4), spectrum[1].cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2.1 * sin(1.4), spectrum[1].sine);
}

static void test_triplen_back_emf_makes_no_torque_in_star(void)
{
    const hci_wave triplen[3] = {hci_wave_polar(3, 0, 5, 1), hci_wave_polar(9, 0, 4, 2),
                                 hci_wave_polar(15, 0, 3, 3)};
    double orders[6];
    for (int order = 0; order <= 20; ++order)
        for (int sequence = -1; sequence <= 1; sequence += 2)
            TEST_ASSERT_EQUAL_UINT64(
                0, hci_component_orders(triplen, 3, (hci_component){order, sequence}, orders));
}

static void check_columns(const trial *t, size_t rows, const int64_t *start, const int64_t *row)
{
    TEST_ASSERT_EQUAL_INT64(0, start[0]);
    for (size_t c = 0; c < 2 * t->component_count; ++c) {
        TEST_ASSERT_TRUE(start[c] <= start[c + 1]);
        for (int64_t p = start[c]; p < start[c + 1]; ++p) {
            TEST_ASSERT_TRUE(row[p] >= 0 && row[p] < (int64_t)rows);
            TEST_ASSERT_TRUE(p == start[c] || row[p - 1] < row[p]);
        }
    }
    TEST_ASSERT_TRUE((size_t)start[2 * t->component_count] <=
                     hci_system_capacity(t->emf_count, t->component_count));
}

static void test_sparse_columns_ascend_and_equal_the_dense_ones(void)
{
    static trial t;
    static double u[MAX_ROWS * 2 * MAX_COMPONENTS];
    uint64_t seed = 14;
    for (int k = 0; k < TRIALS; ++k) {
        int64_t start[2 * MAX_COMPONENTS + 1], row[MAX_ENTRIES];
        double orders[MAX_ORDERS], value[MAX_ENTRIES];
        draw(&t, &seed);
        const size_t count = reached_orders(&t, orders), rows = hci_orders_rows(orders, count);
        hci_system_dense(&(hci_mutual_torque){t.emf, t.emf_count, orders, count}, t.component,
                         t.component_count, u);
        hci_system_sparse(&(hci_mutual_torque){t.emf, t.emf_count, orders, count}, t.component,
                          t.component_count, start, row, value);
        check_columns(&t, rows, start, row);
        for (size_t c = 0; c < 2 * t.component_count; ++c)
            for (int64_t p = start[c]; p < start[c + 1]; ++p)
                u[(size_t)row[p] + c * rows] -= value[p];
        /* entries are sums of at most 6 terms of 3 each; the order of adding may differ */
        for (size_t p = 0; p < rows * 2 * t.component_count; ++p)
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.0, u[p]);
    }
}

static size_t orders_in_column(const int64_t *row, int64_t count, int has_mean)
{
    size_t distinct = 0;
    int64_t last = -1;
    for (int64_t p = 0; p < count; ++p) {
        const int64_t order = (row[p] + has_mean) / 2;
        distinct += order != last;
        last = order;
    }
    return distinct;
}

/* Theory section 4: in a star connection with balanced phases each column has at most one pair per EMF
 * harmonic. */
static void test_a_balanced_star_column_has_one_pair_per_emf_harmonic(void)
{
    static trial t;
    uint64_t seed = 15;
    for (int k = 0; k < TRIALS; ++k) {
        int64_t start[2 * MAX_COMPONENTS + 1], row[MAX_ENTRIES];
        double orders[MAX_ORDERS], value[MAX_ENTRIES];
        t.turns = ref_integer(&seed, 1, 4);
        t.emf_count = MAX_EMF;
        t.component_count = MAX_COMPONENTS;
        for (size_t j = 0; j < MAX_EMF; ++j)
            draw_balanced_emf(&t, j, &seed);
        for (size_t j = 0; j < MAX_COMPONENTS; ++j)
            draw_component(&t, j, BALANCED_STAR, &seed);
        const size_t count = reached_orders(&t, orders);
        size_t active = 0;
        for (size_t j = 0; j < MAX_EMF; ++j)
            active += fmod(t.emf[j].order, 3.0) != 0.0;
        hci_system_sparse(&(hci_mutual_torque){t.emf, MAX_EMF, orders, count}, t.component, MAX_COMPONENTS,
                          start, row, value);
        for (size_t c = 0; c < 2 * MAX_COMPONENTS; ++c)
            TEST_ASSERT_TRUE(orders_in_column(row + start[c], start[c + 1] - start[c], orders[0] == 0.0) <=
                             active);
    }
}

static void test_the_pattern_does_not_depend_on_values(void)
{
    static trial t;
    uint64_t seed = 16;
    for (int k = 0; k < TRIALS; ++k) {
        int64_t start[2][2 * MAX_COMPONENTS + 1], row[2][MAX_ENTRIES];
        double orders[MAX_ORDERS], value[MAX_ENTRIES];
        draw(&t, &seed);
        const size_t count = reached_orders(&t, orders);
        hci_system_sparse(&(hci_mutual_torque){t.emf, t.emf_count, orders, count}, t.component,
                          t.component_count, start[0], row[0], value);
        for (size_t j = 0; j < t.emf_count; ++j)
            t.emf[j].sine = t.emf[j].cosine = 0.0;
        hci_system_sparse(&(hci_mutual_torque){t.emf, t.emf_count, orders, count}, t.component,
                          t.component_count, start[1], row[1], value);
        const size_t columns = 2 * t.component_count;
        TEST_ASSERT_EQUAL_INT64_ARRAY(start[0], start[1], columns + 1);
        for (int64_t p = 0; p < start[0][columns]; ++p)
            TEST_ASSERT_EQUAL_INT64(row[0][p], row[1][p]);
    }
}

static double distance(const hci_harmonic *a, const hci_harmonic *b, size_t count)
{
    double worst = 0.0;
    for (size_t k = 0; k < count; ++k)
        worst = ref_worse(ref_worse(worst, a[k].sine - b[k].sine), a[k].cosine - b[k].cosine);
    return worst;
}

/* θ → θ + α: each wave gains the phase nα, and so does each torque harmonic. */
static hci_wave shifted(hci_wave w, double alpha)
{
    const double c = cos(w.order * alpha), s = sin(w.order * alpha);
    return (hci_wave){w.order, w.sequence, w.sine * c - w.cosine * s, w.sine * s + w.cosine * c};
}

static void test_a_shift_of_the_angle_turns_each_torque_harmonic(void)
{
    static trial t;
    uint64_t seed = 17;
    for (int k = 0; k < TRIALS; ++k) {
        double orders[MAX_ORDERS];
        hci_harmonic before[MAX_ORDERS], after[MAX_ORDERS];
        const double alpha = ref_uniform(&seed, -4.0, 4.0);
        draw(&t, &seed);
        const size_t count = reached_orders(&t, orders);
        add_torque_once(&t, orders, count, before);
        for (size_t j = 0; j < t.emf_count; ++j)
            t.emf[j] = shifted(t.emf[j], alpha);
        for (size_t j = 0; j < t.component_count; ++j)
            t.current[j] = shifted(t.current[j], alpha);
        add_torque_once(&t, orders, count, after);
        for (size_t j = 0; j < count; ++j) {
            const hci_wave w = shifted((hci_wave){orders[j], 0, before[j].sine, before[j].cosine}, alpha);
            before[j] = (hci_harmonic){orders[j], w.sine, w.cosine};
        }
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, 0.0, distance(before, after, count));
    }
}

/* Exchanging phases b and c in machine and currents mirrors every sequence and changes no torque; so does
 * exchanging the part of back-EMF and current. */
static void test_mirrored_and_exchanged_waves_make_the_same_torque(void)
{
    static trial t;
    uint64_t seed = 18;
    for (int k = 0; k < TRIALS; ++k) {
        double orders[MAX_ORDERS];
        hci_harmonic torque[MAX_ORDERS], other[MAX_ORDERS] = {{0, 0, 0}};
        draw(&t, &seed);
        const size_t count = reached_orders(&t, orders);
        add_torque_once(&t, orders, count, torque);
        hci_system_add_torque(&(hci_mutual_torque){t.current, t.component_count, orders, count}, t.emf,
                              t.emf_count, other);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, 0.0, distance(torque, other, count));
        for (size_t j = 0; j < t.emf_count; ++j)
            t.emf[j].sequence = -t.emf[j].sequence;
        for (size_t j = 0; j < t.component_count; ++j)
            t.current[j].sequence = -t.current[j].sequence;
        add_torque_once(&t, orders, count, other);
        TEST_ASSERT_DOUBLE_WITHIN(RELATIVE_ROUNDING * t.scale, 0.0, distance(torque, other, count));
    }
}

/* T(e, αi + βj) = αT(e, i) + βT(e, j), where j has the components of i and values of its own. */
static void test_torque_is_linear_in_the_current(void)
{
    static trial t;
    uint64_t seed = 19;
    for (int k = 0; k < TRIALS; ++k) {
        double orders[MAX_ORDERS];
        hci_harmonic a[MAX_ORDERS], b[MAX_ORDERS], both[MAX_ORDERS];
        hci_wave sum[MAX_COMPONENTS];
        draw(&t, &seed);
        const size_t count = reached_orders(&t, orders);
        add_torque_once(&t, orders, count, a);
        for (size_t j = 0; j < t.component_count; ++j) {
            sum[j] = t.current[j];
            t.current[j].sine = ref_uniform(&seed, -2, 2);
            t.current[j].cosine = ref_uniform(&seed, -2, 2);
            sum[j].sine = 0.3 * sum[j].sine - 1.7 * t.current[j].sine;
            sum[j].cosine = 0.3 * sum[j].cosine - 1.7 * t.current[j].cosine;
        }
        add_torque_once(&t, orders, count, b);
        memcpy(t.current, sum, sizeof sum);
        add_torque_once(&t, orders, count, both);
        for (size_t j = 0; j < count; ++j) {
            a[j].sine = 0.3 * a[j].sine - 1.7 * b[j].sine;
            a[j].cosine = 0.3 * a[j].cosine - 1.7 * b[j].cosine;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, distance(a, both, count)); /* |E|, |I| ≤ 2: sums below 200 */
    }
}

static void test_sorting_keeps_one_of_each_ascending(void)
{
    uint64_t seed = 20;
    for (int trial_number = 0; trial_number < 500; ++trial_number) {
        double list[64];
        int present[21] = {0};
        size_t distinct = 0;
        const size_t count = (size_t)ref_integer(&seed, 0, 64);
        for (size_t k = 0; k < count; ++k) {
            const int quarter = ref_integer(&seed, 0, 20);
            present[quarter] = 1;
            list[k] = quarter / 4.0 + ref_uniform(&seed, 0.0, 0.5e-6);
        }
        for (int q = 0; q <= 20; ++q)
            distinct += (size_t)present[q];
        TEST_ASSERT_EQUAL_UINT64(distinct, hci_orders_sort(list, count));
        for (size_t k = 0, q = 0; k < distinct; ++k, ++q) {
            while (!present[q])
                ++q;
            TEST_ASSERT_DOUBLE_WITHIN(0.5e-6, (double)q / 4.0, list[k]);
        }
    }
}

static void test_orders_are_found_within_the_tolerance_only(void)
{
    const double orders[4] = {0, 2.5, 6, 12};
    for (size_t k = 0; k < 4; ++k) {
        TEST_ASSERT_EQUAL_UINT64(k, hci_orders_find(orders, 4, orders[k]));
        TEST_ASSERT_EQUAL_UINT64(k, hci_orders_find(orders, 4, orders[k] + 0.9e-6));
        TEST_ASSERT_EQUAL_UINT64(k, hci_orders_find(orders, 4, orders[k] - 0.9e-6));
        TEST_ASSERT_EQUAL_UINT64(4, hci_orders_find(orders, 4, orders[k] + 1.1e-6));
        TEST_ASSERT_EQUAL_UINT64(4, hci_orders_find(orders, 4, orders[k] - 1.1e-6));
    }
    TEST_ASSERT_EQUAL_UINT64(0, hci_orders_find(NULL, 0, 1.0));
}

static void test_rows_with_and_without_a_mean(void)
{
    const double with[3] = {0, 1, 2}, without[3] = {0.5, 1, 2};
    TEST_ASSERT_EQUAL_UINT64(0, hci_orders_rows(NULL, 0));
    TEST_ASSERT_EQUAL_UINT64(5, hci_orders_rows(with, 3));
    TEST_ASSERT_EQUAL_UINT64(6, hci_orders_rows(without, 3));
    for (size_t k = 0; k < 3; ++k) {
        const size_t expected[3] = {0, 1, 3};
        TEST_ASSERT_EQUAL_UINT64(expected[k], hci_orders_row(with, 3, k));
        TEST_ASSERT_EQUAL_UINT64(2 * k, hci_orders_row(without, 3, k));
    }
}

static void test_spectrum_and_rows_convert_both_ways(void)
{
    const hci_harmonic spectrum[3] = {{0, 0, 2}, {1, 3, 4}, {6, 5, 6}};
    const double orders[3] = {0, 1, 6}, expected[5] = {2, 3, 4, 5, 6};
    double rows[5] = {0};
    hci_harmonic back[3];
    hci_spectrum_to_rows(spectrum, 3, rows);
    for (size_t k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(expected[k], rows[k]);
    hci_spectrum_from_rows(orders, 3, rows, back);
    for (size_t k = 0; k < 3; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(spectrum[k].order, back[k].order);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, distance(spectrum, back, 3));
    hci_spectrum_to_rows(spectrum + 1, 2, rows);
    for (size_t k = 0; k < 4; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(expected[k + 1], rows[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_dense_u_times_x_is_the_transformed_torque);
    RUN_TEST(test_sparse_u_times_x_is_the_transformed_torque);
    RUN_TEST(test_add_torque_is_the_transformed_torque);
    RUN_TEST(test_add_torque_adds_to_what_is_there);
    RUN_TEST(test_folding_of_the_difference);
    RUN_TEST(test_the_sum_of_opposite_sequences);
    RUN_TEST(test_zero_sequences_make_both_sum_and_difference);
    RUN_TEST(test_triplen_back_emf_makes_no_torque_in_star);
    RUN_TEST(test_sparse_columns_ascend_and_equal_the_dense_ones);
    RUN_TEST(test_a_balanced_star_column_has_one_pair_per_emf_harmonic);
    RUN_TEST(test_the_pattern_does_not_depend_on_values);
    RUN_TEST(test_a_shift_of_the_angle_turns_each_torque_harmonic);
    RUN_TEST(test_mirrored_and_exchanged_waves_make_the_same_torque);
    RUN_TEST(test_torque_is_linear_in_the_current);
    RUN_TEST(test_sorting_keeps_one_of_each_ascending);
    RUN_TEST(test_orders_are_found_within_the_tolerance_only);
    RUN_TEST(test_rows_with_and_without_a_mean);
    RUN_TEST(test_spectrum_and_rows_convert_both_ways);
    return UNITY_END();
}
