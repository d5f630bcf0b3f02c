/* Which orders of a solution can be seen, after how many turns what is seen repeats, and what is drawn of it:
 * against the waves themselves, of motors of any size. */
#include "host/plot/solution_curves.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/expected_ripple.h"
#include "support/reference.h"
#include "unity.h"

static hci_wave wave[3];
static hci_solved_order order[3];
static hci_solution solution;
static hci_solution_curves curves;

void setUp(void)
{
    memset(order, 0, sizeof order);
    wave[0] = hci_wave_polar(1.0, 1, 10.0, 0.4);
    wave[1] = hci_wave_polar(5.0, -1, 2.0, 1.0);
    order[0].torque_Nm = hci_harmonic_polar(0.0, 2.0, 0.0);
    order[1].torque_Nm = hci_harmonic_polar(6.0, 0.3, 0.2);
    solution = (hci_solution){.order = order, .order_count = 2, .period_turns = 1};
    solution.current = (hci_currents){.wave = wave, .count = 2};
    solution.plain = hci_wave_polar(1.0, 1, 9.0, 0.0);
}

void tearDown(void)
{
}

static double top(void)
{
    hci_solution_curves_fill(&curves, &solution);
    return curves.top_order;
}

/* Two thousandths of the largest torque and current are seen, whatever their size. */
static void test_what_is_seen(void)
{
    for (int small = 0; small < 2; ++small)
        for (int seen = 0; seen < 2; ++seen) {
            const double size = small ? 1e-4 : 1.0, share = seen ? 2.1e-3 : 1.9e-3;
            wave[0] = hci_wave_polar(1.0, 1, 10.0 * size, 0.4);
            wave[1] = hci_wave_polar(17.0, -1, 10.0 * size * share, 1.0);
            order[0].torque_Nm = hci_harmonic_polar(0.0, 2.0 * size, 0.0);
            order[1].torque_Nm = hci_harmonic_polar(6.0, 0.3 * size, 0.2);
            TEST_ASSERT_EQUAL_DOUBLE(seen ? 17.0 : 6.0, top());
            wave[1] = hci_wave_polar(5.0, -1, 2.0 * size, 1.0);
            order[1].torque_Nm = hci_harmonic_polar(24.0, 2.0 * size * share, 0.2);
            TEST_ASSERT_EQUAL_DOUBLE(seen ? 24.0 : 5.0, top());
        }
}

/* Of an order the largest of what is wanted, made and was before. */
static void test_the_largest_of_an_order(void)
{
    order[1].torque_Nm = hci_harmonic_polar(6.0, 0.0, 0.0);
    order[1].target_Nm = hci_harmonic_polar(6.0, 0.7, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, hci_order_largest_Nm(&order[1]));
    order[1].before_Nm = hci_harmonic_polar(6.0, 0.9, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.9, hci_order_largest_Nm(&order[1]));
    order[0].torque_Nm = (hci_harmonic){0.0, 3.0, -2.0};
    TEST_ASSERT_EQUAL_DOUBLE(2.0, hci_peak_Nm(order[0].torque_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, hci_peak_Nm((hci_harmonic){1.0, 3.0, -4.0}));
}

/* The turns after which what is seen repeats: of orders in thirds three of the six of the period; of those
 * that are too small, one. */
static void test_turns_that_are_drawn(void)
{
    solution.period_turns = 6;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, (top(), curves.turns));
    wave[2] = hci_wave_polar(4.0 / 3.0, 1, 1.0, 0.0);
    solution.current.count = 3;
    TEST_ASSERT_EQUAL_DOUBLE(3.0, (top(), curves.turns));
    wave[2] = hci_wave_polar(4.0 / 3.0, 1, 0.019, 0.0); /* of 10 A */
    TEST_ASSERT_EQUAL_DOUBLE(1.0, (top(), curves.turns));
    order[2].torque_Nm = hci_harmonic_polar(1.5, 0.0031, 0.0); /* of 0.3 N·m */
    solution.order_count = 3;
    TEST_ASSERT_EQUAL_DOUBLE(2.0, (top(), curves.turns));
    order[2].torque_Nm = hci_harmonic_polar(1.5, 0.0029, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, (top(), curves.turns));
    hci_solution_curves_fill_period(&curves, &solution);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, curves.turns);
}

/* Of twelve turns that differ three are drawn, or those in which the slowest ripple comes once; of eight all.
 */
static void test_few_of_many_turns(void)
{
    static const struct {
        double order;
        size_t period;
        double turns;
    } CASE[] = {{13.0 / 12.0, 12, 3.0},
                {1.0 / 5.0, 12, 5.0},
                {7.0 / 12.0, 12, 3.0},
                {9.0 / 8.0, 8, 8.0},
                {1.0 / 12.0, 12, 12.0}};
    solution.order_count = 3;
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        solution.period_turns = CASE[k].period;
        order[2].torque_Nm = hci_harmonic_polar(CASE[k].order, 0.2, 0.0);
        hci_solution_curves_fill(&curves, &solution);
        TEST_ASSERT_EQUAL_DOUBLE(CASE[k].turns, curves.turns);
    }
}

/* Eight samples of the highest order, 2 to 64 a step; fewer turns where these are not enough. */
static void test_samples_of_a_step(void)
{
    static const struct {
        double order;
        size_t period;
        double turns;
        size_t fine;
    } CASE[] = {{6.0, 1, 1.0, 2},
                {120.0, 1, 1.0, 3},
                {2000.0, 1, 1.0, 45},
                {2000.0, 4, 1.0, 45},
                {700.0, 6, 4.0, 63}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        order[1].torque_Nm = hci_harmonic_polar(CASE[k].order, 0.3, 0.2);
        solution.period_turns = CASE[k].period;
        hci_solution_curves_fill_period(&curves, &solution);
        TEST_ASSERT_EQUAL_DOUBLE(CASE[k].turns, curves.turns);
        TEST_ASSERT_EQUAL_UINT64(CASE[k].fine, curves.fine);
    }
}

/* Each step has the extremes of its samples in the order in which they come; the end is that of the turns. */
static void test_values_of_the_curves(void)
{
    order[1].before_Nm = hci_harmonic_polar(6.0, 0.5, 1.0);
    order[1].target_Nm = hci_harmonic_polar(6.0, 0.1, 2.0);
    hci_solution_curves_fill(&curves, &solution);
    TEST_ASSERT_EQUAL_UINT64(2, curves.fine);
    for (size_t k = 0; k <= 2 * HCI_CURVE_COLUMNS; ++k) {
        const double theta = REF_PI * (double)k / HCI_CURVE_COLUMNS;
        double abc[3];
        hci_waves_at(wave, 2, theta, abc);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 + hci_harmonics_at(&order[1].torque_Nm, 1, theta),
                                  curves.value[HCI_CURVE_AFTER][k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_harmonics_at(&order[1].before_Nm, 1, theta),
                                  curves.value[HCI_CURVE_BEFORE][k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_harmonics_at(&order[1].target_Nm, 1, theta),
                                  curves.value[HCI_CURVE_WANTED][k]);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, abc[s], curves.value[HCI_CURVE_PHASE_A + s][k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0 * sin(theta), curves.value[HCI_CURVE_PLAIN_A][k]);
    }
}

/* A step of many samples has its lowest and highest, whichever comes first. */
static void test_extremes_of_a_step(void)
{
    order[1].torque_Nm = hci_harmonic_polar(1439.0, 0.3, 0.2);
    hci_solution_curves_fill(&curves, &solution);
    TEST_ASSERT_EQUAL_UINT64(32, curves.fine);
    for (size_t k = 0; k < HCI_CURVE_COLUMNS; ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        size_t low_at = 0, high_at = 0;
        for (size_t j = 0; j < 32; ++j) {
            const double x =
                2.0 +
                0.3 * sin(1439.0 * 2.0 * REF_PI * ((double)k + (double)j / 32.0) / HCI_CURVE_COLUMNS + 0.2);
            if (x < low - 1e-9) low = x, low_at = j;
            if (x > high + 1e-9) high = x, high_at = j;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, low_at < high_at ? low : high, curves.value[HCI_CURVE_AFTER][2 * k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, low_at < high_at ? high : low,
                                  curves.value[HCI_CURVE_AFTER][2 * k + 1]);
    }
}

static void is_range(double low, double high, hci_range r)
{
    TEST_ASSERT_DOUBLE_WITHIN(2e-3 * (high - low), low, r.low);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3 * (high - low), high, r.high);
}

/* Of the torque with half of what is to be expected of the machine on both sides of what is made. */
static void test_ranges(void)
{
    solution.current.count = 1;
    hci_solution_curves_fill(&curves, &solution);
    is_range(0.0, 2.3, hci_curve_torque_range(&curves)); /* nothing was before */
    is_range(1.7, 2.3, hci_curve_range(curves.value[HCI_CURVE_AFTER]));
    is_range(-10.0, 10.0, hci_curve_current_range(&curves));
    solution.plain = hci_wave_polar(1.0, 1, 12.0, 0.0);
    hci_solution_curves_fill(&curves, &solution);
    is_range(-12.0, 12.0, hci_curve_current_range(&curves));
}

/* A fundamental stands still in the frame of the rotor; one of order 5 against it goes round. */
static void test_vectors(void)
{
    hci_plot_facts f;
    memset(&f, 0, sizeof f);
    wave[0] = hci_wave_polar(1.0, 1, 10.0, 0.0);
    hci_solution_curves_fill(&curves, &solution);
    const size_t count = hci_curve_vectors(&curves);
    TEST_ASSERT_EQUAL_UINT64(HCI_CURVE_VERTICES, count);
    const hci_dq quarter = hci_curve_vector_sample(&curves, count / 4, count),
                 by_angle = hci_curve_vector(wave, 2, 0.5 * REF_PI);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, by_angle.d, quarter.d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, by_angle.q, quarter.q);
    hci_curve_vector_ranges(&curves, &f);
    is_range(-2.0, 2.0, f.d_A);
    is_range(8.0, 12.0, f.q_A);
    solution.plain = hci_wave_polar(1.0, 1, 20.0, 0.0);
    is_range(-2.0, 20.0, hci_curve_dq_range(&curves));
    order[1].torque_Nm = hci_harmonic_polar(20.0, 0.3, 0.2);
    hci_solution_curves_fill(&curves, &solution);
    TEST_ASSERT_EQUAL_UINT64(64 * 20, hci_curve_vectors(&curves));
    order[1].torque_Nm = hci_harmonic_polar(200.0, 0.3, 0.2);
    hci_solution_curves_fill(&curves, &solution);
    TEST_ASSERT_EQUAL_UINT64(10 * HCI_CURVE_COLUMNS, hci_curve_vectors(&curves));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_seen);
    RUN_TEST(test_the_largest_of_an_order);
    RUN_TEST(test_turns_that_are_drawn);
    RUN_TEST(test_few_of_many_turns);
    RUN_TEST(test_samples_of_a_step);
    RUN_TEST(test_values_of_the_curves);
    RUN_TEST(test_extremes_of_a_step);
    RUN_TEST(test_ranges);
    RUN_TEST(test_vectors);
    return UNITY_END();
}
