#include "host/numeric/slope_average.h"

#include "host/numeric/derivative.h"

enum { LEAST = 3 };

/* Values to be integrated, n at times that ascend. */
typedef struct {
    const double *time_s, *x;
    size_t n, stride;
} curve;

/* Slope at k of the parabola through its neighbours; 0 at the ends. */
static double bend_at(const curve *c, size_t k)
{
    if (k == 0 || k + 1 == c->n) return 0.0;
    const double before_s = c->time_s[k] - c->time_s[k - 1], after_s = c->time_s[k + 1] - c->time_s[k];
    const double *x = c->x + k * c->stride;
    const double before = (x[0] - *(x - c->stride)) / before_s, after = (x[c->stride] - x[0]) / after_s;
    return (after_s * before + before_s * after) / (before_s + after_s);
}

/* The integral from k to k + 1 by the rule of Euler and Maclaurin, which a cubic obeys: between samples an
 * electrical order may turn by a radian and more. */
static double step_of(const curve *c, size_t k)
{
    const double h = c->time_s[k + 1] - c->time_s[k];
    const double from = bend_at(c, k), to = bend_at(c, k + 1);
    const double corrected = k > 0 && k + 2 < c->n ? h * h / 12.0 * (from - to) : 0.0;
    return 0.5 * h * (c->x[k * c->stride] + c->x[(k + 1) * c->stride]) + corrected;
}

/* The slopes of the integral that stands in `work`. */
static void slopes_take(const double *time_s, size_t n, size_t window, double *x, size_t stride, double *work)
{
    double *rate = work + n;
    hci_derivative_over(time_s, work, n, window, rate);
    for (size_t k = 0; k < n; ++k)
        x[k * stride] = rate[k];
}

void hci_slope_average(const double *time_s, size_t n, size_t window, double *x, size_t stride, double *work)
{
    if (n < LEAST || window < LEAST) return;
    const curve c = {time_s, x, n, stride};
    work[0] = 0.0;
    for (size_t k = 1; k < n; ++k)
        work[k] = work[k - 1] + step_of(&c, k - 1);
    slopes_take(time_s, n, window, x, stride, work);
}

void hci_slope_average_of_steps(const double *time_s, size_t n, size_t window, double *x, size_t stride,
                                double *work)
{
    if (n < LEAST || window < LEAST) return;
    work[0] = 0.0;
    for (size_t k = 1; k < n; ++k)
        work[k] = work[k - 1] + (time_s[k] - time_s[k - 1]) * x[(k - 1) * stride];
    slopes_take(time_s, n, window, x, stride, work);
}
