#include "host/diagnose/prepare/smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/prepare/standing_waves.h"
#include "host/numeric/normal_equations.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

enum {
    REACH = 10,        /* neighbours on each side for the angle */
    MOST_ORDER = 24,   /* electrical, of the currents in the rotor frame */
    FIRST_ORDERS = 12, /* of them before all others */
    ALL_ORDERS = 7,    /* up to here those of the mechanical turn too */
    MOST_PERIODS = 200,
    LEAST_SAMPLES = 20, /* for each coefficient */
    LEAST_IN_ALL = 2 * LEAST_SAMPLES * MOST_ORDER,
    LEAST_IN_MEAN = LEAST_SAMPLES * FIRST_ORDERS, /* in a mean over turns, where less noise is left, and of
                                                   * a current without orders */
    SHARPEST = 120,                               /* electrical order, of currents with edges */
    MOST_OF_TURN = 300, /* periods in a turn, of an encoder that errs between its lines */
    USUAL_PERIODS = 5,  /* of an encoder or a resolver that errs */
    OTHER_PERIODS = 6,
    ERROR_PERIODS = USUAL_PERIODS + OTHER_PERIODS
};

#define WHOLE_PERIODS 2.0  /* that waves one apart need to be told apart */
#define REPEATS       60.0 /* χ² of ten values that repeat, once in 10⁸ by chance */
#define RESOLVED      0.48 /* periods for each sample */
#define BY_CHANCE                                                                                            \
    10.0 /* times the mean square that noise has at an order: of 200 one in a hundred recordings */
#define NOTHING 1e-5 /* of the current, that is no order of it */
#define STEADY  0.05 /* change of current within the segment, as a share */
#define TURNING 0.5  /* and of speed, for the angle to be a smooth curve */

/* ---- angle ---- */

/* How many periods in a turn the samples of a segment resolve. */
static double periods_resolved(const hci_binned_sample *sample, size_t n)
{
    const double span_rad = fabs(sample[n - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad);
    return span_rad > 0.0 ? RESOLVED * (double)(n - 1) * 2.0 * HCI_PI / span_rad : 0.0;
}

static bool is_turning(const hci_binned_sample *sample, size_t n)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < n; ++k) {
        least = fmin(least, sample[k].reading.speed_rad_per_s);
        most = fmax(most, sample[k].reading.speed_rad_per_s);
    }
    return least * most > 0.0 && most - least < TURNING * fmax(fabs(most), fabs(least));
}

/* The value at `at` of the parabola through the angles around it; x: time from there. */
static double parabola_at(const hci_binned_sample *sample, size_t from, size_t to, size_t at)
{
    double s[5] = {0.0}, y[3] = {0.0};
    const double scale = sample[to].time_s - sample[from].time_s, base = sample[at].reading.theta_m_rad;
    for (size_t k = from; k <= to; ++k) {
        const double x = (sample[k].time_s - sample[at].time_s) / scale,
                     v = sample[k].reading.theta_m_rad - base;
        double power = 1.0;
        for (int j = 0; j < 5; ++j, power *= x) {
            s[j] += power;
            if (j < 3) y[j] += power * v;
        }
    }
    const double d = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) +
                     s[2] * (s[1] * s[3] - s[2] * s[2]);
    const double c = y[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (y[1] * s[4] - s[3] * y[2]) +
                     s[2] * (y[1] * s[3] - s[2] * y[2]);
    return d > 0.0 ? base + c / d : base;
}

/* ---- errors of the angle that repeat ---- */

/* Periods in a mechanical turn in which encoders and resolvers err: once and twice a turn, and 1, 2 and 4
 * times an electrical period. Only those that the segment has a whole period of. Returns how many. */
static size_t error_periods(const hci_binned_sample *sample, size_t n, int pole_pairs, bool turns,
                            double period[ERROR_PERIODS])
{
    static const int OF_PERIOD[] = {1, 2, 4}, OF_TURN[] = {1, 2};
    const double span = fabs(sample[n - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad);
    size_t count = 0;
    for (size_t k = 0; k < sizeof OF_PERIOD / sizeof *OF_PERIOD; ++k)
        if (OF_PERIOD[k] * pole_pairs * span > 2.0 * HCI_PI) period[count++] = OF_PERIOD[k] * pole_pairs;
    for (size_t k = 0; k < sizeof OF_TURN / sizeof *OF_TURN && turns; ++k)
        if (OF_TURN[k] * span > 2.0 * HCI_PI && OF_TURN[k] != pole_pairs && OF_TURN[k] != 2 * pole_pairs)
            period[count++] = OF_TURN[k];
    return count;
}

/* Further ones that stand out of what smoothing took: an encoder that makes the angle of a sine and a cosine
 * errs a whole number of times in each of its lines, of which a turn may have any. values: room for [2][n].
 * Adds them to those that are there; count: in/out. False when memory is out. */
static bool error_periods_add(const hci_binned_sample *sample, size_t n, size_t stride, const double *smooth,
                              double *values, double period[ERROR_PERIODS], size_t *count)
{
    const size_t inner = n - 2 * REACH;
    const double span_rad = fabs(smooth[n - 1] - smooth[0]), resolved = periods_resolved(sample, n);
    const double *const taken = values + inner;
    size_t found[OTHER_PERIODS + USUAL_PERIODS], others = 0;
    hci_standing_waves q = {.theta_m_rad = values, .value = &taken, .n = inner, .axes = 1, .stride = stride};
    q.most_periods = (size_t)fmin(resolved, (double)MOST_OF_TURN);
    q.apart = 2 * stride;
    if (!(span_rad * (double)stride > WHOLE_PERIODS * 2.0 * HCI_PI)) return true;
    for (size_t k = 0; k < inner; ++k) {
        values[k] = smooth[REACH + k];
        values[inner + k] = sample[REACH + k].reading.theta_m_rad - smooth[REACH + k];
    }
    if (!hci_standing_waves_find(&q, OTHER_PERIODS, found, &others)) return false;
    const size_t usual = *count;
    for (size_t k = 0; k < others; ++k) {
        bool is_there = false;
        for (size_t j = 0; j < usual; ++j)
            is_there = is_there || fabs(period[j] - (double)found[k]) < 0.5;
        if (!is_there) period[(*count)++] = (double)found[k];
    }
    return true;
}

static void error_row(double theta_m_rad, const double *period, size_t count, double *row)
{
    for (size_t k = 0; k < count; ++k) {
        row[2 * k] = cos(period[k] * theta_m_rad);
        row[2 * k + 1] = sin(period[k] * theta_m_rad);
    }
}

/* The sums of a fit of what smoothing took by waves of those periods. Returns the sum of its squares. */
static double errors_sum(const hci_binned_sample *sample, size_t n, const double *period, size_t count,
                         const double *smooth, double *gram, double *moment)
{
    const size_t columns = 2 * count;
    double row[2 * ERROR_PERIODS] = {0.0}, square = 0.0;
    for (size_t k = REACH; k + REACH < n; ++k) {
        const double taken = sample[k].reading.theta_m_rad - smooth[k];
        error_row(smooth[k], period, count, row);
        square += taken * taken;
        for (size_t i = 0; i < columns; ++i) {
            moment[i] += row[i] * taken;
            for (size_t j = 0; j < columns; ++j)
                gram[i + j * columns] += row[i] * row[j];
        }
    }
    return square;
}

/* A parabola through many samples of a period takes an error of the encoder out of the angle: what it took
 * that repeats is put back, where it stands out of the noise, since currents and model go by what was read.
 * At the ends, where the parabolas are shorter, that is the reading. */
static void errors_keep(const hci_binned_sample *sample, size_t n, const double *period, size_t count,
                        double *smooth)
{
    double gram[4 * ERROR_PERIODS * ERROR_PERIODS] = {0.0}, x[2 * ERROR_PERIODS] = {0.0};
    double moment[2 * ERROR_PERIODS] = {0.0}, row[2 * ERROR_PERIODS] = {0.0}, kept = 0.0;
    const double square = errors_sum(sample, n, period, count, smooth, gram, moment);
    memcpy(x, moment, sizeof x);
    if (count == 0 || hci_cholesky_factor(2 * count, gram)) return;
    hci_cholesky_solve(2 * count, gram, x);
    for (size_t i = 0; i < 2 * count; ++i)
        kept += x[i] * moment[i];
    if (!(kept * (double)n > REPEATS * square)) return;
    for (size_t k = 0; k < n; ++k) {
        const bool is_end = k < REACH || k + REACH >= n;
        error_row(smooth[k], period, count, row);
        for (size_t i = 0; i < 2 * count; ++i)
            smooth[k] += row[i] * x[i];
        if (is_end) smooth[k] = sample[k].reading.theta_m_rad;
    }
}

static bool angle_smooth(hci_binned_sample *sample, size_t n, int pole_pairs, bool turns)
{
    double period[ERROR_PERIODS];
    size_t count = error_periods(sample, n, pole_pairs, turns, period);
    double *smooth = hci_memory_new(3 * n, sizeof *smooth);
    if (!smooth) return false;
    for (size_t k = 0; k < n; ++k) {
        const size_t reach = k < REACH ? k : n - 1 - k < REACH ? n - 1 - k : REACH;
        smooth[k] = reach < 2 ? sample[k].reading.theta_m_rad : parabola_at(sample, k - reach, k + reach, k);
    }
    const bool done =
        error_periods_add(sample, n, turns ? 1 : (size_t)pole_pairs, smooth, smooth + n, period, &count);
    errors_keep(sample, n, period, count, smooth);
    for (size_t k = 0; k < n; ++k)
        sample[k].reading.theta_m_rad = smooth[k];
    hci_memory_free(smooth);
    return done;
}

/* ---- currents ---- */

/* Means of the halves of a segment in the rotor frame are the same. */
static bool is_steady(const hci_binned_sample *sample, size_t n, int pole_pairs)
{
    double d[2] = {0.0}, q[2] = {0.0}, length = 0.0;
    for (size_t k = 0; k < n; ++k) {
        const hci_dq i = hci_sample_dq(&sample[k].reading, pole_pairs);
        d[2 * k >= n] += 2.0 * i.d / (double)n;
        q[2 * k >= n] += 2.0 * i.q / (double)n;
        length += hypot(i.d, i.q) / (double)n;
    }
    return hypot(d[1] - d[0], q[1] - q[0]) <= STEADY * length;
}

/* Periods in a turn, ascending: the electrical orders that drives ripple at, once and twice a turn, which an
 * eccentric encoder makes of a steady current, and as many as the samples bear
 * of those of the rotor and of the encoder, up to a few times the pole pairs, and of higher electrical
 * orders. In the rotor frame injected 5th and 7th harmonics are of order 6. Without a known turn only the
 * electrical ones. resolved: no more than so many. */
static size_t periods_list(int pole_pairs, bool turns, size_t n, double resolved, size_t *periods)
{
    const size_t p = (size_t)pole_pairs, most = n / (2 * LEAST_SAMPLES);
    size_t count = 0, others = most > FIRST_ORDERS ? most - FIRST_ORDERS : 0;
    for (size_t k = 1; k <= MOST_ORDER * p && (double)k <= resolved && count < MOST_PERIODS; ++k) {
        const bool whole = k % p == 0, of_encoder = turns && k <= 2;
        const bool first = of_encoder || (whole && k <= FIRST_ORDERS * p);
        if (!first && (others == 0 || (!whole && (!turns || k > ALL_ORDERS * p)))) continue;
        others -= !first;
        periods[count++] = k;
    }
    return count;
}

/* [1, cos, sin, cos, sin …] of the periods at an angle. */
static void basis_at(double theta_m_rad, const size_t *periods, size_t count, double *row)
{
    const double c = cos(theta_m_rad), s = sin(theta_m_rad);
    double x = 1.0, y = 0.0;
    size_t k = 0;
    row[0] = 1.0;
    for (size_t j = 0; j < count; ++j) {
        for (; k < periods[j]; ++k) {
            const double next = c * x - s * y;
            y = s * x + c * y;
            x = next;
        }
        row[1 + 2 * j] = x;
        row[2 + 2 * j] = y;
    }
}

static double series_at(const double *row, const double *coefficients, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += row[k] * coefficients[k];
    return sum;
}

/* Coefficients of one coordinate by least squares; the angles of steady turns are spread evenly enough for
 * normal equations. False where they are not. */
static bool series_fit(const hci_normal_equations *normal, double *factor, double *coefficients)
{
    memcpy(factor, normal->gram, normal->n * normal->n * sizeof *factor);
    memcpy(coefficients, normal->moment, normal->n * sizeof *coefficients);
    if (hci_cholesky_factor(normal->n, factor)) return false;
    hci_cholesky_solve(normal->n, factor, coefficients);
    return true;
}

/* dx/dθ_m and d²x/dθ_m² of a series; row: its basis. */
static void slopes_at(const double *row, const double *coefficients, const size_t *periods, size_t count,
                      double *slope, double *curvature)
{
    *slope = *curvature = 0.0;
    for (size_t j = 0; j < count; ++j) {
        const double k = (double)periods[j], c = coefficients[1 + 2 * j], s = coefficients[2 + 2 * j];
        *slope += k * (s * row[1 + 2 * j] - c * row[2 + 2 * j]);
        *curvature -= k * k * (c * row[1 + 2 * j] + s * row[2 + 2 * j]);
    }
}

/* coordinate: i_d, i_q and the zero sequence of each sample; slope, curvature: their derivatives by the
 * angle; slopes, curvatures: sums of the squares of all of them. */
typedef struct {
    double *rows, *coordinate[3], *slope[3], *curvature[3], *factor, *coefficients;
    double slopes, curvatures;
    bool noisy; /* the current, beside the torque */
    hci_normal_equations normal;
} series_workspace;

/* The mean square of what the series leaves of a coordinate. */
static double series_left(const series_workspace *r, size_t n, const double *coordinate)
{
    const size_t columns = r->normal.n;
    double square = 0.0;
    for (size_t k = 0; k < n; ++k) {
        const double left = coordinate[k] - series_at(r->rows + k * columns, r->coefficients, columns);
        square += left * left;
    }
    return square / (double)n;
}

/* An order that is as large as noise makes it says nothing of how fast the current changes: it leaves the
 * coefficients. */
static void noise_leave(series_workspace *r, size_t n, double variance)
{
    const double most = BY_CHANCE * 4.0 * variance / (double)n;
    for (double *x = r->coefficients + 1; x < r->coefficients + r->normal.n; x += 2)
        if (x[0] * x[0] + x[1] * x[1] < most) x[0] = x[1] = 0.0;
}

/* The coefficients of a coordinate. variance: out, what they leave. False where there are none. */
static bool series_of(series_workspace *r, size_t n, const double *coordinate, double *variance)
{
    const size_t columns = r->normal.n;
    memset(r->normal.moment, 0, columns * sizeof *r->normal.moment);
    for (size_t k = 0; k < n; ++k)
        for (size_t c = 0; c < columns; ++c)
            r->normal.moment[c] += r->rows[k * columns + c] * coordinate[k];
    if (!series_fit(&r->normal, r->factor, r->coefficients)) return false;
    *variance = series_left(r, n, coordinate);
    return true;
}

static void coordinate_put(const series_workspace *r, size_t n, double *coordinate)
{
    for (size_t k = 0; k < n; ++k)
        coordinate[k] = series_at(r->rows + k * r->normal.n, r->coefficients, r->normal.n);
}

/* Where the noise of the current would make more torque than the torque has noise, what is left of it would
 * be explained by a torque that does not go with the current, as where iron saturates: it leaves the current,
 * too. */
static bool coordinate_smooth(series_workspace *r, size_t n, const size_t *periods, int axis)
{
    double *coordinate = r->coordinate[axis], variance;
    if (!series_of(r, n, coordinate, &variance)) return false;
    if (!r->noisy) coordinate_put(r, n, coordinate);
    noise_leave(r, n, variance);
    if (r->noisy) coordinate_put(r, n, coordinate);
    for (size_t k = 0; k < n; ++k) {
        slopes_at(r->rows + k * r->normal.n, r->coefficients, periods, r->normal.n / 2, &r->slope[axis][k],
                  &r->curvature[axis][k]);
        r->slopes += r->slope[axis][k] * r->slope[axis][k];
        r->curvatures += r->curvature[axis][k] * r->curvature[axis][k];
    }
    return true;
}

/* Sets whether the noise of i_q would make more torque than the torque has, by the torque per ampere of their
 * means. torque: room for [n]. */
static void noise_compare(const hci_binned_sample *sample, size_t n, series_workspace *r, double *torque)
{
    double of_current, of_torque, mean_A = 0.0, mean_Nm = 0.0;
    for (size_t k = 0; k < n; ++k) {
        torque[k] = sample[k].torque_Nm;
        mean_A += r->coordinate[1][k] / (double)n;
        mean_Nm += torque[k] / (double)n;
    }
    if (!series_of(r, n, r->coordinate[1], &of_current) || !series_of(r, n, torque, &of_torque)) return;
    r->noisy = mean_Nm * mean_Nm * of_current > mean_A * mean_A * of_torque;
}

/* Rows of the basis and the coordinates of each sample. */
static void coordinates_read(const hci_binned_sample *sample, size_t n, int pole_pairs, const size_t *periods,
                             size_t count, series_workspace *r)
{
    for (size_t k = 0; k < n; ++k) {
        const hci_sample *x = &sample[k].reading;
        const hci_dq i = hci_sample_dq(x, pole_pairs);
        basis_at(x->theta_m_rad, periods, count, r->rows + k * r->normal.n);
        r->coordinate[0][k] = i.d;
        r->coordinate[1][k] = i.q;
        r->coordinate[2][k] = i.zero;
    }
}

static void phases_of(double *const axis[3], size_t k, double scale, double theta_rad, double *phases)
{
    const hci_dq x = {scale * axis[0][k], scale * axis[1][k], scale * axis[2][k]};
    hci_phases_of_dq(x, theta_rad, phases);
}

static void coordinates_write(const series_workspace *r, size_t n, int pole_pairs, hci_binned_sample *sample)
{
    const double swing = r->slopes > 0.0 ? sqrt(r->curvatures / r->slopes) : 0.0; /* periods in a turn */
    for (size_t k = 0; k < n; ++k) {
        hci_sample *x = &sample[k].reading;
        const double theta = pole_pairs * x->theta_m_rad, speed = x->speed_rad_per_s;
        phases_of(r->coordinate, k, 1.0, theta, x->i_abc);
        phases_of(r->slope, k, speed, theta, x->change_A_per_s);
        phases_of(r->curvature, k, speed * speed, theta, x->curvature_A_per_s2);
        x->swing_rad_per_s = swing * fabs(speed);
    }
}

/* ---- orders that the series does not have ---- */

static int ascending(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

/* What the series took of i_d and i_q, and the angles. values: [3][n]. */
static void taken_fill(const hci_binned_sample *sample, size_t n, int pole_pairs, const series_workspace *r,
                       double *values)
{
    for (size_t k = 0; k < n; ++k) {
        const hci_dq i = hci_sample_dq(&sample[k].reading, pole_pairs);
        values[k] = i.d - r->coordinate[0][k];
        values[n + k] = i.q - r->coordinate[1][k];
        values[2 * n + k] = sample[k].reading.theta_m_rad;
    }
}

/* Waves that stand out of what the series took: of the electrical period up to edges, and of the turn, of
 * which a rotor and the interpolation of an encoder may have any, up to fewer. */
static bool waves_find(hci_standing_waves *q, size_t pole_pairs, bool turns, double resolved,
                       size_t periods[MOST_PERIODS], size_t *count)
{
    size_t of_turn[MOST_PERIODS], whole = 0, others = 0;
    q->stride = pole_pairs;
    q->most_periods = (size_t)fmin(resolved, (double)(SHARPEST * pole_pairs));
    if (!hci_standing_waves_find(q, MOST_PERIODS, periods, &whole)) return false;
    q->stride = 1;
    q->most_periods = turns ? (size_t)fmin(resolved, (double)MOST_OF_TURN) : 0;
    if (!hci_standing_waves_find(q, MOST_PERIODS, of_turn, &others)) return false;
    for (size_t k = 0; k < others && whole < MOST_PERIODS; ++k)
        if (of_turn[k] % pole_pairs != 0) periods[whole++] = of_turn[k];
    *count = whole;
    return true;
}

/* Blocks of current have orders far above those that drives ripple at, and an encoder whose angle errs
 * between its lines makes them of steady currents: a series without them rounds both, and that passes for
 * effects of those orders. Adds the orders that stand out of what the series took. count: in/out. False when
 * memory is out. */
static bool standing_add(const hci_binned_sample *sample, size_t n, int pole_pairs, bool turns,
                         const series_workspace *r, size_t *periods, size_t *count, double resolved)
{
    size_t found[MOST_PERIODS], more = 0;
    const size_t most = n / LEAST_SAMPLES < MOST_PERIODS ? n / LEAST_SAMPLES : MOST_PERIODS;
    const double current_A = NOTHING * hypot(r->coordinate[0][0], r->coordinate[1][0]);
    double *values = hci_memory_new(3 * n, sizeof *values);
    if (!values) return false;
    const double *const axis[] = {values, values + n};
    hci_standing_waves q = {.theta_m_rad = values + 2 * n, .value = axis, .n = n, .axes = 2, .apart = 1};
    q.least = current_A * current_A;
    taken_fill(sample, n, pole_pairs, r, values);
    const bool done = waves_find(&q, (size_t)pole_pairs, turns, resolved, found, &more);
    const size_t before = *count;
    for (size_t k = 0; k < more && *count < most; ++k)
        if (!bsearch(&found[k], periods, before, sizeof *periods, ascending)) periods[(*count)++] = found[k];
    qsort(periods, *count, sizeof *periods, ascending);
    hci_memory_free(values);
    return done;
}

/* The series of the currents; false where one has no solution. */
static bool currents_fit(const hci_binned_sample *sample, size_t n, int pole_pairs, const size_t *periods,
                         size_t count, series_workspace *r)
{
    coordinates_read(sample, n, pole_pairs, periods, count, r);
    hci_normal_equations_add(&r->normal, r->rows, r->coordinate[0], n);
    hci_normal_equations_finish(&r->normal);
    noise_compare(sample, n, r, r->slope[0]);
    for (int c = 0; c < 3; ++c)
        if (!coordinate_smooth(r, n, periods, c)) return false;
    return true;
}

static bool workspace_make(series_workspace *r, size_t n, size_t columns)
{
    memset(r, 0, sizeof *r);
    r->rows = hci_memory_new(n * (columns + 9) + columns * (columns + 1), sizeof *r->rows);
    if (!r->rows || !hci_normal_equations_start(&r->normal, columns)) return false;
    for (size_t c = 0; c < 3; ++c) {
        r->coordinate[c] = r->rows + n * (columns + c);
        r->slope[c] = r->rows + n * (columns + 3 + c);
        r->curvature[c] = r->rows + n * (columns + 6 + c);
    }
    r->factor = r->rows + n * (columns + 9);
    r->coefficients = r->factor + columns * columns;
    return true;
}

static void workspace_release(series_workspace *r)
{
    hci_memory_free(r->rows);
    hci_normal_equations_release(&r->normal);
}

/* Whether few samples that are no means bear the series: of a current that has orders they would lose the
 * higher ones. */
static bool is_borne(const hci_segment *segment, const series_workspace *r)
{
    return segment->turns > 0 || segment->count >= LEAST_IN_ALL || (r->noisy && !(r->slopes > 0.0));
}

/* The currents as a series of the orders of the turn, or of the electrical period. series: out, whether there
 * is one. */
static bool series_make(hci_binned_sample *sample, const hci_segment *segment, int pole_pairs, bool turns,
                        bool *series)
{
    const size_t n = segment->count;
    size_t periods[MOST_PERIODS];
    const double resolved = periods_resolved(sample, n);
    const size_t count = periods_list(pole_pairs, turns, n, resolved, periods);
    size_t all = count;
    series_workspace workspace;
    if (n < LEAST_IN_MEAN || count == 0) return true;
    bool made = workspace_make(&workspace, n, 2 * count + 1);
    if (made) *series = currents_fit(sample, n, pole_pairs, periods, count, &workspace);
    if (made && *series)
        made = standing_add(sample, n, pole_pairs, turns, &workspace, periods, &all, resolved);
    if (made && all > count) {
        workspace_release(&workspace);
        made = workspace_make(&workspace, n, 2 * all + 1);
        if (made) *series = currents_fit(sample, n, pole_pairs, periods, all, &workspace);
    }
    *series = *series && is_borne(segment, &workspace);
    if (made && *series) coordinates_write(&workspace, n, pole_pairs, sample);
    workspace_release(&workspace);
    return made;
}

bool hci_segment_smooth(hci_binned_sample *sample, const hci_segment *segment, int pole_pairs, bool turns,
                        bool currents, bool *series)
{
    const size_t n = segment->count;
    *series = false;
    if (segment->timed && segment->turns == 0 && n > 4 * REACH && is_turning(sample, n) &&
        !angle_smooth(sample, n, pole_pairs, turns))
        return false;
    if (!currents || !is_steady(sample, n, pole_pairs)) return true;
    if (!series_make(sample, segment, pole_pairs, turns, series)) return false;
    if (*series || !turns || segment->turns > 0) return true;
    return series_make(sample, segment, pole_pairs, false, series); /* an arc tells no orders of the turn */
}
