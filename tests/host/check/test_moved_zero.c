/* How far the ripple of one recording is from where it is in another. */
#include "host/check/moved_zero.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Ripples of two orders, one by so much of a turn further on than the other: where orders that currents make
 * are among them, less than a twentieth of a radian is no restart. */
static void test_how_far_a_ripple_is_moved(void)
{
    static check_run run[2];
    static const check_interpretation as = {.time = 1.0};
    static const check_model model = {.pole_pairs = 1.0};
    static const run_zeros z = {.as = &as, .model = &model};
    static const double SHIFT_rad[] = {0.04, 0.06, -0.04, -0.06};
    check_ripple_shift shift;
    run[0].path = "a.csv", run[1].path = "b.csv";
    for (int k = 0; k < 4; ++k) {
        for (int r = 0; r < 2; ++r) {
            run[r].ripple = (check_turn_ripple){.is_taken = true, .least = 0.5};
            for (int n = 30; n < 44; n += 7)
                run[r].ripple.wave[n] =
                    hci_check_turned((check_vector){0.6, 0.8}, r == 1 ? n * SHIFT_rad[k] : 0.0);
        }
        TEST_ASSERT_EQUAL(k % 2, is_shifted(&z, &run[0], &run[1], 0, UNLIKE, &shift));
        TEST_ASSERT_DOUBLE_WITHIN(0.004, SHIFT_rad[k], shift.shift_rad);
        TEST_ASSERT_TRUE(is_shifted(&z, &run[0], &run[1], 7, NOT_ALIKE, &shift));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_how_far_a_ripple_is_moved);
    return UNITY_END();
}
