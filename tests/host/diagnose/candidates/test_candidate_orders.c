/* At which orders something is missing: what each would explain against least squares, the rate of chance,
 * and which orders are of slots, of the turn, or grow as nothing known does. */
#include "host/diagnose/candidates/candidate_orders.h"

#include <string.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, RUNS = 4, SAMPLES = 200, COUNT = RUNS * SAMPLES };

static const double NOISE_NM = 0.01;
static const hci_machine MACHINE = {.pole_pairs = P};
static const hci_effects NO_EFFECTS = {NULL, 0};

static uint64_t seed;
static hci_binned_sample sample[COUNT];
static hci_segment segment[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_run run[RUNS];
static bool use[RUNS];
static double residual_Nm[COUNT], variance[COUNT];
static hci_binned_samples samples;
static hci_candidates_source source;
static hci_candidate_orders orders;

/* One turn each, of different currents. */
void setUp(void)
{
    seed = 31;
    memset(sample, 0, sizeof sample);
    memset(statistics, 0, sizeof statistics);
    for (size_t r = 0; r < RUNS; ++r) {
        const double iq = 0.5 * (double)(r * r);
        segment[r] = (hci_segment){.run = r, .first = r * SAMPLES, .count = SAMPLES};
        statistics[r].current_A = iq;
        for (size_t k = r * SAMPLES; k < (r + 1) * SAMPLES; ++k) {
            sample[k].reading.theta_m_rad = 2.0 * REF_PI * (double)(k % SAMPLES) / SAMPLES;
            rec_phases(0.0, iq, P * sample[k].reading.theta_m_rad, sample[k].reading.i_abc);
            residual_Nm[k] = NOISE_NM * ref_normal(&seed);
            variance[k] = NOISE_NM * NOISE_NM;
        }
        use[r] = true;
    }
    samples = (hci_binned_samples){sample, COUNT, segment, RUNS, statistics, RUNS};
    source = (hci_candidates_source){.machine = &MACHINE,
                                     .declared = &NO_EFFECTS,
                                     .samples = &samples,
                                     .runs = run,
                                     .use = use,
                                     .residual_Nm = residual_Nm,
                                     .variance = variance,
                                     .reference_current_A = NAN};
}

void tearDown(void)
{
    hci_candidate_orders_release(&orders);
}

static void find(size_t stride)
{
    hci_candidate_orders_release(&orders);
    TEST_ASSERT_TRUE(hci_candidate_orders_make(&source, stride, &orders));
}

/* A turn forward and back at the same places tells no more orders than the turn forward; at places between
 * them it tells as many as its samples do, and so does a turn with the shaft read at random places. */
static void test_places_that_are_read_twice(void)
{
    static const struct {
        double between, samples_a_turn;
    } CASE[] = {{0.0, 0.5 * SAMPLES}, {0.5, SAMPLES}};
    for (size_t c = 0; c < 2; ++c) {
        for (size_t k = 0; k < COUNT; ++k) {
            const size_t at = k % SAMPLES, place = at < SAMPLES / 2 ? at : SAMPLES - 1 - at;
            sample[k].reading.theta_m_rad =
                4.0 * REF_PI / SAMPLES * ((double)place + (at < SAMPLES / 2 ? 0.0 : CASE[c].between));
        }
        find(1);
        TEST_ASSERT_DOUBLE_WITHIN(0.02 * SAMPLES / P, 0.48 * CASE[c].samples_a_turn / P, orders.resolved);
    }
    for (size_t k = 0; k < COUNT; ++k)
        sample[k].reading.theta_m_rad = ref_uniform(&seed, 0.0, 2.0 * REF_PI);
    find(1);
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * SAMPLES / P, 0.48 * SAMPLES / P, orders.resolved);
}

/* Samples in a turn are a mean over all turns: two of a hundred, and three of two hundred. */
static void test_turns_of_fewer_samples(void)
{
    for (size_t k = 0; k < SAMPLES; ++k)
        sample[k].reading.theta_m_rad *= 2.0;
    find(1);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * SAMPLES / P, 0.48 * (2.0 * 100.0 + 3.0 * SAMPLES) / 5.0 / P,
                              orders.resolved);
}

/* A wave with so many periods in a turn, with the size of some law of the current. */
static void hide(size_t periods, double amplitude_Nm, double exponent)
{
    for (size_t k = 0; k < COUNT; ++k)
        residual_Nm[k] += amplitude_Nm * pow(statistics[k / SAMPLES].current_A, exponent) *
                          sin((double)periods * sample[k].reading.theta_m_rad + 0.7);
}

/* ---- what an order explains ---- */

/* χ² less χ² beside a sine and a cosine whose values solve the 2×2 normal equations, times i_q or not; of
 * residuals whose means run by run are taken away. */
static double fall(size_t periods, bool with_current)
{
    double g[3] = {0.0}, m[2] = {0.0}, mean[RUNS] = {0.0};
    for (size_t k = 0; k < COUNT; ++k)
        mean[k / SAMPLES] += residual_Nm[k] / SAMPLES;
    for (size_t k = 0; k < COUNT; ++k) {
        const double size = with_current ? statistics[k / SAMPLES].current_A : 1.0;
        const double angle = (double)periods * sample[k].reading.theta_m_rad;
        const double s = size * sin(angle) / NOISE_NM, c = size * cos(angle) / NOISE_NM;
        const double y = (residual_Nm[k] - mean[k / SAMPLES]) / NOISE_NM;
        g[0] += s * s;
        g[1] += s * c;
        g[2] += c * c;
        m[0] += s * y;
        m[1] += c * y;
    }
    const double d = g[0] * g[2] - g[1] * g[1];
    return (m[0] * (g[2] * m[0] - g[1] * m[1]) + m[1] * (g[0] * m[1] - g[1] * m[0])) / d;
}

static void test_what_an_order_explains(void)
{
    hide(18, 0.004, 0.0);
    hide(7, 0.002, 1.0);
    find(1);
    for (size_t n = 1; n < orders.count && n < 90; ++n) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * fall(n, false) + 1e-9, fall(n, false), orders.still[n]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * fall(n, true) + 1e-9, fall(n, true), orders.with_current[n]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.3 * 64.0, 0.5 * 0.004 * 0.004 / (NOISE_NM * NOISE_NM) * COUNT,
                              orders.still[18]);
}

/* A run of means has no angle: what it says of orders, and what it weighs, is nothing. */
static void test_means_have_no_orders(void)
{
    double still[90], with_current[90];
    const size_t first = (RUNS - 1) * SAMPLES;
    hide(18, 0.004, 0.0);
    samples.segment_count = RUNS - 1;
    find(1);
    memcpy(still, orders.still, sizeof still);
    memcpy(with_current, orders.with_current, sizeof with_current);
    samples.segment_count = RUNS;
    run[RUNS - 1].only_mean = true;
    for (size_t k = first; k < COUNT; ++k) {
        sample[k].reading.theta_m_rad = 0.0;
        residual_Nm[k] = 0.1 * ref_normal(&seed);
    }
    find(1);
    run[RUNS - 1].only_mean = false;
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(still, orders.still, 90);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(with_current, orders.with_current, 90);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, orders.weight[RUNS - 1]);
}

/* What is the same in all of a run has no order either, where the run does not go round. */
static void test_a_constant_has_no_orders(void)
{
    double still[60];
    for (size_t k = 0; k < COUNT; ++k)
        sample[k].reading.theta_m_rad *= 0.9;
    find(1);
    memcpy(still, orders.still, sizeof still);
    for (size_t k = 0; k < COUNT; ++k)
        residual_Nm[k] += 1.0 + (double)(k / SAMPLES);
    find(1);
    for (size_t k = 0; k < 60; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, still[k], orders.still[k]);
}

/* Noise gives χ² of two degrees of freedom: above x once in exp(x/2) times, above the limit once in 403. */
static void test_noise_stands_out_at_the_rate_of_the_limit(void)
{
    const double rate = exp(-0.5 * HCI_STANDS_OUT);
    double tries = 0.0, alarms = 0.0, above_2 = 0.0;
    for (int draw = 0; draw < 60; ++draw) {
        for (size_t k = 0; k < COUNT; ++k)
            residual_Nm[k] = NOISE_NM * ref_normal(&seed);
        find(1);
        for (size_t n = 1; n < 90; ++n, tries += 1.0) {
            alarms += orders.still[n] > HCI_STANDS_OUT;
            above_2 += orders.still[n] > 2.0;
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * sqrt(rate * tries), rate * tries, alarms); /* 13 ± 3.6 */
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * sqrt(0.23 * tries), exp(-1.0) * tries, above_2);
}

/* Orders that half the samples of a turn do not resolve are none. */
static void test_orders_end_below_half_the_samples(void)
{
    double under = INFINITY;
    hide(SAMPLES - 18, 0.1, 0.0); /* looks like order 18 */
    find(1);
    TEST_ASSERT_TRUE(orders.count <= SAMPLES / 2);
    TEST_ASSERT_EQUAL_UINT64(18, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    for (size_t k = 0; k < COUNT; ++k)
        variance[k] = 1.0;
    find(P);
    TEST_ASSERT_TRUE(orders.stride == P && orders.count * P <= SAMPLES / 2 + P);
}

/* ---- which orders ---- */

/* Whole electrical orders are of slots and poles, the rest is of the turn; the strongest comes first. */
static void test_slots_and_the_turn(void)
{
    double under = INFINITY;
    hide(18, 0.02, 0.0);
    hide(36, 0.05, 0.0);
    hide(1, 0.03, 0.0);
    hide(7, 0.01, 1.0);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(36, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    TEST_ASSERT_EQUAL_UINT64(18, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    under = INFINITY;
    const size_t first = hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_TURN, &under);
    const size_t second = hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_TURN, &under);
    TEST_ASSERT_TRUE((first == 1 && second == 7) || (first == 7 && second == 1));
}

/* Once in an electrical period no tooth meets a pole: what does so few times a turn is something else that
 * turns, and of many pole pairs uneven teeth and magnets. */
static void test_an_order_of_no_slot(void)
{
    double under = INFINITY;
    hide(P, 0.05, 0.0);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(P, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_TURN, &under));
    under = INFINITY;
    TEST_ASSERT_NOT_EQUAL(P, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    find(P);
    under = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(P, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    hide(P, -0.05, 0.0);
    hide(11, 0.05, 0.0);
    find(1);
    under = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(11, hci_candidate_orders_next(&orders, 11, HCI_ORDERS_OF_SLOTS, &under));
}

/* Of one pole pair: teeth that differ make even orders, poles that differ multiples of three, and no load
 * turns more than four times a turn; what is left is the first. */
static void test_low_orders_of_one_pole_pair(void)
{
    for (size_t periods = 1; periods < 6; ++periods) {
        double under = INFINITY;
        hide(periods, 0.05, 0.0);
        find(1);
        const size_t next = hci_candidate_orders_next(&orders, 1, HCI_ORDERS_OF_SLOTS, &under);
        TEST_ASSERT_EQUAL(periods > 1, next == periods);
        hide(periods, -0.05, 0.0);
    }
}

/* With 8 declared slots 8 and 16 a turn are theirs, which are no whole electrical orders of 3 pole pairs. */
static void test_orders_of_all_the_slots(void)
{
    double under = INFINITY;
    hide(16.0, 0.05, 0.0);
    hide(7.0, 0.02, 0.0);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(16, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_TURN, &under));
    source.slots = 8;
    hci_candidate_orders_release(&orders);
    find(1);
    under = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(16, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_SLOTS, &under));
    under = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(7, hci_candidate_orders_next(&orders, P, HCI_ORDERS_OF_TURN, &under));
}

/* Two thirds of a pole pair's orders are shared by groups of poles and slots: of 6 pole pairs order 9. */
static void test_groups_of_slots(void)
{
    double under = INFINITY;
    hide(9, 0.05, 0.0);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(9, hci_candidate_orders_next(&orders, 6, HCI_ORDERS_OF_SLOTS, &under));
    under = INFINITY;
    TEST_ASSERT_NOT_EQUAL(9, hci_candidate_orders_next(&orders, 6, HCI_ORDERS_OF_TURN, &under));
    under = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(9, hci_candidate_orders_next(&orders, 7, HCI_ORDERS_OF_TURN, &under));
}

/* What groups of slots and poles share is cogging where it stands without a current; where it grows with the
 * current it is looked for as such, and whole orders are not. */
static void test_orders_of_slots_that_grow(void)
{
    double under = INFINITY;
    hide(9, 0.02, 1.0);
    hide(12, 0.05, 1.0);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(9, hci_candidate_orders_next(&orders, 6, HCI_ORDERS_OF_LOAD, &under));
    TEST_ASSERT_NOT_EQUAL(12, hci_candidate_orders_next(&orders, 6, HCI_ORDERS_OF_LOAD, &under));
    hide(9, -0.02, 1.0);
    hide(9, 0.05, 0.0);
    find(1);
    under = INFINITY;
    TEST_ASSERT_NOT_EQUAL(9, hci_candidate_orders_next(&orders, 6, HCI_ORDERS_OF_LOAD, &under));
}

/* Poles that differ make orders 3, 9, 15 … with the current; no other order says so, nor cogging. */
static void test_poles_that_differ(void)
{
    find(1);
    TEST_ASSERT_FALSE(hci_candidate_orders_poles_differ(&orders, P));
    hide(3 * P, 0.05, 0.0);
    hide(6 * P, 0.02, 1.0);
    hide(7, 0.02, 1.0);
    find(1);
    TEST_ASSERT_FALSE(hci_candidate_orders_poles_differ(&orders, P));
    hide(9 * P, 0.02, 1.0);
    find(1);
    TEST_ASSERT_TRUE(hci_candidate_orders_poles_differ(&orders, P));
    find(P);
    TEST_ASSERT_TRUE(hci_candidate_orders_poles_differ(&orders, P));
}

/* ---- laws of growth ---- */

/* Growth with the root of the current is nothing that an effect does; growth in proportion is. */
static void test_growth_that_no_effect_has(void)
{
    size_t law = 0, none[1] = {0};
    hide(18, 0.05, 0.5);
    find(1);
    TEST_ASSERT_EQUAL_UINT64(18, hci_candidate_orders_empirical(&orders, &samples, none, 0, &law));
    const hci_growth_law found = hci_growth_law_of(law);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, found.current);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.speed);
    hide(18, -0.05, 0.5);
    hide(18, 0.05, 1.0); /* the best law that is left is another one */
    find(1);
    TEST_ASSERT_EQUAL_UINT64(18, hci_candidate_orders_empirical(&orders, &samples, none, 0, &law));
    TEST_ASSERT_FALSE(hci_growth_law_is_known(law, 18.0));
    none[0] = 18;
    TEST_ASSERT_NOT_EQUAL(18, hci_candidate_orders_empirical(&orders, &samples, none, 1, &law));
}

static void test_laws_of_growth(void)
{
    bool seen[3] = {false};
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        const hci_growth_law x = hci_growth_law_of(g);
        const double expected = pow(3.0, x.current) * pow(50.0, x.speed);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * expected, expected, hci_growth_law_at(g, 3.0, 50.0));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * expected, x.turns_sign ? -expected : expected,
                                  hci_growth_law_at(g, 3.0, -50.0));
        seen[0] = seen[0] ||
                  (x.current == 1.0 && x.speed == 0.0 && !x.turns_sign && hci_growth_law_is_known(g, 6.0));
        seen[1] = seen[1] ||
                  (x.current == 0.5 && x.speed == 0.0 && !x.turns_sign && !hci_growth_law_is_known(g, 6.0));
        seen[2] = seen[2] || (x.current == 0.0 && x.speed == 1.0 && x.turns_sign &&
                              hci_growth_law_is_known(g, 0.0) && !hci_growth_law_is_known(g, 6.0));
    }
    TEST_ASSERT_TRUE(seen[0] && seen[1] && seen[2]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_places_that_are_read_twice);
    RUN_TEST(test_turns_of_fewer_samples);
    RUN_TEST(test_what_an_order_explains);
    RUN_TEST(test_means_have_no_orders);
    RUN_TEST(test_a_constant_has_no_orders);
    RUN_TEST(test_noise_stands_out_at_the_rate_of_the_limit);
    RUN_TEST(test_orders_end_below_half_the_samples);
    RUN_TEST(test_slots_and_the_turn);
    RUN_TEST(test_an_order_of_no_slot);
    RUN_TEST(test_low_orders_of_one_pole_pair);
    RUN_TEST(test_orders_of_all_the_slots);
    RUN_TEST(test_groups_of_slots);
    RUN_TEST(test_orders_of_slots_that_grow);
    RUN_TEST(test_poles_that_differ);
    RUN_TEST(test_growth_that_no_effect_has);
    RUN_TEST(test_laws_of_growth);
    return UNITY_END();
}
