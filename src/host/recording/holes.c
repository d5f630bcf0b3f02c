#include "host/recording/holes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/table.h"
#include "host/numeric/statistics.h"
#include "host/recording/line_rows.h"
#include "host/recording/zero_voltages.h"

typedef struct {
    hci_run_columns *c;
    size_t rows;         /* of the file */
    bool *is_left;       /* of each row: it is used */
    hci_csv_hole first;  /* the first hole */
    size_t holes, twice; /* rows without a number somewhere; rows that are there a second time */
    size_t first_twice;  /* line of the first of them */
    size_t still;        /* rows that repeat a reading */
} rows_task;

static hci_status memory_error(const rows_task *t)
{
    return hci_note_memory(t->c->note, hci_csv_path(t->c->csv), "%zu rows", t->rows);
}

/* ---- columns ---- */

/* A column that others make needless: its holes do not matter. */
static bool is_needless(const hci_run_columns *c, hci_run_column which)
{
    const bool phases = hci_run_phase_count(c, HCI_RUN_IA) >= 2;
    const bool voltages = hci_run_phase_count(c, HCI_RUN_VA) == 3;
    const bool lines = hci_run_phase_count(c, HCI_RUN_VAB) >= 2;
    if (which == HCI_RUN_TORQUE_COMPUTED) return phases || c->has[HCI_RUN_IQ];
    if (which == HCI_RUN_SPEED_E) return c->has[HCI_RUN_SPEED];
    if (which >= HCI_RUN_VAB && which <= HCI_RUN_VCA) return voltages;
    if (which == HCI_RUN_VD || which == HCI_RUN_VQ) return voltages || lines;
    return (which == HCI_RUN_ID || which == HCI_RUN_IQ) && phases && !c->has[HCI_RUN_VQ];
}

static size_t missing_in(const double *value, size_t rows)
{
    size_t count = 0;
    for (size_t k = 0; k < rows; ++k)
        if (isnan(value[k])) ++count;
    return count;
}

/* Between the rows beside it; the first and the last value go on. At least one is a number. */
static void interpolate(double *value, size_t rows)
{
    size_t before = rows;
    for (size_t k = 0; k < rows; ++k) {
        if (isnan(value[k])) continue;
        for (size_t j = before == rows ? 0 : before + 1; j < k; ++j) {
            const double share = before == rows ? 1.0 : (double)(j - before) / (double)(k - before);
            value[j] = share * value[k] + (before == rows ? 0.0 : (1.0 - share) * value[before]);
        }
        before = k;
    }
    for (size_t j = before + 1; j < rows; ++j)
        value[j] = value[before];
}

static void say_column(const hci_run_columns *c, hci_run_column which, size_t missing, const char *what)
{
    char quoted[HCI_QUOTE_SIZE];
    hci_note_add(c->remark, "%s: %zu of %zu cells have no number%s",
                 hci_quote(hci_csv_name(c->csv, c->at[which]), quoted), missing, hci_csv_rows(c->csv), what);
}

static void do_without(hci_run_columns *c, hci_run_column which)
{
    c->has[which] = false;
    c->used[c->at[which]] = true;
    hci_memory_free(c->ready[which]);
    c->ready[which] = NULL;
}

/* A speed of a slower channel, which most rows do not have: angle and time tell it in each. */
static bool is_sparse(const rows_task *t, hci_run_column which, size_t missing)
{
    const bool *has = t->c->has;
    return (which == HCI_RUN_SPEED || which == HCI_RUN_SPEED_E) && 2 * missing > t->rows &&
           has[HCI_RUN_TIME] && (has[HCI_RUN_THETA_M] || has[HCI_RUN_THETA_E]);
}

/* Marks the rows without a number in a column, or does without the column. */
static void take_column(rows_task *t, hci_run_column which, const hci_csv_hole *hole)
{
    hci_run_columns *c = t->c;
    double *value = c->ready[which];
    const size_t missing = missing_in(value, t->rows);
    if (missing == 0) return;
    if (missing == t->rows) {
        say_column(c, which, missing, ", it is not used");
        do_without(c, which);
    } else if (is_sparse(t, which, missing)) {
        say_column(c, which, missing,
                   ", as of a slower channel: it is left out, angle and time tell the speed");
        do_without(c, which);
    } else if (which == HCI_RUN_TEMPERATURE) {
        interpolate(value, t->rows);
        say_column(c, which, missing, " and are interpolated");
    } else {
        if (t->first.line == 0 || hole->line < t->first.line) t->first = *hole;
        for (size_t k = 0; k < t->rows; ++k)
            t->is_left[k] = t->is_left[k] && !isnan(value[k]);
    }
}

/* "torque_Nm: 3 of 4000 cells have a unit of their own, `0.1 mNm` in line 12, and are read by it". */
static void say_united(const hci_run_columns *c, hci_run_column which, const hci_csv_hole *hole)
{
    char name[HCI_QUOTE_SIZE], cell[HCI_QUOTE_SIZE];
    if (hole->united == 0) return;
    hci_note_add(c->remark,
                 "%s: %zu of %zu cells have a unit of their own, such as %s in line %zu, and are read by it",
                 hci_quote(hci_csv_name(c->csv, c->at[which]), name), hole->united, hci_csv_rows(c->csv),
                 hci_quote(hci_csv_cell(c->csv, hole->united_record, c->at[which]), cell),
                 hci_csv_record_line(c->csv, hole->united_record));
}

static hci_status read_columns(rows_task *t)
{
    hci_run_columns *c = t->c;
    for (unsigned which = 0; which < HCI_RUN_COLUMN_COUNT; ++which) {
        hci_csv_hole hole = {0};
        if (!c->has[which] || is_needless(c, which)) continue;
        if (hci_column_find(c->csv, hci_run_column_name(which)).kind != HCI_COLUMN_ONE) continue;
        c->ready[which] = hci_memory_new(t->rows, sizeof(double));
        if (c->ready[which] == NULL) return memory_error(t);
        const hci_status status =
            hci_csv_numbers_or_nan(c->csv, hci_run_column_name(which), c->ready[which], &hole, c->note);
        if (status) return status;
        say_united(c, which, &hole);
        take_column(t, which, &hole);
    }
    for (size_t k = 0; k < t->rows; ++k)
        t->holes += !t->is_left[k];
    return HCI_OK;
}

/* ---- rows that are there twice ---- */

/* Where only equal rows have equal times; a coarse clock repeats its stamps with other values beside them. */
static void leave_twice_out(rows_task *t)
{
    const double *time_s = t->c->ready[HCI_RUN_TIME];
    const size_t from = hci_csv_first_record(t->c->csv);
    size_t last = t->rows;
    for (int pass = 0; pass < 2 && time_s != NULL; ++pass, last = t->rows) {
        for (size_t k = 0; k < t->rows; ++k) {
            if (!t->is_left[k]) continue;
            const bool equal = last < t->rows && !(fabs(time_s[k] - time_s[last]) > 0.0);
            if (equal && pass == 0 && !hci_csv_same_record(t->c->csv, from + k, from + last)) return;
            if (equal && pass == 1) {
                t->is_left[k] = false;
                if (t->twice++ == 0) t->first_twice = hci_csv_line(t->c->csv, k);
            } else {
                last = k;
            }
        }
    }
}

/* ---- readings that stand still ---- */

#define BY_CHANCE 1e-6 /* of a stretch of equal readings in a recording */
#define FEW_PAIRS 8    /* more of them are once in 250 recordings where three are to be expected */
#define FINE      4.0 /* usual steps of a reading, in units of the smallest one, that are not its resolution */
#define WHOLE     0.02 /* off a whole number of such units */
#define MOSTLY    0.9  /* share of the steps */
#define ROUNDING  1e-9 /* of the largest reading */

enum { LEAST_FRESH = 50 };

/* Columns that are read together. */
typedef struct {
    const double *column[3];
    size_t columns;
    const char *what;
} readings;

static bool is_same(const readings *x, size_t a, size_t b)
{
    for (size_t c = 0; c < x->columns; ++c)
        if (fabs(x->column[c][a] - x->column[c][b]) > 0.0) return false;
    return true;
}

/* Rows that are used and whose reading is another one than before. Returns how many. */
static size_t fresh_find(const rows_task *t, const readings *x, size_t *fresh)
{
    size_t count = 0;
    for (size_t k = 0; k < t->rows; ++k)
        if (t->is_left[k] && (count == 0 || !is_same(x, k, fresh[count - 1]))) fresh[count++] = k;
    return count;
}

/* Whether a reading that stays shows more than its resolution: its steps are no multiples of a smallest one,
 * or usually of many of them. What was computed and is constant but for rounding stays by chance. step:
 * [count] */
static bool is_fine(const readings *x, const size_t *fresh, size_t count, double *step)
{
    double least = INFINITY, multiples = 0.0, most = 0.0;
    size_t steps = 0;
    for (size_t k = 0; k + 1 < count; ++k) {
        most = fmax(most, fabs(x->column[0][fresh[k]]));
        const double size = fabs(x->column[0][fresh[k + 1]] - x->column[0][fresh[k]]);
        if (!(size > 0.0)) continue;
        step[steps++] = size;
        least = fmin(least, size);
    }
    for (size_t k = 0; k < steps; ++k)
        multiples += fabs(step[k] / least - floor(step[k] / least + 0.5)) < WHOLE;
    const double usual = steps > 0 ? hci_median(step, steps) : 0.0;
    return usual > ROUNDING * most && (multiples < MOSTLY * (double)steps || usual > FINE * least);
}

/* Rows that are used from one fresh reading up to the next. */
static size_t length_of(const rows_task *t, const size_t *fresh, size_t count, size_t k)
{
    const size_t end = k + 1 < count ? fresh[k + 1] : t->rows;
    size_t length = 0;
    for (size_t j = fresh[k]; j < end; ++j)
        length += t->is_left[j];
    return length;
}

/* The longest stretch of equal readings that there may be by chance, if neighbours are equal as often as a
 * reading and the second one behind it. Where none of those is, that is up to three times (95 %), and so many
 * pairs or some more tell nothing. */
static double longest_by_chance(const rows_task *t, const readings *x, const size_t *fresh, size_t count)
{
    double equal = 0.0;
    size_t stays = 0;
    for (size_t k = 0; k + 2 < count; ++k)
        equal += is_same(x, fresh[k], fresh[k + 2]);
    for (size_t k = 0; k < count; ++k)
        stays += length_of(t, fresh, count, k) > 1;
    if (!(equal > 0.0)) return stays <= FEW_PAIRS ? 2.0 : 1.0;
    return 1.0 + log(BY_CHANCE / (double)count) / log(fmin(equal / (double)count, 0.999));
}

/* Rows without a time in which no current flows, as a table of torques over the angle has them: no reading
 * that stays. */
static bool is_no_current(const rows_task *t, const readings *x, size_t row)
{
    double most = 0.0;
    for (size_t c = 0; c < x->columns; ++c)
        most = fmax(most, fabs(x->column[c][row]));
    return !t->c->ready[HCI_RUN_TIME] && x->columns > 1 && !(most > 0.0);
}

/* Leaves the rows out that repeat a reading for longer. Returns how many. */
static size_t stretches_leave(rows_task *t, const readings *x, const size_t *fresh, size_t count,
                              double longest)
{
    size_t left_out = 0;
    for (size_t k = 0; k < count; ++k) {
        const size_t end = k + 1 < count ? fresh[k + 1] : t->rows;
        const size_t length = length_of(t, fresh, count, k);
        if (!((double)length > longest) || is_no_current(t, x, fresh[k])) continue;
        for (size_t j = fresh[k] + 1; j < end; ++j)
            t->is_left[j] = false;
        left_out += length - 1;
    }
    return left_out;
}

/* ---- a torque at the end of its sensor ---- */

#define RAIL_SHARE   0.01 /* of the rows, at the least and the largest value */
#define RAIL_REPEATS 0.95 /* of the rows that repeat a reading */

enum { LEAST_TIMES = 3 }; /* that the reading comes to its end */

static bool is_at_rail(const double rail[2], double value)
{
    return value <= rail[0] || value >= rail[1];
}

/* Whether what repeats is the least and the largest value, again and again, and not what lies between. A
 * reading that is taken less often, or is coarse, repeats the values between as well. */
static bool is_clipped(const rows_task *t, const double *value, const double rail[2])
{
    double previous = NAN;
    size_t at = 0, between = 0, repeats = 0, there = 0, times = 0;
    for (size_t k = 0; k < t->rows; ++k) {
        if (!t->is_left[k]) continue;
        const bool is_rail = is_at_rail(rail, value[k]),
                   is_again = value[k] >= previous && value[k] <= previous;
        at += is_rail;
        between += !is_rail;
        repeats += is_again;
        there += is_again && is_rail;
        times += is_rail && !is_again;
        previous = value[k];
    }
    return between >= LEAST_FRESH && times >= LEAST_TIMES && (double)at > RAIL_SHARE * (double)t->rows &&
           2 * there > at && (double)there >= RAIL_REPEATS * (double)repeats;
}

/* Rows at a value. */
static size_t rows_at(const rows_task *t, const double *value, double at)
{
    size_t count = 0;
    for (size_t k = 0; k < t->rows; ++k)
        count += t->is_left[k] && value[k] >= at && value[k] <= at;
    return count;
}

/* The least and the largest value; infinite where it is not repeated. */
static void rails_find(const rows_task *t, const double *value, double rail[2])
{
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < t->rows; ++k)
        if (t->is_left[k]) least = fmin(least, value[k]), most = fmax(most, value[k]);
    rail[0] = (double)rows_at(t, value, least) > RAIL_SHARE * (double)t->rows ? least : -HUGE_VAL;
    rail[1] = (double)rows_at(t, value, most) > RAIL_SHARE * (double)t->rows ? most : HUGE_VAL;
}

static void say_clipped(const rows_task *t, const double rail[2], size_t left_out)
{
    char both[96] = "";
    if (isfinite(rail[0])) snprintf(both, sizeof both, "%.4g N·m, its least value", rail[0]);
    if (isfinite(rail[1]))
        snprintf(both + strlen(both), sizeof both - strlen(both), "%s%.4g N·m, its largest",
                 *both ? ", or " : "", rail[1]);
    hci_note_add(t->c->remark,
                 "the torque is clipped: in %zu of %zu rows it stands at %s, as of a sensor at its end; they "
                 "are left out, and what lies beyond is missing",
                 left_out, t->rows, both);
}

/* Leaves the rows out in which the torque is at least or at most what is told. */
static void leave_clipped_out(rows_task *t, const double *torque_Nm)
{
    double rail[2];
    size_t left_out = 0;
    rails_find(t, torque_Nm, rail);
    if (!is_clipped(t, torque_Nm, rail)) return;
    for (size_t k = 0; k < t->rows; ++k) {
        if (!t->is_left[k] || !is_at_rail(rail, torque_Nm[k])) continue;
        t->is_left[k] = false;
        ++left_out;
    }
    say_clipped(t, rail, left_out);
    t->still += left_out;
    t->c->torque_is_clipped = true;
}

/* ---- phase currents at the end of their sensors ---- */

#define SUM_LEFT 0.3 /* of the sum of three currents where one is at its end, that is left elsewhere */

enum { THREE = 3 };

typedef struct {
    double *phase[THREE];
    double rail[THREE][2];     /* least and largest of each, A; infinite where it does not stay there */
    size_t one, several;       /* rows with one, and with more of them at its end */
    size_t elsewhere;          /* rows with none */
    double sum_one, sum_other; /* squares of the sum of the three, over these and over those with none */
} clipped_currents;

/* How many of three stand at an end. which: out, the last of them. */
static size_t at_ends(const clipped_currents *x, size_t row, size_t *which)
{
    size_t count = 0;
    for (size_t s = 0; s < THREE; ++s) {
        if (!is_at_rail(x->rail[s], x->phase[s][row])) continue;
        *which = s;
        ++count;
    }
    return count;
}

static void ends_count(const rows_task *t, clipped_currents *x)
{
    for (size_t k = 0; k < t->rows; ++k) {
        size_t which = 0;
        if (!t->is_left[k]) continue;
        const size_t count = at_ends(x, k, &which);
        const double sum_A = x->phase[0][k] + x->phase[1][k] + x->phase[2][k];
        x->one += count == 1;
        x->several += count > 1;
        x->elsewhere += count == 0;
        if (count == 0) x->sum_other += sum_A * sum_A;
        if (count == 1) x->sum_one += sum_A * sum_A;
    }
}

/* Whether the three make no sum but where one of them is at its end: its sensor ends there, and the current
 * goes on. Of currents that a drive limits the sum is the same. */
static bool sum_tells(const clipped_currents *x)
{
    const double elsewhere = (double)x->elsewhere, one = (double)x->one;
    return x->elsewhere >= LEAST_FRESH && x->one > 0 &&
           x->sum_other / elsewhere < SUM_LEFT * SUM_LEFT * x->sum_one / one;
}

/* Puts in each what the two others leave to a sum of nothing, and leaves out where two are at their ends. */
static void clipped_mend(rows_task *t, const clipped_currents *x)
{
    for (size_t k = 0; k < t->rows; ++k) {
        size_t s = 0;
        const size_t count = t->is_left[k] ? at_ends(x, k, &s) : 0;
        if (count == 1) x->phase[s][k] = -x->phase[(s + 1) % THREE][k] - x->phase[(s + 2) % THREE][k];
        if (count > 1) t->is_left[k] = false;
    }
    t->still += x->several;
}

/* "-3.5 A or 3.5 A" */
static void ends_text(const clipped_currents *x, char *text, size_t size)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t s = 0; s < THREE; ++s) {
        if (isfinite(x->rail[s][0])) least = fmin(least, x->rail[s][0]);
        if (isfinite(x->rail[s][1])) most = fmax(most, x->rail[s][1]);
    }
    text[0] = '\0';
    if (isfinite(least)) snprintf(text, size, "%.4g A", least);
    if (isfinite(most))
        snprintf(text + strlen(text), size - strlen(text), "%s%.4g A", *text ? " or " : "", most);
}

static void say_mended(const rows_task *t, const clipped_currents *x)
{
    char ends[64];
    ends_text(x, ends, sizeof ends);
    hci_note_add(
        t->c->remark,
        "phase currents are clipped: in %zu of %zu rows one stands at %s, as of a sensor at its end, "
        "and is taken from the two others, with which it makes no sum elsewhere; sensors of a wider "
        "range would show it",
        x->one, t->rows, ends);
    if (x->several > 0)
        hci_note_add(t->c->remark, "%zu rows in which two of them do are left out", x->several);
}

/* Of three phase currents, of which some stay at their ends. */
static void mend_clipped_currents(rows_task *t)
{
    clipped_currents x = {
        .phase = {t->c->ready[HCI_RUN_IA], t->c->ready[HCI_RUN_IB], t->c->ready[HCI_RUN_IC]}};
    bool any = false;
    for (size_t s = 0; s < THREE; ++s) {
        if (!x.phase[s]) return;
        rails_find(t, x.phase[s], x.rail[s]);
        const bool clipped = is_clipped(t, x.phase[s], x.rail[s]);
        if (!clipped) x.rail[s][0] = -HUGE_VAL, x.rail[s][1] = HUGE_VAL;
        any = any || clipped;
    }
    if (!any) return;
    ends_count(t, &x);
    if (!sum_tells(&x)) return;
    clipped_mend(t, &x);
    say_mended(t, &x);
}

/* ---- readings that stay ---- */

static hci_status leave_still_out(rows_task *t, const readings *x)
{
    size_t *fresh = hci_memory_new(t->rows + 1, sizeof *fresh), left_out = 0;
    double *step = hci_memory_new(t->rows + 1, sizeof *step);
    if (fresh && step) {
        const size_t count = fresh_find(t, x, fresh);
        if (count >= LEAST_FRESH && is_fine(x, fresh, count, step))
            left_out = stretches_leave(t, x, fresh, count, longest_by_chance(t, x, fresh, count));
    }
    if (left_out > 0)
        hci_note_add(t->c->remark,
                     "%zu of %zu rows repeat the %s before: read less often than the rest, or "
                     "standing still, and left out",
                     left_out, t->rows, x->what);
    t->still += left_out;
    const bool made = fresh && step;
    hci_memory_free(fresh);
    hci_memory_free(step);
    return made ? HCI_OK : memory_error(t);
}

/* ---- a shaft that stands ---- */

#define STANDS_FOR 20.0 /* times as long as an angle stays at one value while the shaft turns */

enum {
    LEAST_STAND = 50,  /* rows */
    MOST_STANDS = 8,   /* more of them are a shaft that is moved in steps, and measured where it stands */
    MOST_OF_A_TURN = 3 /* without a torque: more of them are a shaft that sticks and slips */
};

/* The longest stay of an angle that turns; 0: it does not stand, or is moved in steps. */
static double stay_of_turning(const rows_task *t, const size_t *fresh, size_t count)
{
    const size_t most = t->c->ready[HCI_RUN_TORQUE] ? MOST_STANDS : MOST_OF_A_TURN;
    size_t stands = 0, turning = 0, rows = 0;
    for (size_t k = 0; k < count; ++k) {
        const size_t length = length_of(t, fresh, count, k);
        if (length > LEAST_STAND) continue;
        rows += length;
        ++turning;
    }
    const double longest = fmax(LEAST_STAND, STANDS_FOR * (double)rows / fmax(1.0, (double)turning));
    for (size_t k = 0; k < count; ++k)
        stands += (double)length_of(t, fresh, count, k) > longest;
    return turning >= LEAST_FRESH && stands > 0 && stands <= most ? longest : 0.0;
}

#define ONE_COUNT                                                                                            \
    1.5 /* of the smallest step of an angle, which flickers by no more while the shaft stands                \
         */

static double smallest_step(const rows_task *t, const double *value)
{
    double least = INFINITY;
    for (size_t k = 1; k < t->rows; ++k) {
        const double step = fabs(value[k] - value[k - 1]);
        if (t->is_left[k] && t->is_left[k - 1] && step > 0.0) least = fmin(least, step);
    }
    return least;
}

/* Whether an angle is what it was again, a few rows later. */
static bool is_back(const rows_task *t, const double *angle, size_t row, double last)
{
    for (size_t k = row + 1; k < t->rows && k <= row + LEAST_STAND; ++k)
        if (t->is_left[k] && angle[k] <= last && angle[k] >= last) return true;
    return false;
}

/* held: out, [rows], the angle without the steps of one count that it takes back. */
static void hold_angle(const rows_task *t, const double *angle, double *held)
{
    const double count = ONE_COUNT * smallest_step(t, angle);
    double last = NAN;
    for (size_t k = 0; k < t->rows; ++k) {
        const double step = fabs(angle[k] - last);
        const bool flickers = step < count && (!(step > 0.0) || is_back(t, angle, k, last));
        if (t->is_left[k] && !flickers) last = angle[k];
        held[k] = last;
    }
}

/* Friction takes of the torque of a shaft that stands what it must, and no angle tells what it is of; what
 * its current answers is as little told. */
static hci_status leave_standing_out(rows_task *t, const double *angle)
{
    double *held = hci_memory_new(t->rows + 1, sizeof *held);
    const readings x = {{held}, 1, "angle"};
    size_t *fresh = hci_memory_new(t->rows + 1, sizeof *fresh), left_out = 0;
    if (fresh == NULL || held == NULL) {
        hci_memory_free(fresh);
        hci_memory_free(held);
        return memory_error(t);
    }
    hold_angle(t, angle, held);
    const size_t count = fresh_find(t, &x, fresh);
    const double longest = stay_of_turning(t, fresh, count);
    if (longest > 0.0) left_out = stretches_leave(t, &x, fresh, count, longest);
    if (left_out > 0)
        hci_note_add(
            t->c->remark,
            "in %zu of %zu rows the angle stays while it turns in the others: the shaft stands there, "
            "or the angle is not read; they are left out",
            left_out, t->rows);
    t->still += left_out;
    hci_memory_free(fresh);
    hci_memory_free(held);
    return HCI_OK;
}

/* Torque and currents; beside an angle that goes on these show what the machine does. */
static hci_status leave_all_still_out(rows_task *t)
{
    double *const *ready = t->c->ready;
    readings torque = {{ready[HCI_RUN_TORQUE]}, 1, "torque"}, currents = {{NULL}, 0, "currents"};
    hci_status status = HCI_OK;
    for (unsigned which = HCI_RUN_IA; which <= HCI_RUN_IC; ++which)
        if (ready[which]) currents.column[currents.columns++] = ready[which];
    const double *angle = ready[ready[HCI_RUN_THETA_M] ? HCI_RUN_THETA_M : HCI_RUN_THETA_E];
    if ((torque.column[0] || ready[HCI_RUN_IQ] || currents.columns > 1) && angle)
        status = leave_standing_out(t, angle);
    if (status) return status;
    if (torque.column[0]) leave_clipped_out(t, torque.column[0]);
    if (torque.column[0]) status = leave_still_out(t, &torque);
    mend_clipped_currents(t);
    if (!status && currents.columns > 1) status = leave_still_out(t, &currents);
    return status;
}

/* ---- what is left ---- */

static hci_status too_many(const rows_task *t, size_t holes, size_t rows)
{
    return hci_note_set(t->c->note, HCI_ERROR_INPUT,
                        "%s (%zu of %zu rows have such holes, more than half; remove a column that is not "
                        "needed, or record again)",
                        t->first.error.text, holes, rows);
}

/* Keeps the rows that are used, in every column. */
static hci_status compact(rows_task *t)
{
    hci_run_columns *c = t->c;
    c->row = hci_memory_new(t->rows, sizeof *c->row);
    if (c->row == NULL) return memory_error(t);
    c->count = 0;
    for (size_t k = 0; k < t->rows; ++k)
        if (t->is_left[k]) c->row[c->count++] = k;
    for (unsigned which = 0; which < HCI_RUN_COLUMN_COUNT; ++which)
        for (size_t k = 0; k < c->count && c->ready[which] != NULL; ++k)
            c->ready[which][k] = c->ready[which][c->row[k]];
    return HCI_OK;
}

static hci_status conclude(rows_task *t)
{
    hci_run_columns *c = t->c;
    const hci_csv *csv = c->csv;
    const size_t holes = t->holes + csv->torn, rows = t->rows + csv->torn;
    char quoted[HCI_QUOTE_SIZE];
    if (csv->torn > 0 && (t->first.line == 0 || csv->hole.line < t->first.line)) t->first = csv->hole;
    if (2 * holes > rows) return too_many(t, holes, rows);
    if (holes > 0) {
        const char *name = t->first.column < csv->columns ? hci_csv_name(csv, t->first.column) : "";
        hci_note_add(c->remark,
                     "%zu of %zu rows have a hole and are left out, first line %zu, column %zu%s%s: "
                     "found %s",
                     holes, rows, t->first.line, t->first.column + 1, *name != '\0' ? " " : "",
                     *name != '\0' ? hci_quote(name, quoted) : "", t->first.found);
    }
    if (t->twice > 0)
        hci_note_add(c->remark,
                     "%zu rows are the same as those before them, time included, and are left "
                     "out, first line %zu",
                     t->twice, t->first_twice);
    return t->holes + t->twice + t->still > 0 ? compact(t) : HCI_OK;
}

/* A column of angles without one number. */
static hci_status check_angle_left(const hci_run_columns *c)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (hci_run_columns_suffice(c)) return HCI_OK;
    return hci_note_set(
        c->note, HCI_ERROR_INPUT,
        "%s: found no number in the column of the angle, expected one in each row; record the "
        "run again or remove the column",
        hci_quote_path(hci_csv_path(c->csv), path));
}

static hci_status leave_holes_out(hci_run_columns *c)
{
    rows_task t = {.c = c, .rows = c->count};
    t.is_left = hci_memory_new(t.rows, sizeof *t.is_left);
    if (t.is_left == NULL) return memory_error(&t);
    for (size_t k = 0; k < t.rows; ++k)
        t.is_left[k] = true;
    hci_status status = read_columns(&t);
    if (!status) leave_twice_out(&t);
    if (!status) status = leave_all_still_out(&t);
    if (!status) status = conclude(&t);
    hci_memory_free(t.is_left);
    if (!status) status = hci_line_rows_take(c);
    if (!status) hci_zero_voltages_leave(c);
    return status;
}

hci_status hci_run_columns_open(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note)
{
    hci_status status = hci_run_columns_find(csv, c, remark, note);
    if (!status && csv->leaves_holes) status = leave_holes_out(c);
    return status ? status : check_angle_left(c);
}

hci_status hci_run_columns_open_any(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note)
{
    const hci_status status = hci_run_columns_find_any(csv, c, remark, note);
    return !status && csv->leaves_holes ? leave_holes_out(c) : status;
}
