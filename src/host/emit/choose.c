/* Which shape a table gets. In: the request; out: for each shape the fewest points that keep the error, or
 * the most that fit into the bytes, with what they cost; and the table of the one that is taken. */
#include <math.h>

#include "host/base/memory.h"
#include "host/emit/cost.h"
#include "host/emit/emission.h"
#include "host/emit/table_ripple.h"

/* Waves times their highest order times turns: from here on shapes that nobody asked for are not made. */
#define HEAVY 3e4

/* ---- what is asked for ---- */

/* The error to keep; INFINITY where only bytes are given, 0 where points are, NAN where nothing is. */
static double error_asked_A(const hci_emission *e)
{
    const hci_emit_request *r = e->request;
    if (r->points > 0) return 0.0;
    if (r->max_error_A > 0.0) return r->max_error_A;
    return r->max_bytes > 0 ? (double)INFINITY : (double)NAN;
}

/* With which the table adds little to the ripple that is to be expected. */
static double error_wished_A(const hci_emission *e, double most_A, double peak_A)
{
    const double expected_Nm = e->request->expected_ripple_Nm;
    const double share = HCI_EMIT_RIPPLE_SHARE * expected_Nm / (2.0 * hci_table_torque_per_error(e));
    const double least_A = HCI_EMIT_LEAST_ERROR_SHARE * peak_A;
    return expected_Nm > 0.0 ? fmin(most_A, fmax(share, least_A)) : least_A;
}

static size_t values_in_row(const hci_emission *e)
{
    return e->tabulation.columns * e->tabulation.parts;
}

static bool fits(const hci_emission *e, const hci_emit_choice *c, double error_A)
{
    const size_t instructions = e->request->max_instructions;
    return (error_A == 0.0 || c->max_error_A <= error_A) &&
           (e->most_bytes == 0 || c->bytes <= e->most_bytes) &&
           (instructions == 0 || c->cortex_m4f <= instructions);
}

/* ---- one shape ---- */

/* Where it is only asked whether a table fits, no more than fit are looked at. */
static size_t most_points(const hci_emission *e)
{
    const size_t fitting = e->most_bytes / (values_in_row(e) * sizeof *e->rows);
    return e->only_whether && e->most_bytes > 0 && fitting <= HCI_EMIT_MAX_POINTS ? fitting
                                                                                  : HCI_EMIT_MAX_POINTS;
}

/* Rows of floats: the fewest within the error, as many as asked for, or as many as fit. */
static bool make_f32(hci_emission *e, double error_A)
{
    const hci_emit_request *r = e->request;
    const size_t row_bytes = values_in_row(e) * sizeof *e->rows;
    size_t points = r->points;
    if (isinf(error_A)) points = r->max_bytes / row_bytes > 1 ? r->max_bytes / row_bytes - 1 : 1;
    if (points > HCI_EMIT_MAX_POINTS) points = HCI_EMIT_MAX_POINTS;
    if (points == 0 && hci_tabulate_within(&e->tabulation, error_A, most_points(e), e->rows, &e->table))
        return true;
    if (points > 0)
        hci_tabulate(&e->tabulation, points, e->rows, &e->table);
    else if (!e->only_whether) /* how far off the finest is */
        hci_tabulate_roughly(&e->tabulation, HCI_EMIT_MAX_POINTS, e->rows, &e->table);
    return points > 0;
}

/* Intervals that the shape of a choice needs with knots of 16 bits, which was looked at before. */
static uint32_t intervals_of_i16(const hci_emission *e, hci_emit_shape shape)
{
    for (size_t k = 0; k < e->result.choices; ++k) {
        const hci_emit_choice *c = &e->result.choice[k];
        if (c->shape == shape && !hci_emit_has_rows(c->format) && c->format != HCI_EMIT_I8)
            return (uint32_t)c->points;
    }
    return 1;
}

static bool make_spline(hci_emission *e, const hci_emit_choice *c, uint32_t degree, double error_A)
{
    const hci_emit_request *r = e->request;
    const bool eight = c->format == HCI_EMIT_I8, integer = hci_emit_is_integer(c->format);
    const size_t rows = r->max_bytes / (values_in_row(e) * (eight ? 1 : 2));
    size_t intervals = r->points;
    e->room.knot_bits = eight ? 8 : 16;
    if (isinf(error_A)) intervals = rows > degree ? rows - degree : 1;
    if (intervals == 0 && eight)
        return hci_spline_make_i8_within(&e->room, degree, intervals_of_i16(e, c->shape), error_A,
                                         &e->spline);
    if (intervals == 0) return hci_spline_make_within(&e->room, degree, error_A, integer, &e->spline);
    if (intervals > HCI_TABLE_I16_MOST_INTERVALS) intervals = HCI_TABLE_I16_MOST_INTERVALS;
    hci_spline_make(&e->room, degree, (uint32_t)intervals, &e->spline);
    return true;
}

/* Makes the table of a choice and fills in what it has become. */
static void make(hci_emission *e, hci_emit_choice *c, double error_A)
{
    bool made;
    if (hci_emit_has_rows(c->format)) {
        made = make_f32(e, error_A);
        c->points = e->table.points;
        c->bytes = (c->points + 1) * values_in_row(e) * sizeof *e->rows;
        c->max_error_A = (double)e->table.max_error_A;
    } else {
        const uint32_t degree = (uint32_t)(c->shape - HCI_EMIT_LINEAR) + 1;
        made = make_spline(e, c, degree, error_A);
        c->points = e->spline.intervals;
        c->bytes = (c->points + degree) * values_in_row(e) * (e->spline.knot_bits / 8);
        c->max_error_A =
            (double)(hci_emit_is_integer(c->format) ? e->spline.max_error_q15_A : e->spline.max_error_A);
    }
    hci_emit_cost(&e->tabulation, c);
    c->fits = made && fits(e, c, error_A);
}

/* ---- all of them ---- */

/* Whether a format has to be made to know those that are asked for: 8-bit knots begin at what 16 bits need.
 */
static bool is_needed(hci_emit_format asked, hci_emit_format format)
{
    return format == asked || (asked == HCI_EMIT_I8 && !hci_emit_has_rows(format));
}

/* All shapes, or with a number of points those of the format that it is meant for. is_shown: also those
 * that are not asked for, to be shown beside. */
static void make_all(hci_emission *e, double error_A, bool is_shown)
{
    const hci_emit_format asked = e->request->format;
    const hci_emit_format rows = hci_emit_has_rows(asked) ? asked : HCI_EMIT_F32,
                          small = hci_emit_is_integer(asked) ? HCI_EMIT_Q15 : HCI_EMIT_I16;
    const hci_emit_choice all[HCI_EMIT_MOST_CHOICES] = {{.format = rows, .shape = HCI_EMIT_LINEAR},
                                                        {.format = small, .shape = HCI_EMIT_LINEAR},
                                                        {.format = small, .shape = HCI_EMIT_QUADRATIC},
                                                        {.format = small, .shape = HCI_EMIT_CUBIC},
                                                        {.format = HCI_EMIT_I8, .shape = HCI_EMIT_LINEAR},
                                                        {.format = HCI_EMIT_I8, .shape = HCI_EMIT_QUADRATIC},
                                                        {.format = HCI_EMIT_I8, .shape = HCI_EMIT_CUBIC}};
    hci_emit_result *x = &e->result;
    x->choices = 0;
    for (size_t k = 0; k < HCI_EMIT_MOST_CHOICES; ++k) {
        if (e->request->points > 0 && all[k].format != asked) continue;
        if (!is_shown && !is_needed(asked, all[k].format)) continue;
        x->choice[x->choices] = all[k];
        make(e, &x->choice[x->choices++], error_A);
    }
}

static bool is_asked(const hci_emit_request *r, const hci_emit_choice *c)
{
    return c->format == r->format && (r->shape == HCI_EMIT_AUTO || r->shape == c->shape);
}

/* With bytes alone the least error; else fewer instructions where both are small, and fewer bytes where not.
 */
static bool is_better(const hci_emit_choice *a, const hci_emit_choice *b, double error_A)
{
    const bool small_a = a->bytes <= HCI_EMIT_SMALL_BYTES, small_b = b->bytes <= HCI_EMIT_SMALL_BYTES;
    if (isinf(error_A)) return a->max_error_A < b->max_error_A;
    if (small_a != small_b) return small_a;
    return small_a ? a->cortex_m4f < b->cortex_m4f : a->bytes < b->bytes;
}

static const hci_emit_choice *best_of(const hci_emission *e, double error_A)
{
    const hci_emit_choice *best = NULL;
    for (size_t k = 0; k < e->result.choices; ++k) {
        const hci_emit_choice *c = &e->result.choice[k];
        if (c->fits && is_asked(e->request, c) && (!best || is_better(c, best, error_A))) best = c;
    }
    return best;
}

/* What to look for among all that was asked for. */
typedef enum { LEAST_ERROR, FEWEST_BYTES, FEWEST_INSTRUCTIONS } quality;

static double value_of(const hci_emit_choice *c, quality what)
{
    return what == LEAST_ERROR    ? c->max_error_A
           : what == FEWEST_BYTES ? (double)c->bytes
                                  : (double)c->cortex_m4f;
}

/* Of those within the error, or NULL. */
static const hci_emit_choice *nearest(const hci_emission *e, double error_A, quality what)
{
    const hci_emit_choice *near = NULL;
    for (size_t k = 0; k < e->result.choices; ++k) {
        const hci_emit_choice *c = &e->result.choice[k];
        if (!is_asked(e->request, c) || (what != LEAST_ERROR && error_A > 0.0 && c->max_error_A > error_A))
            continue;
        if (!near || value_of(c, what) < value_of(near, what)) near = c;
    }
    return near;
}

static hci_status none_fits(const hci_emission *e, double error_A, hci_note *note)
{
    const hci_emit_request *r = e->request;
    const hci_emit_choice *near = nearest(e, error_A, FEWEST_BYTES);
    if (!near) {
        near = nearest(e, error_A, LEAST_ERROR);
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "largest error: found %g A, but %s keeps no less than %g A, with %zu points; allow that much%s",
            error_A, hci_emit_format_name(near->format), near->max_error_A, near->points,
            hci_emit_is_integer(near->format) ? ", or use another format" : "");
    }
    if (r->max_bytes > 0 && near->bytes > r->max_bytes)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "bytes: found at most %zu, but the smallest table takes %zu; allow that many, or a larger "
            "error, or another shape or format",
            r->max_bytes, near->bytes);
    near = nearest(e, error_A, FEWEST_INSTRUCTIONS);
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "instructions: found at most %zu, but a %s table of format %s takes about %u on a Cortex-M4F; "
        "allow that many, or use another shape or frame dq",
        r->max_instructions, hci_emit_shape_name(near->shape), hci_emit_format_name(near->format),
        near->cortex_m4f);
}

static hci_status reserve(hci_emission *e, hci_note *note)
{
    const size_t values = (size_t)(HCI_EMIT_MAX_POINTS + 1) * values_in_row(e);
    e->rows = hci_memory_new(values, sizeof *e->rows);
    e->room.knots = hci_memory_new(HCI_SPLINE_MOST_VALUES, sizeof *e->room.knots);
    e->room.knots_A = hci_memory_new(HCI_SPLINE_MOST_VALUES, sizeof *e->room.knots_A);
    e->room.knots_i8 = hci_memory_new(HCI_SPLINE_MOST_VALUES, sizeof *e->room.knots_i8);
    e->room.waves = &e->tabulation;
    e->room.symmetry = hci_symmetry_of(&e->tabulation);
    return e->rows && e->room.knots && e->room.knots_A && e->room.knots_i8
               ? HCI_OK
               : hci_note_memory(note, NULL, "the table");
}

/* Whether all shapes are made in a second or two. */
static bool is_light(const hci_emission *e)
{
    const hci_tabulation *t = &e->tabulation;
    const double waves = (double)(t->constant_count + t->per_Nm_count);
    return waves * hci_tabulation_highest_order(t) * (double)t->period_turns < HEAVY;
}

static const hci_emit_choice *best_within(hci_emission *e, double error_A, bool is_shown)
{
    make_all(e, error_A, is_shown);
    return best_of(e, error_A);
}

static bool can_keep(hci_emission *e, double error_A)
{
    e->only_whether = true;
    make_all(e, error_A, false);
    e->only_whether = false;
    return best_of(e, error_A) != NULL;
}

/* The error that can be kept, from one that is wished: where that cannot be, the least to a fifth. */
static double error_kept_A(hci_emission *e, double wished_A, double most_A)
{
    double kept_A = wished_A;
    while (kept_A < most_A && !can_keep(e, kept_A))
        kept_A *= 2.0;
    double missed_A = 0.5 * kept_A;
    for (int step = 0; step < 2 && kept_A > wished_A && kept_A < most_A; ++step) {
        const double middle_A = sqrt(missed_A * kept_A);
        *(can_keep(e, middle_A) ? &kept_A : &missed_A) = middle_A;
    }
    return kept_A;
}

/* Where nothing is asked for: without a machine a share of the peak current, and so where nothing finer fits.
 */
static const hci_emit_choice *best_chosen(hci_emission *e, double *error_A)
{
    const double peak_A = hci_tabulation_peak_A(&e->tabulation), most_A = HCI_EMIT_ERROR_SHARE * peak_A;
    e->most_bytes = HCI_EMIT_CHOSEN_BYTES;
    *error_A = e->plant ? error_kept_A(e, error_wished_A(e, most_A, peak_A), most_A) : most_A;
    if (*error_A < most_A) return best_within(e, *error_A, is_light(e));
    e->most_bytes = e->request->max_bytes;
    *error_A = most_A;
    return best_within(e, most_A, is_light(e));
}

hci_status hci_emission_choose(hci_emission *e, hci_note *note)
{
    double error_A = error_asked_A(e);
    const hci_status status = reserve(e, note);
    if (status) return status;
    e->most_bytes = e->request->max_bytes;
    const hci_emit_choice *best = isnan(error_A) ? best_chosen(e, &error_A) : best_within(e, error_A, true);
    if (!best) return none_fits(e, error_A, note);
    e->result.chosen = *best;
    make(e, &e->result.chosen, error_A);
    return HCI_OK;
}

void hci_emission_release(hci_emission *e)
{
    hci_memory_free(e->rows);
    hci_wave_samples_release(&e->tabulation.constant_samples);
    hci_wave_samples_release(&e->tabulation.per_Nm_samples);
    hci_memory_free(e->room.knots);
    hci_memory_free(e->room.knots_A);
    hci_memory_free(e->room.knots_i8);
}
