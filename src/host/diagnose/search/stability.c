#include "host/diagnose/search/stability.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/load_range.h"
#include "host/diagnose/fit/run_equations.h"
#include "host/diagnose/search/coenergy.h"

#define FLOOR 0.05 /* mean square of a run, in units of its noise, below which it is as good as can be */

#define HARDLY_TOLD                                                                                          \
    10.0 /* times what a run left out lowers the squares by, that it misses where others do not tell it */

#define BY_CHANCE 8.0 /* χ² by which runs left out are described worse for each term, and some more */

enum { LEAST_RUNS = 6 }; /* for the whole of a model to be asked what it says of runs left out */

/* The model's equations, run by run, and room for what is asked of them. */
typedef struct {
    hci_search *search;
    const hci_candidates *model;
    hci_run_equations equations;
    size_t asked;           /* groups that are left out; the others only where too few are left */
    double *precision;      /* [columns], with a type held at 0 */
    double *with, *without; /* [runs], squares of the runs left out */
} leaving;

static void leaving_end(leaving *l)
{
    hci_run_equations_release(&l->equations);
    hci_memory_free(l->precision);
}

/* A power series in the currents, as that of iron that saturates, says nothing of loads beyond those that it
 * was fitted to: runs of such loads are not asked. */
static void asked_find(leaving *l)
{
    const size_t groups = l->equations.groups.count;
    if (!hci_search_saturates(l->model)) memset(l->equations.beyond, 0, groups * sizeof *l->equations.beyond);
    l->asked = hci_asked_count(l->equations.beyond, groups);
}

/* few: up to so many runs are cut into parts. */
static hci_status leaving_start(hci_search *s, const hci_candidates *model, size_t few, leaving *l,
                                hci_note *note)
{
    const size_t columns = hci_candidates_terms_in(model);
    *l = (leaving){.search = s, .model = model};
    const hci_status status = hci_run_equations_make(s->regression, model, few, &l->equations, note);
    if (status) return status;
    const size_t groups = l->equations.groups.count;
    l->precision = hci_memory_new(columns + 2 * groups + 1, sizeof *l->precision);
    if (!l->precision) {
        leaving_end(l);
        return hci_note_memory(note, NULL, "leaving runs out");
    }
    l->with = l->precision + columns;
    l->without = l->with + groups;
    asked_find(l);
    return HCI_OK;
}

/* Holds the terms of a type at 0. */
static void hold(leaving *l, const hci_effect_type *type)
{
    size_t column = 0;
    for (size_t k = 0; k < l->model->count; ++k) {
        const hci_candidate *x = &l->model->candidate[k];
        for (size_t j = 0; x->in && j < x->count; ++j, ++column)
            l->precision[column] = x->type == type ? (double)INFINITY : l->equations.precision[column];
    }
}

/* ---- what stays ---- */

static double price_of(const leaving *l, const hci_effect_type *type, double rows)
{
    double price = 0.0;
    for (size_t k = 0; k < l->model->count; ++k)
        if (l->model->candidate[k].in && l->model->candidate[k].type == type)
            price += hci_candidate_cost(&l->model->candidate[k], rows);
    return price;
}

/* Whether a type would be found without one run: the others fit decisively better with it. */
static hci_status stays_without(leaving *l, const hci_effect_type *type, size_t run, bool *stays,
                                hci_note *note)
{
    const hci_groups all = l->equations.groups;
    hci_normal_equations *left = hci_memory_new(all.count, sizeof *left);
    double with = 0.0, without = 0.0, rows = 0.0;
    size_t count = 0;
    if (!left) return hci_note_memory(note, NULL, "leaving runs out");
    for (size_t r = 0; r < all.count; ++r) {
        if (r == run) continue;
        left[count++] = all.group[r];
        rows += all.group[r].rows;
    }
    const hci_groups others = {left, count};
    const bool made = hci_all_in_square(&others, l->equations.precision, &with) &&
                      hci_all_in_square(&others, l->precision, &without);
    hci_memory_free(left);
    *stays = without - with > price_of(l, type, rows);
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

static hci_status stays_count(leaving *l, hci_verdict *v, hci_note *note)
{
    hci_status status = HCI_OK;
    hold(l, v->type);
    for (; v->left_out < l->equations.groups.count && !status && !hci_search_is_interrupted(l->search);
         ++v->left_out) {
        bool stays = false;
        status = stays_without(l, v->type, v->left_out, &stays, note);
        v->stays += stays;
    }
    return status;
}

/* ---- what predicts ---- */

/* Whether the other runs tell what one shows: without it the sum of the squares falls by about what it
 * misses. Where it falls by far less, as without the only run of a current, the model may be right and the
 * others do not tell its values. */
static bool is_told(double fall, double left_out)
{
    return fall * HARDLY_TOLD > left_out;
}

/* By how much runs left out are described better with a type than without: as a whole, which tells of small
 * effects in long recordings, or on the average, where a run that lies outside of the others counts no more
 * than they do. Both in units in which 0 is no better. untold: of each run, whether it is not asked; NULL:
 * all are. */
static double worth_in(const leaving *l, const bool *untold)
{
    double sum = 0.0, mean_log = 0.0;
    for (size_t r = 0; r < l->equations.groups.count; ++r) {
        const double rows = fmax(1.0, l->equations.groups.group[r].rows);
        if (l->equations.beyond[r] || (untold && untold[r])) continue;
        sum += l->without[r] - l->with[r];
        mean_log += rows * log((l->without[r] / rows + FLOOR) / (l->with[r] / rows + FLOOR));
    }
    return fmax(sum, mean_log);
}

/* Takes the torque of a type with the values that it has out of what a run shows. */
static void values_take(const hci_candidates *model, const hci_effect_type *type, hci_normal_equations *run)
{
    size_t column = 0;
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].in && j < model->candidate[k].count; ++j, ++column) {
            const double *gram = run->gram + column * run->n;
            const double value = hci_candidate_departure(&model->candidate[k], j);
            if (model->candidate[k].type != type) continue;
            run->square += value * (value * gram[column] - 2.0 * run->moment[column]);
            for (size_t i = 0; i < run->n; ++i)
                run->moment[i] -= value * gram[i];
        }
}

/* The runs as they would be without a type whose values are known. moment: [groups][columns]. */
static void known_fill(const leaving *l, const hci_effect_type *type, hci_normal_equations *run,
                       double *moment)
{
    for (size_t r = 0; r < l->equations.groups.count; ++r) {
        const hci_normal_equations *from = &l->equations.groups.group[r];
        run[r] = *from;
        run[r].moment = moment + r * from->n;
        memcpy(run[r].moment, from->moment, from->n * sizeof *moment);
        values_take(l->model, type, &run[r]);
    }
}

/* Whether a run alone tells most of a combination of values, which the others hardly do: it is missed by far
 * more than leaving it out lowers the squares of the others by. */
static bool tells_alone(double fall, double left_out, double all_in)
{
    return left_out - all_in > HARDLY_TOLD * fmax(0.0, fall - all_in);
}

/* Which runs the others do not tell even with the values of a type known: what is wrong there is not its
 * fault. The type is held. Returns how many the others do tell. */
static hci_status untold_find(const leaving *l, const hci_effect_type *type, bool *untold, size_t *told,
                              hci_note *note)
{
    const size_t groups = l->equations.groups.count, columns = hci_candidates_terms_in(l->model);
    hci_normal_equations *run = hci_memory_new(groups + 1, sizeof *run);
    double *moment = hci_memory_new(groups * (columns + 3) + 1, sizeof *moment);
    double *left_out = moment ? moment + groups * columns : NULL;
    const hci_groups known = {run, groups};
    if (run && moment) known_fill(l, type, run, moment);
    const bool made = run && moment && hci_left_out_squares(&known, l->precision, left_out) &&
                      hci_all_in_squares(&known, l->precision, left_out + groups) &&
                      hci_left_out_falls(&known, l->precision, left_out + 2 * groups);
    *told = 0;
    for (size_t r = 0; r < groups && made; ++r) {
        untold[r] = l->equations.beyond[r] ||
                    tells_alone(left_out[2 * groups + r], left_out[r], left_out[groups + r]);
        *told += !untold[r];
    }
    hci_memory_free(run);
    hci_memory_free(moment);
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

/* Whether a type is in with orders of the turn, which any run tells. */
static bool has_orders(const hci_candidates *model, const hci_effect_type *type)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (x->in && x->type == type && type->parameter[x->term[0].parameter].ordered) return true;
    }
    return false;
}

/* Adds the runs of which the others do not tell the values of the type itself, such as friction of the only
 * one of its speed, among runs without a current. told: out, how many are left. */
static hci_status unproven_add(const leaving *l, bool *untold, size_t *told, hci_note *note)
{
    const hci_groups *groups = &l->equations.groups;
    double *all_in = hci_memory_new(2 * groups->count + 1, sizeof *all_in);
    double *fall = all_in ? all_in + groups->count : NULL;
    const bool made = all_in && hci_all_in_squares(groups, l->equations.precision, all_in) &&
                      hci_left_out_falls(groups, l->equations.precision, fall);
    *told = 0;
    for (size_t r = 0; r < groups->count && made; ++r) {
        untold[r] = untold[r] || tells_alone(fall[r], l->with[r], all_in[r]);
        *told += !untold[r];
    }
    hci_memory_free(all_in);
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

/* The same of the runs that the others tell, as long as there are enough of these. told: out, how many these
 * are, or where the type is worth nothing there, how many tell its values as well. */
static hci_status worth_in_told(const leaving *l, const hci_effect_type *type, double *worth, size_t *told,
                                hci_note *note)
{
    bool *untold = hci_memory_new(l->equations.groups.count + 1, sizeof *untold);
    if (!untold) return hci_note_memory(note, NULL, "leaving runs out");
    hci_status status = untold_find(l, type, untold, told, note);
    if (!status && *told >= HCI_LEAST_GROUPS) *worth = worth_in(l, untold);
    const bool asks_for_values = l->search->no_current && !has_orders(l->model, type);
    if (!status && *told >= HCI_LEAST_GROUPS && *worth < 0.0 && asks_for_values)
        status = unproven_add(l, untold, told, note);
    hci_memory_free(untold);
    return status;
}

/* told: out, how many runs were asked. */
static hci_status worth_of(leaving *l, const hci_effect_type *type, double *worth, size_t *told,
                           hci_note *note)
{
    hold(l, type);
    *told = l->asked;
    if (!hci_left_out_squares(&l->equations.groups, l->equations.precision, l->with) ||
        !hci_left_out_squares(&l->equations.groups, l->precision, l->without))
        return hci_note_memory(note, NULL, "leaving runs out");
    *worth = worth_in(l, NULL);
    return *worth < 0.0 ? worth_in_told(l, type, worth, told, note) : HCI_OK;
}

hci_status hci_search_left_out(hci_search *s, const hci_candidates *model, double *misfit, hci_note *note)
{
    leaving l;
    hci_status status = leaving_start(s, model, HCI_LEAST_GROUPS, &l, note);
    *misfit = 0.0;
    if (status) return status;
    const hci_groups *groups = &l.equations.groups;
    if (groups->count >= HCI_LEAST_GROUPS && !hci_left_out_squares(groups, l.equations.precision, l.with))
        status = hci_note_memory(note, NULL, "leaving runs out");
    for (size_t r = 0; r < groups->count && groups->count >= HCI_LEAST_GROUPS && !status; ++r) {
        const double rows = fmax(1.0, groups->group[r].rows);
        if (!l.equations.beyond[r]) *misfit += rows * log(l.with[r] / rows + FLOOR);
    }
    leaving_end(&l);
    return status;
}

/* What runs left out say of a model. */
typedef struct {
    double taken; /* sum of their squares without any effect, less those of the model fitted to all of them */
    double missed; /* sum of their squares where they are left out, less the same */
    size_t told;   /* of how many that is: of the others nothing is added */
} promises;

/* Where a run alone tells most of a combination of values, it misses that many times what leaving it out
 * lowers the squares of the others by: no more is held against the model. */
static double missed_of(double fall, double left_out, double all_in)
{
    return fmin(left_out - all_in, HARDLY_TOLD * fmax(0.0, fall - all_in));
}

static void promises_add(const leaving *l, size_t run, double fall, promises *p)
{
    if (l->equations.beyond[run] || !is_told(fall, l->with[run])) return;
    p->taken += l->equations.groups.group[run].square - l->without[run];
    p->missed += missed_of(fall, l->with[run], l->without[run]);
    ++p->told;
}

/* all: of all runs, where too few of them are told by the others. */
static hci_status promises_sum(leaving *l, bool all, promises *p, hci_note *note)
{
    const hci_groups *groups = &l->equations.groups;
    double *fall = hci_memory_new(groups->count + 1, sizeof *fall);
    const bool made = fall && hci_left_out_squares(groups, l->equations.precision, l->with) &&
                      hci_all_in_squares(groups, l->equations.precision, l->without) &&
                      hci_left_out_falls(groups, l->equations.precision, fall);
    *p = (promises){0.0, 0.0, 0};
    for (size_t r = 0; r < groups->count && made; ++r) {
        promises_add(l, r, all ? l->with[r] : fall[r], p);
    }
    hci_memory_free(fall);
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

hci_status hci_search_unpredicted(hci_search *s, const hci_candidates *model, double *share, hci_note *note)
{
    leaving l;
    promises p;
    *share = 0.0;
    if (hci_regression_runs_in_use(s->regression) < LEAST_RUNS || hci_candidates_types_in(model) == 0 ||
        hci_search_is_interrupted(s))
        return HCI_OK;
    hci_status status = leaving_start(s, model, HCI_LEAST_GROUPS, &l, note);
    if (status) return status;
    status = promises_sum(&l, false, &p, note);
    if (!status && 3 * p.told < 2 * l.asked) status = promises_sum(&l, true, &p, note);
    leaving_end(&l);
    p.missed -= BY_CHANCE * (double)hci_candidates_terms_in(model);
    if (!status && p.taken > 0.0) *share = fmax(0.0, p.missed / p.taken);
    return status;
}

/* Whether a type may be asked at all: the terms of a whole co-energy were chosen by runs left out already. */
static bool is_asked(const hci_search *s, const hci_candidates *model, const hci_effect_type *type)
{
    return hci_candidates_have(model, type) && type != &hci_empirical_type &&
           !(s->whole_coenergy && type->propose_coenergy);
}

/* Whether a type is found in too few of the cases with one run left out. */
static hci_status is_fickle(leaving *l, const hci_effect_type *type, bool *fickle, hci_note *note)
{
    hci_verdict v = {.type = type};
    const hci_status status = stays_count(l, &v, note);
    *fickle = 3 * v.stays < 2 * v.left_out;
    return status;
}

/* What a type is worth; below 0 where it is of no use, or not found when other runs are left out. told: out,
 * how many runs say so. */
static hci_status use_of(leaving *l, const hci_effect_type *type, double *worth, size_t *told, hci_note *note)
{
    bool fickle = false;
    hci_status status = worth_of(l, type, worth, told, note);
    if (!status) status = is_fickle(l, type, &fickle, note);
    if (fickle && *worth >= 0.0) *told = 0;
    if (fickle) *worth = fmin(*worth, 0.0) - 1.0;
    return status;
}

/* Runs left out, and halves of those of a few that are the only one of their load, direction and speed. */
typedef struct {
    leaving whole, halves;
    bool has_halves;
} leavings;

/* Whether halves are left out of more runs than without. */
static bool any_is_cut(const hci_regression *e)
{
    if (hci_run_parts(e, HCI_LEAST_GROUPS) > 1 || hci_run_parts(e, HCI_FEW_RUNS) == 1) return false;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && hci_run_is_alone(e, r)) return true;
    return false;
}

static void leavings_end(leavings *x)
{
    leaving_end(&x->whole);
    if (x->has_halves) leaving_end(&x->halves);
}

static hci_status leavings_start(hci_search *s, const hci_candidates *model, leavings *x, hci_note *note)
{
    *x = (leavings){.has_halves = false};
    hci_status status = leaving_start(s, model, HCI_LEAST_GROUPS, &x->whole, note);
    if (status || !any_is_cut(s->regression)) return status;
    status = leaving_start(s, model, HCI_FEW_RUNS, &x->halves, note);
    x->has_halves = !status;
    if (status) leaving_end(&x->whole);
    return status;
}

/* The type that is worth least, or not found when other runs are left out; NULL where all predict. Where too
 * few runs are told by the others halves of them are asked. */
static hci_status useless_find(hci_search *s, const hci_candidates *model, const hci_effect_type **useless,
                               hci_note *note)
{
    leavings l;
    double least = 0.0;
    *useless = NULL;
    hci_status status = leavings_start(s, model, &l, note);
    if (status) return status;
    const bool enough = l.whole.equations.groups.count >= HCI_LEAST_GROUPS;
    for (size_t r = 0; r < hci_candidate_types() && enough && !status; ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        double worth = 0.0;
        size_t told = 0;
        if (!is_asked(s, model, type)) continue;
        status = use_of(&l.whole, type, &worth, &told, note);
        if (!status && worth < 0.0 && told < HCI_LEAST_GROUPS && l.has_halves)
            status = use_of(&l.halves, type, &worth, &told, note);
        if (status || !(worth < least)) continue;
        least = worth;
        *useless = type;
    }
    leavings_end(&l);
    return status;
}

hci_status hci_search_keep_predictive(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_effect_type *useless = NULL;
    hci_status status = HCI_OK;
    while (!status && !hci_search_is_interrupted(s)) {
        hci_search_tell(s);
        status = useless_find(s, &model->candidates, &useless, note);
        if (status || !useless) break;
        hci_candidates_remove_type(&model->candidates, useless);
        status = hci_search_renew(s, model, note);
    }
    return status;
}

hci_status hci_search_stability(hci_search *s, hci_attribution *a, hci_note *note)
{
    leaving l;
    if (hci_search_is_interrupted(s)) return HCI_OK;
    hci_status status = leaving_start(s, &a->model.candidates, HCI_LEAST_GROUPS, &l, note);
    if (status) return status;
    for (size_t r = 0; r < a->types && l.equations.groups.count >= HCI_LEAST_GROUPS && !status; ++r)
        if (hci_candidates_have(l.model, a->verdict[r].type)) status = stays_count(&l, &a->verdict[r], note);
    leaving_end(&l);
    return status;
}
