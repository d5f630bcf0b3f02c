/* What a model leaves of the sum of the currents, and that it makes a small defect of a current sensor count.
 */
#define _XOPEN_SOURCE 700
#include "host/diagnose/fit/current_sums.h"

#include "support/searching.h"

enum { N = 600 };

static const double READ_A = 0.005, OFFSET_A = 0.002, ZERO_A[3] = {0.3, -0.1, 0.05};

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* There and back at 9 A, sensors with noise, that of phase a with an offset that makes no torque to speak of.
 */
static void record_offset(double offset_A)
{
    for (size_t r = 0; r < 2; ++r) {
        record(N, &(point){r ? -60.0 : 60.0, 9.0, offset_A, 0.0, 0.0});
        run[r].has_sum = true;
        for (size_t k = 0; k < 3 * N; ++k)
            run[r].i_A[k] += READ_A * ref_normal(&seed);
    }
    search_start();
    model_add("current_offset", "a", NULL, 0.0);
}

static void test_an_offset_is_left_and_taken(void)
{
    static const hci_effects none = {NULL, 0};
    const hci_effect_type *type = hci_effect_type_find("current_offset");
    hci_effect_term a = {parameter_of(type, "a"), 0.0, 0.05, NAN};
    const hci_effect offset = {type, &a, 1};
    const hci_effects known = {&offset, 1};
    const double noise_A = sqrt(3.0) * READ_A;
    record_offset(0.05);
    const double left = hypot(1.0, 0.05 / noise_A);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * left, left, hci_current_sums_rms(&dataset.regression, &none));
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 1.0, hci_current_sums_rms(&dataset.regression, &known));
}

static void test_nothing_where_there_is_no_sum(void)
{
    static const hci_effects none = {NULL, 0};
    record(N, &(point){60.0, 9.0, 0.05, 0.0, 0.0});
    search_start();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_current_sums_rms(&dataset.regression, &none));
}

/* A quarter of the noise of a sum, and less than a twentieth of that of a torque. */
static void test_what_shows_in_the_sum_is_noticeable(void)
{
    hci_candidates empty = {0};
    double explained_Nm = 1.0;
    bool noticeable = false;
    record_offset(OFFSET_A);
    model_fit();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_search_explained(&search, &model.candidates, &empty, &explained_Nm, &note));
    TEST_ASSERT_TRUE(explained_Nm < 0.05 * NOISE_NM);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_search_noticeable(&search, &model.candidates, &empty, &noticeable, &note));
    TEST_ASSERT_TRUE(noticeable);
}

/* Two sensors that read 0.5 % too much and 0.2 % too little, beside noise. */
static void record_gains(void)
{
    static const double GAIN[3] = {0.005, -0.002, 0.0};
    for (size_t r = 0; r < 2; ++r) {
        record(N, &(point){r ? -60.0 : 60.0, 9.0, 0.0, 0.0, 0.0});
        run[r].has_sum = true;
        for (size_t k = 0; k < 3 * N; ++k)
            run[r].i_A[k] = (1.0 + GAIN[k % 3]) * run[r].i_A[k] + READ_A * ref_normal(&seed);
    }
    search_start();
}

/* A common factor of all currents makes less noise of their sum, which says nothing of the currents. */
static void test_a_common_gain_leaves_as_much_of_the_sum(void)
{
    const hci_effect_type *type = hci_effect_type_find("current_gain");
    hci_effect_term term[3];
    const hci_effect gains = {type, term, 3};
    const hci_effects known = {&gains, 1};
    record_gains();
    for (size_t s = 0; s < 3; ++s)
        term[s] = (hci_effect_term){s, 0.0, (const double[]){0.005, -0.002, 0.0}[s], NAN};
    const double left = hci_current_sums_rms(&dataset.regression, &known);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 1.0, left);
    for (size_t s = 0; s < 3; ++s)
        term[s].value = 1.3 * (1.0 + term[s].value) - 1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, left, hci_current_sums_rms(&dataset.regression, &known));
}

/* Where a back-EMF of any size makes up for it, what is expected of sensors tells what they have in common.
 */
static void test_a_common_gain_is_as_expected(void)
{
    static const char *const PHASE[3] = {"a", "b", "c"};
    double sum = 0.0;
    record_gains();
    model_add("back_emf", "sine", NULL, 1.0);
    for (int s = 0; s < 3; ++s) {
        hci_candidate x = candidate_of("current_gain", PHASE[s], NULL, 0.0);
        x.deviation = 0.1;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&model.candidates, &x, &note));
    }
    model_fit();
    model_fit();
    for (int s = 0; s < 3; ++s)
        sum += term_in(&model.candidates, "current_gain", PHASE[s], 0.0)->value;
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, sum / 3.0);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.007,
                              term_in(&model.candidates, "current_gain", "a", 0.0)->value -
                                  term_in(&model.candidates, "current_gain", "b", 0.0)->value);
}

/* Readings that are smoothed are not as noisy as their sum, which then says no more of a gain. */
static void test_smooth_readings_tell_no_gain(void)
{
    static const char *const PHASE[3] = {"a", "b", "c"};
    for (size_t r = 0; r < 2; ++r) {
        record(N, &(point){r ? -60.0 : 60.0, 0.5, 0.0, 0.0, 0.0});
        run[r].has_sum = true;
        for (size_t k = 0; k < 3 * N; ++k)
            run[r].i_A[k] += 40.0 * READ_A * ref_normal(&seed);
    }
    search_start();
    for (size_t k = 0; k < dataset.samples.count; ++k) {
        hci_sample *x = &dataset.samples.sample[k].reading;
        rec_phases(0.0, 0.5, P * x->theta_m_rad, x->i_abc);
    }
    for (int s = 0; s < 3; ++s) {
        hci_candidate x = candidate_of("current_gain", PHASE[s], NULL, 0.0);
        x.deviation = 0.1;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&model.candidates, &x, &note));
    }
    model_fit();
    model_fit();
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(0.05, 0.0,
                                  term_in(&model.candidates, "current_gain", PHASE[s], 0.0)->value);
}

/* Four runs in which nothing flows and each sensor reads its zero, one of them drifted, beside a run at 9 A.
 */
static void record_zeros(double drift, double torque_noise_Nm)
{
    for (size_t r = 0; r < 5; ++r) {
        record(4 * N, &(point){r % 2 ? -60.0 : 60.0, r < 4 ? 0.0 : 9.0, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 12 * N && r < 4; ++k)
            run[r].i_A[k] = (r == 3 ? drift : 1.0) * ZERO_A[k % 3] + READ_A * ref_normal(&seed);
        for (size_t k = 0; k < 12 * N && r == 4; ++k)
            run[r].i_A[k] += ZERO_A[k % 3];
        for (size_t k = 0; k < 4 * N && torque_noise_Nm > 0.0; ++k)
            run[r].torque_Nm[k] += torque_noise_Nm * ref_normal(&seed);
    }
    search_start();
}

/* In units of 5 % of the zeros, (|0.3, -0.1, 0.05| A): each run leaves three readings, and with the right
 * offsets nothing but the drift of the last. */
static void test_zeros_are_left_and_taken(void)
{
    static const hci_effects none = {NULL, 0};
    const hci_effect_type *type = hci_effect_type_find("current_offset");
    hci_effect_term term[3];
    const hci_effect offset = {type, term, 3};
    const hci_effects known = {&offset, 1};
    for (size_t s = 0; s < 3; ++s)
        term[s] = (hci_effect_term){s, 0.0, ZERO_A[s], NAN};
    record_zeros(1.1, 0.0);
    const double left = 20.0 * sqrt((3.0 + 1.0) / 4.0 / 3.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * left, left, hci_current_zeros_rms(&dataset.regression, &none));
    const double drift = 20.0 * (0.1 / 1.1) * sqrt(1.0 / 12.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * drift, drift, hci_current_zeros_rms(&dataset.regression, &known));
    TEST_ASSERT_EQUAL_UINT64(
        0, hci_current_zeros_left(&dataset.regression, &none, hci_segment_next(&dataset.samples, 4, NULL))
               .count);
}

/* A phase that was computed from the others has no sensor, and no zero. */
static void test_zeros_of_two_sensors(void)
{
    static const hci_effects none = {NULL, 0};
    record_zeros(1.0, 0.0);
    const hci_segment *s = hci_segment_next(&dataset.samples, 0, NULL);
    TEST_ASSERT_EQUAL_UINT64(3, hci_current_zeros_left(&dataset.regression, &none, s).count);
    dataset.samples.sample[s->first].reading.computed_phase = 2;
    const hci_current_zeros left = hci_current_zeros_left(&dataset.regression, &none, s);
    TEST_ASSERT_EQUAL_UINT64(2, left.count);
    TEST_ASSERT_EQUAL_UINT64(0, left.phase[0]);
    TEST_ASSERT_EQUAL_UINT64(2, left.phase[1]);
}

static void expect_offsets(void)
{
    static const char *const PHASE[3] = {"a", "b", "c"};
    for (int s = 0; s < 3; ++s)
        model_add("current_offset", PHASE[s], NULL, 0.0);
    model_fit();
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(0.02, ZERO_A[s],
                                  term_in(&model.candidates, "current_offset", PHASE[s], 0.0)->value);
}

/* The torque is without what these readings would make. */
static void test_a_fit_finds_the_zeros(void)
{
    record_zeros(1.0, 0.0);
    expect_offsets();
}

/* A torque with noise of 30 N·m tells an offset to 30/(0.2 √(10 N)) = 2 A: what finds them are the zeros. */
static void test_the_zeros_alone_find_the_offsets(void)
{
    record_zeros(1.0, 30.0);
    expect_offsets();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_offset_is_left_and_taken);
    RUN_TEST(test_nothing_where_there_is_no_sum);
    RUN_TEST(test_what_shows_in_the_sum_is_noticeable);
    RUN_TEST(test_a_common_gain_leaves_as_much_of_the_sum);
    RUN_TEST(test_a_common_gain_is_as_expected);
    RUN_TEST(test_smooth_readings_tell_no_gain);
    RUN_TEST(test_zeros_are_left_and_taken);
    RUN_TEST(test_zeros_of_two_sensors);
    RUN_TEST(test_a_fit_finds_the_zeros);
    RUN_TEST(test_the_zeros_alone_find_the_offsets);
    return UNITY_END();
}
