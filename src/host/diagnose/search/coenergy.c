#include "host/diagnose/search/coenergy.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/candidates/coenergy_terms.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/shown_orders.h"
#include "host/numeric/left_out.h"
#include "host/numeric/noise.h"

enum {
    LEAST_RUNS = 5,
    SHARP_RUNS =
        10, /* at different currents, which tell the high powers of the mean from runs that are off */
    LOW_POWER = 4,
    HIGH_POWER = 6,
    MEAN_POWER = 8, /* of what is the same at every angle, in a choice that is sharp */
    MOST_ORDER = 90,
    LEAST_ORDER = 24,
    OF_IRON = 6, /* orders that phases which are alike make */
    PASSES = 4,  /* over the parts, at most */
    SINGLE_POWERS = 3,
    DECLARED_POWERS = 2, /* cogging and back-EMF: tables of the machine, whose values are known */
    PARTS = SINGLE_POWERS + HCI_MOST_TYPES
};

/* Widths of the expectation that are tried, in units of the noise. */
static const double WIDTHS[] = {1.0, 3.0, 10.0, 30.0, 100.0};

/* The model that the search has found was selected with the runs that are left out here, which flatters it:
 * the mean logarithm may rise by this much, a factor of two in the rms. */
#define SELECTED 1.4
#define LEAST    0.15 /* of the resolution: a torque that is large enough for a name */
#define SHOWN    1.5  /* of the resolution, as an amplitude: no order above that has more is looked for */
#define QUIET    2.0  /* noise over the resolution, up to which all orders are told */
#define PAID     0.5  /* of the price of all terms of a part: the widths that are expected make them fewer */
#define MOST                                                                                                 \
    2.0 /* of the squares that are left with a part, that it takes away: 22 times of the back-EMF that the   \
         * elements of a surface magnet have beside the declared one, 1.2 at most where there is none */
#define NO_WORSE 0.01 /* of the mean logarithm of the squares */
#define FLOOR    0.05 /* mean square of a run, in units of its noise, below which it is as good as can be */

/* How much wider the mean of a power above 2 is expected in a sharp choice, from each to the next: √(1 + x²)
 * has powers that fall by about 0.6. */
#define SHARPER 1.7
#define SHARP   0.2 /* of the mean logarithm of the squares, that it has to be better: a tenth in the rms */

#define SAME_CURRENT 0.02 /* of the largest */
#define BLUNT                                                                                                \
    10.0 /* noise over the resolution, above which single terms say all that the recordings can tell */
#define TOLD       0.48 /* of the samples in a turn: of half as many orders sine and cosine look alike */
#define WHOLE_TURN 0.9  /* electrical, of a run that tells orders by its samples */

/* One choice of what to fit. */
typedef struct {
    int power;           /* highest, of the currents */
    double width;        /* of the expectation, in units of the noise; 0: the model as it was */
    bool sharp;          /* iron that saturates within a part of the currents: the mean has high powers */
    bool without[PARTS]; /* below */
} choice;

/* Whether terms of a type describe what the co-energy describes: its own effects, and the description of what
 * no effect explains. */
static bool is_of_iron(const hci_candidate *x)
{
    return x->type->propose_coenergy || x->type == &hci_empirical_type;
}

/* Parts that a choice may leave out: first cogging, back-EMF and reluctance of the series, then for each type
 * the terms that are not of the series and that the search has found, such as a cogging order above it. -1:
 * none. */
static int part_of(const hci_candidate *x)
{
    size_t r = 0;
    if (x->coenergy_unit > 0.0) return x->power < SINGLE_POWERS ? x->power : -1;
    if (!is_of_iron(x)) return -1;
    while (hci_candidate_type(r) != x->type)
        ++r;
    return SINGLE_POWERS + (int)r;
}

typedef struct {
    hci_search *search;
    const hci_fitted_model *known;
    hci_candidates all;
    size_t currents; /* that differ, of all runs */
    double noise_Nm; /* rms */
    hci_groups runs;
    hci_normal_equations *run;
    double *precision, *square; /* of each column, of each run */
} comparison;

/* ---- recordings, one by one ---- */

/* Terms of the co-energy count from 0, others from where they are, and nothing is expected of them yet. */
static void start_from_zero(hci_candidates *all)
{
    for (size_t k = 0; k < all->count; ++k) {
        hci_candidate *x = &all->candidate[k];
        x->deviation = 0.0;
        for (size_t j = 0; is_of_iron(x) && j < x->count; ++j)
            x->term[j].value = x->declared[j] = 0.0;
    }
}

/* White, and the same in all runs: what the model lacks is not noise, and to weight by it would take the
 * part of a run that it fails in for the part that does not count. */
static void noise_even(hci_regression *e, double rms_Nm)
{
    for (const hci_segment *x = NULL; (x = hci_regression_next(e, x)) != NULL;)
        *hci_regression_noise(e, x) = hci_noise_white(rms_Nm);
}

static hci_status run_linearise(void *context, size_t run, hci_note *note)
{
    comparison *c = context;
    (void)run;
    const hci_status status =
        hci_regression_normal(c->search->regression, &c->all, false, &c->run[c->runs.count], note);
    c->runs.count += !status;
    return status;
}

/* ---- choices ---- */

/* One over the variance that is expected; INFINITY for what is not in a choice. */
static double precision_of(const comparison *c, const hci_candidate *x, const choice *how)
{
    const hci_candidate *before = hci_candidates_find_in(&c->known->candidates, x);
    const double known = before && before->deviation > 0.0 ? before->deviation : 0.0;
    if (how->width <= 0.0) return !before ? (double)INFINITY : known > 0.0 ? 1.0 / (known * known) : 0.0;
    const int part = part_of(x);
    if (part >= 0 && how->without[part]) return (double)INFINITY;
    if (!(x->coenergy_unit > 0.0)) return known > 0.0 ? 1.0 / (known * known) : 0.0;
    const bool of_mean = how->sharp && x->power > 2 && !(x->term[0].order > HCI_ORDER_TOLERANCE);
    if (x->power > (of_mean ? MEAN_POWER : how->power) ||
        (x->power < SINGLE_POWERS && how->without[x->power]))
        return (double)INFINITY;
    double wide = how->width * c->noise_Nm * x->coenergy_unit;
    if (of_mean) wide *= pow(SHARPER, x->power - 2);
    if (before && x->power < 2) wide = fmax(wide, known > 0.0 ? known : (double)INFINITY);
    return 1.0 / (wide * wide);
}

static void precision_set(const comparison *c, const choice *how)
{
    size_t column = 0;
    for (size_t k = 0; k < c->all.count; ++k) {
        const double precision = precision_of(c, &c->all.candidate[k], how);
        for (size_t j = 0; j < c->all.candidate[k].count; ++j)
            c->precision[column++] = precision;
    }
}

/* The mean logarithm, so that no run rules because it lies outside of all others. */
static hci_status misfit_of(const comparison *c, const choice *how, double *misfit, hci_note *note)
{
    precision_set(c, how);
    hci_search_tell(c->search);
    if (!hci_left_out_squares(&c->runs, c->precision, c->square))
        return hci_note_memory(note, NULL, "leaving runs out");
    *misfit = 0.0;
    for (size_t r = 0; r < c->runs.count; ++r)
        *misfit += log(c->square[r] / fmax(1.0, c->runs.group[r].rows) + FLOOR) / (double)c->runs.count;
    return HCI_OK;
}

static hci_status try(const comparison *c, const choice *how, choice *best, double *least, hci_note *note)
{
    double misfit;
    const hci_status status = misfit_of(c, how, &misfit, note);
    if (!status && misfit < *least) {
        *least = misfit;
        *best = *how;
    }
    return status;
}

/* The width and power that describe left-out runs best, of the parts of a choice. */
static hci_status choose(const comparison *c, choice *best, double *least, hci_note *note)
{
    choice how = *best;
    hci_status status = HCI_OK;
    *least = INFINITY;
    for (how.power = LOW_POWER; how.power <= HIGH_POWER && !status; how.power += HIGH_POWER - LOW_POWER)
        for (size_t w = 0; w < sizeof WIDTHS / sizeof *WIDTHS && !status; ++w) {
            how.width = WIDTHS[w];
            status = try(c, &how, best, least, note);
        }
    return status;
}

static double sum_of(const comparison *c)
{
    double sum = 0.0;
    for (size_t r = 0; r < c->runs.count; ++r)
        sum += c->square[r];
    return sum;
}

static double rows_of(const comparison *c)
{
    double rows = 0.0;
    for (size_t r = 0; r < c->runs.count; ++r)
        rows += c->runs.group[r].rows;
    return rows;
}

/* A sum of squares over all rows, in units of the noise, as rms torque. */
static double rms_of(const comparison *c, double squares)
{
    const double rows = rows_of(c);
    return rows > 0.0 ? c->noise_Nm * sqrt(fmax(0.0, squares) / rows) : 0.0;
}

/* Sums of squares in a fit to all runs. */
typedef struct {
    double with, without; /* one part */
} fitted_squares;

/* Both 0 when memory is out. */
static fitted_squares fit_squares(const comparison *c, const choice *how, int part)
{
    choice less = *how;
    fitted_squares x = {0.0, 0.0};
    less.without[part] = true;
    precision_set(c, how);
    bool made = hci_all_in_square(&c->runs, c->precision, &x.with);
    precision_set(c, &less);
    made = made && hci_all_in_square(&c->runs, c->precision, &x.without);
    return made ? x : (fitted_squares){0.0, 0.0};
}

/* Whether terms of a declared table say enough for their number, or most of what a fit to all runs can.
 * Where runs at few currents are left out, they also help between these in the place of high powers that
 * nobody knows, and are no error of the table. */
static bool is_paid(const comparison *c, int part, const fitted_squares *fit)
{
    const double lost = fit->without - fit->with;
    double terms = 0.0;
    for (size_t k = 0; k < c->all.count; ++k)
        terms += part_of(&c->all.candidate[k]) == part ? (double)c->all.candidate[k].count : 0.0;
    return part >= DECLARED_POWERS || lost >= PAID * terms * log(rows_of(c)) || lost >= MOST * fit->with;
}

/* How well left-out runs are described. */
typedef struct {
    double misfit; /* mean logarithm */
    double square; /* sum over all */
} left_out;

static hci_status leave_out(const comparison *c, const choice *how, left_out *x, hci_note *note)
{
    const hci_status status = misfit_of(c, how, &x->misfit, note);
    x->square = sum_of(c);
    return status;
}

/* Cogging and back-EMF are in the declared tables, iron can saturate without reluctance, and what is not of
 * the series is unusual. Left-out runs have to miss such a part: as a whole, which tells of small effects in
 * long recordings, or on the average, where a run that lies outside of the others counts no more than they
 * do. */
static bool is_missed(const left_out *in, const left_out *out)
{
    return in->misfit + NO_WORSE < out->misfit || in->square + HCI_DECISIVE < out->square;
}

/* And it has to be large enough for a name: in the fit to all runs, or by what left-out runs miss, since
 * higher powers take its place where there are runs, and beside them do not. present: in and out, of the
 * choice. */
static hci_status settle_part(const comparison *c, choice *how, int part, left_out *present, hci_note *note)
{
    const bool was_without = how->without[part];
    left_out other;
    how->without[part] = !was_without;
    const hci_status status = leave_out(c, how, &other, note);
    if (status) return status;
    const left_out *in = was_without ? &other : present, *out = was_without ? present : &other;
    how->without[part] = false;
    const fitted_squares fit = fit_squares(c, how, part);
    const bool large = rms_of(c, fit.without - fit.with) >= LEAST * c->search->resolution_Nm ||
                       rms_of(c, out->square - in->square) >= c->search->resolution_Nm;
    how->without[part] = !large || !is_paid(c, part, &fit) || !is_missed(in, out);
    if (how->without[part] != was_without) *present = other;
    return HCI_OK;
}

/* changed: out, whether a part came in or went. */
static hci_status settle_parts(const comparison *c, choice *how, bool *changed, hci_note *note)
{
    bool settled[PARTS] = {false};
    left_out present;
    hci_status status = leave_out(c, how, &present, note);
    *changed = false;
    for (size_t k = 0; k < c->all.count && !status; ++k) {
        const int part = part_of(&c->all.candidate[k]);
        if (part < 0 || settled[part]) continue;
        const bool before = how->without[part];
        settled[part] = true;
        status = settle_part(c, how, part, &present, note);
        *changed = *changed || how->without[part] != before;
    }
    return status;
}

/* With high powers of the mean, where left-out runs say so plainly: they are as large as they like, and
 * wrong outside of the currents that were measured. They take the place of parts, and bring none in. */
static hci_status sharpen(const comparison *c, choice *best, double *least, hci_note *note)
{
    choice sharp = *best, settled;
    double of_sharp = INFINITY;
    bool changed;
    sharp.sharp = true;
    hci_status status = choose(c, &sharp, &of_sharp, note);
    if (status || !(of_sharp < *least - SHARP)) return status;
    *best = settled = sharp;
    *least = of_sharp;
    status = settle_parts(c, &settled, &changed, note);
    for (int part = 0; part < PARTS; ++part)
        best->without[part] = sharp.without[part] || settled.without[part];
    return status || !changed ? status : choose(c, best, least, note);
}

/* The series without what is declared and what the search has found beside it; then with what left-out runs
 * miss, for which the width is chosen again, until neither changes: what stood for a part that has come in
 * goes. Width 0, the model as it was, where that describes left-out runs
 * much better. */
static hci_status choose_all(const comparison *c, choice *best, hci_note *note)
{
    const choice as_it_was = {0};
    double known = 0.0, least = INFINITY;
    bool changed = false;
    for (int part = 0; part < PARTS; ++part)
        best->without[part] = true;
    hci_status status = misfit_of(c, &as_it_was, &known, note);
    if (!status) status = choose(c, best, &least, note);
    for (int k = 0; k < PASSES && !status && (k == 0 || changed); ++k) {
        status = settle_parts(c, best, &changed, note);
        if (!status && changed) status = choose(c, best, &least, note);
    }
    if (!status && c->currents >= SHARP_RUNS) status = sharpen(c, best, &least, note);
    if (!status && least > known + SELECTED) best->width = 0.0;
    return status;
}

/* ---- the model ---- */

static void apply(comparison *c, const choice *how)
{
    size_t kept = 0;
    for (size_t k = 0; k < c->all.count; ++k) {
        const double precision = precision_of(c, &c->all.candidate[k], how);
        if (!isfinite(precision)) continue;
        c->all.candidate[kept] = c->all.candidate[k];
        c->all.candidate[kept++].deviation = precision > 0.0 ? 1.0 / sqrt(precision) : 0.0;
    }
    c->all.count = kept;
}

/* The highest order that the samples of every run in use tell, MOST_ORDER at the most. Those of a part of a
 * turn stand between those of other turns, but not where they were calculated at even steps. */
static int resolved_order(const hci_regression *e)
{
    double order = MOST_ORDER;
    for (const hci_segment *x = NULL; (x = hci_regression_next(e, x)) != NULL;) {
        const hci_binned_sample *first = e->samples->sample + x->first, *last = first + x->count - 1;
        const double span = fabs(last->reading.theta_m_rad - first->reading.theta_m_rad);
        const double turns = span * e->machine->pole_pairs / (2.0 * HCI_PI);
        const bool is_told = turns > WHOLE_TURN || (turns > 0.0 && e->runs[x->run].is_tabulated);
        if (is_told) order = fmin(order, TOLD * (double)x->count / turns);
    }
    return (int)order;
}

/* Of them, in noise, one above those that a run shows. */
static int highest_order(const hci_search *s)
{
    const int resolved = resolved_order(s->regression);
    if (!(hci_search_noise_rms(s) > QUIET * s->resolution_Nm)) return resolved;
    const int shown =
        hci_highest_order_shown(s->regression, OF_IRON, resolved, SHOWN * s->resolution_Nm) + OF_IRON;
    return (int)fmin(resolved, fmax(LEAST_ORDER, shown));
}

static hci_status comparison_make(comparison *c, hci_note *note)
{
    hci_regression *e = c->search->regression;
    const hci_effect_coenergy_series series = {e->machine->pole_pairs,
                                               HIGH_POWER,
                                               highest_order(c->search),
                                               c->known->candidates.reference_current_A,
                                               false,
                                               MEAN_POWER};
    hci_status status = hci_coenergy_terms(&c->known->candidates, &series, &c->all, note);
    if (status) return status;
    start_from_zero(&c->all);
    c->run = hci_memory_new(e->samples->run_count, sizeof *c->run);
    c->precision =
        hci_memory_new(hci_candidates_terms_in(&c->all) + e->samples->run_count, sizeof *c->precision);
    if (!c->run || !c->precision) return hci_note_memory(note, NULL, "leaving runs out");
    c->square = c->precision + hci_candidates_terms_in(&c->all);
    c->runs.group = c->run;
    return hci_regression_each_run(e, run_linearise, c, note);
}

static void comparison_release(comparison *c)
{
    for (size_t r = 0; r < c->runs.count; ++r)
        hci_normal_equations_release(&c->run[r]);
    hci_memory_free(c->run);
    hci_memory_free(c->precision);
    hci_candidates_release(&c->all);
}

/* With the noise found anew the expectations keep their size beside it. */
static hci_status refit(hci_search *s, hci_fitted_model *model, double rms_Nm, hci_note *note)
{
    hci_status status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
    if (!status) status = hci_search_noise(s, &model->candidates, note);
    if (status) return status;
    const double change = hci_search_noise_rms(s) / rms_Nm;
    for (size_t k = 0; k < model->candidates.count; ++k)
        if (model->candidates.candidate[k].coenergy_unit > 0.0)
            model->candidates.candidate[k].deviation *= change;
    return hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
}

bool hci_search_saturates(const hci_candidates *candidates)
{
    for (size_t k = 0; k < candidates->count; ++k)
        if (candidates->candidate[k].in && candidates->candidate[k].type->beyond_quadratic) return true;
    return false;
}

/* Whether a run has about the currents of an earlier one in use. */
static bool is_repeated(const hci_regression *e, size_t run, double most_A)
{
    const hci_run_statistics *of = e->samples->statistics;
    for (size_t r = 0; r < run; ++r)
        if (e->use[r] && hypot(of[r].mean_id_A - of[run].mean_id_A, of[r].mean_iq_A - of[run].mean_iq_A) <
                             SAME_CURRENT * most_A)
            return true;
    return false;
}

/* Runs in use, of those at the same currents one: as many powers of the currents as there are of them can be
 * told at the most. Of a run whose currents vary nothing is known here, and it counts. */
static size_t different_currents(const hci_regression *e)
{
    double most_A = 0.0;
    size_t count = 0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r]) most_A = fmax(most_A, e->samples->statistics[r].current_A);
    for (size_t r = 0; r < e->samples->run_count; ++r)
        count += e->use[r] && hci_segment_next(e->samples, r, NULL) && !is_repeated(e, r, most_A);
    return count;
}

/* rms noise of the samples. What a model lacks of short runs counts as their noise, since they have no
 * spectrum; where neighbours differ by less, it is none. */
static hci_status sample_noise_find(hci_search *s, const hci_candidates *model, double *noise_Nm,
                                    hci_note *note)
{
    double sum = 0.0, rows = 0.0;
    const hci_status status = hci_search_residual(s, model, note);
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;) {
        double rms = hci_regression_noise(s->regression, x)->rms;
        const double of_neighbours = hci_noise_of_neighbours(s->residual_Nm + x->first, x->count);
        if (x->count < HCI_NOISE_LEAST && x->turns == 0 && isfinite(of_neighbours))
            rms = fmin(rms, hypot(of_neighbours, s->resolution_Nm));
        sum += (double)x->count * rms * rms;
        rows += (double)x->count;
    }
    *noise_Nm = rows > 0.0 ? sqrt(sum / rows) : 0.0;
    return status;
}

hci_status hci_search_coenergy(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    comparison c = {.search = s, .known = model, .currents = different_currents(s->regression)};
    choice best = {0};
    if (!hci_search_saturates(&model->candidates) || c.currents < LEAST_RUNS) return HCI_OK;
    hci_status status = sample_noise_find(s, &model->candidates, &c.noise_Nm, note);
    if (status || c.noise_Nm > BLUNT * s->resolution_Nm) return status;
    noise_even(s->regression, c.noise_Nm);
    status = comparison_make(&c, note);
    if (!status) status = choose_all(&c, &best, note);
    if (!status && best.width > 0.0) {
        apply(&c, &best);
        hci_candidates_release(&model->candidates);
        model->candidates = c.all;
        c.all = (hci_candidates){0};
        s->whole_coenergy = true;
    }
    comparison_release(&c);
    return status || !(best.width > 0.0) ? status : refit(s, model, c.noise_Nm, note);
}
