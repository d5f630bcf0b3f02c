#include "host/diagnose/prepare/rest.h"

#include <math.h>
#include <string.h>

#define DEVIATIONS                                                                                           \
    8.0                 /* of the noise of the angle: a shaft that moves less may be at rest; steps of an    \
                           encoder have 1/√12 of theirs */
#define LEAST_SHARE 0.1 /* of the samples that must be left, … */

/* … or so many: a shaft that runs down may stand for most of its recording. */
enum { REACH = 2, ENOUGH = 100 };

/* Standard deviation of the angle's noise, from fourth differences: (1 −4 6 −4 1)² = 70. */
static double noise_of(const double *x, size_t n)
{
    double square = 0.0;
    for (size_t k = REACH; k + REACH < n; ++k) {
        const double bend = x[k - 2] - 4.0 * (x[k - 1] + x[k + 1]) + 6.0 * x[k] + x[k + 2];
        square += bend * bend;
    }
    return sqrt(square / (70.0 * (double)(n - 2 * REACH)));
}

/* Marks the samples around one, `reach` on both sides. */
static void mark(bool *at_rest, size_t n, size_t k, size_t reach)
{
    const size_t from = k > reach ? k - reach : 0, end = k + reach + 1 < n ? k + reach + 1 : n;
    for (size_t j = from; j < end; ++j)
        at_rest[j] = true;
}

/* Returns how many are not. */
static size_t marks_set(const hci_run *run, double least_rad, size_t half, size_t reach, bool *at_rest)
{
    const size_t n = run->count;
    size_t moving = 0;
    for (size_t k = half; k + half < n; ++k)
        if (fabs(run->theta_m_rad[k + half] - run->theta_m_rad[k - half]) <= least_rad)
            mark(at_rest, n, k, reach);
    for (size_t k = 0; k < n; ++k)
        moving += !at_rest[k];
    return moving;
}

void hci_rest_find(const hci_run *run, bool *at_rest)
{
    const size_t n = run->count, half = run->torque_window / 2, reach = half + run->speed_window / 2;
    memset(at_rest, 0, n * sizeof *at_rest);
    if (run->torque_source != HCI_TORQUE_INERTIA || !run->theta_m_rad || half == 0 || n <= 2 * REACH) return;
    const double least_rad = DEVIATIONS * noise_of(run->theta_m_rad, n);
    const size_t moving = marks_set(run, least_rad, half, reach, at_rest);
    if (moving < ENOUGH && (double)moving < LEAST_SHARE * (double)n) memset(at_rest, 0, n * sizeof *at_rest);
}
