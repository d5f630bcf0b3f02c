/* What makes a model hard to believe, by values on both sides of each bound. */
#include "host/diagnose/search/belief.c"

#include <string.h>

#include "unity.h"

enum { RUNS = 3 };

static hci_run_statistics statistics[RUNS];
static bool use[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_candidate list[3];
static hci_candidates model;

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

/* Runs at 60, -25 and 10 rad/s, the last of which is not in use. */
void setUp(void)
{
    static const double SPEED[RUNS] = {60.0, -25.0, 10.0};
    memset(list, 0, sizeof list);
    for (int r = 0; r < RUNS; ++r) {
        statistics[r] = (hci_run_statistics){.mean_speed_rad_per_s = SPEED[r]};
        use[r] = r < 2;
    }
    samples = (hci_binned_samples){.statistics = statistics, .run_count = RUNS};
    regression = (hci_regression){.samples = &samples, .use = use};
    model = (hci_candidates){.candidate = list, .count = 0};
}

void tearDown(void)
{
}

static hci_candidate *add(const char *effect, const char *name, double value, double deviation)
{
    hci_candidate *x = &list[model.count++];
    *x = (hci_candidate){.type = type(effect), .count = 1, .in = true, .deviation = deviation};
    x->term[0] = (hci_effect_term){parameter(x->type, name), 0.0, value, NAN};
    return x;
}

/* Of the slowest run that is in use and turns. */
static void test_the_longest_turn(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * HCI_PI / 25.0, longest_turn_s(&regression));
    use[2] = true;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * HCI_PI / 10.0, longest_turn_s(&regression));
    statistics[1].mean_speed_rad_per_s = 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * HCI_PI / 10.0, longest_turn_s(&regression));
    use[0] = use[1] = use[2] = false;
    TEST_ASSERT_FALSE(isfinite(longest_turn_s(&regression)));
}

/* A time constant; of a damping ζ at f it is 2ζ/(2πf). */
static void test_the_lag_of_a_sensor(void)
{
    hci_candidate *x = add("torque_sensor", "time_constant", 0.02, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02, lag_of(x));
    x->term[0] = (hci_effect_term){parameter(x->type, "natural_frequency"), 0.0, 50.0, NAN};
    x->term[1] = (hci_effect_term){parameter(x->type, "damping"), 0.0, 3.0, NAN};
    x->count = 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * 3.0 / (2.0 * HCI_PI * 50.0), lag_of(x));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, lag_of(add("torque_sensor", "offset", 7.0, 0.0)));
}

/* Of the largest declared cogging torque, of order 18, in the slowest run: 18 · 3 · 25 rad/s, 215 Hz. Behind
 * a resonance at so much over √6 a fifth of it is left. */
static void test_a_resonance_that_hides_the_cogging_torque(void)
{
    hci_harmonic cogging[2] = {{36.0, 0.1, 0.0}, {18.0, 0.0, 0.5}};
    const hci_machine machine = {.pole_pairs = 3, .cogging = cogging, .cogging_count = 2};
    const double least_Hz = 18.0 * 3.0 * 25.0 / (2.0 * HCI_PI) / sqrt(6.0);
    regression.machine = &machine;
    hci_candidate *x = add("torque_sensor", "natural_frequency", 1.01 * least_Hz, 0.0);
    TEST_ASSERT_FALSE(is_large_defect(&regression, x));
    x->term[0].value = 0.99 * least_Hz;
    TEST_ASSERT_TRUE(is_large_defect(&regression, x));
    use[2] = true; /* at 10 rad/s it shows */
    TEST_ASSERT_FALSE(is_large_defect(&regression, x));
    use[2] = false;
    cogging[1].cosine = 0.05; /* the other one is the larger now, and hidden all the more */
    x->term[0].value = 1.99 * least_Hz;
    TEST_ASSERT_TRUE(is_large_defect(&regression, x));
}

/* Three times what is expected, either way, and a lag of a turn, 0.2513 s. */
static void test_a_large_defect(void)
{
    hci_candidate *gain = add("current_gain", "a", 0.299, 0.1);
    TEST_ASSERT_EQUAL_UINT64(1, large_defect(&regression, &model));
    gain->term[0].value = -0.301;
    TEST_ASSERT_EQUAL_UINT64(0, large_defect(&regression, &model));
    gain->in = false;
    TEST_ASSERT_EQUAL_UINT64(1, large_defect(&regression, &model));
    gain->in = true, gain->deviation = 0.0;
    TEST_ASSERT_EQUAL_UINT64(1, large_defect(&regression, &model));
    hci_candidate *lag = add("torque_sensor", "time_constant", 0.251, 0.0);
    TEST_ASSERT_EQUAL_UINT64(2, large_defect(&regression, &model));
    lag->term[0].value = 0.252;
    TEST_ASSERT_EQUAL_UINT64(1, large_defect(&regression, &model));
    lag->type = type("friction"), lag->term[0] = (hci_effect_term){0, 0.0, 9.0, NAN}, lag->deviation = 0.1;
    TEST_ASSERT_EQUAL(type("friction")->is_small, is_large_defect(&regression, lag));
}

/* Decisively, by the noise of now and by white noise. */
static void test_which_model_is_better(void)
{
    const merit than = {100.0, -50.0};
    TEST_ASSERT_TRUE(is_better(&(merit){110.1, -60.1}, &than));
    TEST_ASSERT_FALSE(is_better(&(merit){109.9, -90.0}, &than) || is_better(&(merit){190.0, -59.9}, &than));
}

/* What both have stays, but for the culprit. */
static void test_what_leaves_with_a_model(void)
{
    hci_candidate other[2];
    hci_disbelieved better = {.type = type("back_emf")};
    memset(other, 0, sizeof other);
    other[0] = (hci_candidate){.type = type("back_emf"), .count = 1, .in = true};
    other[1] = (hci_candidate){.type = type("friction"), .count = 1, .in = true};
    better.model.candidates = (hci_candidates){.candidate = other, .count = 2};
    add("friction", "coulomb", 0.1, 0.0);
    TEST_ASSERT_FALSE(others_remove(&better, &model));
    TEST_ASSERT_TRUE(hci_candidates_have(&model, type("friction")));
    add("cogging", "sine", 0.1, 0.0);
    add("back_emf", "sine", 0.1, 0.0);
    TEST_ASSERT_TRUE(others_remove(&better, &model));
    TEST_ASSERT_TRUE(hci_candidates_have(&model, type("friction")));
    TEST_ASSERT_FALSE(hci_candidates_have(&model, type("cogging")) ||
                      hci_candidates_have(&model, type("back_emf")));
}

/* What a series describes besides leaves a model that it would stand in for. */
static void test_parts_of_a_series(void)
{
    add("friction", "coulomb", 0.1, 0.0);
    add("back_emf", "sine", 0.1, 0.0);
    parts_of_series_leave(&model);
    TEST_ASSERT_EQUAL(!type("back_emf")->in_series, hci_candidates_have(&model, type("back_emf")));
    TEST_ASSERT_EQUAL(!type("friction")->in_series, hci_candidates_have(&model, type("friction")));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_longest_turn);
    RUN_TEST(test_the_lag_of_a_sensor);
    RUN_TEST(test_a_resonance_that_hides_the_cogging_torque);
    RUN_TEST(test_a_large_defect);
    RUN_TEST(test_which_model_is_better);
    RUN_TEST(test_what_leaves_with_a_model);
    RUN_TEST(test_parts_of_a_series);
    return UNITY_END();
}
