/* Parts of the normal equations by themselves: constants that leave, blocks, columns that are rounding, what
 * is expected, and which run shows what. */
#include "host/diagnose/fit/linearise.c"

#include "support/reference.h"
#include "unity.h"

enum { ROWS = 300, COLUMNS = 3 };

static uint64_t seed;
static double x[ROWS * COLUMNS], y[ROWS], constant[ROWS], square[COLUMNS * COLUMNS + COLUMNS];
static double gram[COLUMNS * COLUMNS], moment[COLUMNS];
static hci_binned_sample sample[ROWS];
static hci_segment segment;
static hci_run run;
static hci_run_statistics statistics;
static bool use = true;
static hci_binned_samples samples;
static hci_regression regression;
static hci_candidate list[COLUMNS];
static hci_model_column column[COLUMNS];
static hci_model model;
static hci_normal_equations normal;
static hci_scatter scatter;
static filling f;

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

static size_t parameter(const hci_effect_type *of, const char *name)
{
    size_t k = 0;
    while (strcmp(of->parameter[k].name, name) != 0)
        ++k;
    return k;
}

static void is(size_t c, const char *effect, const char *name, double value)
{
    list[c] = (hci_candidate){.type = type(effect), .count = 1, .in = true};
    list[c].term[0] = (hci_effect_term){parameter(list[c].type, name), 1.0, value, NAN};
}

void setUp(void)
{
    seed = 9;
    for (size_t k = 0; k < ROWS * COLUMNS; ++k)
        x[k] = ref_normal(&seed);
    for (size_t k = 0; k < ROWS; ++k) {
        y[k] = 2.0 + ref_normal(&seed);
        sample[k].count = k % 10 == 3 ? 0.0 : 1.0;
    }
    memset(square, 0, sizeof square);
    is(0, "cogging", "sine", 0.1);
    is(1, "back_emf", "sine", 0.2);
    is(2, "friction", "coulomb", -0.3);
    for (size_t c = 0; c < COLUMNS; ++c) {
        column[c] = (hci_model_column){&list[c], 0, c};
        moment[c] = 1.0 + (double)c;
        for (size_t d = 0; d < COLUMNS; ++d)
            gram[c * COLUMNS + d] = c == d ? 4.0 : 1.0;
    }
    segment = (hci_segment){.count = ROWS};
    run = (hci_run){.torque_source = HCI_TORQUE_MEASURED};
    statistics = (hci_run_statistics){.turns = 1.0};
    samples = (hci_binned_samples){sample, ROWS, &segment, 1, &statistics, 1};
    regression = (hci_regression){.samples = &samples, .runs = &run, .use = &use};
    model = (hci_model){.column = column, .columns = COLUMNS};
    normal = (hci_normal_equations){COLUMNS, gram, moment, 50.0, 20.0};
    scatter = (hci_scatter){square, 0};
    f = (filling){.regression = &regression,
                  .model = &model,
                  .normal = &normal,
                  .scatter = &scatter,
                  .x = x,
                  .y = y,
                  .constant = constant,
                  .reference_current_A = 5.0};
}

void tearDown(void)
{
}

/* ---- constants ---- */

/* As if one more unknown of the deviation u were in all rows that tell something: in white noise the mean m
 * of n rows falls to m/√(1 + u² n). */
static void test_a_constant_leaves_as_far_as_it_is_unknown(void)
{
    const double n = 270.0, unknown[] = {1e-3, 0.05, 1e6};
    const hci_noise noise = hci_noise_white(1.0);
    for (int k = 0; k < 3; ++k) {
        double before = 0.0, after = 0.0, of_column[2] = {0.0};
        setUp();
        for (size_t j = 0; j < ROWS; ++j) {
            if (!(sample[j].count > 0.0)) y[j] = x[3 * j + 2] = 0.0;
            before += y[j], of_column[0] += x[3 * j + 2];
        }
        constants_free(&f, &segment, &noise, unknown[k]);
        for (size_t j = 0; j < ROWS; ++j)
            after += y[j], of_column[1] += x[3 * j + 2];
        const double share = 1.0 / sqrt(1.0 + unknown[k] * unknown[k] * n);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(before), before * share, after);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(of_column[0]) + 1e-9, of_column[0] * share, of_column[1]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, y[3]);
    }
    for (size_t j = 0; j < ROWS; ++j)
        sample[j].count = 0.0;
    const double kept = y[7];
    constants_free(&f, &segment, &noise, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(kept, y[7]);
    row_clear(&f, 7);
    TEST_ASSERT_TRUE(y[7] == 0.0 && x[21] == 0.0 && x[23] == 0.0 && x[20] != 0.0 && x[24] != 0.0);
}

/* ---- blocks ---- */

/* Sums over 120 rows, and over what is left where that is more than half as many. */
static void test_scatter_of_blocks(void)
{
    double hand[COLUMNS * COLUMNS] = {0.0};
    for (size_t rows = 0; rows <= 1; ++rows) {
        const size_t n = rows ? 301 - 1 : 180, from[] = {0, 120, 240};
        setUp();
        memset(hand, 0, sizeof hand);
        size_t blocks = 0;
        for (int b = 0; b < 3; ++b) {
            const size_t end = from[b] + 120 < n ? from[b] + 120 : n;
            double sum[COLUMNS] = {0.0};
            if (from[b] + 60 >= n) continue;
            ++blocks;
            for (size_t k = from[b]; k < end; ++k)
                for (size_t c = 0; c < COLUMNS; ++c)
                    sum[c] += x[k * COLUMNS + c] * y[k];
            for (size_t c = 0; c < COLUMNS * COLUMNS; ++c)
                hand[c] += sum[c / COLUMNS] * sum[c % COLUMNS];
        }
        scatter_add(&f, NULL, COLUMNS, n, 120);
        TEST_ASSERT_EQUAL_UINT64(blocks, scatter.blocks);
        for (size_t c = 0; c < COLUMNS * COLUMNS; ++c)
            TEST_ASSERT_DOUBLE_WITHIN(1e-8, hand[c], square[c]);
    }
    const size_t at[] = {2, 0};
    setUp();
    scatter_add(&f, at, 2, 100, 120);
    double sum[2] = {0.0};
    for (size_t k = 0; k < 100; ++k)
        sum[0] += x[2 * k] * y[k], sum[1] += x[2 * k + 1] * y[k];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum[0] * sum[1], square[2 * COLUMNS]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum[1] * sum[1], square[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, square[1]);
    TEST_ASSERT_EQUAL_UINT64(120, block_of(&segment));
    segment.joined = 4.0;
    TEST_ASSERT_EQUAL_UINT64(30, block_of(&segment));
}

/* Bins that were joined count as rows whose squares are those of noise. */
static void test_joined_bins_count(void)
{
    segment.joined = 2.5;
    joined_add(&f, &segment);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20.0 + 1.5 * ROWS, normal.rows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 50.0 + 1.5 * ROWS, normal.square);
}

static void test_sums_of_currents_join(void)
{
    size_t summed[] = {0, 2};
    double few[] = {7.0, 0.0, 3.0, 9.0}, of_few[] = {0.5, 0.25};
    f.summed = summed, f.summed_count = 2;
    f.sums = (hci_normal_equations){2, few, of_few, 8.0, 5.0};
    sums_join(&f);
    TEST_ASSERT_EQUAL_DOUBLE(58.0, normal.square);
    TEST_ASSERT_EQUAL_DOUBLE(20.0, normal.rows);
    TEST_ASSERT_TRUE(moment[0] == 1.5 && moment[1] == 2.0 && moment[2] == 3.25);
    TEST_ASSERT_TRUE(gram[0] == 11.0 && gram[8] == 13.0 && gram[6] == 4.0 && gram[2] == 1.0 &&
                     gram[4] == 4.0);
}

/* Where the noise of the sum is none, or is not known, there is no row of it. */
static void test_sums_without_noise_are_no_rows(void)
{
    double deviation_A[] = {0.0};
    regression.sum_deviation_A = deviation_A;
    TEST_ASSERT_FALSE(sum_rows(&f, &segment));
    deviation_A[0] = (double)NAN;
    TEST_ASSERT_FALSE(sum_rows(&f, &segment));
}

/* ---- columns ---- */

/* 10⁻¹² of the largest square of the same effect. */
static void test_columns_of_rounding(void)
{
    list[1].type = list[0].type;
    gram[4] = 4.0 * 0.9e-12;
    rounding_drop(&model, &normal);
    TEST_ASSERT_TRUE(gram[4] == 0.0 && gram[3] == 0.0 && gram[1] == 0.0 && gram[5] == 0.0 && gram[7] == 0.0 &&
                     moment[1] == 0.0);
    TEST_ASSERT_TRUE(gram[0] == 4.0 && gram[2] == 1.0 && moment[0] == 1.0);
    setUp();
    list[1].type = list[0].type;
    gram[4] = 4.0 * 1.1e-12;
    rounding_drop(&model, &normal);
    TEST_ASSERT_TRUE(gram[4] > 0.0 && moment[1] == 2.0);
    gram[4] = 1e-30; /* the largest of its own effect */
    list[1].type = type("back_emf");
    rounding_drop(&model, &normal);
    TEST_ASSERT_TRUE(gram[4] > 0.0);
}

/* One row more: (value − declared)/deviation. */
static void test_expectations_are_rows(void)
{
    list[0].deviation = 0.5, list[2].deviation = 0.25, list[2].declared[0] = 0.1;
    expectations_add(&model, &normal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8.0, gram[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, gram[4]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20.0, gram[8]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 - 4.0 * 0.1, moment[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, moment[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 + 16.0 * 0.4, moment[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 50.0 + 4.0 * 0.01 + 16.0 * 0.16, normal.square);
}

/* ---- what a run shows ---- */

static bool shows(const char *effect, const char *name, double order)
{
    is(0, effect, name, 0.1);
    list[0].term[0].order = order;
    return can_show(&run, &statistics, &list[0], 0);
}

static void test_what_a_run_shows(void)
{
    TEST_ASSERT_TRUE(shows("back_emf", "sine", 1.0) && shows("torque_sensor", "offset", 0.0) &&
                     shows("current_gain", "a", 0.0));
    statistics.no_current = true;
    TEST_ASSERT_FALSE(shows("back_emf", "sine", 1.0) || shows("current_gain", "a", 0.0));
    TEST_ASSERT_TRUE(shows("cogging", "sine", 6.0) && shows("friction", "coulomb", 0.0));
    statistics.no_current = false, statistics.zeros_read = true;
    TEST_ASSERT_FALSE(shows("back_emf", "sine", 1.0));
    statistics.zeros_read = false;
    run.torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(shows("torque_sensor", "offset", 0.0));
    TEST_ASSERT_TRUE(shows("back_emf", "sine", 1.0) && shows("friction", "coulomb", 0.0));
    TEST_ASSERT_FALSE(shows("channel_delay", "current", 0.0)); /* the speed was filtered */
    run.speed_window = 5;
    TEST_ASSERT_TRUE(shows("channel_delay", "current", 0.0));
    run.torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(shows("back_emf", "sine", 1.0) || shows("back_emf", "sine", 5.0) ||
                      shows("friction", "viscous", 0.0));
    TEST_ASSERT_TRUE(shows("cogging", "sine", 6.0) && shows("friction", "coulomb", 0.0));
    statistics.is_loaded = true;
    TEST_ASSERT_TRUE(shows("back_emf", "sine", 5.0));
    TEST_ASSERT_FALSE(shows("back_emf", "sine", 1.0));
    run.mean_is_unknown = true;
    TEST_ASSERT_FALSE(shows("friction", "coulomb", 0.0));
    TEST_ASSERT_TRUE(shows("cogging", "sine", 6.0));
}

static void test_columns_that_no_run_shows(void)
{
    statistics.no_current = true;
    columns_clear(&f, &segment);
    for (size_t k = 0; k < ROWS; ++k)
        TEST_ASSERT_TRUE(x[k * COLUMNS] != 0.0 && x[k * COLUMNS + 1] == 0.0 && x[k * COLUMNS + 2] != 0.0);
    TEST_ASSERT_TRUE(is_shown(&f, 0) && !is_shown(&f, 1) && is_shown(&f, 2));
    statistics.no_current = false;
    TEST_ASSERT_TRUE(is_shown(&f, 1));
    run.hardly_accelerates = true, f.scales = true;
    TEST_ASSERT_TRUE(is_shown(&f, 0) && !is_shown(&f, 1));
    f.scales = false;
    TEST_ASSERT_TRUE(is_shown(&f, 1));
}

/* A change of the torque per ampere of 10⁻⁴ of about 1 at the reference current. */
static void test_which_columns_scale(void)
{
    double by_value[COLUMNS] = {0.0, -1.9e-5, 1e-6};
    f.plan.constant_by_value = by_value;
    TEST_ASSERT_FALSE(any_scales(&f));
    by_value[1] = -2.1e-5;
    TEST_ASSERT_TRUE(any_scales(&f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_constant_leaves_as_far_as_it_is_unknown);
    RUN_TEST(test_scatter_of_blocks);
    RUN_TEST(test_joined_bins_count);
    RUN_TEST(test_sums_of_currents_join);
    RUN_TEST(test_sums_without_noise_are_no_rows);
    RUN_TEST(test_columns_of_rounding);
    RUN_TEST(test_expectations_are_rows);
    RUN_TEST(test_what_a_run_shows);
    RUN_TEST(test_columns_that_no_run_shows);
    RUN_TEST(test_which_columns_scale);
    return UNITY_END();
}
