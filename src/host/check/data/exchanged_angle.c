#include "host/check/data/exchanged_angle.h"

#include <math.h>

/* Of the steps of an angle that turns evenly: so near to their mean, and so many of them. */
#define EVEN 0.2
#define MOST 0.95

/* Of all that a column goes over: a step in which an angle begins again. */
#define AGAIN 0.5

/* An angle that turns goes at least so far; what stands in its place goes to and fro, one way at least by
 * this share of the other. */
#define TURNS_rad  6.0
#define TO_AND_FRO 0.2

enum { LEAST_ROWS = 50 };

/* How far a column goes in the steps that are alike, and which share of all they are. */
typedef struct {
    double gone, share;
} even_steps;

static double range_of(const double *x, size_t count)
{
    double least = x[0], most = x[0];
    for (size_t k = 1; k < count; ++k) {
        least = fmin(least, x[k]);
        most = fmax(most, x[k]);
    }
    return most - least;
}

/* The mean of those in which the column does not begin again. */
static double step_of(const double *x, size_t count)
{
    const double again = AGAIN * range_of(x, count);
    double sum = 0.0, steps = 0.0;
    for (size_t k = 1; k < count; ++k) {
        if (!(fabs(x[k] - x[k - 1]) < again)) continue;
        sum += x[k] - x[k - 1];
        steps += 1.0;
    }
    return steps > 0.0 ? sum / steps : 0.0;
}

static even_steps even_steps_of(const double *x, size_t count)
{
    even_steps found = {0.0, 0.0};
    const double step = step_of(x, count);
    for (size_t k = 1; k < count; ++k) {
        if (!(fabs(x[k] - x[k - 1] - step) <= EVEN * fabs(step))) continue;
        found.gone += x[k] - x[k - 1];
        found.share += 1.0 / (double)(count - 1);
    }
    return found;
}

static bool goes_to_and_fro(const double *x, size_t count)
{
    double up = 0.0, down = 0.0;
    for (size_t k = 1; k < count; ++k)
        if (x[k] > x[k - 1])
            up += x[k] - x[k - 1];
        else
            down += x[k - 1] - x[k];
    return fmin(up, down) > TO_AND_FRO * fmax(up, down);
}

bool hci_check_is_exchanged(const double *theta, const double *torque, size_t count)
{
    if (!theta || !torque || count < LEAST_ROWS) return false;
    const even_steps even = even_steps_of(torque, count);
    return even.share > MOST && fabs(even.gone) > TURNS_rad && goes_to_and_fro(theta, count);
}
