/* Peaks between the samples of a grid, and samples that leave a program: of one sine, whose largest value is
 * midway between two of sixteen samples. */
#include "host/limit/points.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { SAMPLES = 16 };

static hci_component component = {1.0, 1};
static hci_set name = HCI_SET_POS;
static hci_component_set set;
static hci_limit_field field;
static hci_limit_grid grid;
static hci_limit_points points;

/* sin(θ + π/16): at samples of π/8 sin(π/16), …, cos(π/16) twice about its peak at 7π/16. */
static const double SIZE_A = 4.0;
static double x[2];

void setUp(void)
{
    set = (hci_component_set){&component, &name, 1, {{0}}};
    field = (hci_limit_field){.set = &set, .turns = 1};
    memset(&points, 0, sizeof points);
    grid = (hci_limit_grid){.kind = HCI_POINT_CURRENT, .samples = SAMPLES, .period_rad = 2.0 * REF_PI};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_limit_grid_make(&field, &grid));
    x[0] = SIZE_A * cos(REF_PI / 16.0);
    x[1] = SIZE_A * sin(REF_PI / 16.0);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_limit_grid_release(&grid);
    hci_memory_free(points.point);
    hci_memory_free(points.row);
}

/* How far beyond ±limit it goes, and how many peaks are found. */
static size_t peaks_beyond(double low_A, double high_A, double *worst)
{
    points.count = points.rows = 0;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_limit_peaks(&field, &grid, x, (const double[]){low_A, high_A}, &points, worst));
    return points.count;
}

static void test_the_grid(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2.0 * REF_PI / SAMPLES, grid.step_rad);
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double *row = hci_limit_grid_rows(&grid, k);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, SIZE_A * sin(REF_PI / 8.0 * (double)k + REF_PI / 16.0),
                                  hci_limit_value(HCI_POINT_CURRENT, 2, row, x));
    }
}

/* Both signs, at the angle of the sine and not of a sample, to the rounding of the angle. */
static void test_peaks_of_both_signs(void)
{
    double worst;
    TEST_ASSERT_EQUAL_UINT(2, peaks_beyond(-3.0, 3.0, &worst));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, worst);
    for (size_t k = 0; k < 2; ++k) {
        TEST_ASSERT_EQUAL_INT(HCI_POINT_CURRENT, points.point[k].kind);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, (k == 0 ? 7.0 : 23.0) * REF_PI / 16.0, points.point[k].theta_rad);
    }
    TEST_ASSERT_EQUAL_UINT(1, peaks_beyond(-5.0, 3.5, &worst));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, worst);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 7.0 * REF_PI / 16.0, points.point[0].theta_rad);
    TEST_ASSERT_EQUAL_UINT(1, peaks_beyond(-3.5, 5.0, &worst));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 23.0 * REF_PI / 16.0, points.point[0].theta_rad);
}

/* Samples reach 3.923 A: what they are within by up to a fiftieth of the band is looked at. */
static void test_peaks_that_no_sample_shows(void)
{
    double worst;
    TEST_ASSERT_EQUAL_UINT(2, peaks_beyond(-3.99, 3.99, &worst));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, worst);
    TEST_ASSERT_EQUAL_UINT(0, peaks_beyond(-4.01, 4.01, &worst));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.01, worst);
    TEST_ASSERT_EQUAL_UINT(2, peaks_beyond(0.3, 3.99, &worst)); /* and far below 0.3 */
    const double sample_A = SIZE_A * cos(REF_PI / 16.0);
    for (int far = 0; far < 2; ++far) { /* a band of ±high: 0.04 of it */
        const double high_A = sample_A / (far ? 0.959 : 0.961);
        (void)peaks_beyond(-high_A, high_A, &worst);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, (far ? sample_A : SIZE_A) - high_A, worst);
    }
}

/* Samples below a share of the ends leave, above it they stay: six of 16 are beyond 0.8 of 4 A. */
static void test_samples_that_leave(void)
{
    for (size_t k = 0; k < SAMPLES; ++k)
        grid.is_row[k] = true;
    hci_limit_grid_thin(&grid, x, (const double[]){-4.0, 4.0}, 0.8);
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double share = fabs(sin(REF_PI / 8.0 * (double)k + REF_PI / 16.0));
        TEST_ASSERT_EQUAL(share > 0.8, grid.is_row[k]);
    }
}

static void test_no_memory(void)
{
    double worst;
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY,
                          hci_limit_peaks(&field, &grid, x, (const double[]){-3.0, 3.0}, &points, &worst));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_grid);
    RUN_TEST(test_peaks_of_both_signs);
    RUN_TEST(test_peaks_that_no_sample_shows);
    RUN_TEST(test_samples_that_leave);
    RUN_TEST(test_no_memory);
    return UNITY_END();
}
