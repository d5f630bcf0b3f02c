/* A measured response between its points, against loops in closed form: few exact points of a PI loop say all
 * of it, noise is averaged, and a loop of another kind is told by the ratio to the nearest one of this kind.
 */
#include "host/drive/response_curve.h"

#include <math.h>

#include "support/draws.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

enum { MOST = 128 };

static const double complex J = (double complex)I;
static const double T_s = 1e-4, HIGHEST = 0.8 * 31415.926535897932;

/* 1/(C H) of a PI loop; of another kind with a lag of its own, 1/(1 + jν lag). */
static double complex through(double nu, double kp, double ki, double delay_s, double lag_s)
{
    const double x = 0.5 * nu * T_s;
    const double complex z = cexp(J * nu * T_s), control = kp + ki * T_s / (z - 1.0);
    return (1.0 + J * nu * lag_s) / (control * sin(x) / x * cexp(-J * nu * delay_s));
}

/* Points from 20 Hz to 2.5 kHz. noise: of the weighted share. */
static hci_response_curve curve_of(hci_curve_point point[MOST], int n, double lag_s, double noise)
{
    uint64_t seed = 7;
    for (int k = 0; k < n; ++k) {
        const double nu = 125.66370614 * pow(125.0, (double)k / (n - 1));
        const double weight = fmin(1.0, nu / 3000.0);
        const double complex off =
            noise / weight * (ref_uniform(&seed, -1.0, 1.0) + J * ref_uniform(&seed, -1.0, 1.0));
        point[k] = (hci_curve_point){nu, through(nu, 1.0, 200.0, 1.7e-4, lag_s) * (1.0 + off), weight};
    }
    return hci_response_curve_of(point, (size_t)n, T_s);
}

/* Root mean square of weight·|curve/true − 1| between 20 Hz and 2.5 kHz. */
static double error_of(const hci_response_curve *c, double lag_s)
{
    double square = 0.0;
    for (int k = 0; k < 400; ++k) {
        const double nu = 125.66370614 * pow(125.0, k / 400.0), weight = fmin(1.0, nu / 3000.0);
        const double off = cabs(hci_response_curve_at(c, nu) / through(nu, 1.0, 200.0, 1.7e-4, lag_s) - 1.0);
        square += weight * weight * off * off / 400.0;
    }
    return sqrt(square);
}

static void test_four_exact_points_are_enough(void)
{
    static const int COUNT[] = {4, 5, 16, 128};
    static hci_curve_point point[MOST];
    for (int k = 0; k < 4; ++k) {
        const hci_response_curve c = curve_of(point, COUNT[k], 0.0, 0.0);
        TEST_ASSERT_TRUE(c.kind != HCI_CURVE_STRAIGHT);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, error_of(&c, 0.0));
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, c.error);
        /* beyond the points too */
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-5, 0.0,
            cabs(hci_response_curve_at(&c, HIGHEST) / through(HIGHEST, 1.0, 200.0, 1.7e-4, 0.0) - 1.0));
    }
}

/* A delay of less than half a step of those that are tried, and one between the last two. */
static void test_delays_at_the_ends(void)
{
    static const double DELAY_s[] = {0.0, 0.02e-4, 5.97e-4};
    static hci_curve_point point[MOST];
    for (int d = 0; d < 3; ++d) {
        for (int k = 0; k < 16; ++k) {
            const double nu = 125.66370614 * pow(125.0, k / 15.0);
            point[k] = (hci_curve_point){nu, through(nu, 1.0, 200.0, DELAY_s[d], 0.0), 1.0};
        }
        const hci_response_curve c = hci_response_curve_of(point, 16, T_s);
        TEST_ASSERT_TRUE(c.kind != HCI_CURVE_STRAIGHT);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * T_s, DELAY_s[d], c.loop.delay_s);
    }
}

/* What is said of the error is what it is, to a factor of three. */
static void test_noise_is_averaged_and_told(void)
{
    static const int COUNT[] = {8, 16, 32, 128};
    static hci_curve_point point[MOST];
    double last = HUGE_VAL;
    for (int k = 0; k < 4; ++k) {
        const hci_response_curve c = curve_of(point, COUNT[k], 0.0, 0.03);
        const double error = error_of(&c, 0.0);
        TEST_ASSERT_EQUAL_INT(HCI_CURVE_LOOP, c.kind);
        TEST_ASSERT_TRUE(c.error < 3.0 * error && error < 3.0 * c.error);
        TEST_ASSERT_TRUE(error < 1.2 * last);
        last = error;
    }
    TEST_ASSERT_TRUE(last < 0.005);
}

static void test_another_kind_of_loop_is_told_by_its_ratio(void)
{
    static hci_curve_point point[MOST];
    const hci_response_curve c = curve_of(point, 16, 3e-4, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_CURVE_RATIO, c.kind);
    const double ratio = error_of(&c, 3e-4);
    TEST_ASSERT_TRUE(ratio < 0.02);
    TEST_ASSERT_TRUE(c.error > ratio && c.error < 10.0 * ratio);
    hci_response_curve straight = c;
    straight.kind = HCI_CURVE_STRAIGHT;
    TEST_ASSERT_TRUE(error_of(&straight, 3e-4) > 2.0 * ratio);
    for (int k = 0; k < 16; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-9, 0.0, cabs(hci_response_curve_at(&c, point[k].rad_per_s) / point[k].through - 1.0));
}

/* Points above half the sampling tell nothing of such a loop. */
static void test_too_few_points_below_half_the_sampling_are_joined_straight(void)
{
    static hci_curve_point point[MOST];
    for (int k = 0; k < 6; ++k)
        point[k] = (hci_curve_point){1.3e4 * (k + 1), 1.0 + J * k, 1.0};
    const hci_response_curve c = hci_response_curve_of(point, 6, T_s);
    TEST_ASSERT_EQUAL_INT(HCI_CURVE_STRAIGHT, c.kind);
    TEST_ASSERT_TRUE(isnan(c.error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, cabs(hci_response_curve_at(&c, 1.95e4) - (1.0 + 0.5 * J)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, cabs(hci_response_curve_at(&c, 1.3e3) - 0.1));
}

/* Straight lines between the frequencies of the grid, from 0, are what a controller reads. */
static void test_the_grid_is_read_by_straight_lines(void)
{
    static hci_curve_point point[MOST];
    double grid[256];
    const hci_response_curve c = curve_of(point, 8, 0.0, 0.0), both[2] = {c, c};
    const size_t n = hci_response_curve_grid(both, HIGHEST, 256, grid);
    TEST_ASSERT_TRUE(n >= 2 && n < 256);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * HIGHEST, HIGHEST, grid[n - 1]);
    const double most = cabs(hci_response_curve_at(&c, HIGHEST));
    size_t k = 0;
    for (double nu = 5.0; nu < grid[n - 1]; nu += 5.0) {
        while (grid[k] < nu)
            ++k;
        const double low = k > 0 ? grid[k - 1] : 0.0, way = (nu - low) / (grid[k] - low);
        const double complex a = k > 0 ? hci_response_curve_at(&c, low) : 0.0,
                             b = hci_response_curve_at(&c, grid[k]), x = hci_response_curve_at(&c, nu);
        /* asked for at the eighths of a line: a parabola is off by no more than 64/63 of that between them */
        TEST_ASSERT_TRUE(cabs(a + way * (b - a) - x) < 64.0 / 63.0 * 1e-3 * fmax(cabs(x), 0.05 * most));
    }
    /* fewer than it takes are as good as they can be */
    TEST_ASSERT_TRUE(hci_response_curve_grid(both, HIGHEST, 12, grid) <= 12);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * HIGHEST, HIGHEST,
                              grid[hci_response_curve_grid(both, HIGHEST, 12, grid) - 1]);
}

static size_t points_with(double wiggle)
{
    static hci_curve_point point[24];
    double grid[256];
    point[0] = (hci_curve_point){1e3, 1.0, 1.0};
    for (int k = 1; k < 24; ++k)
        point[k] = (hci_curve_point){2e3 + 50.0 * k, 1e-6 + (k % 2 ? wiggle : 0.0), 1.0};
    const hci_response_curve c = {
        .point = point, .count = 24, .usable = 24, .sample_s = T_s, .kind = HCI_CURVE_STRAIGHT};
    const hci_response_curve both[2] = {c, c};
    return hci_response_curve_grid(both, 3.1e3, 256, grid);
}

/* 2e-5 of the largest, against 1e-3 of a twentieth of that. */
static void test_what_is_small_beside_the_largest_is_not_followed(void)
{
    TEST_ASSERT_EQUAL(points_with(0.0), points_with(2e-5));
    TEST_ASSERT_TRUE(points_with(2e-3) > points_with(0.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_four_exact_points_are_enough);
    RUN_TEST(test_delays_at_the_ends);
    RUN_TEST(test_noise_is_averaged_and_told);
    RUN_TEST(test_another_kind_of_loop_is_told_by_its_ratio);
    RUN_TEST(test_too_few_points_below_half_the_sampling_are_joined_straight);
    RUN_TEST(test_the_grid_is_read_by_straight_lines);
    RUN_TEST(test_what_is_small_beside_the_largest_is_not_followed);
    return UNITY_END();
}
