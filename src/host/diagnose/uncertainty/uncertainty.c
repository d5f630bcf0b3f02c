#include "host/diagnose/uncertainty/uncertainty.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/run_parts.h"
#include "host/diagnose/uncertainty/sidebands.h"
#include "host/diagnose/uncertainty/width_trials.h"
#include "host/machine/torque_constant.h"
#include "host/recording/rotor_frame.h"

enum { MACHINES = 200, SEED = 1 };

#define MOST_FREEDOM 200.0 /* of Student's distribution, that is a normal one */

#define COPY      0.99 /* cosine of what two recordings tell, from which on they are left out together */
#define TOLD      0.3  /* of the work, that recordings one by one are */
#define MISREAD_D 0.01 /* i_d of the largest current, that sensors and an angle a little off make */
#define WHOLE     1.0  /* electrical turns that remain of a run where a part of it is left out */

typedef struct {
    hci_regression *regression;
    const hci_candidates *fitted;
    const hci_alternatives *alternatives;
    hci_model found; /* of the fitted terms */
    hci_allowed_terms terms;
    hci_condensed parts; /* runs, or parts of them */
    hci_condensed runs;  /* the same, with those joined that tell the same */
    size_t *run, *group; /* of each part: its run, and what it is joined to */
    hci_width_trials trials;
} finding;

/* ---- recordings, one by one ---- */

/* Whether the i_d of a run is no more than what current sensors read wrongly. */
static bool direct_is_error(const finding *f, const hci_regression *e, size_t run)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;)
        for (size_t k = s->first; k < s->first + s->count; ++k) {
            const hci_sample truth =
                hci_effects_undo(&f->found.list, e->machine->pole_pairs, &e->samples->sample[k].reading);
            sum += pow(hci_sample_dq(&truth, e->machine->pole_pairs).d, 2.0);
            count += 1.0;
        }
    return sqrt(sum) <= MISREAD_D * f->terms.largest_current_A * sqrt(count);
}

/* Whether a term is the torque per ampere, of which the recordings tell nothing, nor alternatives. */
static bool is_untold(const finding *f, const hci_candidate *x, size_t j)
{
    size_t parameter;
    return f->alternatives->constant_share > 0.0 && x->type == hci_torque_per_ampere(&parameter) &&
           x->term[j].parameter == parameter && fabs(x->term[j].order - 1.0) <= HCI_ORDER_TOLERANCE;
}

static void column_leave(hci_normal_equations *normal, size_t c)
{
    normal->moment[c] = 0.0;
    for (size_t k = 0; k < normal->n; ++k)
        normal->gram[c * normal->n + k] = normal->gram[k * normal->n + c] = 0.0;
}

/* Such a run says nothing of terms that need i_d: the torque that they would make of what is read did not
 * flow. */
static void direct_leave(const hci_allowed_terms *terms, hci_normal_equations *normal)
{
    for (size_t c = 0; c < normal->n; ++c)
        if (terms->by_direct[c]) column_leave(normal, c);
}

/* Beside means that tell nothing the noise of a current would, and too little: it makes no torque. */
static void untold_leave(const finding *f, hci_normal_equations *normal)
{
    const hci_candidates *all = &f->terms.candidates;
    size_t c = 0;
    for (size_t k = 0; k < all->count; ++k)
        for (size_t j = 0; j < all->candidate[k].count; ++j, ++c)
            if (is_untold(f, &all->candidate[k], j)) column_leave(normal, c);
}

static hci_status part_add(void *context, const hci_regression *part, size_t run, hci_note *note)
{
    finding *f = context;
    hci_normal_equations normal;
    if (hci_watch_stops(part->watch)) return HCI_ERROR_STOPPED;
    hci_watch_tell(part->watch, "looking at what is left open",
                   TOLD * (double)run / (double)part->samples->run_count);
    const hci_status status = hci_regression_normal(part, &f->terms.candidates, true, &normal, note);
    if (status) return status;
    if (direct_is_error(f, part, run)) direct_leave(&f->terms, &normal);
    untold_leave(f, &normal);
    const bool told = normal.rows > 0.0;
    const bool made = !told || hci_condensed_add(&f->parts, &normal, f->terms.unit);
    hci_normal_equations_release(&normal);
    if (!made) return hci_note_memory(note, NULL, "what recordings leave open");
    if (told) f->run[f->parts.count - 1] = run;
    return HCI_OK;
}

/* Electrical turns that the samples of a run cover. */
static double turns_of(const hci_regression *e, size_t run)
{
    double turns = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;) {
        const hci_binned_sample *first = e->samples->sample + s->first, *last = first + s->count - 1;
        turns += fabs(last->reading.theta_m_rad - first->reading.theta_m_rad) * e->machine->pole_pairs;
    }
    return turns / (2.0 * HCI_PI);
}

/* Whether a part of a run can be left out, and what remains still tells all orders. */
static bool spans_enough(const hci_regression *e, size_t parts)
{
    for (size_t r = 0; r < e->samples->run_count && parts > 1; ++r)
        if (e->use[r] && !(turns_of(e, r) * (double)(parts - 1) >= WHOLE * (double)parts)) return false;
    return true;
}

static hci_status join_failed(const finding *f, hci_note *note)
{
    if (hci_watch_stops(f->parts.watch)) return HCI_ERROR_STOPPED;
    return hci_note_memory(note, NULL, "what recordings leave open");
}

/* A recording that another one repeats is not left out while that one stays: both are. Where so few are left
 * that nothing can be left out, such as parts of one run, repetitions are all there is. */
static hci_status runs_join(finding *f, hci_note *note)
{
    if (!hci_condensed_join(&f->parts, f->terms.unit, COPY, &f->runs, f->group)) return join_failed(f, note);
    if (f->runs.count >= HCI_LEAST_GROUPS || f->runs.count == f->parts.count) return HCI_OK;
    hci_condensed_release(&f->runs);
    if (!hci_condensed_join(&f->parts, f->terms.unit, INFINITY, &f->runs, f->group))
        return join_failed(f, note);
    return HCI_OK;
}

static hci_status parts_add(finding *f, hci_note *note)
{
    const hci_regression *e = f->regression;
    const size_t parts = hci_run_parts(e, HCI_LEAST_GROUPS - 1), most = parts * hci_regression_runs_in_use(e);
    if (!spans_enough(e, parts)) return HCI_OK;
    f->run = hci_memory_new(2 * most + 1, sizeof *f->run);
    if (!f->run || !hci_condensed_start(&f->parts, f->terms.count, most))
        return hci_note_memory(note, NULL, "what recordings leave open");
    f->group = f->run + most;
    f->parts.watch = e->watch;
    const hci_status status = hci_run_parts_each(e, parts, false, part_add, f, note);
    return status ? status : runs_join(f, note);
}

/* ---- what was measured ---- */

static void range_add(hci_measured_range *range, double value)
{
    range->least = fmin(range->least, value);
    range->most = fmax(range->most, value);
}

static hci_status measured_fill(const finding *f, const hci_effects *effects, size_t run,
                                hci_measured_run *out, hci_note *note)
{
    const hci_regression *e = f->regression;
    const hci_measured_range none = {NAN, NAN};
    const char *name = e->runs[run].name;
    const bool moves = e->runs[run].speed_rad_per_s != NULL;
    *out = (hci_measured_run){hci_memory_new(strlen(name) + 1, 1), none, none, none, NAN};
    if (!out->file) return hci_note_memory(note, NULL, "what recordings leave open");
    memcpy(out->file, name, strlen(name) + 1);
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;)
        for (size_t k = s->first; k < s->first + s->count; ++k) {
            const hci_sample truth =
                hci_effects_undo(effects, e->machine->pole_pairs, &e->samples->sample[k].reading);
            const hci_dq i = hci_sample_dq(&truth, e->machine->pole_pairs);
            range_add(&out->id_A, i.d);
            range_add(&out->iq_A, i.q);
            if (moves) range_add(&out->speed_rad_per_s, truth.speed_rad_per_s);
        }
    return HCI_OK;
}

/* What leaving out tells of one run: mean of s² over its parts; NAN: nothing. */
static double misfit_of_run(const finding *f, const hci_left_out_group *left, size_t run)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < f->parts.count; ++k) {
        const double misfit = left[f->group[k]].misfit;
        if (f->run[k] != run || !isfinite(misfit)) continue;
        sum += misfit;
        count += 1.0;
    }
    return count > 0.0 ? sum / count : (double)NAN;
}

/* Whether a part is the first of its run. */
static bool is_first(const finding *f, size_t part)
{
    return part == 0 || f->run[part - 1] != f->run[part];
}

static hci_status runs_fill(const finding *f, const hci_effects *effects, hci_uncertainty *u, hci_note *note)
{
    const hci_left_out_group *left = f->trials.trial[f->trials.best].left;
    double sum = 0.0, count = 0.0;
    size_t at = 0;
    hci_status status = HCI_OK;
    for (size_t k = 0; k < f->parts.count && !status; ++k) {
        if (!is_first(f, k)) continue;
        status = measured_fill(f, effects, f->run[k], &u->run[at], note);
        u->run[at].misfit = misfit_of_run(f, left, f->run[k]);
        if (isfinite(u->run[at].misfit)) {
            sum += u->run[at].misfit;
            count += 1.0;
        }
        ++at;
    }
    for (size_t r = 0; r < at; ++r)
        u->run[r].misfit = sqrt(u->run[r].misfit * count / sum);
    return status;
}

/* ---- machines that are allowed ---- */

/* How many groups tell of s; where none shows an error, 0. */
static size_t told_by(const finding *f, const hci_width_trial *x)
{
    size_t count = 0;
    double sum = 0.0;
    for (size_t g = 0; g < f->runs.count; ++g)
        if (isfinite(x->left[g].misfit)) {
            sum += x->left[g].misfit;
            ++count;
        }
    return sum > 0.0 ? count : 0;
}

/* Where machines go, and what chance they are drawn with. */
typedef struct {
    const hci_model *model;
    hci_uncertainty *uncertainty;
    hci_draws draws;
    double *x, *size; /* [columns], [groups] */
} drawing;

/* The size of the group that has one behind place `at`, around and around. */
static double next_size(const finding *f, const double *size, size_t *at)
{
    do
        *at = (*at + 1) % f->runs.count;
    while (isnan(size[*at]));
    return size[*at];
}

/* Departures of the machines from one place to another, of one trial: errors of the size that is to be
 * expected of one run after the other, and more, since few runs may have shown too little. */
static hci_status trial_draw(const finding *f, hci_width_place trial, size_t from, size_t until, drawing *d,
                             hci_note *note)
{
    const double freedom = hci_group_sizes(f->trials.trial[trial.width].left, f->runs.count, d->size);
    const unsigned whole = (unsigned)fmin(MOST_FREEDOM, fmax(1.0, freedom));
    size_t at = 0;
    hci_ridge ridge;
    if (!hci_width_trials_ridge(&f->trials, trial, &f->terms, &f->runs, &ridge))
        return hci_note_memory(note, NULL, "what recordings leave open");
    for (size_t m = from; m < until; ++m) {
        const double s = next_size(f, d->size, &at) * hci_draws_student_scale(&d->draws, whole);
        hci_ridge_draw(&ridge, s, &d->draws, d->x);
        for (size_t c = 0; c < d->model->columns; ++c)
            d->uncertainty->departure[d->model->column[c].place * d->uncertainty->machines + m] = d->x[c];
    }
    hci_ridge_release(&ridge);
    return HCI_OK;
}

/* Each trial, with each share of the powers, has as many machines as its weight is of all. */
static hci_status machines_draw(const finding *f, const hci_model *model, hci_uncertainty *u, hci_note *note)
{
    drawing d = {model, u, {SEED}, hci_memory_new(model->columns + f->runs.count + 1, sizeof *d.x), NULL};
    double sum = 0.0;
    size_t from = 0;
    hci_status status = d.x ? HCI_OK : hci_note_memory(note, NULL, "what recordings leave open");
    if (d.x) d.size = d.x + model->columns;
    for (size_t k = 0; k < f->trials.count * f->trials.powers.count && !status; ++k) {
        const hci_width_place at = {k / f->trials.powers.count, k % f->trials.powers.count};
        sum += f->trials.trial[at.width].weight * f->trials.powers.trial[at.power].weight;
        const size_t until = (size_t)floor(sum * (double)u->machines + 0.5);
        if (until > from) status = trial_draw(f, at, from, until, &d, note);
        from = until;
    }
    hci_memory_free(d.x);
    return status;
}

/* ---- machines by other effects ---- */

#define PINNED 1e-6 /* in the term's unit: deviation of what no machine but an alternative has */

/* The fitted terms, and those of the machine that alternatives have, which are held where they are declared;
 * those of the co-energy are expected anyway. */
static hci_status with_alternatives(const hci_candidates *fitted, const hci_alternatives *alternatives,
                                    hci_candidates *all, hci_note *note)
{
    hci_status status = hci_candidates_copy(fitted, all, note);
    for (size_t n = 0; n < alternatives->count; ++n)
        for (size_t k = 0; k < alternatives->machine[n]->count && !status; ++k) {
            hci_candidate x = alternatives->machine[n]->candidate[k];
            if (!x.in || !x.type->in_machine || x.type->propose_coenergy) continue;
            if (hci_candidates_find_in(all, &x)) continue;
            for (size_t j = 0; j < x.count; ++j)
                x.term[j].value = x.declared[j];
            x.deviation = PINNED;
            status = hci_candidates_add(all, &x, note);
        }
    return status;
}

/* The fundamental of the back-EMF by which the torque per ampere differs. */
static hci_status with_constant(const hci_regression *e, double share, hci_candidates *all, hci_note *note)
{
    size_t parameter;
    hci_candidate x = {.type = hci_torque_per_ampere(&parameter), .count = 1, .in = true};
    hci_candidates one = {.candidate = &x, .count = 1};
    hci_model model;
    x.term[0] = (hci_effect_term){.parameter = parameter, .order = 1.0, .value = 1.0};
    if (hci_candidates_find_in(all, &x)) return HCI_OK;
    hci_status status = hci_model_make(e->declared, &one, false, &model, note);
    if (status) return status;
    const double constant = hci_torque_constant(e->machine, e->declared);
    x.deviation = share * fabs(constant / (hci_torque_constant(e->machine, &model.list) - constant));
    hci_model_release(&model);
    x.term[0].value = 0.0;
    return hci_candidates_add(all, &x, note);
}

/* The value of a term in a model; NAN: it does not have it. */
static double value_in(const hci_candidates *model, const hci_candidate *x, size_t j)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *c = &model->candidate[k];
        for (size_t i = 0; c->in && c->type == x->type && i < c->count; ++i)
            if (c->term[i].parameter == x->term[j].parameter &&
                fabs(c->term[i].order - x->term[j].order) <= HCI_ORDER_TOLERANCE)
                return c->term[i].value;
    }
    return (double)NAN;
}

/* By how much an alternative has another value than the fitted model; where neither has it, 0. */
static double alternative_more(const finding *f, const hci_candidates *alternative, const hci_candidate *x,
                               size_t j)
{
    const double there = value_in(alternative, x, j), here = value_in(f->fitted, x, j);
    if (isnan(there)) return isnan(here) ? 0.0 : x->declared[j] - here;
    return there - (isnan(here) ? x->term[j].value : here);
}

/* One in so many machines is what the recordings are by other effects, with the same chance about it. */
static void alternatives_take(const finding *f, const hci_model *model, hci_uncertainty *u)
{
    for (size_t n = 0; n < f->alternatives->count; ++n)
        for (size_t c = 0; c < model->columns; ++c) {
            const hci_candidate *x = model->column[c].candidate;
            const size_t j = model->column[c].term;
            if (!x->type->in_machine || is_untold(f, x, j)) continue;
            const double more = alternative_more(f, f->alternatives->machine[n], x, j);
            for (size_t m = n; m < u->machines; m += f->alternatives->count + 1)
                u->departure[model->column[c].place * u->machines + m] += more;
        }
}

static size_t runs_told(const finding *f)
{
    size_t runs = 0;
    for (size_t k = 0; k < f->parts.count; ++k)
        runs += is_first(f, k);
    return runs;
}

static hci_status uncertainty_fill(const finding *f, hci_uncertainty *u, hci_note *note)
{
    hci_model model;
    hci_status status = hci_model_make(f->regression->declared, &f->terms.candidates, true, &model, note);
    if (status) return status;
    u->effects = (hci_effects_data){model.list, model.effect, model.term};
    status = hci_uncertainty_reserve(u, runs_told(f), MACHINES, note);
    if (!status) status = runs_fill(f, &model.list, u, note);
    if (!status) status = machines_draw(f, &model, u, note);
    if (!status) alternatives_take(f, &model, u);
    hci_memory_free(model.column);
    return status;
}

/* ---- all of it ---- */

static void finding_release(finding *f)
{
    hci_model_release(&f->found);
    hci_width_trials_release(&f->trials);
    hci_condensed_release(&f->parts);
    hci_condensed_release(&f->runs);
    hci_allowed_terms_release(&f->terms);
    hci_memory_free(f->run);
}

hci_status hci_uncertainty_find(hci_regression *regression, const hci_candidates *fitted,
                                const hci_alternatives *alternatives, hci_uncertainty *uncertainty,
                                hci_note *note)
{
    finding f = {.regression = regression, .fitted = fitted, .alternatives = alternatives};
    hci_candidates all = {0};
    memset(uncertainty, 0, sizeof *uncertainty);
    hci_status status = with_alternatives(fitted, alternatives, &all, note);
    if (!status && alternatives->constant_share > 0.0)
        status = with_constant(regression, alternatives->constant_share, &all, note);
    if (!status) status = hci_sidebands_add(regression->machine, &all, note);
    if (!status) status = hci_allowed_terms_make(f.regression, &all, &f.terms, note);
    if (!status) status = hci_model_make(regression->declared, fitted, false, &f.found, note);
    if (!status) status = parts_add(&f, note);
    if (!status && f.runs.count >= HCI_LEAST_GROUPS) {
        status = hci_width_trials_make(&f.terms, &f.runs, &f.trials, note);
        if (!status && told_by(&f, &f.trials.trial[f.trials.best]) >= HCI_LEAST_GROUPS)
            status = uncertainty_fill(&f, uncertainty, note);
    }
    finding_release(&f);
    hci_candidates_release(&all);
    if (status) hci_uncertainty_release(uncertainty);
    return status;
}
