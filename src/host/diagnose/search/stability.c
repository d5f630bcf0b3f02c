#include "host/diagnose/search/stability.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/run_equations.h"

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
    double *precision;      /* [columns], with a type held at 0 */
    double *with, *without; /* [runs], squares of the runs left out */
} leaving;

static void leaving_end(leaving *l)
{
    hci_run_equations_release(&l->equations);
    hci_memory_free(l->precision);
}

static hci_status leaving_start(hci_search *s, const hci_candidates *model, leaving *l, hci_note *note)
{
    const size_t columns = hci_candidates_terms_in(model);
    *l = (leaving){.search = s, .model = model};
    const hci_status status = hci_run_equations_make(s->regression, model, &l->equations, note);
    if (status) return status;
    const size_t groups = l->equations.groups.count;
    l->precision = hci_memory_new(columns + 2 * groups + 1, sizeof *l->precision);
    if (!l->precision) {
        leaving_end(l);
        return hci_note_memory(note, NULL, "leaving runs out");
    }
    l->with = l->precision + columns;
    l->without = l->with + groups;
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

/* The runs but one. left: [groups]. Returns their rows. */
static double others_of(const hci_groups *all, size_t run, hci_normal_equations *left)
{
    double rows = 0.0;
    for (size_t r = 0; r < all->count; ++r) {
        if (r == run) continue;
        *left++ = all->group[r];
        rows += all->group[r].rows;
    }
    return rows;
}

/* Puts what a type makes with the values that it has in the place of what a run shows. moment: out,
 * [columns]. */
static void values_show(const leaving *l, const hci_effect_type *type, hci_normal_equations *run,
                        double *moment)
{
    size_t column = 0;
    memset(moment, 0, run->n * sizeof *moment);
    run->moment = moment;
    run->square = 0.0;
    for (size_t k = 0; k < l->model->count; ++k)
        for (size_t j = 0; l->model->candidate[k].in && j < l->model->candidate[k].count; ++j, ++column) {
            const double *gram = run->gram + column * run->n;
            const double value = hci_candidate_departure(&l->model->candidate[k], j);
            if (l->model->candidate[k].type != type) continue;
            run->square += value * (value * gram[column] + 2.0 * moment[column]);
            for (size_t i = 0; i < run->n; ++i)
                moment[i] += value * gram[i];
        }
}

#define TOLD 2.0 /* times its price: what the others have to show of a type to be asked */

/* One run left out, and what the others say of a type. */
typedef struct {
    const hci_effect_type *type; /* which is held */
    hci_normal_equations *left;  /* [groups], room */
    double *moment;              /* [groups][columns], room */
    bool stays;                  /* the others fit decisively better with it */
    bool told;                   /* they would, with the values that it has: no other effect makes as much */
} left_out_case;

static bool case_find(const leaving *l, size_t run, left_out_case *x)
{
    const hci_groups *all = &l->equations.groups, others = {x->left, all->count - 1};
    const double price = price_of(l, x->type, others_of(all, run, x->left));
    double with = 0.0, without = 0.0, expected = 0.0;
    bool made = hci_all_in_square(&others, l->equations.precision, &with) &&
                hci_all_in_square(&others, l->precision, &without);
    for (size_t r = 0; r < others.count && made; ++r)
        values_show(l, x->type, &x->left[r], x->moment + r * x->left[r].n);
    made = made && hci_all_in_square(&others, l->precision, &expected);
    x->stays = without - with > price;
    x->told = x->stays || expected > TOLD * price;
    return made;
}

/* told: out, the cases in which the others show enough of the type to be asked. */
static hci_status stays_count(leaving *l, hci_verdict *v, size_t *told, hci_note *note)
{
    const size_t runs = l->equations.groups.count, columns = hci_candidates_terms_in(l->model);
    left_out_case x = {.type = v->type,
                       .left = hci_memory_new(runs + 1, sizeof *x.left),
                       .moment = hci_memory_new(runs * columns + 1, sizeof *x.moment)};
    bool made = x.left && x.moment;
    hold(l, v->type);
    for (*told = 0; v->left_out < runs && made && !hci_search_is_interrupted(l->search); ++v->left_out) {
        made = case_find(l, v->left_out, &x);
        v->stays += x.stays;
        *told += x.told;
    }
    hci_memory_free(x.left);
    hci_memory_free(x.moment);
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
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
 * than they do. Both in units in which 0 is no better. */
static double worth_in(const leaving *l)
{
    double sum = 0.0, mean_log = 0.0;
    for (size_t r = 0; r < l->equations.groups.count; ++r) {
        const double rows = fmax(1.0, l->equations.groups.group[r].rows);
        sum += l->without[r] - l->with[r];
        mean_log += rows * log((l->without[r] / rows + FLOOR) / (l->with[r] / rows + FLOOR));
    }
    return fmax(sum, mean_log);
}

/* Where a run alone tells most of a combination of values, it misses that many times what leaving it out
 * lowers the squares of the others by: no more is held against the model. */
static double missed_of(double fall, double left_out, double all_in)
{
    return fmin(left_out - all_in, HARDLY_TOLD * fmax(0.0, fall - all_in));
}

/* Squares of the runs left out, of each no more than is held against the model. False when memory is out. */
static bool squares_held(const leaving *l, const double *precision, double *square)
{
    const hci_groups *groups = &l->equations.groups;
    double *fall = hci_memory_new(2 * groups->count + 1, sizeof *fall);
    double *all_in = fall ? fall + groups->count : NULL;
    const bool made = fall && hci_left_out_squares(groups, precision, square) &&
                      hci_all_in_squares(groups, precision, all_in) &&
                      hci_left_out_falls(groups, precision, fall);
    for (size_t r = 0; r < groups->count && made; ++r)
        square[r] = all_in[r] + missed_of(fall[r], square[r], all_in[r]);
    hci_memory_free(fall);
    return made;
}

/* What the others do not tell of a run is not the fault of the type that is asked about. */
static hci_status worth_of(leaving *l, const hci_effect_type *type, double *worth, hci_note *note)
{
    hold(l, type);
    bool made = hci_left_out_squares(&l->equations.groups, l->equations.precision, l->with) &&
                hci_left_out_squares(&l->equations.groups, l->precision, l->without);
    *worth = made ? worth_in(l) : 0.0;
    if (*worth < 0.0) {
        made = squares_held(l, l->equations.precision, l->with) && squares_held(l, l->precision, l->without);
        *worth = worth_in(l);
    }
    return made ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
}

hci_status hci_search_left_out(hci_search *s, const hci_candidates *model, double *misfit, hci_note *note)
{
    leaving l;
    hci_status status = leaving_start(s, model, &l, note);
    *misfit = 0.0;
    if (status) return status;
    const hci_groups *groups = &l.equations.groups;
    if (groups->count >= HCI_LEAST_GROUPS && !hci_left_out_squares(groups, l.equations.precision, l.with))
        status = hci_note_memory(note, NULL, "leaving runs out");
    for (size_t r = 0; r < groups->count && groups->count >= HCI_LEAST_GROUPS && !status; ++r) {
        const double rows = fmax(1.0, groups->group[r].rows);
        *misfit += rows * log(l.with[r] / rows + FLOOR);
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

static void promises_add(const leaving *l, size_t run, double fall, promises *p)
{
    if (!is_told(fall, l->with[run])) return;
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
    hci_status status = leaving_start(s, model, &l, note);
    if (status) return status;
    status = promises_sum(&l, false, &p, note);
    if (!status && 3 * p.told < 2 * l.equations.groups.count) status = promises_sum(&l, true, &p, note);
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

/* Whether a type is found in too few of the cases with one run left out; of those in which the others do not
 * show it, as an offset of the torque sensor beside friction without the only run of a direction, none is
 * held against it, as long as any shows it. */
static hci_status is_fickle(leaving *l, const hci_effect_type *type, bool *fickle, hci_note *note)
{
    hci_verdict v = {.type = type};
    size_t told = 0;
    const hci_status status = stays_count(l, &v, &told, note);
    *fickle = 3 * v.stays < 2 * told || (v.left_out > 0 && v.stays == 0);
    return status;
}

/* What a type is worth in runs left out; one that is fickle less than nothing. */
typedef struct {
    const hci_effect_type *type;
    double worth, alone; /* alone: whether fickle or not */
} usefulness;

static bool is_less(const usefulness *x, const usefulness *than)
{
    return x->worth < than->worth || (x->worth == than->worth && x->alone < than->alone);
}

static hci_status usefulness_find(leaving *l, usefulness *x, hci_note *note)
{
    bool fickle = false;
    hci_status status = worth_of(l, x->type, &x->alone, note);
    if (!status) status = is_fickle(l, x->type, &fickle, note);
    x->worth = fickle ? fmin(x->alone, 0.0) - 1.0 : x->alone;
    return status;
}

/* The type that is worth least, or not found when other runs are left out; NULL where all predict. */
static hci_status useless_find(hci_search *s, const hci_candidates *model, const hci_effect_type **useless,
                               hci_note *note)
{
    leaving l;
    usefulness least = {0};
    hci_status status = leaving_start(s, model, &l, note);
    *useless = NULL;
    if (status) return status;
    for (size_t r = 0; r < hci_candidate_types() && l.equations.groups.count >= HCI_LEAST_GROUPS && !status;
         ++r) {
        usefulness x = {.type = hci_candidate_type(r)};
        if (!is_asked(s, model, x.type)) continue;
        status = usefulness_find(&l, &x, note);
        if (!status && is_less(&x, &least)) least = x;
    }
    leaving_end(&l);
    *useless = least.type;
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
    size_t told = 0;
    if (hci_search_is_interrupted(s)) return HCI_OK;
    hci_status status = leaving_start(s, &a->model.candidates, &l, note);
    if (status) return status;
    for (size_t r = 0; r < a->types && l.equations.groups.count >= HCI_LEAST_GROUPS && !status; ++r)
        if (hci_candidates_have(l.model, a->verdict[r].type))
            status = stays_count(&l, &a->verdict[r], &told, note);
    leaving_end(&l);
    return status;
}
