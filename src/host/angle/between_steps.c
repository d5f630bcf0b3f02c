#include "host/angle/between_steps.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"

#define LARGEST_RAD (HCI_PI / 180.0)
#define ROUNDING    1e-9 /* rad, that is no step */
#define ONE_STEP    1.5  /* times the least, that is one step and not two */
#define NEAR        0.2  /* of a step, by which a multiple of it may be off: decimals of a file */
#define NEARLY_ALL  0.98
#define MOSTLY      0.95
#define BESIDE      0.75 /* steps, by which a reading is off at most: half of one, and noise at its edge */
#define GAP         3.0  /* times the usual time between two samples: what lies in it is no time of a step */
#define FEWEST      1.2 /* samples for each change, below which their instants tell no more than the readings */
#define MOST        50.0 /* the same, above which a shaft may rest on each step */
#define FARTHEST    2.0  /* steps from sample to sample, beside which they are small */
#define OTHERWISE                                                                                            \
    0.05 /* of the samples, that go on by none or two: else a speed that hardly varies is a step */

enum { REACH = 8 /* steps on either side */, LEAST = 4 * REACH };

/* What parabolas are laid through: the middles of steps, when the reading goes on, or where it does so at
 * nearly every sample, the readings. */
typedef struct {
    double *angle_rad, *time_s;
    size_t count;
} edges;

/* The steps that were found. */
typedef struct {
    double rad; /* 0: there are none, or none that matter */
    bool often; /* the reading goes on at nearly every sample */
} steps;

static double least_change(const double *angle_rad, size_t n)
{
    double least = INFINITY;
    for (size_t k = 1; k < n; ++k) {
        const double change = fabs(angle_rad[k] - angle_rad[k - 1]);
        if (change > ROUNDING) least = fmin(least, change);
    }
    return least;
}

/* The mean of the changes that are one step. */
static double single_change(const double *angle_rad, size_t n, double least)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double change = fabs(angle_rad[k] - angle_rad[k - 1]);
        if (change <= ROUNDING || change > ONE_STEP * least) continue;
        sum += change;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

/* The step of which all changes are multiples, and not all of them the same. */
static steps steps_of(const double *angle_rad, size_t n)
{
    const double step = single_change(angle_rad, n, least_change(angle_rad, n));
    double changes = 0.0, multiples = 0.0, otherwise = 0.0, sum = 0.0;
    for (size_t k = 1; k < n && step > 0.0; ++k) {
        const double of_step = fabs(angle_rad[k] - angle_rad[k - 1]) / step, whole = round(of_step);
        otherwise += fabs(whole - 1.0) > 0.5 ? 1.0 : 0.0;
        if (of_step * step <= ROUNDING) continue;
        changes += 1.0;
        sum += of_step;
        multiples += fabs(of_step - whole) < NEAR ? 1.0 : 0.0;
    }
    const bool is_step = changes >= LEAST && multiples >= NEARLY_ALL * changes && step <= LARGEST_RAD;
    const bool matters = (double)n <= MOST * changes && sum <= FARTHEST * (double)n;
    const bool found = is_step && matters && otherwise >= OTHERWISE * (double)n;
    return (steps){found ? step : 0.0, (double)n < FEWEST * changes};
}

static void readings_take(const double *angle_rad, const double *time_s, size_t n, edges *e)
{
    memcpy(e->angle_rad, angle_rad, n * sizeof *angle_rad);
    memcpy(e->time_s, time_s, n * sizeof *time_s);
    e->count = n;
}

static void edges_find(const double *angle_rad, const double *time_s, size_t n, edges *e)
{
    const double usual_s = (time_s[n - 1] - time_s[0]) / (double)(n - 1);
    e->count = 0;
    for (size_t k = 1; k < n; ++k) {
        if (fabs(angle_rad[k] - angle_rad[k - 1]) <= ROUNDING) continue;
        if (time_s[k] - time_s[k - 1] > GAP * usual_s) continue;
        e->angle_rad[e->count] = 0.5 * (angle_rad[k] + angle_rad[k - 1]);
        e->time_s[e->count++] = 0.5 * (time_s[k] + time_s[k - 1]);
    }
}

/* angle = base + a + b·x + c·x², x: the time from `time_s` in units of the width. */
typedef struct {
    double base_rad, time_s, width_s, a, b, c;
} parabola;

/* Through the edges first … first + 2 REACH - 1. */
static parabola parabola_of(const edges *e, size_t first)
{
    const size_t last = first + 2 * REACH - 1;
    parabola p = {.base_rad = e->angle_rad[first + REACH], .time_s = e->time_s[first + REACH]};
    double s[5] = {0.0}, y[3] = {0.0};
    p.width_s = e->time_s[last] - e->time_s[first];
    for (size_t k = first; k <= last; ++k) {
        const double x = (e->time_s[k] - p.time_s) / p.width_s, v = e->angle_rad[k] - p.base_rad;
        double power = 1.0;
        for (int j = 0; j < 5; ++j, power *= x) {
            s[j] += power;
            if (j < 3) y[j] += power * v;
        }
    }
    const double m00 = s[2] * s[4] - s[3] * s[3], m01 = s[2] * s[3] - s[1] * s[4],
                 m02 = s[1] * s[3] - s[2] * s[2];
    const double m11 = s[0] * s[4] - s[2] * s[2], m12 = s[1] * s[2] - s[0] * s[3],
                 m22 = s[0] * s[2] - s[1] * s[1];
    const double d = s[0] * m00 + s[1] * m01 + s[2] * m02;
    p.a = (m00 * y[0] + m01 * y[1] + m02 * y[2]) / d;
    p.b = (m01 * y[0] + m11 * y[1] + m12 * y[2]) / d;
    p.c = (m02 * y[0] + m12 * y[1] + m22 * y[2]) / d;
    return p;
}

static double value_at(const parabola *p, double time_s)
{
    const double x = (time_s - p->time_s) / p->width_s;
    return p->base_rad + p->a + x * (p->b + x * p->c);
}

/* Puts the parabolas at all samples. Returns how many readings they follow. */
static size_t values_fill(const double *angle_rad, const double *time_s, size_t n, const edges *e,
                          double step, double *smooth)
{
    size_t next = 0, first = e->count, follows = 0;
    parabola p = {0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < n; ++k) {
        while (next < e->count && e->time_s[next] < time_s[k])
            ++next;
        const size_t most = e->count - 2 * REACH, from = next < REACH ? 0 : next - REACH;
        if (first != (from < most ? from : most)) p = parabola_of(e, first = from < most ? from : most);
        smooth[k] = value_at(&p, time_s[k]);
        if (fabs(smooth[k] - angle_rad[k]) <= BESIDE * step)
            ++follows;
        else
            smooth[k] = angle_rad[k];
    }
    return follows;
}

double hci_angle_between_steps(double *angle_rad, const double *time_s, size_t n)
{
    const steps found = n > LEAST ? steps_of(angle_rad, n) : (steps){0.0, false};
    if (!(found.rad > 0.0)) return 0.0;
    double *smooth = hci_memory_new(3 * n, sizeof *smooth);
    if (!smooth) return -1.0;
    edges e = {smooth + n, smooth + 2 * n, 0};
    (found.often ? readings_take : edges_find)(angle_rad, time_s, n, &e);
    const bool follows = e.count >= LEAST && (double)values_fill(angle_rad, time_s, n, &e, found.rad,
                                                                 smooth) >= MOSTLY * (double)n;
    if (follows) memcpy(angle_rad, smooth, n * sizeof *smooth);
    hci_memory_free(smooth);
    return follows ? found.rad : 0.0;
}
