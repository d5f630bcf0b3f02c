/* Rows of a table and how far off it is. In: waves over a period, and points or an allowed error; out: the
 * rows in single precision, a bound of the error that holds at every angle, and the peak. The table is read
 * with the very code that runs on the device. */
#include "host/emit/tabulate.h"

#include <math.h>

#include "hci/machine/frames.h"

/* Below this a current in A or A/(N·m) is rounding dust of sin and cos, which differs from one libm to the
 * next. */
static const double DUST = 1e-12;

static double amplitude(const hci_wave *w)
{
    return hci_amplitude(w->sine, w->cosine);
}

double hci_tabulation_bound_A(const hci_tabulation *t)
{
    double constant = 0.0, per_Nm = 0.0;
    for (size_t k = 0; k < t->constant_count; ++k)
        constant += amplitude(&t->constant[k]);
    for (size_t k = 0; k < t->per_Nm_count; ++k)
        per_Nm += amplitude(&t->per_Nm[k]);
    return constant + t->torque_Nm * per_Nm;
}

double hci_tabulation_order_seen(const hci_tabulation *t, const hci_wave *w)
{
    return t->frame == HCI_TABLE_ABC ? w->order : w->order - w->sequence;
}

/* |d²i/dθ²| of one wave. */
static double curvature(const hci_tabulation *t, const hci_wave *w)
{
    const double order = hci_tabulation_order_seen(t, w);
    return order * order * amplitude(w);
}

double hci_tabulation_bend_A(const hci_tabulation *t)
{
    double constant = 0.0, per_Nm = 0.0;
    for (size_t k = 0; k < t->constant_count; ++k)
        constant += curvature(t, &t->constant[k]);
    for (size_t k = 0; k < t->per_Nm_count; ++k)
        per_Nm += curvature(t, &t->per_Nm[k]);
    return constant + t->torque_Nm * per_Nm;
}

double hci_tabulation_highest_order(const hci_tabulation *t)
{
    double highest = 1.0;
    for (size_t k = 0; k < t->constant_count; ++k)
        highest = fmax(highest, t->constant[k].order);
    for (size_t k = 0; k < t->per_Nm_count; ++k)
        highest = fmax(highest, t->per_Nm[k].order);
    return highest;
}

double hci_tabulation_highest_seen(const hci_tabulation *t)
{
    double highest = 0.0;
    for (size_t k = 0; k < t->constant_count; ++k)
        highest = fmax(highest, fabs(hci_tabulation_order_seen(t, &t->constant[k])));
    for (size_t k = 0; k < t->per_Nm_count; ++k)
        highest = fmax(highest, fabs(hci_tabulation_order_seen(t, &t->per_Nm[k])));
    return highest;
}

static void to_frame(const hci_tabulation *t, const double abc[3], double theta_rad, double current[3])
{
    if (t->frame == HCI_TABLE_DQ) {
        const hci_dq x = hci_park(hci_clarke(abc), theta_rad);
        current[0] = x.d;
        current[1] = x.q;
        current[2] = 0.0;
    } else {
        for (size_t s = 0; s < 3; ++s)
            current[s] = abc[s];
    }
}

static void waves_at(const hci_wave *waves, size_t count, const hci_wave_samples *samples, size_t turns,
                     double share, double abc[3])
{
    if (samples->count > 0)
        hci_wave_samples_at(samples, share, abc);
    else
        hci_waves_at(waves, count, 2.0 * HCI_PI * (double)turns * share, abc);
}

void hci_tabulation_exact(const hci_tabulation *t, uint32_t angle, double torque_Nm, double current[3],
                          double *phase_A)
{
    const double share = (double)angle / 4294967296.0;
    const double theta_rad = 2.0 * HCI_PI * (double)t->period_turns * share;
    double abc[3], slope[3];
    waves_at(t->constant, t->constant_count, &t->constant_samples, t->period_turns, share, abc);
    waves_at(t->per_Nm, t->per_Nm_count, &t->per_Nm_samples, t->period_turns, share, slope);
    for (size_t s = 0; s < 3; ++s)
        abc[s] += torque_Nm * slope[s];
    to_frame(t, abc, theta_rad, current);
    if (phase_A) *phase_A = fmax(fabs(abc[0]), fmax(fabs(abc[1]), fabs(abc[2])));
}

double hci_tabulation_peak_A(const hci_tabulation *t)
{
    /* cos(π/count·order) is what the grid misses at most */
    const double count =
        ceil(fmin(256.0 * hci_tabulation_highest_order(t), 65536.0) * (double)t->period_turns);
    double exact[3], phase_A, peak_A = 0.0;
    for (double k = 0.0; k < count; k += 1.0)
        for (int sign = -1; sign < (int)t->parts; sign += 2) {
            hci_tabulation_exact(t, (uint32_t)(k / count * 4294967296.0), sign * t->torque_Nm, exact,
                                 &phase_A);
            peak_A = fmax(peak_A, phase_A);
        }
    return peak_A;
}

double hci_tabulation_clean(double current)
{
    return fabs(current) < DUST ? 0.0 : current;
}

/* ---- rows ---- */

/* Where the values of a table come from: the waves, or the samples of them, where there are any, which are
 * quicker by far where the waves are many, and off by 1e-11 of them: for tables that are but measured. */
typedef enum { OF_WAVES, OF_SAMPLES } source;

static void fill_part(const hci_tabulation *t, const hci_wave *waves, size_t count,
                      const hci_wave_samples *samples, double share, float *out)
{
    double abc[3], value[3];
    waves_at(waves, count, samples, t->period_turns, share, abc);
    to_frame(t, abc, 2.0 * HCI_PI * (double)t->period_turns * share, value);
    for (size_t k = 0; k < t->columns; ++k)
        out[k] = (float)hci_tabulation_clean(value[k]);
}

/* Row k of a table; the last one, the guard, is computed as the first one. */
static void fill_row(const hci_tabulation *t, source from, size_t points, size_t k, float *rows)
{
    static const hci_wave_samples NONE = {NULL, 0};
    const double share = (double)(k % points) / (double)points;
    float *row = rows + k * t->parts * t->columns;
    if (t->parts == 2) {
        fill_part(t, t->per_Nm, t->per_Nm_count, from == OF_SAMPLES ? &t->per_Nm_samples : &NONE, share, row);
        row += t->columns;
    }
    fill_part(t, t->constant, t->constant_count, from == OF_SAMPLES ? &t->constant_samples : &NONE, share,
              row);
}

/* ---- error ---- */

/* A grid of `fine` angles in each of `points` intervals, and what the error can be above that at the grid. */
typedef struct {
    size_t points, fine;
    double margin_A;
} grid;

/* What is the same for any number of points. */
typedef struct {
    double highest_order, bend_A, bound_A;
} bounds;

static bounds bounds_of(const hci_tabulation *t)
{
    return (bounds){hci_tabulation_highest_order(t), hci_tabulation_bend_A(t), hci_tabulation_bound_A(t)};
}

/* The error of a chord of f between two angles δ apart is a function with the curvature of f, so it passes
 * the larger of its values there by δ²/8·max|f''| at most. Rows, interpolation and sums in single precision,
 * with or without fused multiply-add, stay within 2⁻²¹ of the largest current of each other. */
static grid grid_of(const hci_tabulation *t, const bounds *b, size_t points)
{
    const double least = 64.0 * b->highest_order * (double)t->period_turns / (double)points;
    grid g = {points, (size_t)fmax(32.0, ceil(least)), 0.0};
    const double step_rad = 2.0 * HCI_PI * (double)t->period_turns / ((double)points * (double)g.fine);
    g.margin_A = step_rad * step_rad / 8.0 * b->bend_A + ldexp(b->bound_A, -21);
    return g;
}

/* The first angle of the runtime at or after grid angle j of interval k. */
static uint32_t grid_angle(grid g, size_t k, size_t j)
{
    const uint64_t count = (uint64_t)g.points * g.fine;
    return (uint32_t)((((uint64_t)k * g.fine + j) * (UINT64_C(1) << 32) + count - 1) / count);
}

typedef struct {
    double error_A, peak_A;
} extremes;

static void measure_at(const hci_tabulation *t, const hci_table_f32 *table, uint32_t angle, double torque_Nm,
                       extremes *most)
{
    double exact[3], phase_A;
    float current[3];
    hci_tabulation_exact(t, angle, torque_Nm, exact, &phase_A);
    hci_table_f32_currents(table, angle, (float)torque_Nm, current);
    for (size_t s = 0; s < 3; ++s)
        most->error_A = fmax(most->error_A, fabs((double)current[s] - exact[s]));
    most->peak_A = fmax(most->peak_A, phase_A);
}

/* Measures interval k, from its middle on and around, where a chord is most off, until the error passes
 * `limit_A`. Currents are linear in torque: the ends decide. */
static void measure_interval(const hci_tabulation *t, const hci_table_f32 *table, grid g, size_t k,
                             double limit_A, extremes *most)
{
    for (size_t j = 0; j < g.fine && most->error_A <= limit_A; ++j) {
        const uint32_t angle = grid_angle(g, k, (j + g.fine / 2) % g.fine);
        measure_at(t, table, angle, t->torque_Nm, most);
        if (t->parts == 2) measure_at(t, table, angle, -t->torque_Nm, most);
    }
}

static hci_table_f32 table_of(const hci_tabulation *t, size_t points, const float *rows)
{
    hci_table_f32 table = {0};
    table.rows = rows;
    table.points = (uint32_t)points;
    table.columns = (uint32_t)t->columns;
    table.parts = (uint32_t)t->parts;
    table.frame = t->frame;
    table.period_turns = (uint32_t)t->period_turns;
    table.reference_torque_Nm = (float)t->torque_Nm;
    return table;
}

float hci_tabulation_round_up(double x)
{
    const float y = (float)x;
    return (double)y < x ? nextafterf(y, INFINITY) : y;
}

/* Fills and measures the table interval by interval, from interval *first on and around, and stops in the
 * first one whose error passes the limit: *first is then that interval's place. False in that case. */
static bool tabulate(const hci_tabulation *t, source from, grid g, double limit_A, double *first, float *rows,
                     hci_table_f32 *table)
{
    const size_t start = (size_t)(*first * (double)g.points);
    extremes most = {0.0, 0.0};
    *table = table_of(t, g.points, rows);
    for (size_t n = 0; n < g.points; ++n) {
        const size_t k = (start + n) % g.points;
        if (n == 0 || k == 0) fill_row(t, from, g.points, k, rows);
        fill_row(t, from, g.points, k + 1, rows);
        measure_interval(t, table, g, k, limit_A, &most);
        if (most.error_A > limit_A) {
            *first = ((double)k + 0.5) / (double)g.points;
            return false;
        }
    }
    table->max_error_A = hci_tabulation_round_up(most.error_A + g.margin_A);
    table->peak_A = hci_tabulation_round_up(most.peak_A);
    return true;
}

static void tabulate_all(const hci_tabulation *t, source from, size_t points, float *rows,
                         hci_table_f32 *table)
{
    const bounds b = bounds_of(t);
    double first = 0.0;
    (void)tabulate(t, from, grid_of(t, &b, points), HUGE_VAL, &first, rows, table);
}

void hci_tabulate(const hci_tabulation *t, size_t points, float *rows, hci_table_f32 *table)
{
    tabulate_all(t, OF_WAVES, points, rows, table);
}

void hci_tabulate_roughly(const hci_tabulation *t, size_t points, float *rows, hci_table_f32 *table)
{
    tabulate_all(t, OF_SAMPLES, points, rows, table);
}

static bool has_samples(const hci_tabulation *t)
{
    return t->constant_samples.count > 0 || t->per_Nm_samples.count > 0;
}

/* Whether a table of a grid keeps the error: where there are samples, they are asked first. */
static bool keeps(const hci_tabulation *t, grid g, double max_error_A, double *first, float *rows,
                  hci_table_f32 *table)
{
    const double limit_A = max_error_A - g.margin_A;
    return limit_A >= 0.0 && (!has_samples(t) || tabulate(t, OF_SAMPLES, g, limit_A, first, rows, table)) &&
           tabulate(t, OF_WAVES, g, limit_A, first, rows, table) && (double)table->max_error_A <= max_error_A;
}

/* The error does not fall steadily with the points, so each number is tried in turn, beginning where the one
 * before has failed: that is nearly always enough to refuse it. */
bool hci_tabulate_within(const hci_tabulation *t, double max_error_A, size_t most_points, float *rows,
                         hci_table_f32 *table)
{
    const bounds b = bounds_of(t);
    double first = 0.0;
    for (size_t points = 1; points <= most_points; ++points)
        if (keeps(t, grid_of(t, &b, points), max_error_A, &first, rows, table)) return true;
    return false;
}
