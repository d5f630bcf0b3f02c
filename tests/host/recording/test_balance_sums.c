/* The inertia that makes slow turns agree, against sums by hand: J = Σ ΔαΔM/ΣΔα² about the means of the ways,
 * whatever the units. */
#include "host/recording/turn_balance.h"

#include <math.h>
#include <string.h>

#include "unity.h"

enum { HIGHEST = 4 };

static const double CONSTANT = 0.5;
static hci_way_order forward[HIGHEST + 1], backward[HIGHEST + 1];
static hci_turn_ways ways;

/* What differs between forward and backward, of orders 1 to 4, sine and cosine. */
static const double ALPHA[2 * HIGHEST] = {1.0, -0.5, 0.3, 0.7, -0.9, 0.2, 0.4, 0.1},
                              OFF[2 * HIGHEST] = {0.01, -0.02, 0.015, 0.005, 0.02, -0.01, -0.015, 0.01};

void setUp(void)
{
}

void tearDown(void)
{
}

/* Ways that differ by J α k and a share that is off; T is common. scale: of accelerations. */
static void fill(double inertia, double scale, double off)
{
    memset(forward, 0, sizeof forward);
    memset(backward, 0, sizeof backward);
    ways = (hci_turn_ways){.scale = 1.0, .highest = HIGHEST};
    ways.way[0] = (hci_way){.speed_rad_per_s = 1.0, .order = forward, .any = true};
    ways.way[1] = (hci_way){.speed_rad_per_s = -1.0, .order = backward, .any = true};
    for (int k = 1; k <= HIGHEST; ++k)
        for (int c = 0; c < 2; ++c) {
            const double alpha = scale * ALPHA[2 * (k - 1) + c],
                         iq = inertia * (alpha + off * scale * OFF[2 * (k - 1) + c]) / CONSTANT;
            forward[k].time_s.stands_out = true;
            *(c ? &forward[k].alpha_cosine : &forward[k].alpha_sine) = 0.1 * scale + 0.5 * alpha;
            *(c ? &backward[k].alpha_cosine : &backward[k].alpha_sine) = 0.1 * scale - 0.5 * alpha;
            *(c ? &forward[k].iq_A.cosine : &forward[k].iq_A.sine) = 0.3 + 0.5 * iq;
            *(c ? &backward[k].iq_A.cosine : &backward[k].iq_A.sine) = 0.3 - 0.5 * iq;
        }
}

/* Of two ways the sums about their mean are half of those of the differences. */
static void sums(double off, double *slope, double *error)
{
    double alpha2 = 0.0, product = 0.0, made2 = 0.0;
    for (int k = 0; k < 2 * HIGHEST; ++k) {
        const double made = ALPHA[k] + off * OFF[k];
        alpha2 += 0.5 * ALPHA[k] * ALPHA[k];
        product += 0.5 * ALPHA[k] * made;
        made2 += 0.5 * made * made;
    }
    *slope = product / alpha2;
    *error = sqrt((made2 - *slope * product) / (2 * HIGHEST - 1) / alpha2);
}

static void test_values_and_errors(void)
{
    static const double SCALE[] = {1e-3, 1.0, 1e4};
    double slope, expected_error;
    sums(3.0, &slope, &expected_error);
    for (int s = 0; s < 3; ++s) {
        double error = NAN;
        fill(2e-4, SCALE[s], 3.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4 * slope, hci_balance_inertia(&ways, 1, CONSTANT, &error));
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 2e-4 * expected_error, error);
        TEST_ASSERT_TRUE(hci_balance_inertia(&ways, 1, CONSTANT, NULL) > 0.0);
    }
}

/* An error of a tenth of the inertia is too much; just less is not. */
static void test_how_well_it_is_told(void)
{
    double slope, error, at = 1.0;
    for (double step = 64.0; step > 1e-6; step *= 0.5) {
        sums(at + step, &slope, &error);
        if (error < 0.1 * slope) at += step;
    }
    fill(1.0, 1.0, 0.999 * at);
    TEST_ASSERT_TRUE(hci_balance_inertia(&ways, 1, CONSTANT, NULL) > 0.0);
    fill(1.0, 1.0, 1.001 * at);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(&ways, 1, CONSTANT, NULL));
}

/* Between the slope of currents over accelerations and that of the other regression, three errors beyond. */
static void test_bounds(void)
{
    double slope, error, low = NAN, high = NAN, made2 = 0.0, product = 0.0;
    sums(3.0, &slope, &error);
    for (int k = 0; k < 2 * HIGHEST; ++k) {
        const double made = ALPHA[k] + 3.0 * OFF[k];
        product += ALPHA[k] * made;
        made2 += made * made;
    }
    fill(2e-4, 1e-2, 3.0);
    TEST_ASSERT_TRUE(hci_balance_bounds(&ways, CONSTANT, &low, &high));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4 * (slope - 3.0 * error), low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4 * made2 / product * (1.0 + 3.0 * error / slope), high);
}

/* One way, orders that do not move, currents against the motion: nothing is told. */
static void test_what_tells_nothing(void)
{
    double low, high;
    fill(2e-4, 1.0, 1.0);
    ways.way[1].any = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(&ways, 1, CONSTANT, NULL));
    TEST_ASSERT_FALSE(hci_balance_bounds(&ways, CONSTANT, &low, &high));
    fill(2e-4, 1.0, 1.0);
    for (int k = 0; k <= HIGHEST; ++k)
        forward[k].time_s.stands_out = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(&ways, 1, CONSTANT, NULL));
    fill(-2e-4, 1.0, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(&ways, 1, CONSTANT, NULL));
    TEST_ASSERT_FALSE(hci_balance_bounds(&ways, CONSTANT, &low, &high));
}

/* Turns of another length are not compared, and of several the orders that all have. */
static void test_several_runs(void)
{
    hci_turn_ways both[2];
    fill(2e-4, 1.0, 0.0);
    both[0] = both[1] = ways;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4, hci_balance_inertia(both, 2, CONSTANT, NULL));
    both[1].scale = 7.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(both, 2, CONSTANT, NULL));
    both[1].scale = 1.0;
    both[1].highest = HIGHEST - 1;
    forward[HIGHEST].iq_A.sine = 1e3; /* beyond the orders of the second */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4, hci_balance_inertia(both, 2, CONSTANT, NULL));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(both, 1, CONSTANT, NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_and_errors);
    RUN_TEST(test_how_well_it_is_told);
    RUN_TEST(test_bounds);
    RUN_TEST(test_what_tells_nothing);
    RUN_TEST(test_several_runs);
    return UNITY_END();
}
