/* Free shafts that hardly accelerate: a machine that makes no torque describes them, and nothing else is
 * told. */
#include "host/diagnose/search/belief.c"

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

/* Two loads of which so much of the torque of the currents is seen. */
static bool seen(hci_torque_source first, hci_torque_source second, double share)
{
    bool trivial = false;
    for (size_t r = 0; r < 2; ++r) {
        record(450, &(point){60.0, 5.0, 0.0, 0.0, 0.0});
        run[r].torque_source = r ? second : first;
        for (size_t k = 0; k < run[r].count; ++k)
            run[r].torque_Nm[k] = share * 1.5 * K_NM_PER_A * 5.0 + 1e-4 * ref_normal(&seed);
    }
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, is_trivial(&search, &trivial, &note));
    tearDown();
    setUp();
    return trivial;
}

static void test_shafts_that_hardly_accelerate(void)
{
    TEST_ASSERT_TRUE(seen(HCI_TORQUE_INERTIA, HCI_TORQUE_INERTIA, 0.0));
    TEST_ASSERT_FALSE(seen(HCI_TORQUE_INERTIA, HCI_TORQUE_INERTIA, 0.8)); /* they accelerate */
    TEST_ASSERT_FALSE(seen(HCI_TORQUE_MEASURED, HCI_TORQUE_MEASURED, 0.0));
    TEST_ASSERT_FALSE(seen(HCI_TORQUE_INERTIA, HCI_TORQUE_MEASURED, 0.0)); /* a sensor says it */
    TEST_ASSERT_FALSE(seen(HCI_TORQUE_MEASURED, HCI_TORQUE_INERTIA, 0.0));
    search_start();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_shafts_that_hardly_accelerate);
    return UNITY_END();
}
