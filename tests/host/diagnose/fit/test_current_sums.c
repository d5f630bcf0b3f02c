/* What a model leaves of the sum of the currents, and that it makes a small defect of a current sensor count.
 */
#define _XOPEN_SOURCE 700
#include "host/diagnose/fit/current_sums.h"

#include "support/searching.h"

enum { N = 600 };

static const double READ_A = 0.005, OFFSET_A = 0.002;

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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_offset_is_left_and_taken);
    RUN_TEST(test_nothing_where_there_is_no_sum);
    RUN_TEST(test_what_shows_in_the_sum_is_noticeable);
    return UNITY_END();
}
