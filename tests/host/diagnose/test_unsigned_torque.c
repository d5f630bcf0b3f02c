/* A display shows the size of the torque: in half of the runs it has the other sign than the machine's, and
 * no effect makes that. */
#include "support/diagnosing.h"

enum { N = 600 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Loads of both signs; with or without the sign of the torque. */
static void record_loads(bool sign)
{
    static const double CURRENT_A[] = {6.0, -8.0, 3.0, -5.0, 9.0, -7.0};
    for (int k = 0; k < 6; ++k) {
        record(N, &(point){k % 3 ? 40.0 : -60.0, CURRENT_A[k], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < N && !sign; ++j)
            run[k].torque_Nm[j] = fabs(run[k].torque_Nm[j]);
    }
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
}

static void test_a_torque_without_its_sign_is_no_effect(void)
{
    record_loads(false);
    TEST_ASSERT_TRUE(diagnosis.not_searched);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.slip, "the torque has no sign"));
}

static void test_with_its_sign_it_is_sound(void)
{
    record_loads(true);
    TEST_ASSERT_FALSE(diagnosis.not_searched);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_torque_without_its_sign_is_no_effect);
    RUN_TEST(test_with_its_sign_it_is_sound);
    return UNITY_END();
}
