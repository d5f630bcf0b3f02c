/* The Gauss–Newton fit: closed forms of linear terms, a known parameter that is not linear, and standard
 * errors against the scatter of the values over draws of the noise. */
#include "host/diagnose/fit/fit.h"

#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/standard_errors.h"
#include "support/searching.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    search_end();
    dataset_end();
}

/* ---- recordings ---- */

static const double ID_A[] = {-3.0, 5.0};

/* Two runs with i_d, which makes no torque; the angle is read too much by an electrical angle. colour: of the
 * noise, x_k = colour·x_{k−1} + e. */
static void record_two(size_t n, double angle_rad, double cogging_Nm, double colour)
{
    for (size_t r = 0; r < 2; ++r) {
        double noise = 0.0;
        const double iq = r == 0 ? 2.0 : 9.0;
        record(n, &(point){r == 0 ? 60.0 : -150.0, iq, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < n; ++k) {
            rec_phases(ID_A[r], iq, P * run[r].theta_m_rad[k], run[r].i_A + 3 * k);
            noise = colour * noise + (colour > 0.0 ? NOISE_NM * ref_normal(&seed) : 0.0);
            run[r].torque_Nm[k] += cogging_Nm * sin(6.0 * P * run[r].theta_m_rad[k]) + noise;
        }
        for (size_t k = 0; k < n; ++k)
            run[r].theta_m_rad[k] += angle_rad / P;
    }
    search_start();
}

/* Noise that is known. */
static void weigh(double rms_Nm)
{
    for (size_t s = 0; s < dataset.samples.segment_count; ++s)
        dataset.regression.noise[s] = hci_noise_white(rms_Nm);
}

static void fit(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_regression_fit(&dataset.regression, &model.candidates, &model.fit, &note));
}

static hci_effect_term *value_of(size_t candidate, size_t term_of)
{
    return &model.candidates.candidate[candidate].term[term_of];
}

/* ---- linear terms ---- */

/* Whole periods: the value is 2/N Σ y sin, its standard error σ √(2/N), χ² falls by (value/error)². */
static void test_a_linear_term(void)
{
    enum { N = 100 };
    double sum = 0.0, square = 0.0;
    record_two(N, 0.0, 0.03, 0.0);
    weigh(NOISE_NM);
    for (size_t k = 0; k < 2 * N; ++k) {
        const hci_binned_sample *x = &dataset.samples.sample[k];
        double d, q;
        rec_rotor(x->raw.i_abc, P * x->raw.theta_m_rad, &d, &q);
        const double y = x->torque_Nm - 1.5 * K_NM_PER_A * q;
        sum += y * sin(6.0 * P * x->raw.theta_m_rad) / N;
        square += y * y / (NOISE_NM * NOISE_NM);
    }
    model_add("cogging", "sine", NULL, 6.0);
    model.candidates.candidate[0].price = 4.0;
    fit();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * sum, sum, value_of(0, 0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * NOISE_NM, NOISE_NM / sqrt(N), value_of(0, 0)->std_error);
    const double left = square - sum * sum * N / (NOISE_NM * NOISE_NM);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * left, left, model.fit.square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * left, left + log(2.0 * N) + 4.0, model.fit.score);
    TEST_ASSERT_EQUAL_UINT64(1, model.fit.parameters);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 * N, model.fit.rows);
}

/* An expected deviation d draws a value v ± s to v/(1 + s²/d²), and pays (value/d)² in χ². */
static void test_what_is_expected_draws_a_value(void)
{
    const double d = 0.0005;
    record_two(100, 0.0, 0.03, 0.0);
    weigh(NOISE_NM);
    model_add("cogging", "sine", NULL, 6.0);
    fit();
    const double v = value_of(0, 0)->value, s = value_of(0, 0)->std_error, square = model.fit.square;
    model.candidates.candidate[0].deviation = d;
    fit();
    const double drawn = v / (1.0 + s * s / (d * d));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * v, drawn, value_of(0, 0)->value);
    const double pays = square + pow((v - drawn) / s, 2.0) + pow(drawn / d, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * pays, pays, model.fit.square);
}

/* A term counts as 1 − (standard error/deviation)² of a parameter, whose price is ln(rows): nothing where its
 * expectation alone says what it is, as one where nothing is expected. What is out does not count. */
static void test_a_score_of_what_the_recordings_tell(void)
{
    hci_candidate x[3] = {{.count = 2, .price = 3.0, .deviation = 0.5, .in = true},
                          {.count = 1, .price = 7.0, .in = true},
                          {.count = 1, .price = 11.0}};
    const hci_candidates all = {x, 3, NAN};
    const hci_fit of = {.square = 100.0, .rows = 50.0};
    x[0].term[0].std_error = 0.3;
    x[0].term[1].std_error = 0.6;
    x[1].term[0].std_error = 9.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 100.0 + 3.0 + 7.0 + (0.64 + 1.0) * log(50.0),
                              hci_fit_effective_score(&of, &all));
}

/* A value does not pass what it may be at least. */
static void test_a_value_stays_above_its_least(void)
{
    record_two(100, 0.0, 0.0, 0.0);
    weigh(NOISE_NM);
    model_add("torque_sensor", "time_constant", NULL, 0.0);
    value_of(0, 0)->value = 1e-3;
    fit();
    TEST_ASSERT_TRUE(value_of(0, 0)->value >= 0.0);
}

/* Two terms that are the same: the values are not known, but the fit comes to an end, and as good as one. */
static void test_a_term_twice(void)
{
    for (int k = 0; k < 3; ++k)
        record(100, &(point){60.0, 3.0 * k, 0.0, 0.05, 0.0});
    search_start();
    weigh(NOISE_NM);
    model_add("torque_sensor", "offset", NULL, 0.0);
    fit();
    const double square = model.fit.square;
    model_add("friction", "coulomb", NULL, 0.0);
    fit();
    TEST_ASSERT_DOUBLE_WITHIN(0.01, square, model.fit.square);
    const double sum = term_in(&model.candidates, "torque_sensor", "offset", 0.0)->value -
                       term_in(&model.candidates, "friction", "coulomb", 0.0)->value;
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * NOISE_NM / sqrt(300.0), -0.05, sum);
}

/* ---- a parameter that is not linear ---- */

/* T = 1.5 k (i_q cos δ + i_d sin δ), from starts on both sides of it. */
static void test_an_angle_is_found(void)
{
    static const double START_rad[] = {0.0, 0.9, -0.8};
    const double error_rad = NOISE_NM / (1.5 * K_NM_PER_A * sqrt(100.0 * (9.0 + 25.0)));
    record_two(100, 0.3, 0.0, 0.0);
    weigh(NOISE_NM);
    model_add("position_offset", "angle", NULL, 0.0);
    for (size_t k = 0; k < sizeof START_rad / sizeof *START_rad; ++k) {
        value_of(0, 0)->value = START_rad[k];
        fit();
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * error_rad, error_rad, value_of(0, 0)->std_error);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * error_rad, 0.3, value_of(0, 0)->value);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * sqrt(2.0 * 200.0), 200.0, model.fit.square);
    }
}

/* What a fit from far off takes, in predictions of the recordings. */
static double predictions_of_fit(double work_so_far)
{
    value_of(0, 0)->value = 0.9;
    *dataset.regression.work = work_so_far;
    fit();
    const double taken = *dataset.regression.work - work_so_far;
    hci_normal_equations normal;
    *dataset.regression.work = 0.0;
    dataset.regression.known = NULL;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_regression_normal(&dataset.regression, &model.candidates, false, &normal, &note));
    hci_normal_equations_release(&normal);
    return taken / *dataset.regression.work;
}

/* Beyond the limit of work it is the start and two steps. */
static void test_a_fit_in_haste(void)
{
    record_two(100, 0.3, 0.0, 0.0);
    weigh(NOISE_NM);
    dataset.regression.known = NULL;
    model_add("position_offset", "angle", NULL, 0.0);
    TEST_ASSERT_TRUE(predictions_of_fit(0.0) > 3.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.0, predictions_of_fit(2.0 * HCI_MOST_WORK));
}

static bool is_asked(void *context)
{
    ++*(long *)context;
    return true;
}

/* Where the user ends it too, whatever bar it is to be below; a shorter one is not asked. */
static void test_a_fit_that_is_ended(void)
{
    long asked = 0;
    hci_watch watch = {.stop = is_asked, .stop_context = &asked};
    record_two(100, 0.3, 0.0, 0.0);
    weigh(NOISE_NM);
    dataset.regression.known = NULL;
    model_add("position_offset", "angle", NULL, 0.0);
    dataset.regression.watch = &watch;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.0, predictions_of_fit(0.0));
    TEST_ASSERT_TRUE(asked == 1 && watch.stopped);
    dataset.regression.watch = NULL;
    const double ended = model.fit.square;
    fit();
    TEST_ASSERT_TRUE(model.fit.square < ended); /* the rest of the way */
    watch.stopped = false, dataset.regression.watch = &watch;
    fit();
    TEST_ASSERT_EQUAL_INT64(1, asked);
}

/* ---- standard errors ---- */

typedef struct {
    double mean, deviation, error, sandwich; /* of the values; rms of the standard errors, before and after */
} scatter;

static scatter scatter_over(size_t draws, size_t n, double angle_rad, double colour)
{
    scatter x = {0.0, 0.0, 0.0, 0.0};
    const double rms = colour > 0.0 ? NOISE_NM * sqrt(1.0 + 1.0 / (1.0 - colour * colour)) : NOISE_NM;
    for (size_t draw = 0; draw < draws; ++draw) {
        seed = 500 + 7919 * draw;
        record_two(n, angle_rad, 0.03, colour);
        weigh(rms);
        if (!(colour > 0.0)) model_add("position_offset", "angle", NULL, 0.0);
        model_add("cogging", "sine", "cosine", 6.0);
        fit();
        const hci_effect_term *t = value_of(0, 0);
        x.mean += t->value / (double)draws;
        x.deviation += t->value * t->value / (double)draws;
        x.error += t->std_error * t->std_error / (double)draws;
        TEST_ASSERT_EQUAL_INT(HCI_OK,
                              hci_regression_standard_errors(&dataset.regression, &model.candidates, &note));
        x.sandwich += t->std_error * t->std_error / (double)draws;
        search_end();
        for (; runs.count > 0; --runs.count)
            rec_release(&run[runs.count - 1]);
    }
    return (scatter){x.mean, sqrt(x.deviation - x.mean * x.mean), sqrt(x.error), sqrt(x.sandwich)};
}

/* The deviation of n values is known to 1/√(2n). */
static void test_standard_errors_are_the_scatter(void)
{
    enum { DRAWS = 150 };
    const scatter x = scatter_over(DRAWS, 100, 0.3, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * x.error / sqrt(DRAWS), 0.3, x.mean);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * x.error / sqrt(2.0 * DRAWS), x.error, x.deviation);
}

/* Noise of a colour that the weights do not know: at a low order it scatters the values more than the errors
 * of the fit say, and the sums over blocks tell. Order 6 of 300 samples a turn turns by 0.377 rad a sample,
 * where the power of x_k = 0.8 x_{k−1} + e is 1/|1 − 0.8 e^{−0.377j}|² = 6.5 of e, and 2.8 is its mean. */
static void test_correlated_noise_raises_the_errors(void)
{
    enum { DRAWS = 60 };
    const scatter x = scatter_over(DRAWS, 900, 0.0, 0.8);
    TEST_ASSERT_TRUE(x.deviation > 1.2 * x.error);
    TEST_ASSERT_DOUBLE_WITHIN(0.35 * x.deviation, x.deviation, x.sandwich);
    TEST_ASSERT_TRUE(x.sandwich > 1.1 * x.error);
}

static void test_memory_is_out(void)
{
    record_two(50, 0.0, 0.03, 0.0);
    weigh(NOISE_NM);
    model_add("cogging", "sine", "cosine", 6.0);
    for (long n = 0; n < 4; ++n) {
        const hci_fit before = model.fit;
        hci_memory_fail_after(n);
        const hci_status status =
            hci_regression_fit(&dataset.regression, &model.candidates, &model.fit, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
        TEST_ASSERT_EQUAL_DOUBLE(before.square, model.fit.square);
    }
}

/* A fit that cannot fall below a bar is not brought to its end, and one that can is. */
static void test_below_a_bar(void)
{
    hci_fit full, below;
    record_two(900, 0.2, 0.05, 0.0);
    weigh(NOISE_NM);
    model_add("position_offset", "angle", NULL, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_fit(&dataset.regression, &model.candidates, &full, &note));
    value_of(0, 0)->value = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_fit_below(&dataset.regression, &model.candidates,
                                                           2.0 * full.score, &below, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, full.score, below.score);
    value_of(0, 0)->value = 0.0;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_regression_fit_below(&dataset.regression, &model.candidates, -1e9, &below, &note));
    TEST_ASSERT_TRUE(below.score > full.score + 1.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_linear_term);
    RUN_TEST(test_what_is_expected_draws_a_value);
    RUN_TEST(test_a_score_of_what_the_recordings_tell);
    RUN_TEST(test_a_value_stays_above_its_least);
    RUN_TEST(test_a_term_twice);
    RUN_TEST(test_an_angle_is_found);
    RUN_TEST(test_a_fit_in_haste);
    RUN_TEST(test_a_fit_that_is_ended);
    RUN_TEST(test_standard_errors_are_the_scatter);
    RUN_TEST(test_correlated_noise_raises_the_errors);
    RUN_TEST(test_memory_is_out);
    RUN_TEST(test_below_a_bar);
    return UNITY_END();
}
