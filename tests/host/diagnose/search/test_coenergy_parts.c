/* The choice of a co-energy by parts: what belongs to which, what is expected of each term, and bounds from
 * both sides. */
#include "host/diagnose/search/coenergy.c"

#include "support/reference.h"
#include "unity.h"

enum { RUNS = 6, COLUMNS = 4, ROWS = 30 };

static uint64_t seed;
static hci_candidate list[COLUMNS], known_list[COLUMNS];
static hci_fitted_model known;
static hci_attribute_options options = {.resolution_Nm = 0.01};
static hci_search search;
static comparison c;
static double gram[RUNS][COLUMNS * COLUMNS], moment[RUNS][COLUMNS], precision[COLUMNS], square[RUNS];
static hci_normal_equations run[RUNS];
static hci_binned_samples samples;
static hci_run_statistics statistics[RUNS];
static hci_run recording[RUNS];
static hci_segment segment[RUNS];
static hci_binned_sample sample[RUNS * 100];
static bool use[RUNS];
static hci_machine machine = {.pole_pairs = 3};
static hci_regression regression;

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

/* Of the series a cogging order, a back-EMF and a power of 5; friction beside it. */
void setUp(void)
{
    seed = 2;
    memset(list, 0, sizeof list);
    memset(known_list, 0, sizeof known_list);
    list[0] =
        (hci_candidate){.type = type("cogging"), .count = 1, .in = true, .coenergy_unit = 2.0, .power = 0};
    list[1] =
        (hci_candidate){.type = type("back_emf"), .count = 1, .in = true, .coenergy_unit = 0.5, .power = 1};
    list[2] =
        (hci_candidate){.type = type("saturation"), .count = 1, .in = true, .coenergy_unit = 0.1, .power = 5};
    list[3] = (hci_candidate){.type = type("friction"), .count = 1, .in = true};
    for (size_t k = 0; k < COLUMNS; ++k)
        list[k].term[0] = (hci_effect_term){0, 6.0 * (double)k, 0.3, NAN};
    known = (hci_fitted_model){.candidates = {.candidate = known_list, .count = 0}};
    for (int r = 0; r < RUNS; ++r) {
        memset(gram[r], 0, sizeof gram[r]);
        memset(moment[r], 0, sizeof moment[r]);
        run[r] = (hci_normal_equations){COLUMNS, gram[r], moment[r], 0.0, ROWS};
        for (int k = 0; k < ROWS; ++k) {
            double x[COLUMNS], y = ref_normal(&seed);
            for (int i = 0; i < COLUMNS; ++i)
                y += (x[i] = ref_normal(&seed));
            run[r].square += y * y;
            for (int i = 0; i < COLUMNS; ++i) {
                moment[r][i] += x[i] * y;
                for (int j = 0; j < COLUMNS; ++j)
                    gram[r][i * COLUMNS + j] += x[i] * x[j];
            }
        }
        statistics[r] = (hci_run_statistics){.current_A = 5.0, .mean_iq_A = 1.0 + r};
        segment[r] = (hci_segment){.run = (size_t)r, .first = 100 * (size_t)r, .count = 100};
        use[r] = true;
        for (size_t k = 0; k < 100; ++k)
            sample[100 * (size_t)r + k].reading.theta_m_rad = 0.97 * 2.0 * REF_PI * (double)k / 99.0;
    }
    samples = (hci_binned_samples){sample, RUNS * 100, segment, RUNS, statistics, RUNS};
    regression = (hci_regression){.machine = &machine, .samples = &samples, .runs = recording, .use = use};
    search = (hci_search){.regression = &regression, .options = &options, .resolution_Nm = 0.01};
    c = (comparison){.search = &search,
                     .known = &known,
                     .all = {.candidate = list, .count = COLUMNS},
                     .noise_Nm = 0.02,
                     .runs = {run, RUNS},
                     .run = run,
                     .precision = precision,
                     .square = square};
}

void tearDown(void)
{
}

static void knows(size_t k, double deviation)
{
    known_list[known.candidates.count] = list[k];
    known_list[known.candidates.count++].deviation = deviation;
}

/* ---- parts ---- */

static void test_parts_of_the_series_and_beside_it(void)
{
    TEST_ASSERT_EQUAL_INT(0, part_of(&list[0]));
    TEST_ASSERT_EQUAL_INT(1, part_of(&list[1]));
    TEST_ASSERT_EQUAL_INT(-1, part_of(&list[2]));
    TEST_ASSERT_EQUAL_INT(-1, part_of(&list[3]));
    list[2].power = 2;
    TEST_ASSERT_EQUAL_INT(2, part_of(&list[2]));
    list[2].power = 3;
    TEST_ASSERT_EQUAL_INT(-1, part_of(&list[2]));
    list[0].coenergy_unit = list[1].coenergy_unit = 0.0;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        list[0].type = hci_candidate_type(r);
        const bool iron = list[0].type->propose_coenergy || list[0].type == &hci_empirical_type;
        TEST_ASSERT_EQUAL_INT(iron ? 3 + (int)r : -1, part_of(&list[0]));
    }
}

static void test_terms_of_the_iron_count_from_nothing(void)
{
    for (size_t k = 0; k < COLUMNS; ++k)
        list[k].deviation = 7.0, list[k].declared[0] = 0.1;
    start_from_zero(&c.all);
    for (size_t k = 0; k < COLUMNS; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, list[k].deviation);
        TEST_ASSERT_EQUAL_DOUBLE(k == 3 ? 0.3 : 0.0, list[k].term[0].value);
        TEST_ASSERT_EQUAL_DOUBLE(k == 3 ? 0.1 : 0.0, list[k].declared[0]);
    }
}

/* ---- what is expected ---- */

/* As wide as the noise times the unit; a fundamental that is known at least as wide as it was; outside of a
 * choice nothing. */
static void test_what_is_expected_of_a_term(void)
{
    choice how = {.power = 4, .width = 10.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / pow(10.0 * 0.02 * 2.0, 2.0), precision_of(&c, &list[0], &how));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / pow(10.0 * 0.02 * 0.5, 2.0), precision_of(&c, &list[1], &how));
    TEST_ASSERT_FALSE(isfinite(precision_of(&c, &list[2], &how)));
    how.power = 5;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / pow(10.0 * 0.02 * 0.1, 2.0), precision_of(&c, &list[2], &how));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, precision_of(&c, &list[3], &how));
    knows(1, 0.4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / 0.16, precision_of(&c, &list[1], &how));
    known_list[0].deviation = 0.01;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / 0.01, precision_of(&c, &list[1], &how));
    known_list[0].deviation = 0.0; /* any */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, precision_of(&c, &list[1], &how));
    knows(2, 0.4); /* of a higher power the unit says it */
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 / pow(10.0 * 0.02 * 0.1, 2.0), precision_of(&c, &list[2], &how));
    knows(3, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, precision_of(&c, &list[3], &how));
    how.without[1] = true;
    TEST_ASSERT_FALSE(isfinite(precision_of(&c, &list[1], &how)));
}

/* A width of 0 is the model as it was. */
static void test_the_model_as_it_was(void)
{
    const choice how = {.width = 0.0};
    TEST_ASSERT_FALSE(isfinite(precision_of(&c, &list[0], &how)) ||
                      isfinite(precision_of(&c, &list[3], &how)));
    knows(0, 0.5);
    knows(3, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, precision_of(&c, &list[0], &how));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, precision_of(&c, &list[3], &how));
}

/* ---- runs left out ---- */

/* The mean logarithm of the squares of a row, with a floor of a twentieth. */
static void test_the_misfit_of_a_choice(void)
{
    hci_note note = {{0}};
    double misfit = 0.0, by_hand = 0.0, left[RUNS];
    const choice how = {.power = 6, .width = 30.0};
    TEST_ASSERT_EQUAL_INT(HCI_OK, misfit_of(&c, &how, &misfit, &note));
    TEST_ASSERT_TRUE(hci_left_out_squares(&c.runs, precision, left));
    for (int r = 0; r < RUNS; ++r) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, left[r], square[r]);
        by_hand += log(left[r] / ROWS + 0.05) / RUNS;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, by_hand, misfit);
    for (size_t k = 0; k < COLUMNS; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(precision_of(&c, &list[k], &how), precision[k]);
    double sum = 0.0;
    for (int r = 0; r < RUNS; ++r)
        sum += left[r];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum, sum_of(&c));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02 * sqrt(sum / (RUNS * ROWS)), rms_of(&c, sum));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, rms_of(&c, -1.0));
}

/* Less of all terms by that share, as if so much of them had been taken off the torque before. */
static void weaken(double share)
{
    for (int r = 0; r < RUNS; ++r)
        for (int i = 0; i < COLUMNS; ++i) {
            double made = 0.0;
            for (int j = 0; j < COLUMNS; ++j)
                made += gram[r][i * COLUMNS + j];
            run[r].square += share * (share * made - 2.0 * moment[r][i]);
        }
    for (int r = 0; r < RUNS; ++r)
        for (int k = 0; k < COLUMNS * COLUMNS; ++k)
            moment[r][k / COLUMNS] -= share * gram[r][k];
}

/* The best of two powers and five widths, by trying all of terms as small as their errors: each width is it,
 * of noise from small to large. */
static void test_the_best_of_all_choices(void)
{
    static const double WIDTH[] = {1.0, 3.0, 10.0, 30.0, 100.0};
    hci_note note = {{0}};
    bool is_best[5] = {false};
    weaken(0.9);
    for (int k = 0; k < 3; ++k)
        list[k].coenergy_unit = 1.0;
    for (c.noise_Nm = 1e-3; c.noise_Nm < 10.0; c.noise_Nm *= 1.6) {
        choice best = {.power = 1}, of_all = {.power = 1};
        double least, misfit, fewest = INFINITY;
        TEST_ASSERT_EQUAL_INT(HCI_OK, choose(&c, &best, &least, &note));
        for (int power = 4; power <= 6; power += 2)
            for (int w = 0; w < 5; ++w) {
                const choice how = {.power = power, .width = WIDTH[w]};
                TEST_ASSERT_EQUAL_INT(HCI_OK, misfit_of(&c, &how, &misfit, &note));
                if (misfit < fewest) fewest = misfit, of_all = how;
            }
        TEST_ASSERT_EQUAL_DOUBLE(fewest, least);
        TEST_ASSERT_EQUAL_INT(of_all.power, best.power);
        TEST_ASSERT_EQUAL_DOUBLE(of_all.width, best.width);
        for (int w = 0; w < 5; ++w)
            is_best[w] = is_best[w] || best.width == WIDTH[w];
    }
    for (int w = 0; w < 5; ++w)
        TEST_ASSERT_TRUE(is_best[w]);
}

/* What all runs lose without a part. */
static void test_what_a_part_explains(void)
{
    choice how = {.power = 6, .width = 30.0};
    double with, without;
    precision_set(&c, &how);
    TEST_ASSERT_TRUE(hci_all_in_square(&c.runs, precision, &with));
    how.without[1] = true;
    precision_set(&c, &how);
    TEST_ASSERT_TRUE(hci_all_in_square(&c.runs, precision, &without));
    how.without[1] = false;
    const fitted_squares fit = fit_squares(&c, &how, 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, with, fit.with);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, without, fit.without);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02 * sqrt((without - with) / (RUNS * ROWS)),
                              rms_of(&c, fit.without - fit.with));
}

/* The two terms of the back-EMF: half of their price in BIC, or two thirds of all that is left without. What
 * no table declares is not asked. */
static void test_what_is_paid(void)
{
    const double price = (double)list[1].count * log(RUNS * ROWS);
    TEST_ASSERT_TRUE(is_paid(&c, 1, &(fitted_squares){1e3, 1e3 + 0.51 * price}));
    TEST_ASSERT_FALSE(is_paid(&c, 1, &(fitted_squares){1e3, 1e3 + 0.49 * price}));
    TEST_ASSERT_TRUE(is_paid(&c, 1, &(fitted_squares){0.1 * price, 0.31 * price}));
    TEST_ASSERT_FALSE(is_paid(&c, 1, &(fitted_squares){0.1 * price, 0.29 * price}));
    TEST_ASSERT_TRUE(is_paid(&c, 2, &(fitted_squares){1e3, 1e3}));
}

static void test_what_is_missed(void)
{
    const left_out in = {1.0, 100.0};
    TEST_ASSERT_FALSE(is_missed(&in, &(left_out){1.009, 109.0}));
    TEST_ASSERT_TRUE(is_missed(&in, &(left_out){1.011, 0.0}));
    TEST_ASSERT_TRUE(is_missed(&in, &(left_out){0.0, 110.1}));
}

/* ---- all ---- */

static int told;

static void count_told(void *context, const char *what, double share)
{
    (void)context, (void)what, (void)share;
    ++told;
}

/* Runs that all ask for cogging and back-EMF have both; of noise alone neither comes in, and one look at each
 * is enough: the model as it was, two powers of five widths, the choice and its two parts. */
static void test_parts_that_runs_miss_come_in(void)
{
    options.progress = count_told;
    for (int shown = 1; shown >= 0; --shown) {
        hci_note note = {{0}};
        choice best = {0};
        for (int r = 0; r < RUNS && !shown; ++r) {
            memset(moment[r], 0, sizeof moment[r]);
            run[r].square = ROWS;
        }
        told = 0;
        TEST_ASSERT_EQUAL_INT(HCI_OK, choose_all(&c, &best, &note));
        TEST_ASSERT_EQUAL(!shown, best.without[0]);
        TEST_ASSERT_EQUAL(!shown, best.without[1]);
        if (!shown) TEST_ASSERT_EQUAL_INT(1 + 2 * 5 + 1 + 2, told);
    }
}

static void test_what_of_a_choice_is_kept(void)
{
    const choice how = {.power = 4, .width = 10.0};
    apply(&c, &how);
    TEST_ASSERT_EQUAL_UINT64(3, c.all.count);
    TEST_ASSERT_TRUE(list[0].type == type("cogging") && list[1].type == type("back_emf") &&
                     list[2].type == type("friction"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.4, list[0].deviation);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, list[2].deviation);
}

/* 0.48 of the samples in an electrical turn of the run with fewest, of those that have one or were calculated
 * at even steps; 90 at the most. */
static void test_the_order_that_samples_tell(void)
{
    TEST_ASSERT_EQUAL_INT(16, resolved_order(&regression)); /* 48 / 2.91 */
    for (size_t k = 0; k < 100; ++k)
        sample[200 + k].reading.theta_m_rad *= -2.0;
    TEST_ASSERT_EQUAL_INT(8, resolved_order(&regression));
    for (size_t k = 0; k < 100; ++k)
        sample[200 + k].reading.theta_m_rad *= 0.5;
    for (int r = 0; r < RUNS; ++r)
        for (size_t k = 0; k < 100; ++k)
            sample[100 * r + (int)k].reading.theta_m_rad *= 0.91 / 2.91;
    TEST_ASSERT_EQUAL_INT(52, resolved_order(&regression));
    for (size_t k = 0; k < RUNS * 100; ++k)
        sample[k].reading.theta_m_rad *= 0.89 / 0.91;
    TEST_ASSERT_EQUAL_INT(90, resolved_order(&regression));
    recording[0].is_tabulated = true;
    TEST_ASSERT_EQUAL_INT(53, resolved_order(&regression)); /* 48 / 0.89 */
    recording[0].is_tabulated = false;
}

/* Two hundredths of the largest current apart, whatever its size. */
static void test_runs_at_different_currents(void)
{
    for (double scale = 1.0; scale > 1e-4; scale *= 0.01) {
        setUp();
        for (int r = 0; r < RUNS; ++r)
            statistics[r].current_A *= scale, statistics[r].mean_iq_A *= scale;
        TEST_ASSERT_EQUAL_UINT64(6, different_currents(&regression));
        statistics[3].mean_iq_A = statistics[1].mean_iq_A + 0.099 * scale;
        TEST_ASSERT_EQUAL_UINT64(5, different_currents(&regression));
        statistics[3].mean_iq_A = statistics[1].mean_iq_A + 0.101 * scale;
        TEST_ASSERT_EQUAL_UINT64(6, different_currents(&regression));
        statistics[3].mean_iq_A = statistics[1].mean_iq_A, statistics[3].mean_id_A = 0.2 * scale;
        TEST_ASSERT_EQUAL_UINT64(6, different_currents(&regression));
        use[1] = false, statistics[3].mean_id_A = 0.0;
        TEST_ASSERT_EQUAL_UINT64(5, different_currents(&regression));
        use[1] = true;
        statistics[0].current_A = 0.0, statistics[5].current_A = 60.0 * scale;
        TEST_ASSERT_EQUAL_UINT64(2, different_currents(&regression)); /* 1.2 A apart: 1 and 5 */
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_parts_of_the_series_and_beside_it);
    RUN_TEST(test_terms_of_the_iron_count_from_nothing);
    RUN_TEST(test_what_is_expected_of_a_term);
    RUN_TEST(test_the_model_as_it_was);
    RUN_TEST(test_the_misfit_of_a_choice);
    RUN_TEST(test_the_best_of_all_choices);
    RUN_TEST(test_what_a_part_explains);
    RUN_TEST(test_what_is_paid);
    RUN_TEST(test_what_is_missed);
    RUN_TEST(test_parts_that_runs_miss_come_in);
    RUN_TEST(test_what_of_a_choice_is_kept);
    RUN_TEST(test_the_order_that_samples_tell);
    RUN_TEST(test_runs_at_different_currents);
    return UNITY_END();
}
