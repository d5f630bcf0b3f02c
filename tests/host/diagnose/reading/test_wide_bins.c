/* Means over wide bins against the mean of a parabola: of a(θ − c)² the torque at the mean angle lacks a
 * times the variance of the angles. */
#include "host/diagnose/reading/wide_bins.h"

#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { COUNT = 9, COLUMNS = 2, PARTS = 3, LEAD = 2 };

static hci_binned_sample sample[COUNT];
static const double BEND[COLUMNS] = {0.7, -1.9};

void setUp(void)
{
    memset(sample, 0, sizeof sample);
}

void tearDown(void)
{
}

/* Angles that are not evenly apart, and variances of which the third is none. */
static void angles_fill(double direction)
{
    for (size_t k = 0; k < COUNT; ++k) {
        sample[k].reading.theta_m_rad = direction * (0.2 * (double)k + (k % 2 ? 0.03 : 0.0));
        sample[k].spread_rad2 = k == 2 ? 0.0 : 0.001 * (double)(k + 1);
    }
}

static double parabola(size_t column, double theta_rad)
{
    return BEND[column] * (theta_rad - 0.4) * (theta_rad - 0.4);
}

static void test_rows_beside_each_other(void)
{
    for (int way = -1; way <= 1; way += 2) {
        const hci_wide_bins bins = {sample, COUNT, 0.0};
        double x[COUNT * COLUMNS], row[2 * COLUMNS];
        angles_fill(way);
        for (size_t k = 0; k < COUNT; ++k)
            for (size_t c = 0; c < COLUMNS; ++c)
                x[k * COLUMNS + c] = parabola(c, sample[k].reading.theta_m_rad);
        hci_bins_widen(&bins, x, COLUMNS, row);
        for (size_t k = 0; k < COUNT; ++k)
            for (size_t c = 0; c < COLUMNS; ++c) {
                /* the first and the last have no neighbour on one side */
                const double more = k == 0 || k + 1 == COUNT ? 0.0 : BEND[c] * sample[k].spread_rad2;
                TEST_ASSERT_DOUBLE_WITHIN(1e-13, parabola(c, sample[k].reading.theta_m_rad) + more,
                                          x[k * COLUMNS + c]);
            }
    }
}

/* Around the turn each has two; three values by three angles of a sine, differenced by hand. */
static void test_around_the_turn(void)
{
    const hci_wide_bins bins = {sample, COUNT, 1.9};
    double x[COUNT], before[COUNT], row[2];
    angles_fill(1.0);
    for (size_t k = 0; k < COUNT; ++k)
        x[k] = before[k] = sin(1.3 * (double)k);
    hci_bins_widen(&bins, x, 1, row);
    for (size_t k = 0; k < COUNT; ++k) {
        const size_t last = (k + COUNT - 1) % COUNT, next = (k + 1) % COUNT;
        const double here = sample[k].reading.theta_m_rad,
                     behind = here - sample[last].reading.theta_m_rad + (k == 0 ? 1.9 : 0.0),
                     ahead = sample[next].reading.theta_m_rad - here + (next == 0 ? 1.9 : 0.0);
        const double bend = 2.0 / (behind + ahead) *
                            ((before[next] - before[k]) / ahead - (before[k] - before[last]) / behind);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, before[k] + 0.5 * sample[k].spread_rad2 * bend, x[k]);
    }
}

/* Angles closer than a quarter of the mean step tell no curvature: neither of two that are. */
static void test_angles_that_are_close(void)
{
    for (int far = 0; far < 2; ++far) {
        const hci_wide_bins bins = {sample, COUNT, 0.0};
        double x[COUNT], row[2];
        angles_fill(1.0);
        /* the mean of COUNT steps of all that is between the first and the last */
        const double step = (sample[COUNT - 1].reading.theta_m_rad) / COUNT;
        sample[4].reading.theta_m_rad = sample[3].reading.theta_m_rad + step * (far ? 0.26 : 0.24);
        for (size_t k = 0; k < COUNT; ++k)
            x[k] = parabola(0, sample[k].reading.theta_m_rad);
        hci_bins_widen(&bins, x, 1, row);
        for (size_t k = 3; k < 6; ++k) {
            const double more = k == 5 || far ? BEND[0] * sample[k].spread_rad2 : 0.0;
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, parabola(0, sample[k].reading.theta_m_rad) + more, x[k]);
        }
    }
}

/* Rows between samples, of steps that are evenly apart; what leads the first is its neighbour. */
static void test_rows_with_others_between(void)
{
    const hci_wide_bins bins = {sample, COUNT, 0.2 * COUNT};
    double x[(LEAD + COUNT * PARTS) * COLUMNS];
    const double part_rad = 0.2 / PARTS;
    for (size_t k = 0; k < COUNT; ++k) {
        sample[k].reading.theta_m_rad = 0.2 * (double)k;
        sample[k].spread_rad2 = k == 2 ? 0.0 : 0.001 * (double)(k + 1);
    }
    for (size_t k = 0; k < LEAD + COUNT * PARTS; ++k)
        for (size_t c = 0; c < COLUMNS; ++c)
            x[k * COLUMNS + c] = parabola(c, part_rad * ((double)k - LEAD));
    hci_parts_widen(&bins, PARTS, LEAD, x, COLUMNS);
    for (size_t k = 0; k < LEAD + COUNT * PARTS; ++k)
        for (size_t c = 0; c < COLUMNS; ++c) {
            const bool is_sample = k >= LEAD && (k - LEAD) % PARTS == 0;
            const double more = is_sample ? BEND[c] * sample[(k - LEAD) / PARTS].spread_rad2 : 0.0;
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, parabola(c, part_rad * ((double)k - LEAD)) + more,
                                      x[k * COLUMNS + c]);
        }
}

/* With nothing that leads the last row of all is before the first; steps are what they are. */
static void test_parts_around_the_turn(void)
{
    enum { SAMPLES = 4, ROWS = 2 * SAMPLES };
    static const double THETA[SAMPLES] = {0.0, 0.3, 0.5, 0.9};
    const hci_wide_bins bins = {sample, SAMPLES, 1.5};
    double x[ROWS * COLUMNS], before[ROWS * COLUMNS];
    for (size_t k = 0; k < SAMPLES; ++k) {
        sample[k].reading.theta_m_rad = THETA[k];
        sample[k].spread_rad2 = 0.002 * (double)(k + 1);
    }
    for (size_t k = 0; k < ROWS * COLUMNS; ++k)
        x[k] = before[k] = cos(2.1 * (double)k);
    hci_parts_widen(&bins, 2, 0, x, COLUMNS);
    for (size_t k = 0; k < ROWS * COLUMNS; ++k) {
        const size_t row = k / COLUMNS, n = row / 2;
        const double behind = 0.5 * (n > 0 ? THETA[n] - THETA[n - 1] : 1.5 - THETA[SAMPLES - 1]),
                     ahead = 0.5 * (n + 1 < SAMPLES ? THETA[n + 1] - THETA[n] : 1.5 - THETA[SAMPLES - 1]);
        const double last = before[(k + (ROWS - 1) * COLUMNS) % (ROWS * COLUMNS)],
                     next = before[(k + COLUMNS) % (ROWS * COLUMNS)];
        const double bend = (next - before[k]) / ahead - (before[k] - last) / behind;
        const double more = row % 2 == 0 ? sample[n].spread_rad2 * bend / (behind + ahead) : 0.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, before[k] + more, x[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_beside_each_other);
    RUN_TEST(test_around_the_turn);
    RUN_TEST(test_angles_that_are_close);
    RUN_TEST(test_rows_with_others_between);
    RUN_TEST(test_parts_around_the_turn);
    return UNITY_END();
}
