/* Which of many models with one more effect, or two, are fitted: tables by hand, on both sides of each bound.
 */
#include "host/diagnose/search/forward.c"

#include "unity.h"

static hci_candidate_models table;
static hci_regression regression;
static hci_binned_samples samples;
static hci_search search;
static hci_candidate list[4];
static hci_candidates model;

void setUp(void)
{
    memset(&table, 0, sizeof table);
    samples = (hci_binned_samples){0};
    regression = (hci_regression){.samples = &samples};
    search = (hci_search){.regression = &regression};
    memset(list, 0, sizeof list);
    model = (hci_candidates){.candidate = list};
}

void tearDown(void)
{
}

static size_t type_of(const char *name)
{
    size_t r = 0;
    while (strcmp(hci_candidate_type(r)->name, name) != 0)
        ++r;
    return r;
}

static hci_candidate_model *add(const char *a, const char *b, double gain, size_t terms)
{
    hci_candidate_model *x = &table.model[table.count++];
    *x = (hci_candidate_model){.a = type_of(a), .b = type_of(b), .gain = gain, .terms = terms};
    return x;
}

static hci_candidate_model *add_single(const char *a, double gain, size_t terms)
{
    return add(a, a, gain, terms);
}

static size_t picks(const hci_candidate_model *picked[SINGLES + PAIRS])
{
    memset(picked, 0, (SINGLES + PAIRS) * sizeof *picked);
    return models_pick(&table, picked);
}

/* ---- single effects ---- */

/* Those that promise half of what is decisive, the three best; 30 % and 60 behind the best is the border. */
static void test_the_best_single_effects(void)
{
    const hci_candidate_model *picked[SINGLES + PAIRS];
    add_single("friction", 4.9, 1);
    TEST_ASSERT_EQUAL_UINT64(0, picks(picked));
    table.model[0].gain = 5.1;
    TEST_ASSERT_EQUAL_UINT64(1, picks(picked));
    add_single("cogging", 1000.0, 2);
    add_single("reluctance", 641.0, 2);
    add_single("back_emf", 639.0, 2);
    add_single("current_offset", 700.0, 3);
    TEST_ASSERT_EQUAL_UINT64(3, picks(picked));
    TEST_ASSERT_EQUAL_PTR(&table.model[1], picked[0]);
    TEST_ASSERT_EQUAL_PTR(&table.model[4], picked[1]);
    TEST_ASSERT_EQUAL_PTR(&table.model[2], picked[2]);
    table.model[4].gain = 100.0;
    table.model[2].gain = 639.0;
    TEST_ASSERT_EQUAL_UINT64(1, picks(picked));
}

/* ---- pairs ---- */

/* Twice what is decisive; and more than what begins with the best single one by what is decisive. */
static void test_the_best_pair(void)
{
    const hci_candidate_model *picked[SINGLES + PAIRS];
    hci_candidate_model *pair = add("saturation", "friction", 19.0, 9);
    TEST_ASSERT_EQUAL_UINT64(0, picks(picked));
    pair->gain = 21.0;
    TEST_ASSERT_EQUAL_UINT64(1, picks(picked));
    add_single("cogging", 15.0, 2);
    hci_candidate_model *with = add("cogging", "saturation", 12.0, 9);
    TEST_ASSERT_EQUAL_UINT64(1, picks(picked));
    TEST_ASSERT_EQUAL_PTR(&table.model[1], picked[0]);
    with->gain = 10.9;
    TEST_ASSERT_EQUAL_UINT64(2, picks(picked));
    TEST_ASSERT_EQUAL_PTR(pair, picked[1]);
    with->gain = 30.0; /* it begins with the best itself */
    TEST_ASSERT_EQUAL_UINT64(1, picks(picked));
    TEST_ASSERT_EQUAL_PTR(with, best_pair(&table, NULL));
    TEST_ASSERT_EQUAL_PTR(with, best_pair(&table, picked[0]));
    with->gain = 1.0;
    TEST_ASSERT_EQUAL_PTR(pair, best_pair(&table, NULL));
    TEST_ASSERT_EQUAL_PTR(with, best_pair(&table, picked[0]));
}

static void test_what_is_loose(void)
{
    TEST_ASSERT_TRUE(is_loose(type_of("saturation")));
    TEST_ASSERT_TRUE(is_loose(hci_candidate_types() - 1));
    TEST_ASSERT_FALSE(is_loose(type_of("cogging")) || is_loose(type_of("back_emf")));
}

/* Six values at the most beside a single effect, and none more than it has; 20 better. */
static void test_two_effects_of_few_values(void)
{
    hci_candidate_model *single = add_single("cogging", 100.0, 6),
                        *pair = add("friction", "reluctance", 121.0, 6);
    TEST_ASSERT_TRUE(is_frugal(&table, pair, single));
    TEST_ASSERT_EQUAL_PTR(pair, frugal_pair(&table, single));
    pair->gain = 119.0;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, single));
    pair->gain = 121.0, pair->terms = 7, single->terms = 8;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, single));
    pair->terms = 6, single->terms = 5;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, single));
    single->terms = 6;
    TEST_ASSERT_FALSE(is_frugal(&table, single, single));
    hci_candidate_model *loose = add("friction", "saturation", 500.0, 4);
    TEST_ASSERT_FALSE(is_frugal(&table, loose, single));
    hci_candidate_model *better = add("friction", "back_emf", 130.0, 4);
    TEST_ASSERT_EQUAL_PTR(better, frugal_pair(&table, single));
}

/* In place of a series as many values as it has, and half a per cent less; not where one effect does within 2
 * %. */
static void test_two_effects_in_place_of_a_series(void)
{
    hci_candidate_model *series = add_single("saturation", 1000.0, 20),
                        *pair = add("friction", "reluctance", 996.0, 20);
    TEST_ASSERT_TRUE(is_frugal(&table, pair, series));
    pair->gain = 994.0;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, series));
    pair->gain = 1000.0;
    hci_candidate_model *one = add_single("back_emf", 979.0, 20);
    TEST_ASSERT_TRUE(is_frugal(&table, pair, series));
    one->gain = 982.0;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, series));
    one->terms = 21;
    TEST_ASSERT_TRUE(is_frugal(&table, pair, series));
    pair->terms = 21;
    TEST_ASSERT_FALSE(is_frugal(&table, pair, series));
}

/* ---- what a model must be better by ---- */

static void test_handicaps(void)
{
    hci_candidate_model *best = add_single("cogging", 1000.0, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, handicap_of(&table, best, best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0 + 20.0,
                              handicap_of(&table, add("friction", "reluctance", 500.0, 2), best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0,
                              handicap_of(&table, add("friction", "reluctance", 1021.0, 2), best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, handicap_of(&table, add_single("saturation", 900.0, 9), best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0 + 20.0 + 10.0,
                              handicap_of(&table, add("friction", "saturation", 900.0, 9), best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, handicap_of(&table, add_single("position_load", 900.0, 1), best));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0 + 20.0 + 10.0,
                              handicap_of(&table, add("friction", "position_load", 900.0, 3), best));
    best->gain = 1e6;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5000.0, handicap_of(&table, &table.model[3], best));
}

static void test_powers_that_lead(void)
{
    hci_candidate_model *one = add_single("cogging", 10.0, 2);
    TEST_ASSERT_FALSE(powers_lead(&table));
    add_single("saturation", 10.5, 2);
    TEST_ASSERT_TRUE(powers_lead(&table));
    one->gain = 11.0;
    TEST_ASSERT_FALSE(powers_lead(&table));
    one->gain = 10.0;
    add("cogging", "friction", 99.0, 3);
    TEST_ASSERT_TRUE(powers_lead(&table));
}

/* ---- what would not stay ---- */

static void put_in(const char *type)
{
    list[model.count++] = (hci_candidate){.type = hci_candidate_type(type_of(type)), .count = 1, .in = true};
}

/* Beside a series that came with 1000 an effect of the iron has to explain half of half a per cent of … it is
 * hci_companion_error that says of what. */
static void test_what_the_iron_must_explain(void)
{
    put_in("saturation");
    search.came_with[type_of("saturation")] = 1e4;
    const double error = hci_companion_error(&regression, &model, hci_effect_type_find("saturation"));
    TEST_ASSERT_TRUE(error > 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * 1e4 * error, least_of(&search, &model, type_of("back_emf")));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * 1e4 * error, least_of(&search, &model, hci_candidate_types() - 1));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_of(&search, &model, type_of("friction")));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_of(&search, &model, type_of("saturation")));
    list[0].in = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_of(&search, &model, type_of("back_emf")));
    list[0].in = true;
    put_in("rotor_inertia");
    search.came_with[type_of("rotor_inertia")] = 1e5;
    const double slope = hci_companion_error(&regression, &model, hci_effect_type_find("rotor_inertia"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * 1e5 * slope, least_of(&search, &model, type_of("channel_delay")));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, least_of(&search, &model, type_of("friction")));
}

/* A pair stays where each adds what it must to the other alone; a single one where it explains that. */
static void test_faint_ones_leave(void)
{
    put_in("saturation");
    search.came_with[type_of("saturation")] = 1e4;
    const double least = least_of(&search, &model, type_of("back_emf"));
    add_single("friction", 100.0, 1);
    add_single("back_emf", least - 0.1, 1);
    add("friction", "back_emf", 100.0 + least - 0.1, 2);
    add("back_emf", "friction", 100.0 + least - 0.1, 2);
    faint_leave(&search, &model, &table);
    TEST_ASSERT_EQUAL_UINT64(1, table.count);
    TEST_ASSERT_EQUAL_UINT64(type_of("friction"), table.model[0].a);
    setUp();
    put_in("saturation");
    search.came_with[type_of("saturation")] = 1e4;
    add_single("friction", 100.0, 1);
    add_single("back_emf", least + 0.1, 1);
    add("friction", "back_emf", 100.0 + least + 0.1, 2);
    TEST_ASSERT_EQUAL_DOUBLE(100.0, single_gain(&table, type_of("friction")));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, single_gain(&table, type_of("cogging")));
    faint_leave(&search, &model, &table);
    TEST_ASSERT_EQUAL_UINT64(3, table.count);
}

static void test_series_are_left_out_of_few_values(void)
{
    add_single("saturation", 10.0, 2);
    add_single("cogging", 9.0, 2);
    add("cogging", "saturation", 8.0, 2);
    add("friction", "reluctance", 7.0, 2);
    loose_leave(&table);
    TEST_ASSERT_EQUAL_UINT64(2, table.count);
    TEST_ASSERT_EQUAL_DOUBLE(9.0, table.model[0].gain);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, table.model[1].gain);
}

/* Of an effect that comes in alone; two that come together are not told apart. */
static void test_what_a_score_falls_by_is_noted(void)
{
    hci_fitted_model before = {0}, after = {0};
    put_in("friction");
    before.candidates = model, before.fit.score = 70.0;
    put_in("cogging");
    after.candidates = model, after.fit.score = 45.0;
    coming_note(&search, &before, &after);
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        TEST_ASSERT_EQUAL_DOUBLE(r == type_of("cogging") ? 25.0 : 0.0, search.came_with[r]);
    before.candidates.count = 0, after.fit.score = 5.0;
    coming_note(&search, &before, &after);
    TEST_ASSERT_EQUAL_DOUBLE(25.0, search.came_with[type_of("cogging")]);
}

/* Three times the resolution and 1.1 times the noise. */
static void test_how_much_is_left(void)
{
    enum { N = 10 };
    static hci_binned_sample sample[N];
    static double residual[N];
    static bool use = true;
    static hci_noise noise[1];
    hci_segment segment = {.count = N};
    samples = (hci_binned_samples){
        .sample = sample, .count = N, .segment = &segment, .segment_count = 1, .run_count = 1};
    regression = (hci_regression){.samples = &samples, .use = &use, .noise = noise};
    search.residual_Nm = residual;
    for (size_t k = 0; k < N; ++k) {
        residual[k] = k % 2 ? 1.0 : -1.0;
        sample[k].count = 1.0;
    }
    noise[0] = hci_noise_white(0.5);
    search.resolution_Nm = 0.32;
    TEST_ASSERT_TRUE(is_much_left(&search));
    search.resolution_Nm = 0.34;
    TEST_ASSERT_FALSE(is_much_left(&search));
    search.resolution_Nm = 0.1;
    noise[0] = hci_noise_white(0.9);
    TEST_ASSERT_TRUE(is_much_left(&search));
    noise[0] = hci_noise_white(0.92);
    TEST_ASSERT_FALSE(is_much_left(&search));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_best_single_effects);
    RUN_TEST(test_the_best_pair);
    RUN_TEST(test_what_is_loose);
    RUN_TEST(test_two_effects_of_few_values);
    RUN_TEST(test_two_effects_in_place_of_a_series);
    RUN_TEST(test_handicaps);
    RUN_TEST(test_powers_that_lead);
    RUN_TEST(test_what_the_iron_must_explain);
    RUN_TEST(test_faint_ones_leave);
    RUN_TEST(test_series_are_left_out_of_few_values);
    RUN_TEST(test_what_a_score_falls_by_is_noted);
    RUN_TEST(test_how_much_is_left);
    return UNITY_END();
}
