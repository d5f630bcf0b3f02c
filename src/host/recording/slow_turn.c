#include "host/recording/slow_turn.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "hci/host/base/note.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/noise.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define NEGLIGIBLE 0.2   /* inertia × acceleration beside the torque of the current */
#define LOAD       4.0   /* times what the size of a current varies by */
#define WORTH_WORD 0.005 /* inertia × acceleration of which nothing need be said, in the same measure */

#define MOVED_RAD 0.1 /* that a shaft at rest does not turn by */

#define COMMON 0.02 /* share of the mean square that neighbours have in common, of a current that flows … */
#define CHANCE 3.0  /* … beyond what they have by chance, in standard deviations */

#define NEAR_RAD (2.0 * HCI_PI / 48.0) /* electrical: four samples in a period of order 12 */

enum { LEAST = 16, ENOUGH = 100 };

/* rms about the mean of torque_constant·i_q. */
static double rms_of_current(const hci_run *run, int pole_pairs, double constant)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const double made = constant * hci_run_dq(run, pole_pairs, k).q;
        sum += made;
        square += made * made;
    }
    const double share = 1.0 / (double)run->count;
    return sqrt(fmax(0.0, share * square - share * sum * share * sum));
}

/* Samples from where the shaft has begun to move to where it has not yet come to rest. */
typedef struct {
    size_t first, count;
} span;

static span moving_span(const hci_run *run)
{
    const double *x = run->theta_m_rad;
    size_t first = 0, end = run->count;
    while (first + 1 < end && fabs(x[first] - x[0]) < MOVED_RAD)
        ++first;
    while (end > first + 1 && fabs(x[end - 1] - x[run->count - 1]) < MOVED_RAD)
        --end;
    return end - first < LEAST ? (span){0, run->count} : (span){first, end - first};
}

/* Of a shaft that no current flows in: white, so that neighbours have nothing in common, while a current that
 * holds is much the same from one sample to the next, where these are near each other. */
static bool has_no_current(const hci_run *run, int pole_pairs)
{
    double common = 0.0, square = 0.0, way_rad = 0.0;
    for (size_t k = 1; k < run->count; ++k)
        way_rad += fabs(run->theta_m_rad[k] - run->theta_m_rad[k - 1]);
    if (way_rad * pole_pairs > NEAR_RAD * (double)run->count) return false;
    hci_dq before = hci_run_dq(run, pole_pairs, 0);
    for (size_t k = 1; k < run->count; ++k) {
        const hci_dq i = hci_run_dq(run, pole_pairs, k);
        common += i.d * before.d + i.q * before.q;
        square += i.d * i.d + i.q * i.q;
        before = i;
    }
    return common < (COMMON + CHANCE / sqrt(2.0 * (double)run->count)) * square;
}

bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A)
{
    if (!(torque_constant_Nm_per_A > 0.0) || run->count < LEAST || run->theta_m_rad == NULL) return false;
    const double rms_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double mean_Nm = hci_mean(run->torque_Nm, run->count);
    const double accelerating_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, mean_Nm));
    const span moving = moving_span(run);
    const double energy_J =
        0.5 * inertia_kgm2 * hci_mean_square_about(run->speed_rad_per_s + moving.first, moving.count, 0.0);
    if (has_no_current(run, pole_pairs)) return false;
    return accelerating_Nm < NEGLIGIBLE * rms_Nm && energy_J < rms_Nm / pole_pairs;
}

/* The longest ways up and down; noise of the angle is in neither. */
static void ways_of(const double *theta_m_rad, size_t count, double *up_rad, double *down_rad)
{
    double least = theta_m_rad[0], most = theta_m_rad[0];
    *up_rad = *down_rad = 0.0;
    for (size_t k = 0; k < count; ++k) {
        least = fmin(least, theta_m_rad[k]);
        most = fmax(most, theta_m_rad[k]);
        *up_rad = fmax(*up_rad, theta_m_rad[k] - least);
        *down_rad = fmax(*down_rad, most - theta_m_rad[k]);
    }
}

bool hci_is_slow(const hci_run *run, int pole_pairs)
{
    double pace = 0.0;
    if (run->theta_m_rad == NULL || run->time_s == NULL || run->speed_rad_per_s == NULL) return false;
    if (run->count < LEAST || !(rms_of_current(run, pole_pairs, 1.0) > 0.0)) return false;
    if (has_no_current(run, pole_pairs)) return false;
    const span moving = moving_span(run);
    for (size_t k = 0; k < moving.count; ++k)
        pace += fabs(run->speed_rad_per_s[moving.first + k]) / (double)moving.count;
    return pace < HCI_SLOW_TURN_RAD_PER_S;
}

bool hci_is_slow_turn_both_ways(const hci_run *run, int pole_pairs)
{
    double up_rad, down_rad;
    if (!hci_is_slow(run, pole_pairs)) return false;
    ways_of(run->theta_m_rad, run->count, &up_rad, &down_rad);
    return fmin(up_rad, down_rad) > HCI_PI / pole_pairs;
}

static void take_from_iq(hci_run *run, int pole_pairs, size_t k, double iq_A)
{
    const hci_dq off = {.d = 0.0, .q = iq_A};
    double phases_A[3];
    hci_phases_of_dq(off, pole_pairs * run->theta_m_rad[k], phases_A);
    for (size_t s = 0; s < 3; ++s)
        run->i_A[3 * k + s] -= phases_A[s];
}

void hci_slow_turn_take_constant(hci_run *run, int pole_pairs, double iq_A)
{
    for (size_t k = 0; k < run->count; ++k)
        take_from_iq(run, pole_pairs, k, iq_A);
}

void hci_slow_turn_correct(hci_run *run, int pole_pairs, double torque_constant_Nm_per_A)
{
    const double made_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double rms_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, 0.0));
    for (size_t k = 0; k < run->count; ++k)
        take_from_iq(run, pole_pairs, k, run->torque_Nm[k] / torque_constant_Nm_per_A);
    run->inertia_share = made_Nm > 0.0 ? rms_Nm / made_Nm : 0.0;
    if (rms_Nm > WORTH_WORD * made_Nm)
        hci_note_add(&run->remark,
                     "inertia x acceleration, %.3g N·m rms, is taken out of the %.3g N·m that i_q makes",
                     rms_Nm, made_Nm);
}

bool hci_run_is_loaded(const hci_run *run, int pole_pairs)
{
    double size_A = 0.0, square = 0.0;
    if (run->count == 0 || !run->i_A || !run->theta_m_rad) return false;
    for (size_t k = 0; k < run->count; ++k) {
        const double iq_A = hci_run_dq(run, pole_pairs, k).q;
        size_A += fabs(iq_A) / (double)run->count;
        square += iq_A * iq_A / (double)run->count;
    }
    return size_A * size_A > LOAD * LOAD * (square - size_A * size_A);
}

/* ---- the way of rows without time ---- */

#define SLOWLY_RAD_PER_S 0.1
#define REVERSALS        0.05 /* of the rows, at which a shaft may turn back */

enum { LEAST_ROWS = 16 };

/* −1, 0 or 1: how the angle goes from a row to the next. */
static int step_of(const hci_run *run, size_t k)
{
    const double step = run->theta_m_rad[k + 1] - run->theta_m_rad[k];
    return (step > 0.0) - (step < 0.0);
}

static size_t reversals_of(const hci_run *run)
{
    size_t reversals = 0;
    int before = 0;
    for (size_t k = 0; k + 1 < run->count; ++k) {
        const int step = step_of(run, k);
        reversals += step * before < 0;
        before = step ? step : before;
    }
    return reversals;
}

bool hci_row_direction_set(hci_run *run)
{
    if (run->time_s || run->speed_rad_per_s || !run->theta_m_rad || run->count < LEAST_ROWS) return true;
    if ((double)reversals_of(run) > REVERSALS * (double)run->count) return true;
    run->speed_rad_per_s = hci_memory_new(run->count, sizeof *run->speed_rad_per_s);
    if (!run->speed_rad_per_s) return false;
    for (size_t k = 0, before = 0; k < run->count; before = k++) {
        const int step = step_of(run, k + 1 < run->count ? k : k - 1);
        run->speed_rad_per_s[k] = step ? step * SLOWLY_RAD_PER_S : run->speed_rad_per_s[before];
    }
    hci_note_add(&run->remark,
                 "no time and no speed: the shaft turned slowly, the way the angle goes from row to row");
    return true;
}

/* Of the rows, in each direction at least, of a shaft that was turned forward and back. */
#define BOTH_WAYS 0.1

bool hci_row_direction_of_both_set(hci_run *run)
{
    size_t forward = 0, back = 0;
    for (size_t k = 0; run->theta_m_rad && k + 1 < run->count; ++k) {
        forward += step_of(run, k) > 0;
        back += step_of(run, k) < 0;
    }
    const double least = (double)(forward < back ? forward : back);
    return least > BOTH_WAYS * (double)run->count ? hci_row_direction_set(run) : true;
}

/* ---- rows in which the current answers something else ---- */

#define WINDOW_TURNS 0.05 /* electrical, over which the speed is looked at */
#define LEAST_WAY    2.0  /* electrical turns of a part that is looked at */
#define REACH        0.5  /* electrical turns from its ends */
#define LEAST_AWAY   0.1  /* of the pace of a part, … */
#define AWAY         3.0  /* … and times the rms by which the speed varies in it, that is no pace of it */
#define WAITS        0.2  /* of the pace: less, and the shaft waits */
#define STAYS_TURNS  0.02 /* electrical, within which a shaft stays that waits on its way … */
#define WAIT_TURNS   0.5  /* … as long as it takes for so much of it */

enum {
    MOST_WAITS = 3 /* on a way; where there are more it goes in steps, and what is read at rest is meant */
};

typedef struct {
    const hci_run *run;
    double turn_rad;        /* mechanical angle of an electrical turn */
    bool *out;              /* of each row */
    size_t waiting, others; /* rows that are out */
} rows;

/* Rows first … end − 1 go one way; behind them the shaft turns round, or the recording ends. */
typedef struct {
    size_t first, end;
    size_t inner_first, inner_end; /* without what is within reach of its ends */
    size_t half;                   /* rows of half a window */
    double pace;                   /* mechanical, rad/s, signed */
    double away;                   /* share of the pace */
} part;

/* Over the pace of the part: 1 where the shaft goes on as in the rest of it. */
static double relative_speed(const hci_run *run, const part *a, size_t k)
{
    const size_t from = k > a->half ? k - a->half : 0;
    const size_t to = k + a->half < run->count ? k + a->half : run->count - 1;
    const double span_s = run->time_s[to] - run->time_s[from];
    return span_s > 0.0 ? (run->theta_m_rad[to] - run->theta_m_rad[from]) / span_s / a->pace : 1.0;
}

/* False: too short, or it has no pace. */
static bool measure(const rows *x, part *a)
{
    const double *theta = x->run->theta_m_rad, from = theta[a->first], to = theta[a->end - 1];
    a->inner_first = a->first;
    a->inner_end = a->end;
    if (fabs(to - from) < LEAST_WAY * x->turn_rad) return false;
    while (fabs(theta[a->inner_first] - from) < REACH * x->turn_rad)
        ++a->inner_first;
    while (fabs(theta[a->inner_end - 1] - to) < REACH * x->turn_rad)
        --a->inner_end;
    if (a->inner_end < a->inner_first + LEAST) return false;
    const double way = theta[a->inner_end - 1] - theta[a->inner_first];
    const double turns = fabs(way) / x->turn_rad, count = (double)(a->inner_end - a->inner_first);
    a->pace = way / (x->run->time_s[a->inner_end - 1] - x->run->time_s[a->inner_first]);
    a->half = (size_t)(0.5 * WINDOW_TURNS * count / turns) + 1;
    double square = 0.0;
    for (size_t k = a->inner_first; k < a->inner_end; ++k) {
        const double off = relative_speed(x->run, a, k) - 1.0;
        square += off * off / count;
    }
    a->away = fmax(LEAST_AWAY, AWAY * sqrt(square));
    return isfinite(a->pace) && isfinite(square);
}

static void leave_out(rows *x, const part *a, size_t from, size_t to)
{
    for (size_t k = from; k < to; ++k) {
        if (x->out[k]) continue;
        x->out[k] = true;
        ++*(fabs(relative_speed(x->run, a, k)) < WAITS ? &x->waiting : &x->others);
    }
}

static bool is_settled(const rows *x, const part *a, size_t k)
{
    return fabs(relative_speed(x->run, a, k) - 1.0) <= a->away;
}

/* The first row of a part is the one behind the turning point, where the window is half in the other one. */
static void take(rows *x, part *a)
{
    if (!measure(x, a)) return;
    size_t from = a->inner_first, to = a->inner_end;
    while (from > a->first && is_settled(x, a, from - 1))
        --from;
    while (to < a->end && is_settled(x, a, to))
        ++to;
    /* a window in which the speed is off reaches as far */
    if (from > a->first) from = from + a->half < a->inner_end ? from + a->half : a->inner_end;
    if (to < a->end) to = to > from + a->half ? to - a->half : from;
    leave_out(x, a, a->first, from);
    leave_out(x, a, to, a->end);
}

/* Behind the rows from `first` on between which the shaft stays where it is. */
static size_t stay_end(const rows *x, size_t first, size_t end)
{
    const double *theta = x->run->theta_m_rad;
    double least = theta[first], most = theta[first];
    size_t k = first;
    for (; k < end; ++k) {
        least = fmin(least, theta[k]);
        most = fmax(most, theta[k]);
        if (most - least > STAYS_TURNS * x->turn_rad) break;
    }
    return k;
}

/* Middles of the waits on a way; more than MOST_WAITS: there are more. */
static size_t waits_of(const rows *x, size_t first, size_t end, size_t middle[MOST_WAITS])
{
    const double *t = x->run->time_s;
    const double way = fabs(x->run->theta_m_rad[end - 1] - x->run->theta_m_rad[first]);
    const double least_s = WAIT_TURNS * x->turn_rad / way * (t[end - 1] - t[first]);
    size_t waits = 0;
    for (size_t k = first, next; k < end && waits <= MOST_WAITS; k = next) {
        const size_t stay = stay_end(x, k, end);
        const bool is_inside = k > first && stay < end;
        const bool is_wait = t[stay - 1] - t[k] > least_s;
        if (is_wait && is_inside && waits++ < MOST_WAITS) middle[waits - 1] = k + (stay - k) / 2;
        next = is_wait ? stay : k + 1 + (stay - k) / 4;
    }
    return waits;
}

/* A way from turning point to turning point, cut where the shaft waits on it. */
static void take_way(rows *x, size_t first, size_t end)
{
    size_t middle[MOST_WAITS];
    size_t waits = waits_of(x, first, end, middle);
    if (waits > MOST_WAITS) waits = 0;
    for (size_t j = 0; j <= waits; ++j)
        take(x, &(part){.first = j > 0 ? middle[j - 1] : first, .end = j < waits ? middle[j] : end});
}

/* Cut where the angle has gone back by half an electrical turn. */
static void find_parts(rows *x)
{
    const double *theta = x->run->theta_m_rad;
    size_t start = 0, extreme = 0;
    int way = 0;
    for (size_t k = 1; k < x->run->count; ++k) {
        const double gone = theta[k] - theta[extreme];
        if (way * gone > 0.0) {
            extreme = k;
        } else if (fabs(gone) > REACH * x->turn_rad) {
            if (way != 0) take_way(x, start, extreme + 1);
            start = way != 0 ? extreme + 1 : start;
            way = gone > 0.0 ? 1 : -1;
            extreme = k;
        }
    }
    if (way != 0) take_way(x, start, x->run->count);
}

/* ---- */

static void compact(double *values, size_t width, const bool *out, size_t count)
{
    size_t kept = 0;
    for (size_t k = 0; values != NULL && k < count; ++k)
        if (!out[k]) memmove(values + width * kept++, values + width * k, width * sizeof *values);
}

static void compact_rows(hci_run *run, const bool *out)
{
    size_t kept = 0;
    for (size_t k = 0; k < run->count; ++k) {
        if (run->row != NULL && !out[k]) run->row[kept] = run->row[k];
        kept += !out[k];
    }
    run->count = kept;
}

void hci_run_rows_leave(hci_run *run, const bool *out)
{
    double *const one[] = {run->time_s, run->theta_m_rad, run->speed_rad_per_s, run->torque_Nm,
                           run->temperature_C};
    for (size_t j = 0; j < sizeof one / sizeof *one; ++j)
        compact(one[j], 1, out, run->count);
    compact(run->i_A, 3, out, run->count);
    compact(run->v_V, 3, out, run->count);
    compact_rows(run, out);
}

static void say(const rows *x, size_t count, hci_note *remark)
{
    if (x->waiting > 0 && x->others > 0)
        hci_note_add(
            remark,
            "%zu of %zu rows are not used: in %zu the shaft waits, and in %zu it speeds up, slows down "
            "or turns round",
            x->waiting + x->others, count, x->waiting, x->others);
    else
        hci_note_add(remark, "%zu of %zu rows are not used, in which the shaft %s", x->waiting + x->others,
                     count, x->waiting > 0 ? "waits" : "speeds up, slows down or turns round");
}

static double range_of(const double *x, size_t count)
{
    double least = x[0], most = x[0];
    for (size_t k = 1; k < count; ++k) {
        least = fmin(least, x[k]);
        most = fmax(most, x[k]);
    }
    return most - least;
}

bool hci_settled_rows_keep(hci_run *run, int pole_pairs)
{
    if (run->time_s == NULL || run->theta_m_rad == NULL || run->count < LEAST) return true;
    rows x = {.run = run, .turn_rad = 2.0 * HCI_PI / pole_pairs};
    x.out = hci_memory_new(run->count, sizeof *x.out);
    if (x.out == NULL) return false;
    find_parts(&x);
    if (x.waiting + x.others > 0) {
        run->swept_rad = range_of(run->theta_m_rad, run->count);
        say(&x, run->count, &run->remark);
        hci_run_rows_leave(run, x.out);
    }
    hci_memory_free(x.out);
    return true;
}

/* ---- a free shaft that stands ---- */

#define AT_REST 8.0 /* times the noise of the angle, within which a shaft stands */

/* Of `count` samples from one end in steps of `step`: those that stand where the first one does. */
static size_t standing(const double *x, size_t count, ptrdiff_t step, double least_rad)
{
    size_t k = 0;
    while (k < count && fabs(x[step * (ptrdiff_t)k] - x[0]) <= least_rad)
        ++k;
    return k;
}

/* As long as the slopes of the samples that are left need them, rows at rest stay beside those that move. */
static size_t beyond_slopes(const hci_run *run, size_t standing)
{
    const size_t needed = run->torque_window + run->speed_window;
    return standing > needed + LEAST ? standing - needed : 0;
}

bool hci_rest_at_ends_leave(hci_run *run)
{
    const size_t n = run->count;
    if (run->theta_m_rad == NULL || n < LEAST) return true;
    const double least_rad = AT_REST * hci_noise_of_neighbours(run->theta_m_rad, n);
    const size_t before = standing(run->theta_m_rad, n, 1, least_rad);
    if (before == n) return true;
    const size_t after = standing(run->theta_m_rad + n - 1, n, -1, least_rad);
    const size_t first = beyond_slopes(run, before), last = beyond_slopes(run, after);
    if (first + last == 0 || first + last + ENOUGH > n) return true;
    bool *out = hci_memory_new(n, sizeof *out);
    if (out == NULL) return false;
    for (size_t k = 0; k < n; ++k)
        out[k] = k < first || k >= n - last;
    hci_run_rows_leave(run, out);
    hci_note_add(&run->remark,
                 "%zu of %zu rows, in which the shaft stands before or after it runs, are not used",
                 first + last, n);
    hci_memory_free(out);
    return true;
}
