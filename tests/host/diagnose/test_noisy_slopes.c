/* Free shafts, whose torque is inertia × acceleration: the noise of an angle that was differentiated twice is
 * as large as the torque, and nearly all of it is fast. */
#include "support/diagnosing.h"

#define SLOPE_NOISE_NM 1.0 /* rms of a sample */

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Four runs of both directions and two speeds, with second differences of white noise in the torque. */
static void record_free_shafts(double brake_Nm)
{
    static const double SPEED[] = {60.0, -60.0, 150.0, -150.0};
    for (int k = 0; k < 4; ++k) {
        record(4000, &(point){SPEED[k], k % 2 ? 4.0 : 1.0, 0.0, SPEED[k] < 0.0 ? -brake_Nm : brake_Nm, 0.0});
        run[k].torque_source = HCI_TORQUE_INERTIA;
        double before = 0.0, second = 0.0;
        for (size_t j = 0; j < run[k].count; ++j) {
            const double next = SLOPE_NOISE_NM / sqrt(6.0) * ref_normal(&seed);
            run[k].torque_Nm[j] += next - 2.0 * before + second;
            second = before;
            before = next;
        }
    }
    diagnose(NULL);
}

/* A friction of less than a twentieth of a sample's noise is eight of its standard errors beside what that
 * noise has of slow ones. */
static void test_friction_beside_the_noise_of_a_slope(void)
{
    record_free_shafts(0.04);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    const hci_effect_term *t = term("friction", "coulomb", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, 0.04, t->value);
    TEST_ASSERT_TRUE(t->std_error < 0.01);
}

static void test_noise_of_a_slope_is_no_effect(void)
{
    record_free_shafts(0.0);
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_friction_beside_the_noise_of_a_slope);
    RUN_TEST(test_noise_of_a_slope_is_no_effect);
    return UNITY_END();
}
