#include "host/recording/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/name_words.h"
#include "host/csv/table.h"
#include "host/numeric/statistics.h"

#define GAP         20.0 /* steps so many times the usual one are gaps */
#define ROUNDED     1.25 /* range of the residual of a rounded clock, over its step */
#define JITTER      3.0  /* steps back of so many usual ones are no new piece */
#define ROUGHER     3.0  /* the angle over the stamps than over the rows */
#define SMALL       0.01 /* rad of the electrical angle that does not count */
#define FOREIGN     0.02 /* rad of the mechanical angle */
#define LEAST_STEP  1e-6 /* rad; less is rounding of the numbers … */
#define LEAST_SHARE 1e-4 /* … and so are such shares of a step in time */

enum { RESTARTS = 20, LEAST = 8, HALF_WINDOW = 20 };

static double row_of(const hci_stamps *s, size_t k)
{
    return (double)(s->row != NULL ? s->row[k] : k);
}

/* ---- steps ---- */

typedef struct {
    double stamp_s;  /* mean step forward */
    double sample_s; /* mean step of all, those of 0 included */
} mean_steps;

/* Without gaps and steps back. 0 where nothing steps forward. */
static mean_steps mean_steps_of(const double *time_s, size_t n)
{
    mean_steps mean = {INFINITY, 0.0};
    double before;
    do {
        double sum = 0.0, count = 0.0, still = 0.0;
        before = mean.stamp_s;
        for (size_t k = 1; k < n; ++k) {
            const double step = time_s[k] - time_s[k - 1];
            if (step < 0.0 || step > GAP * before) continue;
            sum += step;
            count += step > 0.0;
            still += !(step > 0.0);
        }
        mean.stamp_s = count > 0.0 ? sum / count : 0.0;
        mean.sample_s = count > 0.0 ? sum / (count + still) : 0.0;
    } while (mean.stamp_s < before && mean.stamp_s > 0.0);
    return mean;
}

double hci_clock_gap_s(const double *time_s, size_t n)
{
    return GAP * mean_steps_of(time_s, n).stamp_s;
}

static bool ascends(const double *time_s, size_t n)
{
    for (size_t k = 1; k < n; ++k)
        if (!(time_s[k] > time_s[k - 1])) return false;
    return true;
}

/* ---- steps back ---- */

/* After which a clock of the day or a counter begins again, s. */
static const double PERIODS[] = {60.0,          3600.0,        43200.0,       86400.0,
                                 0x1p16 * 1e-6, 0x1p16 * 1e-3, 0x1p31 * 1e-6, 0x1p32 * 1e-6,
                                 0x1p32 * 1e-3, 0x1p32 * 1e-9, 0x1p31 * 1e-3};

/* The period that makes a step back one forward that is no gap; 0: none. */
static double period_of(double step, double stamp_s)
{
    for (size_t k = 0; k < sizeof PERIODS / sizeof *PERIODS; ++k)
        if (step + PERIODS[k] > 0.0 && step + PERIODS[k] <= GAP * stamp_s) return PERIODS[k];
    return 0.0;
}

typedef struct {
    size_t wraps, pieces, early; /* whole periods; new pieces; stamps a little earlier than the one before */
    double period;               /* of the first wrap */
} steps_back;

/* Takes the steps back out; those of jitter become steps of 0. */
static steps_back go_forward(const hci_stamps *s, mean_steps mean)
{
    steps_back found = {0};
    double shift = 0.0;
    for (size_t k = 1; k < s->n; ++k) {
        const double step = s->time_s[k] + shift - s->time_s[k - 1];
        const double period = step < 0.0 ? period_of(step, mean.stamp_s) : 0.0;
        if (step < 0.0 && step >= -JITTER * mean.stamp_s) {
            ++found.early;
            s->time_s[k] = s->time_s[k - 1];
            continue;
        }
        if (period > 0.0) {
            if (found.wraps++ == 0) found.period = period;
            shift += period;
        } else if (step < 0.0) {
            ++found.pieces;
            shift += mean.sample_s * (double)s->n - step;
        }
        s->time_s[k] += shift;
    }
    return found;
}

static void say_back(const steps_back *b, hci_note *remark)
{
    if (b->wraps > 0)
        hci_note_add(remark, "the time begins again after %.10g s (%zu time%s): it goes on", b->period,
                     b->wraps, b->wraps == 1 ? "" : "s");
    if (b->pieces > 0)
        hci_note_add(remark, "the time steps back %zu time%s: what follows is a piece of its own", b->pieces,
                     b->pieces == 1 ? "" : "s");
}

/* ---- stamps that repeat ---- */

/* Behind the last sample of a piece without a gap. */
static size_t end_of_piece(const hci_stamps *s, size_t first, double most_s)
{
    size_t end = first + 1;
    while (end < s->n && s->time_s[end] - s->time_s[end - 1] <= most_s)
        ++end;
    return end;
}

typedef struct {
    double row, time_s, slope; /* at the middle */
    double low, high;          /* of the residual */
} line;

static line line_of(const hci_stamps *s, size_t first, size_t end)
{
    const double share = 1.0 / (double)(end - first);
    line l = {.low = INFINITY, .high = -INFINITY};
    double square = 0.0, product = 0.0;
    for (size_t k = first; k < end; ++k) {
        l.row += share * (row_of(s, k) - row_of(s, first));
        l.time_s += share * (s->time_s[k] - s->time_s[first]);
    }
    l.row += row_of(s, first);
    l.time_s += s->time_s[first];
    for (size_t k = first; k < end; ++k) {
        square += (row_of(s, k) - l.row) * (row_of(s, k) - l.row);
        product += (row_of(s, k) - l.row) * (s->time_s[k] - l.time_s);
    }
    l.slope = square > 0.0 ? product / square : 0.0;
    for (size_t k = first; k < end; ++k) {
        const double residual = s->time_s[k] - l.time_s - l.slope * (row_of(s, k) - l.row);
        l.low = fmin(l.low, residual);
        l.high = fmax(l.high, residual);
    }
    return l;
}

/* Whether each piece is a uniform clock rounded to steps of quantum_s; with write it becomes one. step_s:
 * out, of the longest piece. */
static bool is_uniform(const hci_stamps *s, double quantum_s, double most_s, bool write, double *step_s)
{
    size_t longest = 0;
    for (size_t first = 0, end; first < s->n; first = end) {
        end = end_of_piece(s, first, most_s);
        if (end - first < LEAST) return false;
        const line l = line_of(s, first, end);
        if (!(l.slope > 0.0) || l.high - l.low > ROUNDED * quantum_s) return false;
        if (end - first > longest) *step_s = l.slope;
        longest = end - first > longest ? end - first : longest;
        for (size_t k = first; k < end && write; ++k)
            s->time_s[k] = l.time_s + l.slope * (row_of(s, k) - l.row);
    }
    return true;
}

/* A uniform clock where the stamps are one rounded. */
static bool make_uniform(const hci_stamps *s, hci_note *remark)
{
    const double stamp_s = mean_steps_of(s->time_s, s->n).stamp_s, most_s = GAP * stamp_s;
    const double quantum_s = hci_quantum(s->time_s, s->n, LEAST_SHARE * stamp_s);
    double step_s = 0.0;
    if (!is_uniform(s, quantum_s, most_s, false, &step_s)) return false;
    is_uniform(s, quantum_s, most_s, true, &step_s);
    hci_note_add(remark, "the time is a uniform clock of %.4g s rounded to %.4g s: the uniform one is taken",
                 step_s, quantum_s);
    return ascends(s->time_s, s->n);
}

/* Samples of one stamp, evenly to the next stamp, but over no gap. Returns how many there were. */
static size_t spread(const hci_stamps *s, mean_steps mean)
{
    size_t repeated = 0;
    double step_s = mean.sample_s;
    for (size_t first = 0, end; first < s->n; first = end) {
        const double from = s->time_s[first];
        for (end = first + 1; end < s->n && !(s->time_s[end] > from);)
            ++end;
        const double count = (double)(end - first);
        const double to = end < s->n ? s->time_s[end] : from + step_s * count;
        if (to - from <= GAP * mean.stamp_s) step_s = (to - from) / count;
        for (size_t k = first; k < end; ++k)
            s->time_s[k] = from + step_s * (double)(k - first);
        repeated += end - first - 1;
    }
    return repeated;
}

bool hci_clock_mend(hci_stamps stamps, hci_note *remark)
{
    const hci_stamps *s = &stamps;
    if (ascends(s->time_s, s->n)) return true;
    const mean_steps mean = mean_steps_of(s->time_s, s->n);
    const steps_back back = mean.stamp_s > 0.0 ? go_forward(s, mean) : (steps_back){0};
    if (!(mean.stamp_s > 0.0) || (back.pieces + back.wraps) * RESTARTS > s->n) {
        hci_note_add(remark, "the time does not go on: it is not used");
        return false;
    }
    say_back(&back, remark);
    if (ascends(s->time_s, s->n)) return true;
    if (make_uniform(s, remark)) return true;
    const size_t repeated = spread(s, mean);
    hci_note_add(remark, "%zu stamp%s not later than the one before: %s spread evenly", repeated,
                 repeated == 1 ? " is" : "s are", repeated == 1 ? "its sample is" : "their samples are");
    return ascends(s->time_s, s->n);
}

/* ---- early and late by turns ---- */

#define ROUGH 0.1 /* of the usual step, by which steps are off it on average, a gap no more than one */
#define TURNS 0.5 /* of the pairs of steps, one longer and one shorter; noise of the stamps makes 2/3 */

bool hci_clock_is_rough(hci_stamps stamps)
{
    const hci_stamps *s = &stamps;
    if (s->n < 2 * LEAST) return false;
    const double usual_s = mean_steps_of(s->time_s, s->n).sample_s;
    const double least_s = LEAST_SHARE * usual_s;
    double pairs = 0.0, turns = 0.0, before = 0.0, sum = 0.0;
    for (size_t k = 1; k < s->n; ++k) {
        const double more_s = s->time_s[k] - s->time_s[k - 1] - usual_s;
        const double off = fabs(more_s) > least_s ? more_s : 0.0;
        pairs += fabs(off * before) > 0.0;
        turns += off * before < 0.0;
        before = off;
        sum += fmin(fabs(off), usual_s);
    }
    return sum > ROUGH * usual_s * (double)s->n && turns > TURNS * pairs;
}

/* ---- beside the angle ---- */

static double place_of(const hci_stamps *s, bool by_row, size_t k)
{
    return by_row ? row_of(s, k) : s->time_s[k];
}

/* x[k] less the cubic through its four neighbours, over the standard deviation that has for unit noise. */
static double departure(const hci_stamps *s, bool by_row, const double *x, size_t k)
{
    const size_t at[4] = {k - 2, k - 1, k + 1, k + 2};
    double residual = x[k] - x[k - 1], variance = 1.0;
    for (int i = 0; i < 4; ++i) {
        double weight = 1.0;
        for (int j = 0; j < 4; ++j)
            if (j != i)
                weight *= (place_of(s, by_row, k) - place_of(s, by_row, at[j])) /
                          (place_of(s, by_row, at[i]) - place_of(s, by_row, at[j]));
        residual -= weight * (x[at[i]] - x[k - 1]);
        variance += weight * weight;
    }
    return fabs(residual) / sqrt(variance);
}

/* How rough an angle is over its stamps or rows: the median, so that a jerk does not count. */
static double roughness(const hci_stamps *s, bool by_row, const double *angle, double *work)
{
    for (size_t k = 2; k + 2 < s->n; ++k)
        work[k - 2] = departure(s, by_row, angle, k);
    return hci_median(work, s->n - 4) / 0.6745;
}

hci_clock_kind hci_clock_judge(hci_stamps stamps, const double *theta_m_rad, int pole_pairs, double *work)
{
    if (stamps.n < 2 * LEAST) return HCI_CLOCK_AGREES;
    const double quantum = hci_quantum(theta_m_rad, stamps.n, LEAST_STEP);
    const double by_time = roughness(&stamps, false, theta_m_rad, work);
    if (!(by_time > fmax(SMALL / pole_pairs, 2.0 * quantum))) return HCI_CLOCK_AGREES;
    if (by_time > ROUGHER * roughness(&stamps, true, theta_m_rad, work)) return HCI_CLOCK_JITTERS;
    return by_time > fmax(FOREIGN, 4.0 * quantum) ? HCI_CLOCK_FOREIGN : HCI_CLOCK_AGREES;
}

/* The mean of the neighbours on both sides, which are as many. */
static double mean_around(const hci_stamps *s, size_t k)
{
    size_t half = k < s->n - 1 - k ? k : s->n - 1 - k;
    half = half < HALF_WINDOW ? half : HALF_WINDOW;
    const double *from = s->time_s + k - half, *end = s->time_s + k + half;
    const double rows = row_of(s, k + half) - row_of(s, k - half);
    const double slope = rows > 0.0 ? (*end - *from) / rows : 0.0;
    double sum = 0.0;
    for (size_t j = k - half; j <= k + half; ++j)
        sum += s->time_s[j] - *from - slope * (row_of(s, j) - row_of(s, k));
    return *from + sum / (double)(2 * half + 1);
}

void hci_clock_smooth(hci_stamps stamps, double *work, hci_note *remark)
{
    if (make_uniform(&stamps, remark)) return;
    for (size_t k = 0; k < stamps.n; ++k)
        work[k] = mean_around(&stamps, k);
    if (!ascends(work, stamps.n)) return;
    memcpy(stamps.time_s, work, stamps.n * sizeof *work);
    hci_note_add(remark, "the angle is smooth over the rows and not over the time: the time is smoothed");
}

/* ---- two clocks in one table ---- */

#define APART 0.05 /* of the record */
#define HELD  1.5  /* steps of the coarser clock, which may be held from row to row */

enum { MOST_CLOCKS = 8, LEAST_BOTH = 16 };

/* Columns of time of a table, from left to right. */
typedef struct {
    const hci_csv *csv;
    size_t column[MOST_CLOCKS + 1], count; /* behind the last one: the number of columns */
} clocks;

/* As what a column is given; NULL: as nothing. */
static const char *given_as(const hci_csv *csv, size_t column)
{
    for (size_t k = 0; k < csv->given_count; ++k)
        if (csv->given[k].column == column) return csv->given[k].name;
    return NULL;
}

static bool is_time(const hci_csv *csv, size_t column)
{
    const hci_unit *unit = hci_column_unit(csv, column);
    const char *given = given_as(csv, column);
    if (given != NULL) return strncmp(given, "time", 4) == 0;
    return unit != NULL && unit->dimension == hci_unit_find("s", 1)->dimension;
}

static clocks clocks_of(const hci_csv *csv)
{
    clocks x = {csv, {0}, 0};
    for (size_t column = 0; column < hci_csv_columns(csv) && x.count < MOST_CLOCKS; ++column)
        if (is_time(csv, column)) x.column[x.count++] = column;
    x.column[x.count] = hci_csv_columns(csv);
    return x;
}

/* The first column that is known to the right of a clock, before the next one; that of the clock: none. */
static size_t first_of(const clocks *x, size_t k)
{
    for (size_t column = x->column[k] + 1; column < x->column[k + 1]; ++column) {
        const char *given = given_as(x->csv, column);
        if (given != NULL ? strcmp(given, HCI_CSV_LEFT_OUT) != 0
                          : hci_column_is_known(hci_csv_name(x->csv, column)))
            return column;
    }
    return x->column[k];
}

/* The numbers of a column in seconds, NAN where there is none. */
static hci_status read_seconds(hci_csv *csv, size_t column, double *values, hci_note *note)
{
    hci_csv_hole hole = {0};
    hci_status status = hci_csv_give(csv, "time", column, note);
    if (status) return status;
    status = hci_csv_numbers_or_nan(csv, "time_s", values, &hole, note);
    --csv->given_count;
    return status;
}

/* How far two clocks are apart at most, from the first row that has both, less what is held. at: out, that
 * row. */
static double apart(const double *a_s, const double *b_s, size_t n, size_t *at)
{
    size_t first = n, last = n, both = 0;
    double most = 0.0, step_s = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!isfinite(a_s[k]) || !isfinite(b_s[k])) continue;
        if (first == n) first = k;
        if (last < n && (a_s[k] < a_s[last] || b_s[k] < b_s[last]))
            return 0.0; /* not a clock, or begun again */
        if (last < n) step_s = fmax(step_s, fmax(a_s[k] - a_s[last], b_s[k] - b_s[last]));
        last = k;
        ++both;
        const double off = fabs((a_s[k] - a_s[first]) - (b_s[k] - b_s[first]));
        if (off > most) most = off, *at = k;
    }
    if (both < LEAST_BOTH) return 0.0;
    const double span_s = fmin(a_s[last] - a_s[first], b_s[last] - b_s[first]);
    return span_s > 0.0 && most > APART * span_s + HELD * step_s ? most : 0.0;
}

static hci_status tell_clocks(const clocks *x, size_t k, size_t member, size_t at, const double *time_s[2],
                              hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], first[HCI_QUOTE_SIZE], second[HCI_QUOTE_SIZE], of[HCI_QUOTE_SIZE];
    const hci_csv *csv = x->csv;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:%zu: column %zu %s: found a second time, %.6g s where %s is %.6g s, so that %s "
                        "and what else stands "
                        "to its right is of other instants than the rest of its row; expected one clock for "
                        "all columns: export "
                        "them with one, or leave what is of the other clock out, by --column \"none=%.60s\" "
                        "and so of each of "
                        "them and of this time",
                        hci_quote_path(hci_csv_path(csv), path), hci_csv_line(csv, at), x->column[k] + 1,
                        hci_quote(hci_csv_name(csv, x->column[k]), second), time_s[1][at],
                        hci_quote(hci_csv_name(csv, x->column[0]), first), time_s[0][at],
                        hci_quote(hci_csv_name(csv, member), of), hci_csv_name(csv, member));
}

hci_status hci_clocks_agree(hci_csv *csv, hci_note *note)
{
    const clocks x = clocks_of(csv);
    const size_t n = hci_csv_rows(csv);
    hci_note unused = {{0}};
    hci_status status = HCI_OK;
    if (x.count < 2 || n == 0 || first_of(&x, 0) == x.column[0]) return HCI_OK;
    double *time_s = hci_memory_new(2 * n, sizeof *time_s);
    if (time_s == NULL) return hci_note_memory(note, hci_csv_path(csv), "its times");
    const double *both[2] = {time_s, time_s + n};
    bool is_told = !read_seconds(csv, x.column[0], time_s, &unused);
    for (size_t k = 1; k < x.count && is_told && !status; ++k) {
        size_t at = 0;
        const size_t member = first_of(&x, k);
        if (member == x.column[k] || read_seconds(csv, x.column[k], time_s + n, &unused)) continue;
        if (apart(both[0], both[1], n, &at) > 0.0) status = tell_clocks(&x, k, member, at, both, note);
    }
    hci_memory_free(time_s);
    return status;
}

/* ---- rows in the order of another column ---- */

#define SCATTERED 20.0 /* times the mean step, that half of the steps of time are, one way or the other */
#define BACK      0.05 /* of the steps, that go back */

typedef struct {
    double time_s;
    size_t row;
} stamped_row;

static int compare_stamps(const void *a, const void *b)
{
    const stamped_row *x = a, *y = b;
    if (x->time_s < y->time_s || x->time_s > y->time_s) return x->time_s < y->time_s ? -1 : 1;
    return (x->row > y->row) - (x->row < y->row);
}

/* Whether times jump about from row to row. work: n. */
static bool is_scattered(const double *time_s, size_t n, double *work)
{
    double least = INFINITY, most = -INFINITY, back = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!isfinite(time_s[k])) return false;
        least = fmin(least, time_s[k]);
        most = fmax(most, time_s[k]);
        if (k == 0) continue;
        back += time_s[k] < time_s[k - 1];
        work[k - 1] = fabs(time_s[k] - time_s[k - 1]);
    }
    return back > BACK * (double)n && hci_median(work, n - 1) > SCATTERED * (most - least) / (double)n;
}

/* Whether a column is there and never goes back. work: n. */
static bool ascends_in(const hci_csv *csv, const char *column, double *work, size_t n)
{
    hci_note unused = {{0}};
    if (!hci_csv_has(csv, column) || hci_csv_numbers(csv, column, work, &unused)) return false;
    for (size_t k = 1; k < n; ++k)
        if (work[k] < work[k - 1]) return false;
    return work[n - 1] > work[0];
}

static void reorder(hci_csv *csv, stamped_row *order, size_t n, uint32_t *moved)
{
    const size_t width = csv->columns + 1;
    uint32_t *rows = csv->index + hci_csv_first_record(csv) * width;
    qsort(order, n, sizeof *order, compare_stamps);
    for (size_t k = 0; k < n; ++k)
        memcpy(moved + k * width, rows + order[k].row * width, width * sizeof *moved);
    memcpy(rows, moved, n * width * sizeof *moved);
}

static hci_status by_time(hci_csv *csv, size_t n, double *time_s, hci_note *note)
{
    double *work = time_s + n;
    hci_note unused = {{0}};
    if (hci_csv_numbers(csv, "time_s", time_s, &unused) || !is_scattered(time_s, n, work)) return HCI_OK;
    if (!ascends_in(csv, "theta_m_rad", work, n) && !ascends_in(csv, "theta_e_rad", work, n)) return HCI_OK;
    stamped_row *order = hci_memory_new(n, sizeof *order);
    uint32_t *moved = hci_memory_new(n * (csv->columns + 1), sizeof *moved);
    if (order != NULL && moved != NULL) {
        for (size_t k = 0; k < n; ++k)
            order[k] = (stamped_row){time_s[k], k};
        reorder(csv, order, n, moved);
        hci_note_add(&csv->decided,
                     "its rows stand in the order of the angle, and are taken in that of the time");
    }
    const bool done = order != NULL && moved != NULL;
    hci_memory_free(order);
    hci_memory_free(moved);
    return done ? HCI_OK : hci_note_memory(note, hci_csv_path(csv), "its rows by time");
}

hci_status hci_rows_by_time(hci_csv *csv, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    if (csv->number != NULL || n < LEAST || !hci_csv_has(csv, "time_s")) return HCI_OK;
    double *work = hci_memory_new(2 * n, sizeof *work);
    if (work == NULL) return hci_note_memory(note, hci_csv_path(csv), "its times");
    const hci_status status = by_time(csv, n, work, note);
    hci_memory_free(work);
    return status;
}
