/* After an attribution all that follows goes by the means again, known to the search or not. */
#include "host/diagnose/attribute/attribute.h"

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

/* Eight speeds without a current whose means no law says, and a cogging torque. */
static void test_means_count_again(void)
{
    static const double OFF_NM[] = {1.0, -1.0, -0.6, 1.1, 0.4, -0.9, -0.2, 0.8};
    hci_attribution a;
    for (size_t r = 0; r < 8; ++r) {
        record(450, &(point){60.0 + 30.0 * (double)r, 3.0, 0.0, 0.3 * OFF_NM[r], 0.0});
        for (size_t k = 0; k < 450; ++k)
            run[r].torque_Nm[k] += 0.1 * sin(6.0 * P * run[r].theta_m_rad[k]);
    }
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_attribute(&dataset.regression, &how, &a, &note));
    TEST_ASSERT_TRUE(a.means_open && a.unknown);
    TEST_ASSERT_FALSE(dataset.regression.free_means);
    TEST_ASSERT_FALSE(dataset.regression.raw);
    hci_attribution_release(&a);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_count_again);
    return UNITY_END();
}
