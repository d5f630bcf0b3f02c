/* What is left of long recordings and of short ones, summed by hand. */
#include "host/diagnose/search/noise_left.h"

#include "support/searching.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Of a run of a thousand samples and one of twelve, without any effect: all rows and all squares. */
static void test_all_samples_count(void)
{
    hci_noise_left left;
    double square_Nm2 = 0.0;
    record(1000, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    record(12, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    search_start();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_noise_left_find(&search, &model.candidates, &left, &note));
    for (size_t k = 0; k < dataset.samples.count; ++k)
        square_Nm2 += pow(search.residual_Nm[k], 2.0);
    TEST_ASSERT_EQUAL_DOUBLE((double)dataset.samples.count, left.rows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, square_Nm2, left.square_Nm2);
    TEST_ASSERT_DOUBLE_WITHIN(0.2 * square_Nm2, square_Nm2, left.noise_Nm2);
    TEST_ASSERT_TRUE(left.is_noise && !left.wanders);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_samples_count);
    return UNITY_END();
}
