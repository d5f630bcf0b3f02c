/* What a search tells of itself, and the figures that all its steps use, beside plain sums. */
#include "host/diagnose/search/search.c"

#include "support/searching.h"

enum { SAMPLES = 6 };

static struct {
    const char *doing;
    double share;
    int calls;
} told;

static void listen(void *context, const char *doing, double share)
{
    TEST_ASSERT_EQUAL_PTR(&told, context);
    told.doing = doing, told.share = share;
    ++told.calls;
}

void setUp(void)
{
    dataset_start();
    memset(&told, 0, sizeof told);
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* A fiftieth of what is left of the part, each time: it comes near its end and never there. */
static void test_progress_is_told(void)
{
    const hci_attribute_options options_here = {.progress = listen, .context = &told};
    hci_search s = {.options = &options_here};
    hci_search_begin(&s, "first", 0.2, 0.6);
    TEST_ASSERT_EQUAL_STRING("first", told.doing);
    TEST_ASSERT_TRUE(told.share == 0.2 && told.calls == 1);
    double left = 0.4;
    for (int k = 0; k < 50; ++k) {
        hci_search_tell(&s);
        left *= 0.98;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.6 - left, told.share);
    }
    TEST_ASSERT_EQUAL_INT(51, told.calls);
    TEST_ASSERT_TRUE(told.share < 0.6);
}

/* Of samples that tell something; those of joined bins have the noise of the narrow ones too. */
static void test_rms_of_residual_and_noise(void)
{
    hci_binned_sample sample[2 * SAMPLES] = {{.count = 1.0}};
    hci_segment segment[2] = {{.run = 0, .first = 0, .count = SAMPLES},
                              {.run = 1, .first = SAMPLES, .count = SAMPLES, .joined = 3.0}};
    hci_noise noise[2] = {hci_noise_white(0.2), hci_noise_white(0.5)};
    double residual[2 * SAMPLES], square = 0.0;
    bool use[2] = {true, true};
    for (size_t k = 0; k < 2 * SAMPLES; ++k) {
        sample[k].count = k == 3 ? 0.0 : 2.0;
        residual[k] = k == 3 ? 0.0 : 0.1 * (double)k - 0.4;
        square += residual[k] * residual[k];
    }
    const hci_binned_samples samples = {
        .sample = sample, .count = 2 * SAMPLES, .segment = segment, .segment_count = 2, .run_count = 2};
    hci_regression regression = {.samples = &samples, .use = use, .noise = noise};
    hci_search s = {.regression = &regression, .residual_Nm = residual};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt((square + 2.0 * 0.25 * 6.0) / 11.0), hci_search_residual_rms(&s));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt((5.0 * 0.04 + 3.0 * 6.0 * 0.25) / 11.0), hci_search_noise_rms(&s));
    use[1] = false;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, hci_search_noise_rms(&s));
    use[0] = false;
    TEST_ASSERT_TRUE(hci_search_noise_rms(&s) == 0.0 && hci_search_residual_rms(&s) == 0.0);
}

/* The rms of what a friction of known size makes: with values that are given, and its own fit. */
static void record_friction(double coulomb_Nm)
{
    for (int k = 0; k < 2; ++k)
        record(400, &(point){k ? -60.0 : 60.0, 3.0, 0.0, k ? -coulomb_Nm : coulomb_Nm, 0.0});
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
}

static void test_what_an_effect_explains(void)
{
    double explained = 0.0;
    hci_candidates none = {0};
    record_friction(0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_explained(&search, &model.candidates, &none, &explained, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, explained);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_explained_by(&search, &model, hci_effect_type_find("friction"),
                                                          &explained, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, explained);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_explained(&search, &none, &model.candidates, &explained, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, explained);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_search_explained_by(&search, &model, hci_effect_type_find("cogging"), &explained, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, explained);
}

static bool is_noticed(double coulomb_Nm, double resolution_Nm, bool with_itself)
{
    bool noticeable = false;
    const hci_candidates none = {0};
    record_friction(0.0);
    search.resolution_Nm = resolution_Nm;
    model.candidates.candidate[0].term[0].value = coulomb_Nm;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_search_residual(&search, &none, &note)); /* as those values make the torque */
    for (size_t k = 0; k < dataset.samples.count; ++k)
        dataset.samples.sample[k].torque_Nm -= k < dataset.samples.count / 2 ? coulomb_Nm : -coulomb_Nm;
    hci_known_residuals_release(&search.residuals);
    for (size_t k = 0; k < dataset.samples.segment_count; ++k)
        dataset.regression.noise[k] = hci_noise_white(0.01);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_search_noticeable(&search, &model.candidates,
                                                with_itself ? &model.candidates : &none, &noticeable, &note));
    tearDown();
    setUp();
    return noticeable;
}

/* Beside the noise and the resolution; what is in may always become more exact. */
static void test_what_is_noticeable(void)
{
    TEST_ASSERT_TRUE(is_noticed(1.3 * 0.05 * 0.01, 1e-6, false));
    TEST_ASSERT_FALSE(is_noticed(0.7 * 0.05 * 0.01, 1e-6, false));
    TEST_ASSERT_TRUE(is_noticed(0.05, 0.8 * 0.1, false));
    TEST_ASSERT_FALSE(is_noticed(0.05, 1.2 * 0.1, false));
    TEST_ASSERT_TRUE(is_noticed(0.05, 1.2 * 0.1, true));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_progress_is_told);
    RUN_TEST(test_rms_of_residual_and_noise);
    RUN_TEST(test_what_an_effect_explains);
    RUN_TEST(test_what_is_noticeable);
    return UNITY_END();
}
