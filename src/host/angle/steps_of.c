#include "host/angle/steps_of.h"

#include <math.h>
#include <stdbool.h>

enum { LEAST_READINGS = 16 };

#define ROUNDING  1e-9 /* of the largest reading: a change of less is none */
#define LEAST_RAD 1e-5
#define OFTEN     0.05 /* of the readings */

/* The largest number of which both are multiples, to a rounding. */
static double common_part(double a, double b, double rounding)
{
    while (b > rounding) {
        const double left = fabs(remainder(a, b));
        a = b;
        b = left;
    }
    return a;
}

/* Whether readings follow each other by different numbers of steps. */
static bool changes_differ(const double *angle_rad, size_t n, double step_rad)
{
    size_t other = 0;
    for (size_t k = 2; k < n; ++k)
        other += fabs(angle_rad[k] - 2.0 * angle_rad[k - 1] + angle_rad[k - 2]) > 0.5 * step_rad;
    return (double)other > OFTEN * (double)n;
}

double hci_steps_of(const double *angle_rad, size_t n)
{
    double step_rad = 0.0;
    if (n < LEAST_READINGS) return 0.0;
    const double rounding = ROUNDING * fmax(1.0, fmax(fabs(angle_rad[0]), fabs(angle_rad[n - 1])));
    for (size_t k = 1; k < n && (k == 1 || step_rad > LEAST_RAD || step_rad <= rounding); ++k)
        step_rad = common_part(fabs(angle_rad[k] - angle_rad[k - 1]), step_rad, rounding);
    return step_rad > LEAST_RAD && changes_differ(angle_rad, n, step_rad) ? step_rad : 0.0;
}
