/* Currents within limits (theory.md, section 15). In: a task, bounds and the currents without them; out: the
 * currents that meet the wishes in turn (wishes.c) on a set of components (limited_set.c), step by step where
 * the torque is not linear (limited_path.c). */
#include "host/solution/limited.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solution/limited_path.h"
#include "host/solution/limited_set.h"
#include "host/solution/limits.h"
#include "host/solution/wish.h"
#include "host/solve/linear.h"

enum {
    MOST_MORE = 90
}; /* components that are tried where fewer were before: the time grows with their cube */

#define SMALL       1e-3 /* share of the torque below which the ripple may be that of orders left out */
#define SMALL_SWING 4e-3 /* the same from peak to peak */
#define NEAR        1e-4 /* share of the torque to which an answer without its last steps tells the mean */

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

static bool is_same(hci_component a, hci_component b)
{
    return a.sequence == b.sequence && fabs(a.order - b.order) < HCI_ORDER_TOLERANCE;
}

/* Coordinates of the answer without limits on the set, as far as it has them. */
static void start(const hci_wishes *w, const hci_answer *a, double *x)
{
    const double mean_Nm = hci_target_mean_Nm(w->of->options->target);
    for (size_t k = 0; k < w->set.count; ++k)
        for (size_t j = 0; j < a->set.count; ++j)
            if (is_same(a->set.component[j], w->set.component[k]))
                for (size_t part = 0; part < 2; ++part)
                    x[2 * k + part] = hci_coordinate(a->x, 2 * a->set.count, mean_Nm, 2 * j + part);
}

/* The set and the currents into the answer. */
static hci_status give(const hci_wishes *w, hci_answer *a, hci_note *note)
{
    hci_answer_release(a);
    if (hci_answer_reserve(w->set.count, a)) return out_of_memory(note);
    memcpy(a->set.component, w->set.component, w->set.count * sizeof *a->set.component);
    memcpy(a->set.set, w->set.set, w->set.count * sizeof *a->set.set);
    memcpy(a->x + 2 * w->set.count, w->x, 2 * w->set.count * sizeof *a->x);
    return HCI_OK;
}

/* ---- another beginning, where the torque is not linear ---- */

static bool is_fundamental(hci_component c)
{
    return fabs(c.order - 1.0) < HCI_ORDER_TOLERANCE && c.sequence == 1;
}

/* Coordinates of the best sine within the limits, and no harmonics. */
static hci_status start_at_sine(const hci_wishes *w, const hci_answer *a, double *x, hci_note *note)
{
    hci_component fundamental = {1.0, 1};
    hci_set name = HCI_SET_POS;
    hci_wishes sine = {.of = w->of, .set = {.component = &fundamental, .set = &name, .count = 1}};
    double from[2] = {0.0, 0.0};
    hci_status status = hci_wishes_begin(&sine, note);
    start(&sine, a, from);
    if (!status) status = hci_limited_path_approach(&sine, from, note);
    for (size_t k = 0; k < w->set.count && !status; ++k)
        for (size_t part = 0; part < 2; ++part)
            x[2 * k + part] = is_fundamental(w->set.component[k]) ? sine.x[part] : 0.0;
    sine.set = (hci_component_set){0};
    hci_wishes_release(&sine);
    return status;
}

/* What stands beside the currents of an answer. */
typedef struct {
    double *x;
    hci_limit_merit merit;
    hci_limit_optimum cost;
    hci_solution solution;
} beginning;

static hci_status merit_of(const hci_wishes *w, hci_limit_merit *merit, hci_note *note)
{
    return hci_limited_path_merit(w, w->x, merit, note);
}

/* Whether what the best sine leads to may have a mean that is nearer to the wanted one by more than it is
 * known to. x: out, its currents. */
static hci_status try_sine(hci_wishes *w, const hci_answer *a, const beginning *first, double *x,
                           hci_note *note)
{
    hci_limit_merit merit;
    hci_status status = start_at_sine(w, a, x, note);
    w->is_hard = false;
    hci_limit_points_cut(&w->program.points, 0);
    if (!status) status = hci_limited_path_approach(w, x, note);
    if (!status) status = merit_of(w, &merit, note);
    if (status) return status;
    memcpy(x, w->x, 2 * w->set.count * sizeof *x);
    return merit.mean_error_Nm < first->merit.mean_error_Nm - NEAR * w->program.scale_Nm ? HCI_OK
                                                                                         : HCI_ERROR_NUMERIC;
}

/* The better of what was found and what comes of the best sine: w->x. */
static hci_status better(hci_wishes *w, const hci_answer *a, beginning *first, double *x, hci_note *note)
{
    hci_limit_merit merit;
    hci_status status = try_sine(w, a, first, x, note);
    if (!status) status = hci_limited_path_follow(w, x, note);
    if (!status) status = merit_of(w, &merit, note);
    if (hci_wish_is_end(status)) return status;
    if (!status && hci_limit_merit_less(&merit, &first->merit, w->program.scale_Nm)) return HCI_OK;
    memcpy(w->x, first->x, 2 * w->set.count * sizeof *w->x);
    w->cost = first->cost;
    *w->of->solution = first->solution;
    return HCI_OK;
}

/* Whether the work leaves another beginning. */
static bool has_steps(const hci_wishes *w)
{
    return w->steps + HCI_LIMITED_LEAST_STEPS <= HCI_LIMITED_MOST_STEPS;
}

/* Whether a second beginning may find more: where the mean falls short of torque that is not linear. */
static bool may_find_more(const hci_wishes *w)
{
    bool has_fundamental = false;
    for (size_t k = 0; k < w->set.count; ++k)
        has_fundamental = has_fundamental || is_fundamental(w->set.component[k]);
    return has_fundamental && has_steps(w) && w->set.count > 1 && !w->of->task->held &&
           !hci_task_is_linear(w->of->task) && hci_bounds_are_alike(w->of->bounds) &&
           w->of->solution->limit_cost == HCI_COST_TORQUE;
}

static hci_status begin_again(hci_wishes *w, const hci_answer *a, double *x, hci_note *note)
{
    beginning first = {.x = hci_memory_new(2 * w->set.count, sizeof *first.x)};
    hci_status status = first.x ? HCI_OK : out_of_memory(note);
    if (!status) {
        memcpy(first.x, w->x, 2 * w->set.count * sizeof *w->x);
        first.cost = w->cost;
        first.solution = *w->of->solution;
        status = merit_of(w, &first.merit, note);
    }
    if (!status) status = better(w, a, &first, x, note);
    hci_memory_free(first.x);
    return status;
}

/* ---- all of it ---- */

/* w->x: the best currents within the limits. */
static hci_status find(hci_wishes *w, const hci_answer *a, hci_note *note)
{
    double *x = hci_memory_new(2 * w->set.count, sizeof *x);
    hci_status status = x ? HCI_OK : out_of_memory(note);
    if (!status) {
        start(w, a, x);
        status = hci_limited_path_follow(w, x, note);
    }
    if (!status && may_find_more(w)) status = begin_again(w, a, x, note);
    hci_memory_free(x);
    return status;
}

/* Whether what was found is to take the place of the currents without limits: where those do not keep them or
 * are worse. */
static hci_status find_whether_better(const hci_wishes *w, const hci_solution *without, bool *is_better,
                                      hci_note *note)
{
    const hci_wave_list i = {without->current.wave, without->current.count};
    hci_limit_merit before, now;
    hci_status status;
    *is_better = true;
    if (!without->within_limits) return HCI_OK;
    status = hci_limit_merit_evaluate(w->of->task, w->program.minimise, &i, &before, note);
    if (!status) status = merit_of(w, &now, note);
    if (!status) *is_better = hci_limit_merit_less(&now, &before, w->program.scale_Nm);
    return status;
}

/* The set on which w answers has fewer components than the currents without limits. */
static void tell_cut(const hci_wishes *w, const hci_answer *a)
{
    hci_note_add(&w->of->solution->remark,
                 "within limits the components up to order %g are looked at; without limits they go up to "
                 "order %g: more can be named with --harmonics",
                 hci_wishes_top(&w->set), hci_wishes_top(&a->set));
}

/* without: what there was before w. */
static hci_status take(hci_wishes *w, const hci_solution *without, hci_answer *a, hci_note *note)
{
    hci_solution *s = w->of->solution;
    bool is_better = true;
    hci_status status = find_whether_better(w, without, &is_better, note);
    if (status) return status;
    if (!is_better) {
        *s = *without;
        return HCI_OK;
    }
    if (hci_limited_set_is_cut(a, w)) tell_cut(w, a);
    if (w->is_ended) w->cost.pull = HUGE_VAL;
    hci_limits_take_gains(&w->cost, s);
    status = give(w, a, note);
    return status ? status : hci_linear_describe(w->of->task, a, s, note);
}

/* ---- more components ---- */

/* Whether the ripple is so small that the orders that were cut off may be what is left of it. */
static bool is_worth_more(const hci_wishes *w, const hci_answer *a)
{
    const double share = w->program.minimise == HCI_MINIMISE_PEAK_TO_PEAK ? SMALL_SWING : SMALL;
    return has_steps(w) && hci_limited_set_is_cut(a, w) && hci_bounds_are_alike(w->of->bounds) &&
           w->program.has_mean && !(w->of->solution->minimised_Nm > share * w->program.scale_Nm);
}

/* The work of an answer is bounded, and these may not be the best currents. */
static void tell_end(const hci_wishes *w)
{
    const hci_solve_options *o = w->of->options;
    hci_note_add(&w->of->solution->remark,
                 "within limits the steps, in which the torque is made linear, ended before they came to "
                 "rest: these are "
                 "the best currents of %zu, others may be better, and what a limit costs is not known; fewer "
                 "components (%s) come to rest sooner",
                 w->steps, o->choose_at_most > 0 ? "a smaller K of --auto" : "--harmonics");
}

/* w->x: the best currents of all components. Where fewer did not come to rest by themselves, more hardly do.
 */
static hci_status find_beside(hci_wishes *w, const hci_wishes *cut, const hci_answer *a, hci_note *note)
{
    w->is_bounded = cut->is_bounded;
    return find(w, a, note);
}

/* On all components up to the top order of the currents without limits; `cut` where that finds nothing
 * better.
 */
static hci_status take_better(hci_wishes *cut, const hci_solution *without, hci_answer *a, hci_note *note)
{
    const hci_solution first = *cut->of->solution;
    hci_limit_merit merit, before;
    hci_wishes w = {.of = cut->of, .steps = cut->steps};
    hci_status status = merit_of(cut, &before, note);
    if (!status) status = hci_limited_set_choose(a, true, &w, note);
    if (!status && w.set.count > MOST_MORE) {
        hci_wishes_release(&w);
        return take(cut, without, a, note);
    }
    if (!status) status = hci_wishes_begin(&w, note);
    if (!status) status = find_beside(&w, cut, a, note);
    if (!status) status = merit_of(&w, &merit, note);
    if (!status && w.is_ended && !cut->is_ended) tell_end(&w);
    if (!status && hci_limit_merit_less(&merit, &before, w.program.scale_Nm))
        status = take(&w, without, a, note);
    else if (!hci_wish_is_end(status)) {
        *cut->of->solution = first;
        status = take(cut, without, a, note);
    }
    hci_wishes_release(&w);
    return status;
}

static hci_status solve(hci_wishes *w, hci_answer *a, hci_note *note)
{
    const hci_solution without = *w->of->solution;
    const hci_status status = find(w, a, note);
    if (status) return status;
    if (w->is_ended) tell_end(w);
    return is_worth_more(w, a) ? take_better(w, &without, a, note) : take(w, &without, a, note);
}

/* Where working precision does not do, the currents without limits stay and that is said. */
static hci_status give_up(hci_solution *s, const hci_note *why)
{
    s->limit_cost = HCI_COST_NONE;
    s->minimised_Nm = NAN;
    s->exceeded_share = 0.0;
    hci_note_add(&s->remark, "limits: %s; these are the currents without limits", why->text);
    return HCI_OK;
}

hci_status hci_limited_answer(const hci_limited *limited, hci_answer *answer, hci_note *note)
{
    hci_wishes w = {.of = limited};
    hci_note why = {{0}};
    hci_status status = hci_limited_set_choose(answer, false, &w, note);
    if (!status) status = hci_wishes_begin(&w, note);
    if (!status) {
        status = solve(&w, answer, &why);
        if (status == HCI_ERROR_NUMERIC)
            status = give_up(limited->solution, &why);
        else if (status)
            hci_note_set(note, status, "%s", why.text);
    }
    hci_wishes_release(&w);
    return status;
}
