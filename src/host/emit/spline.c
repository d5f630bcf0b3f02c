/* In: waves over a period; out: knots c of a uniform B-spline of degree 1, 2 or 3 on the part of the period
 * that says all. The spline of the knots g·e^{iνj} is e^{iνu} times a function of the place in the interval
 * that is nearly real, and so each order has a factor g(ν) by which its largest error is the least. Errors
 * are measured with the very code that runs on the device. */
#include "host/emit/spline.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "hci/machine/frames.h"

/* Largest knots and currents in units, and largest differences of neighbours: no sum overflows. */
#define MOST_UNITS 32000.0
static const double MOST_STEP[] = {0.0, 2.0 * MOST_UNITS, MOST_UNITS, 10800.0};    /* [degree] */
static const double MOST_STEP_I8[] = {0.0, 2.0 * MOST_UNITS, MOST_UNITS, 10496.0}; /* 41 units of 256 */
#define CUBIC_UNITS 0.75 /* unit of a cubic knot in units of the currents */

/* What truncation in the device's arithmetic changes from one angle to the next, and rounding to whole units
 * of each of the parts. */
#define TRUNCATION 0.3
#define ROUNDING   0.51

/* Of the peak: with knots of 8 bits, 125 units to it, some current is off by 0.4 units but for happy chances.
 */
#define LEAST_ROUNDING (0.4 / 125.0)

/* Numbers of knots of 8 bits that are tried. */
enum { MOST_TRIES = 32 };

enum { PLACES = 16 };

/* Angles in an interval that are looked at, at most: with more, no table is good. */
#define MOST_FINE 128.0

/* ---- factors ---- */

/* Weights of the knots at the place u of an interval. */
static void weights_at(uint32_t degree, double u, double w[4])
{
    const double v = 1.0 - u;
    w[2] = w[3] = 0.0;
    if (degree == 1) {
        w[0] = v;
        w[1] = u;
    } else if (degree == 2) {
        w[0] = 0.5 * v * v;
        w[1] = 0.5 + u * v;
        w[2] = 0.5 * u * u;
    } else {
        w[0] = v * v * v / 6.0;
        w[1] = (1.0 + 3.0 * v * (1.0 + u * v)) / 6.0;
        w[2] = (1.0 + 3.0 * u * (1.0 + u * v)) / 6.0;
        w[3] = u * u * u / 6.0;
    }
}

/* Knot j of an interval stands for the place j − (degree − 1)/2 of it. */
static double knot_place(uint32_t degree, uint32_t j)
{
    return (double)j - 0.5 * (double)(degree - 1);
}

/* The knots' share of an order that turns by `step_rad` in an interval. */
static double factor_of(uint32_t degree, double step_rad)
{
    double least = DBL_MAX, most = -DBL_MAX, w[4];
    for (int k = 0; k <= PLACES; ++k) {
        const double u = (double)k / PLACES;
        double ratio = 0.0;
        weights_at(degree, u, w);
        for (uint32_t j = 0; j <= degree; ++j)
            ratio += w[j] * cos(step_rad * (knot_place(degree, j) - u));
        least = fmin(least, ratio);
        most = fmax(most, ratio);
    }
    return least + most > 0.5 ? 2.0 / (least + most) : 1.0;
}

/* ---- knots ---- */

static double interval_rad(const hci_spline_room *r, uint32_t intervals)
{
    return 2.0 * HCI_PI * (double)r->waves->period_turns / ((double)r->symmetry.sectors * (double)intervals);
}

/* Adds a wave, whose value is taken at theta_rad, to the columns of a row. */
static void add_wave(const hci_tabulation *t, const hci_wave *wave, double factor, double theta_rad,
                     double *row)
{
    double abc[3], value[3];
    hci_waves_at(wave, 1, theta_rad, abc);
    const hci_dq x = hci_park(hci_clarke(abc), theta_rad);
    value[0] = t->frame == HCI_TABLE_DQ ? x.d : abc[0];
    value[1] = t->frame == HCI_TABLE_DQ ? x.q : abc[1];
    value[2] = abc[2];
    for (size_t k = 0; k < t->columns; ++k)
        row[k] += factor * value[k];
}

/* One part: columns of every row, from `first` on. */
static void fill_part(const hci_spline_room *r, const hci_table_i16 *x, size_t part, double scale,
                      double *first)
{
    const hci_tabulation *t = r->waves;
    const bool per_Nm = t->parts == 2 && part == 0;
    const hci_wave *waves = per_Nm ? t->per_Nm : t->constant;
    const size_t count = per_Nm ? t->per_Nm_count : t->constant_count, stride = t->columns * t->parts;
    const double step_rad = interval_rad(r, x->intervals);
    for (size_t k = 0; k < (x->intervals + x->degree) * stride; k += stride)
        for (size_t c = 0; c < t->columns; ++c)
            first[k + c] = 0.0;
    for (size_t w = 0; w < count; ++w) {
        const double factor =
            scale * factor_of(x->degree, step_rad * hci_tabulation_order_seen(t, &waves[w]));
        for (uint32_t j = 0; j < x->intervals + x->degree; ++j)
            add_wave(t, &waves[w], factor, step_rad * knot_place(x->degree, j), first + j * stride);
    }
}

static void fill_knots(const hci_spline_room *r, const hci_table_i16 *x)
{
    const hci_tabulation *t = r->waves;
    if (t->parts == 2) fill_part(r, x, 0, t->torque_Nm, r->knots_A);
    fill_part(r, x, t->parts - 1, 1.0, r->knots_A + (t->parts - 1) * t->columns);
}

/* ---- units ---- */

/* The largest knot, sums of parts and a star's third phase included, and the largest difference of
 * neighbours. */
typedef struct {
    double value_A, step_A;
} extent;

/* Σ over parts of a column of a row less that before it; of column 2 of a star, that of the third phase. */
static double value_extent(const hci_tabulation *t, const double *row, const double *before, size_t column)
{
    double sum = 0.0;
    for (size_t p = 0; p < t->parts; ++p) {
        const double *x = row + p * t->columns, *y = before ? before + p * t->columns : NULL;
        const bool third = column >= t->columns;
        sum += fabs(third ? x[0] + x[1] - (y ? y[0] + y[1] : 0.0) : x[column] - (y ? y[column] : 0.0));
    }
    return sum;
}

static double row_extent(const hci_tabulation *t, const double *row, const double *before)
{
    double most = 0.0;
    for (size_t c = 0; c < (t->frame == HCI_TABLE_ABC ? 3u : 2u); ++c)
        most = fmax(most, value_extent(t, row, before, c));
    return most;
}

static extent extent_of(const hci_spline_room *r, const hci_table_i16 *x)
{
    const size_t stride = r->waves->columns * r->waves->parts;
    extent e = {0.0, 0.0};
    for (size_t j = 0; j < x->intervals + x->degree; ++j) {
        const double *row = r->knots_A + j * stride;
        e.value_A = fmax(e.value_A, row_extent(r->waves, row, NULL));
        if (j > 0) e.step_A = fmax(e.step_A, row_extent(r->waves, row, row - stride));
    }
    return e;
}

static void round_knots(const hci_spline_room *r, hci_table_i16 *x)
{
    const extent e = extent_of(r, x);
    const bool eight = x->knot_bits == 8;
    const double share = x->degree == 3 ? CUBIC_UNITS : 1.0;
    const double most_step = (eight ? MOST_STEP_I8 : MOST_STEP)[x->degree];
    const double unit_A = fmax(e.value_A / MOST_UNITS, e.step_A / most_step) / share;
    x->unit_A = unit_A > 0.0 ? (float)unit_A : 1.0f;
    const double knot_A = (double)x->unit_A * share * (eight ? 256.0 : 1.0);
    for (size_t k = 0; k < (size_t)(x->intervals + x->degree) * x->columns * x->parts; ++k) {
        const double knot = floor(hci_tabulation_clean(r->knots_A[k]) / knot_A + 0.5);
        if (eight)
            r->knots_i8[k] = (int8_t)knot;
        else
            r->knots[k] = (int16_t)knot;
        r->knots_A[k] = knot * knot_A;
    }
}

/* ---- error ---- */

/* Largest second derivative of the spline: that of a knot's second difference. */
static double spline_bend_A(const hci_spline_room *r, const hci_table_i16 *x)
{
    const size_t stride = (size_t)x->columns * x->parts;
    const double step_rad = interval_rad(r, x->intervals);
    double most_A = 0.0;
    for (size_t k = 2 * stride; x->degree > 1 && k < (x->intervals + x->degree) * stride; ++k) {
        const double *c = r->knots_A + k;
        most_A = fmax(most_A, fabs(c[0] - 2.0 * c[-(ptrdiff_t)stride] + c[-2 * (ptrdiff_t)stride]));
    }
    return 2.0 * (double)x->parts * most_A / (step_rad * step_rad); /* 2: the third phase */
}

typedef struct {
    uint32_t fine;
    double margin_A;
} grid;

/* Between two angles δ apart the error passes the larger of its values there by δ²/8 times its second
 * derivative at most. */
static grid grid_of(const hci_spline_room *r, const hci_table_i16 *x)
{
    const hci_tabulation *t = r->waves;
    const double step_rad = interval_rad(r, x->intervals);
    const double fine = fmin(fmax(32.0, ceil(20.0 * step_rad * hci_tabulation_highest_order(t))), MOST_FINE);
    const double d_rad = step_rad / fine, bend_A = hci_tabulation_bend_A(t) + spline_bend_A(r, x);
    return (grid){(uint32_t)fine, d_rad * d_rad / 8.0 * bend_A + TRUNCATION * (double)x->unit_A * x->parts +
                                      ldexp(hci_tabulation_bound_A(t), -21)};
}

typedef struct {
    double error_A, peak_A;
} extremes;

static void measure_at(const hci_tabulation *t, const hci_table_i16 *x, uint32_t angle, double torque_Nm,
                       extremes *most)
{
    double exact[3], phase_A;
    float current[3];
    hci_tabulation_exact(t, angle, torque_Nm, exact, &phase_A);
    hci_table_i16_currents(x, angle, (float)torque_Nm, current);
    for (size_t s = 0; s < 3; ++s)
        most->error_A = fmax(most->error_A, fabs((double)current[s] - exact[s]));
    most->peak_A = fmax(most->peak_A, phase_A);
}

/* The sector that is kept, and the first angle of each other one: those differ by phases and signs alone. */
static void measure(const hci_spline_room *r, hci_table_i16 *x)
{
    const hci_tabulation *t = r->waves;
    const grid g = grid_of(r, x);
    const double count = (double)x->intervals * g.fine, sector = 4294967296.0 / x->sectors;
    extremes most = {0.0, 0.0};
    for (double k = 0.0; k < count + x->sectors; k += 1.0) {
        const uint32_t angle = (uint32_t)(k < count ? k / count * sector : ceil((k - count) * sector));
        measure_at(t, x, angle, t->torque_Nm, &most);
        if (t->parts == 2) measure_at(t, x, angle, -t->torque_Nm, &most);
    }
    const double unit_A = (double)x->unit_A;
    x->max_error_A = hci_tabulation_round_up(most.error_A + g.margin_A);
    x->max_error_q15_A =
        hci_tabulation_round_up(most.error_A + g.margin_A + ROUNDING * unit_A * (x->parts == 2 ? 3.0 : 1.0));
    x->peak_A = hci_tabulation_round_up(most.peak_A);
}

void hci_spline_make(const hci_spline_room *r, uint32_t degree, uint32_t intervals, hci_table_i16 *x)
{
    const hci_tabulation *t = r->waves;
    const bool eight = r->knot_bits == 8;
    *x = (hci_table_i16){.knots = eight ? NULL : r->knots,
                         .knots_i8 = eight ? r->knots_i8 : NULL,
                         .knot_bits = r->knot_bits,
                         .intervals = intervals,
                         .degree = degree,
                         .columns = (uint32_t)t->columns,
                         .parts = (uint32_t)t->parts,
                         .sectors = r->symmetry.sectors,
                         .rotation = r->symmetry.rotation,
                         .alternates = r->symmetry.alternates,
                         .frame = t->frame,
                         .period_turns = (uint32_t)t->period_turns,
                         .reference_torque_Nm = (float)t->torque_Nm};
    fill_knots(r, x);
    round_knots(r, x);
    measure(r, x);
}

static bool is_within(const hci_spline_room *r, uint32_t degree, uint32_t intervals, double max_error_A,
                      bool integer, hci_table_i16 *x)
{
    hci_spline_make(r, degree, intervals, x);
    return (double)(integer ? x->max_error_q15_A : x->max_error_A) <= max_error_A;
}

bool hci_spline_make_within(const hci_spline_room *r, uint32_t degree, double max_error_A, bool integer,
                            hci_table_i16 *x)
{
    uint32_t bad = 0, good = 1;
    while (!is_within(r, degree, good, max_error_A, integer, x)) {
        if (good == HCI_TABLE_I16_MOST_INTERVALS) return false;
        bad = good;
        good = 2 * good < HCI_TABLE_I16_MOST_INTERVALS ? 2 * good : HCI_TABLE_I16_MOST_INTERVALS;
    }
    while (good - bad > 1) {
        const uint32_t middle = bad + (good - bad) / 2;
        *(is_within(r, degree, middle, max_error_A, integer, x) ? &good : &bad) = middle;
    }
    return is_within(r, degree, good, max_error_A, integer, x);
}

bool hci_spline_make_i8_within(const hci_spline_room *r, uint32_t degree, uint32_t first, double max_error_A,
                               hci_table_i16 *x)
{
    const uint32_t step = 1 + first / MOST_TRIES;
    for (uint32_t k = 0; k < MOST_TRIES && first + k * step <= HCI_TABLE_I16_MOST_INTERVALS; ++k) {
        if (is_within(r, degree, first + k * step, max_error_A, true, x)) return true;
        if ((double)x->peak_A * LEAST_ROUNDING > max_error_A) break;
    }
    return false;
}
