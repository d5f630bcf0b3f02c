/* Means over wide bins of the turn against every row of the recording: least squares on the rows themselves
 * gives the same values, within a tenth of their standard errors, and the same squares. */
#include "host/diagnose/reading/predicted_reading.h"

#include "hci/math/dense.h"
#include "host/diagnose/search/noise_left.h"
#include "support/searching.h"

enum { N = 23772 /* 63 turns: what is behind the last one is left */, COLUMNS = 5 };

/* Electrical orders, and what they have: three times the noise at an order with 14 samples in a period. */
static const double ORDER[2] = {6.0, 24.0}, SINE_NM[2] = {0.03, 0.03}, COSINE_NM[2] = {-0.02, 0.02};
static const double COULOMB_NM = 0.02, SAMPLES_OF_TURN = 377.318;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static double sign(double x)
{
    return x < 0.0 ? -1.0 : 1.0;
}

static void record_long(double speed, double iq)
{
    hci_run *r = add_run(N);
    for (size_t k = 0; k < N; ++k) {
        const double theta_m = sign(speed) * 2.0 * REF_PI * (double)k / SAMPLES_OF_TURN;
        r->theta_m_rad[k] = theta_m;
        r->time_s[k] = theta_m / speed;
        r->speed_rad_per_s[k] = speed;
        rec_phases(0.0, iq, P * theta_m, r->i_A + 3 * k);
        r->torque_Nm[k] = 1.5 * K_NM_PER_A * iq - COULOMB_NM * sign(speed) + NOISE_NM * ref_normal(&seed);
        for (int j = 0; j < 2; ++j)
            r->torque_Nm[k] +=
                SINE_NM[j] * sin(ORDER[j] * P * theta_m) + COSINE_NM[j] * cos(ORDER[j] * P * theta_m);
    }
}

static void row_at(const hci_run *r, size_t k, double row[COLUMNS])
{
    for (int j = 0; j < 2; ++j) {
        row[2 * j] = sin(ORDER[j] * P * r->theta_m_rad[k]);
        row[2 * j + 1] = cos(ORDER[j] * P * r->theta_m_rad[k]);
    }
    row[4] = -sign(r->speed_rad_per_s[k]);
}

/* Of all rows of all runs. error: of each value, for the noise that the rows were made with. */
static void least_squares(double value[COLUMNS], double error[COLUMNS])
{
    double gram[COLUMNS * COLUMNS] = {0.0}, row[COLUMNS], unit[COLUMNS];
    memset(value, 0, COLUMNS * sizeof *value);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < N; ++k) {
            const double *i = run[r].i_A + 3 * k;
            double y = run[r].torque_Nm[k];
            for (int s = 0; s < 3; ++s)
                y -= K_NM_PER_A * sin(P * run[r].theta_m_rad[k] - 2.0 * REF_PI * s / 3.0) * i[s];
            row_at(&run[r], k, row);
            for (int a = 0; a < COLUMNS; ++a) {
                value[a] += row[a] * y;
                for (int b = 0; b < COLUMNS; ++b)
                    gram[a + b * COLUMNS] += row[a] * row[b];
            }
        }
    TEST_ASSERT_EQUAL_UINT64(0, hci_cholesky_factor(COLUMNS, gram));
    hci_cholesky_solve(COLUMNS, gram, value);
    for (int a = 0; a < COLUMNS; ++a) {
        memset(unit, 0, sizeof unit);
        unit[a] = 1.0;
        hci_cholesky_solve(COLUMNS, gram, unit);
        error[a] = NOISE_NM * sqrt(unit[a]);
    }
}

/* Sums over all rows have no noise to find first, which weights the runs. */
static void noise_known(void)
{
    for (const hci_segment *s = NULL; (s = hci_regression_next(&dataset.regression, s)) != NULL;)
        *hci_regression_noise(&dataset.regression, s) =
            hci_noise_white(NOISE_NM * sqrt((double)s->count / N));
}

static void test_the_values_of_all_rows(void)
{
    double value[COLUMNS], error[COLUMNS];
    record_long(60.0, 3.0);
    record_long(-150.0, 9.0);
    search_start();
    for (int j = 0; j < 2; ++j)
        model_add("cogging", "sine", "cosine", ORDER[j]);
    model_add("friction", "coulomb", NULL, 0.0);
    noise_known();
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_regression_fit(&dataset.regression, &model.candidates, &model.fit, &note));
    least_squares(value, error);
    TEST_ASSERT_EQUAL_UINT64(2, dataset.samples.segment_count);
    TEST_ASSERT_EQUAL_UINT64(2 * 1024, dataset.samples.count);
    for (int a = 0; a < COLUMNS; ++a) {
        const hci_effect_term *t =
            a < 4 ? term_in(&model.candidates, "cogging", a % 2 ? "cosine" : "sine", ORDER[a / 2])
                  : term_in(&model.candidates, "friction", "coulomb", 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * error[a], value[a], t->value);
        TEST_ASSERT_DOUBLE_WITHIN(0.15 * error[a], error[a], t->std_error);
    }
}

/* What a fit is judged by is that of bins that were not joined: as many rows, each with a square of noise,
 * and the noise of one of them. */
static void test_squares_of_narrow_bins(void)
{
    record_long(60.0, 3.0);
    search_start();
    for (int j = 0; j < 2; ++j)
        model_add("cogging", "sine", "cosine", ORDER[j]);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    model_fit();
    const double narrow = 4.0 * (double)dataset.samples.count, in_one = (double)N / narrow;
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * narrow, narrow, model.fit.rows);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * narrow, narrow, model.fit.square);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM / sqrt(in_one), hci_search_noise_rms(&search));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_residual(&search, &model.candidates, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM / sqrt(in_one), hci_search_residual_rms(&search));
}

/* An order that nothing describes, 144 of the turn. Its variance over that of the noise of four joined bins
 * is four times that over the noise of a narrow one, by which it is judged: a tenth is more than noise. */
static bool noise_with_excess(double excess)
{
    const double bin_Nm = NOISE_NM / sqrt((double)N / 1024.0), size_Nm = bin_Nm * sqrt(2.0 * excess);
    bool noise = false;
    record_long(60.0, 3.0);
    for (size_t k = 0; k < N; ++k)
        run[0].torque_Nm[k] += size_Nm * sin(48.0 * P * run[0].theta_m_rad[k]);
    search_start();
    for (int j = 0; j < 2; ++j)
        model_add("cogging", "sine", "cosine", ORDER[j]);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_is_noise(&search, &model.candidates, &noise, &note));
    return noise;
}

static void test_an_excess_of_narrow_bins_is_noise(void)
{
    TEST_ASSERT_TRUE(noise_with_excess(0.2));
}

static void test_an_excess_beyond_them_is_none(void)
{
    TEST_ASSERT_FALSE(noise_with_excess(0.8));
}

/* ---- samples that lie close on one half of the turn ---- */

static void record_uneven(double direction)
{
    hci_run *r = add_run(20000);
    for (size_t k = 0; k < r->count; ++k) {
        const double turns = (double)k / 500.318, x = turns - floor(turns);
        const double of_turn = x < 0.2 ? 0.5 * x / 0.2 : 0.5 + 0.5 * (x - 0.2) / 0.8;
        const double turned = 2.0 * REF_PI * (floor(turns) + of_turn);
        r->theta_m_rad[k] = direction * turned;
        r->time_s[k] = turned / 60.0;
        r->speed_rad_per_s[k] = direction * 60.0;
        rec_phases(0.0, 3.0, P * turned * direction, r->i_A + 3 * k);
        r->torque_Nm[k] = 1.5 * K_NM_PER_A * 3.0 + NOISE_NM * ref_normal(&seed);
    }
}

/* Bins of four samples have twice the noise of those of sixteen, and that is noise all the same. */
static void test_uneven_counts_are_noise(void)
{
    bool noise = false;
    record_uneven(1.0);
    record_uneven(-1.0);
    search_start();
    TEST_ASSERT_EQUAL_UINT64(2, dataset.samples.segment_count);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_is_noise(&search, &model.candidates, &noise, &note));
    TEST_ASSERT_TRUE(noise);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_values_of_all_rows);
    RUN_TEST(test_squares_of_narrow_bins);
    RUN_TEST(test_an_excess_of_narrow_bins_is_noise);
    RUN_TEST(test_an_excess_beyond_them_is_none);
    RUN_TEST(test_uneven_counts_are_noise);
    return UNITY_END();
}
