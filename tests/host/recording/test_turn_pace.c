/* The pace of a shaft over a part of a recording: the slope of its time over its angle, by least squares. */
#include "host/recording/turn_ways.c"

#include "unity.h"

enum { ROWS = 9 };

static double time_s[ROWS], theta_rad[ROWS];
static hci_run run;

void setUp(void)
{
}

void tearDown(void)
{
}

/* Of rows that are on no line, by the sums Σ x t and Σ x² about the means; wherever time and angle begin. */
static void test_the_slope_of_the_time(void)
{
    static const double T[5] = {0.0, 0.9, 2.3, 2.8, 4.5}, X[5] = {0.0, 2.0, 4.0, 7.0, 8.0};
    double t = 0.0, x = 0.0, tx = 0.0, xx = 0.0;
    for (int k = 0; k < 5; ++k)
        t += T[k] / 5.0, x += X[k] / 5.0;
    for (int k = 0; k < 5; ++k) {
        tx += (T[k] - t) * (X[k] - x);
        xx += (X[k] - x) * (X[k] - x);
    }
    for (int far = 0; far < 2; ++far)
        for (int way = -1; way <= 1; way += 2) {
            for (int k = 0; k < ROWS; ++k) {
                const int n = k - 2 < 0 ? 0 : k - 2 > 4 ? 4 : k - 2;
                time_s[k] = T[n] + (far ? 700.0 : 0.0);
                theta_rad[k] = way * X[n] - (far ? 90.0 : 0.0);
            }
            run = (hci_run){.count = ROWS, .time_s = time_s, .theta_m_rad = theta_rad};
            const part a = {.first = 2, .end = 7};
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, way * tx / xx, pace_of(&run, &a));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_slope_of_the_time);
    return UNITY_END();
}
