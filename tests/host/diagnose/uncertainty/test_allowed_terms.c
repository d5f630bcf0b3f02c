/* The terms in which a machine may differ from the one that was fitted: how far the series goes, and what is
 * expected of each. */
#include "host/diagnose/uncertainty/allowed_terms.h"

#include <math.h>
#include <string.h>

#include "support/effect_list.h"
#include "unity.h"

enum { P = 2, N = 200 };

static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}};
static const hci_machine MACHINE = {.pole_pairs = P, .back_emf = emf, .back_emf_count = 1};

static hci_binned_sample sample[N];
static hci_segment segment[2];
static hci_run_statistics statistics[2];
static hci_noise noise[2];
static bool use[2];
static hci_run run[2];
static hci_binned_samples samples;
static el_list declared;
static hci_regression regression;
static hci_candidates fitted;
static hci_allowed_terms terms;
static hci_note note;

/* `turns` electrical turns in each of two segments of N/2 samples. */
static void turn(double first, double second)
{
    for (size_t k = 0; k < N; ++k) {
        const double share = (double)(k % (N / 2)) / (N / 2 - 1);
        sample[k].reading.theta_m_rad = -2.0 * REF_PI / P * share * (k < N / 2 ? first : second);
    }
}

void setUp(void)
{
    memset(&declared, 0, sizeof declared);
    for (size_t r = 0; r < 2; ++r) {
        segment[r] =
            (hci_segment){.run = r, .first = N / 2 * r, .count = N / 2, .joined = r == 0 ? 4.0 : 0.0};
        statistics[r] = (hci_run_statistics){.current_A = 3.0 + 2.0 * (double)r};
        noise[r] = hci_noise_white(0.01 * (double)(r + 1));
        use[r] = true;
    }
    turn(0.5, 0.5);
    samples = (hci_binned_samples){sample, N, segment, 2, statistics, 2};
    regression = (hci_regression){.machine = &MACHINE,
                                  .declared = &declared.list,
                                  .samples = &samples,
                                  .runs = run,
                                  .use = use,
                                  .noise = noise,
                                  .saliency = {0.002, 0.03}};
}

void tearDown(void)
{
    hci_allowed_terms_release(&terms);
    hci_candidates_release(&fitted);
    memset(&fitted, 0, sizeof fitted);
}

static void make(void)
{
    hci_allowed_terms_release(&terms);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_allowed_terms_make(&regression, &fitted, &terms, &note));
}

static hci_candidate *fit(const char *effect, const char *parameter, double order, double value)
{
    hci_candidate x = {.type = hci_effect_type_find(effect), .count = 1, .in = true};
    x.term[0] = (hci_effect_term){el_parameter(x.type, parameter), order, value, NAN};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&fitted, &x, &note));
    for (size_t k = 0; k < fitted.count; ++k)
        if (fitted.candidate[k].type == x.type &&
            fitted.candidate[k].term[0].parameter == x.term[0].parameter &&
            !(fabs(fitted.candidate[k].term[0].order - order) > 1e-9))
            return &fitted.candidate[k];
    return NULL;
}

/* The candidate with a term, and its place among all terms; fails where there is none. */
static const hci_candidate *find(const char *effect, const char *parameter, double order, size_t *at)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    const size_t p = el_parameter(type, parameter);
    *at = 0;
    for (size_t k = 0; k < terms.candidates.count; ++k) {
        const hci_candidate *x = &terms.candidates.candidate[k];
        for (size_t j = 0; j < x->count; ++j, ++*at)
            if (x->type == type && x->term[j].parameter == p && fabs(x->term[j].order - order) < 1e-6)
                return x;
    }
    TEST_FAIL_MESSAGE(parameter);
    return NULL;
}

/* ---- how far ---- */

static double highest_order(void)
{
    double most = 0.0;
    make();
    for (size_t k = 0; k < terms.candidates.count; ++k)
        most = fmax(most, terms.candidates.candidate[k].term[0].order);
    return most;
}

static int highest_power(void)
{
    int most = 0;
    make();
    for (size_t k = 0; k < terms.count; ++k)
        most = terms.power[k] > most ? terms.power[k] : most;
    return most;
}

/* Half as many as there are steps in a turn, less one, of the segment that tells least; of less than 0.9 of a
 * turn none is told. Orders are multiples of six and their neighbours: 24 is told by 51 steps and not by 50.
 */
static void test_orders_that_the_samples_tell(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 48.0, highest_order());
    turn(0.5, 99.0 / 51.0);
    TEST_ASSERT_TRUE(highest_order() >= 24.0);
    turn(0.5, 99.0 / 49.9);
    TEST_ASSERT_TRUE(highest_order() < 24.0 + 0.5);
    turn(0.5, 99.0 / 48.0);
    TEST_ASSERT_TRUE(highest_order() < 24.0);
    use[1] = false;
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 48.0, highest_order());
    turn(0.89, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 48.0, highest_order());
    use[0] = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.largest_current_A - 3.0);
}

/* Powers to the fourth, and to the eighth where iron saturates; orders twice as high of a whole co-energy. */
static void test_how_far_the_series_goes(void)
{
    TEST_ASSERT_EQUAL_INT(4, highest_power());
    hci_candidate *x = fit("saturation", "d0q4_cosine", 0.0, 0.001);
    TEST_ASSERT_EQUAL_INT(8, highest_power());
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 48.0, highest_order());
    x->coenergy_unit = 0.1;
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 96.0, highest_order());
    x->in = false;
    TEST_ASSERT_EQUAL_INT(4, highest_power());
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 48.0, highest_order());
}

/* The current of the runs in use where the model has no reference of its own. */
static void test_the_reference_current(void)
{
    make();
    TEST_ASSERT_EQUAL_DOUBLE(5.0, terms.candidates.reference_current_A);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, terms.largest_current_A);
    use[1] = false;
    make();
    TEST_ASSERT_EQUAL_DOUBLE(3.0, terms.candidates.reference_current_A);
    fitted.reference_current_A = 7.0;
    make();
    TEST_ASSERT_EQUAL_DOUBLE(7.0, terms.candidates.reference_current_A);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, terms.largest_current_A);
    fitted.reference_current_A = 0.0;
    statistics[0].current_A = 0.0;
    make();
    TEST_ASSERT_EQUAL_DOUBLE(1.0, terms.candidates.reference_current_A);
}

/* ---- what is expected ---- */

/* Of terms that the model does not have: at their declared values, by the width in units of the noise, of
 * which a joined sample has as much as if it were not: √((4·0.01² + 0.02²)/2). */
static void test_terms_that_are_not_in_the_model(void)
{
    const double rms = sqrt(0.5 * (4.0 * 1e-4 + 4e-4));
    el_add(&declared, "reluctance", "dq_cosine", 6.0, 0.7);
    el_add(&declared, "reluctance", "dd_cosine", 0.0, 3e-4);
    el_add(&declared, "reluctance", "dd_cosine", 6.0, 2e-4);
    el_add(&declared, "back_emf", "sine", 5.0, 0.004);
    make();
    for (size_t k = 0; k < terms.count; ++k) {
        TEST_ASSERT_TRUE(isnan(terms.fixed[k]));
        TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.centre[k]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.known[k]);
    }
    size_t at;
    const hci_candidate *x = find("reluctance", "dd_cosine", 6.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(2e-4, x->term[0].value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, x->coenergy_unit * rms, terms.unit[at]);
    TEST_ASSERT_TRUE(x->in);
    TEST_ASSERT_EQUAL_DOUBLE(0.004, find("back_emf", "sine", 5.0, &at)->term[0].value);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, find("back_emf", "sine", 7.0, &at)->term[0].value);
}

/* Order 0, and of the back-EMF order 1, are of the mean torque; what has i_d² needs a direct current. */
static void test_kinds_of_terms(void)
{
    static const struct {
        const char *effect, *parameter;
        double order;
        bool of_mean, by_direct;
        int power;
    } TERM[] = {
        {"back_emf", "sine", 1.0, true, false, 1},         {"back_emf", "sine", 5.0, false, false, 1},
        {"reluctance", "dd_cosine", 0.0, true, true, 2},   {"reluctance", "dd_cosine", 6.0, false, true, 2},
        {"reluctance", "qq_cosine", 6.0, false, false, 2}, {"saturation", "d1q2_cosine", 0.0, true, false, 3},
        {"saturation", "d3q0_cosine", 6.0, false, true, 3}};
    make();
    for (size_t k = 0; k < sizeof TERM / sizeof *TERM; ++k) {
        size_t at;
        (void)find(TERM[k].effect, TERM[k].parameter, TERM[k].order, &at);
        TEST_ASSERT_EQUAL_MESSAGE(TERM[k].of_mean, terms.of_mean[at], TERM[k].parameter);
        TEST_ASSERT_EQUAL_MESSAGE(TERM[k].by_direct, terms.by_direct[at], TERM[k].parameter);
        TEST_ASSERT_EQUAL_INT_MESSAGE(TERM[k].power, terms.power[at], TERM[k].parameter);
    }
}

/* Where the means of the recordings tell nothing, no term of the mean is another one. */
static void test_terms_of_means_that_tell_nothing(void)
{
    size_t at;
    make();
    (void)find("saturation", "d1q2_cosine", 0.0, &at);
    TEST_ASSERT_FALSE(terms.fixed[at] > 1e20);
    regression.free_means = true;
    make();
    (void)find("saturation", "d1q2_cosine", 0.0, &at);
    TEST_ASSERT_TRUE(terms.fixed[at] > 1e20);
    (void)find("saturation", "d3q0_cosine", 6.0, &at);
    TEST_ASSERT_FALSE(terms.fixed[at] > 1e20);
}

/* Order 0 of i_d² is as large as rotors are salient, ¾ (ΔL + Δψ/I) I², whatever was found; other orders are
 * not. */
static void test_what_is_usual_of_the_mean(void)
{
    size_t at;
    make();
    const hci_candidate *x = find("reluctance", "dd_cosine", 0.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, x->coenergy_unit * 0.75 * (0.002 + 0.03 / 5.0) * 25.0, terms.twin[at]);
    (void)find("reluctance", "dd_cosine", 6.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.twin[at]);
    (void)find("saturation", "d1q2_cosine", 0.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.twin[at]);
}

/* Iron takes 2 % of the torque per ampere k at the largest current I, T = p c (i_q/I)³: c = 0.02 k I/p of
 * order 0 of i_d i_q² alone, whatever sign the constant has. */
static void test_what_is_usual_along_q(void)
{
    size_t at;
    regression.declared_constant = -0.4;
    make();
    (void)find("saturation", "d1q2_cosine", 0.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02 * 0.4 * 5.0 / P, terms.iron[at]);
    for (size_t k = 0; k < terms.count; ++k)
        TEST_ASSERT_TRUE(k == at || terms.iron[k] == 0.0);
}

/* A term of the model keeps what was expected of it, about where that was: 0 less its value. Where nothing
 * was, its size is what the recordings tell it to: a size in N·m would be another one of a smaller motor. */
static void test_terms_of_the_model(void)
{
    size_t at;
    fit("friction", "coulomb", 0.0, 0.05)->term[0].std_error = 2e-4;
    fit("friction", "viscous", 0.0, 0.01); /* whose error is not known */
    fit("current_gain", "a", 0.0, 0.02)->deviation = 0.1;
    make();
    (void)find("friction", "viscous", 0.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, terms.unit[at]);
    (void)find("friction", "coulomb", 0.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.fixed[at]);
    TEST_ASSERT_EQUAL_DOUBLE(-0.05, terms.centre[at]);
    TEST_ASSERT_EQUAL_DOUBLE(2e-4, terms.unit[at]);
    TEST_ASSERT_FALSE(terms.of_mean[at] || terms.by_direct[at]);
    TEST_ASSERT_EQUAL_INT(0, terms.power[at]);
    const hci_candidate *x = find("current_gain", "a", 0.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0, terms.fixed[at]);
    TEST_ASSERT_EQUAL_DOUBLE(-0.02, terms.centre[at]);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, terms.unit[at]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x->deviation);
}

/* What was found at an order makes another term there as likely, in units of its own; and what was found is
 * likely to be as large as it is where nothing else is expected of it by the width. */
static void test_what_was_found_at_an_order(void)
{
    size_t at;
    hci_candidate *known = fit("reluctance", "dd_cosine", 6.0, 4e-5);
    make();
    const hci_candidate *x = find("reluctance", "dd_cosine", 6.0, &at);
    const double size = 4e-5 / x->coenergy_unit;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.fixed[at]); /* any value, as it was fitted */
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 4e-5, terms.known[at]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -4e-5, terms.centre[at]);
    x = find("reluctance", "qq_cosine", 6.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, x->coenergy_unit * size, terms.twin[at]);
    x = find("back_emf", "sine", 7.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, x->coenergy_unit * size, terms.twin[at]);
    (void)find("reluctance", "qq_cosine", 12.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.twin[at]);
    known->declared[0] = 1e-5; /* the departure counts */
    make();
    (void)find("reluctance", "dd_cosine", 6.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3e-5, terms.known[at]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -3e-5, terms.centre[at]);
}

/* Where iron saturates, all that grows as a square or a higher power is by the width, and so is what came in
 * with a whole co-energy and an expectation of its own. */
static void test_what_is_by_the_width(void)
{
    size_t at;
    fit("friction", "coulomb", 0.0, 0.05);
    hci_candidate *whole = fit("back_emf", "sine", 5.0, 0.002);
    make();
    (void)find("back_emf", "sine", 5.0, &at);
    TEST_ASSERT_FALSE(isnan(terms.fixed[at]));
    whole->coenergy_unit = 0.1;
    make();
    (void)find("back_emf", "sine", 5.0, &at);
    TEST_ASSERT_FALSE(isnan(terms.fixed[at]));
    whole->deviation = 0.1;
    make();
    (void)find("back_emf", "sine", 5.0, &at);
    TEST_ASSERT_TRUE(isnan(terms.fixed[at]));
    fit("reluctance", "dd_cosine", 6.0, 4e-5);
    fit("cogging", "sine", 6.0, 0.01);
    fit("saturation", "d0q4_cosine", 6.0, 0.001);
    make();
    (void)find("reluctance", "dd_cosine", 6.0, &at);
    TEST_ASSERT_TRUE(isnan(terms.fixed[at]));
    (void)find("saturation", "d0q4_cosine", 6.0, &at);
    TEST_ASSERT_TRUE(isnan(terms.fixed[at]));
    (void)find("cogging", "sine", 6.0, &at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, terms.fixed[at]);
}

/* The root of the mean square of what was found at several orders, of squares for squares. */
static void test_the_usual_size_of_several_orders(void)
{
    size_t at;
    fit("reluctance", "dd_cosine", 6.0, 4e-5);
    fit("reluctance", "dd_cosine", 12.0, 3e-5);
    fit("back_emf", "sine", 5.0, 0.002);
    make();
    const double a = 4e-5 / find("reluctance", "dd_cosine", 6.0, &at)->coenergy_unit,
                 b = 3e-5 / find("reluctance", "dd_cosine", 12.0, &at)->coenergy_unit,
                 c = fmax(a, 0.002 / find("back_emf", "sine", 5.0, &at)->coenergy_unit);
    const hci_candidate *x = find("reluctance", "qq_cosine", 12.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * terms.twin[at], x->coenergy_unit * sqrt(0.5 * (a * a + b * b)),
                              terms.twin[at]);
    x = find("back_emf", "sine", 7.0, &at);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * terms.twin[at], x->coenergy_unit * sqrt(0.5 * (c * c + b * b)),
                              terms.twin[at]);
}

/* ---- precisions ---- */

/* One over the larger of the width and of the twins' size, squared; what is fixed and known narrows further.
 */
static void test_precisions(void)
{
    double unit[6] = {0.2, 0.2, 0.2, 0.2, 0.2, 0.2}, fixed[6] = {NAN, NAN, NAN, NAN, 9.0, 9.0},
           twin[6] = {0.0, 0.0, 0.5, 0.5, 0.0, 0.0}, known[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.1},
           iron[6] = {0.0}, precision[6];
    bool of_mean[6] = {false, true, false, false, false, false};
    int power[6] = {2, 2, 2, 3, 2, 2};
    const hci_allowed_terms t = {.count = 6,
                                 .unit = unit,
                                 .fixed = fixed,
                                 .twin = twin,
                                 .iron = iron,
                                 .known = known,
                                 .of_mean = of_mean,
                                 .power = power};
    hci_allowed_terms_precision(&t, (hci_allowed_width){3.0, 4.0, 2.0, 0.7}, precision);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (0.6 * 0.6), precision[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (2.4 * 2.4), precision[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (1.0 * 1.0), precision[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (0.7 * 0.7), precision[3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, precision[4]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 25.0, precision[5]);
    known[5] = 0.2;
    hci_allowed_terms_precision(&t, (hci_allowed_width){3.0, 4.0, 0.0, 0.7}, precision);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (0.6 * 0.6), precision[3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 25.0, precision[5]);
    iron[3] = 0.6; /* in units of the errors' size, whatever the power */
    hci_allowed_terms_precision(&t, (hci_allowed_width){3.0, 4.0, 2.0, 0.7}, precision);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / (1.2 * 1.2), precision[3]);
    known[5] = 0.4; /* 6.25 is less than the 9 that were expected */
    hci_allowed_terms_precision(&t, (hci_allowed_width){3.0, 4.0, 0.0, 0.7}, precision);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, precision[5]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_that_the_samples_tell);
    RUN_TEST(test_how_far_the_series_goes);
    RUN_TEST(test_the_reference_current);
    RUN_TEST(test_terms_that_are_not_in_the_model);
    RUN_TEST(test_kinds_of_terms);
    RUN_TEST(test_terms_of_means_that_tell_nothing);
    RUN_TEST(test_what_is_usual_of_the_mean);
    RUN_TEST(test_what_is_usual_along_q);
    RUN_TEST(test_terms_of_the_model);
    RUN_TEST(test_what_was_found_at_an_order);
    RUN_TEST(test_what_is_by_the_width);
    RUN_TEST(test_the_usual_size_of_several_orders);
    RUN_TEST(test_precisions);
    return UNITY_END();
}
