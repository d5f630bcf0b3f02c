/* How high the orders of the currents have to go when their number is free. In: a task and the pointwise
 * limit of copper; out: all useful components up to one order, with their currents. The least-norm solution
 * over all candidates up to an order N is exact once N is high enough, and its copper falls towards the limit
 * as N grows (theory.md, sections 5 and 6), so N is doubled until both are good enough and then bisected. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/candidates.h"
#include "host/solve/choose.h"

#define LOSS_MARGIN 1.01  /* copper over the pointwise limit at which no further orders are looked for */
#define EXACT       0.1   /* share of the tolerance: the rest is for what the solution does elsewhere */
#define UNUSED      1e-13 /* share of the largest coordinate, below which a component carries nothing */
#define DOUBLINGS   5

/* A current that needs more components than this of a torque that is sampled has a kink, and no order would
 * be enough. */
#define MOST_SAMPLED 512.0

/* Components that are not doubled any more: what a set of twice as many costs grows with their number to the
 * third where orders have nothing but a mechanical turn in common. */
#define MOST_DOUBLED 600

typedef struct {
    const hci_task *task;
    double tolerance_Nm;
    double limit_A2; /* mean square of the pointwise limit, or NAN */
    hci_choice best;
} search;

static void tell(const hci_task *t, double share)
{
    if (t->progress) t->progress(t->progress_context, "choosing harmonics", share);
}

/* The least-norm solution of the choice's set. */
static hci_status solve_set(const hci_task *t, hci_choice *c, hci_note *note)
{
    const hci_component_set *set = &c->answer.set;
    hci_harmonic_system system;
    hci_status status =
        hci_harmonic_system_make(t, set->component, set->count, HCI_COMPARE_ALL, &system, note);
    if (status) return status;
    c->answer.x = hci_memory_new(2 * system.unknowns, sizeof *c->answer.x);
    status = c->answer.x ? hci_choice_solve(&system, hci_target_mean_Nm(t->target), c, note)
                         : hci_note_memory(note, NULL, "choosing harmonics");
    hci_harmonic_system_release(&system);
    return status;
}

/* The worst error with all orders compared, for a solution that was found with fewer. */
static hci_status check_all_orders(const hci_task *t, hci_choice *c, hci_note *note)
{
    const hci_component_set *set = &c->answer.set;
    hci_harmonic_system system;
    double *r;
    const hci_status status =
        hci_harmonic_system_make(t, set->component, set->count, HCI_COMPARE_ALL, &system, note);
    if (status) return status;
    r = hci_memory_new(system.rows, sizeof *r);
    if (r) c->cost.worst_Nm = hci_worst_residual_Nm(&system, c->answer.x, hci_target_mean_Nm(t->target), r);
    hci_memory_free(r);
    hci_harmonic_system_release(&system);
    return r ? HCI_OK : hci_note_memory(note, NULL, "choosing harmonics");
}

/* Solves with all candidates up to top_order. The back-EMF of a surface-magnet machine ends at some order,
 * and every order that the components reach can be made right. e + L'i does not end: there the orders above
 * the components' own are left to fall off by themselves, or they would take all the freedom that is to save
 * copper (theory.md, section 7). */
static hci_status solve_up_to(const hci_task *t, double top_order, hci_choice *c, hci_note *note)
{
    const bool is_endless = t->offset_count > 0;
    hci_task limited = *t;
    hci_status status;
    memset(c, 0, sizeof *c);
    if (is_endless) limited.compared_up_to = top_order;
    status = hci_candidates(&limited, top_order, &c->answer.set, note);
    if (!status) status = solve_set(&limited, c, note);
    if (!status && is_endless) status = check_all_orders(t, c, note);
    if (status) hci_choice_release(c);
    return status;
}

static bool is_good_enough(const search *s, const hci_choice *c)
{
    return c->cost.worst_Nm <= EXACT * s->tolerance_Nm &&
           (isnan(s->limit_A2) || c->cost.mean_square_A2 <= LOSS_MARGIN * s->limit_A2);
}

/* Whether no component above an order may be chosen. */
static bool is_all(const hci_task *t, double top_order)
{
    return t->highest_rotor_order > 0.0 && top_order > t->highest_rotor_order + 1.0;
}

/* Whether orders twice as high would be no answer any more: their current has a kink, or they cost too much.
 */
static bool is_most(const search *s, double top_order)
{
    const double waves = 2.0 * 2.0 * top_order * (double)s->task->period_turns;
    return s->best.answer.set.count > MOST_DOUBLED || (s->task->higher && waves > MOST_SAMPLED);
}

/* Doubles *top until it is good enough; *below: the highest that was not. *found: whether there is such. */
static hci_status find_upper(search *s, double *below, double *top, bool *found, hci_note *note)
{
    for (int doubling = 0;; ++doubling) {
        hci_status status;
        hci_choice_release(&s->best);
        tell(s->task, 0.5 * doubling / DOUBLINGS);
        status = solve_up_to(s->task, *top, &s->best, note);
        *found = !status && is_good_enough(s, &s->best);
        if (status || *found) return status;
        if (doubling == DOUBLINGS || is_all(s->task, *top) || is_most(s, *top)) return HCI_OK;
        *below = *top;
        *top *= 2.0;
    }
}

/* The lowest top order in (bad, good] that is still good enough. */
static hci_status bisect(search *s, double bad, double good, hci_note *note)
{
    const double step = 1.0 / (double)s->task->period_turns;
    while (good - bad > 1.5 * step) {
        const double middle = floor(0.5 * (bad + good) / step + 0.5) * step;
        hci_choice c;
        const hci_status status = solve_up_to(s->task, middle, &c, note);
        if (status) return status;
        if (is_good_enough(s, &c)) {
            hci_choice_release(&s->best);
            s->best = c;
            good = middle;
        } else {
            hci_choice_release(&c);
            bad = middle;
        }
        tell(s->task, 1.0 - 0.5 * (good - bad) / good);
    }
    return HCI_OK;
}

/* Whether component k carries current in either column of x. */
static bool is_used(const hci_answer *a, size_t k, double least)
{
    const double *s = a->x + 2 * k, *c = s + 2 * a->set.count;
    return fmax(fmax(fabs(s[0]), fabs(s[1])), fmax(fabs(c[0]), fabs(c[1]))) > least;
}

/* Components that the solution does not use are dropped. */
static void drop_unused(hci_answer *a)
{
    const size_t n = a->set.count;
    double largest = 0.0;
    size_t kept = 0;
    for (size_t k = 0; k < 4 * n; ++k)
        largest = fmax(largest, fabs(a->x[k]));
    for (size_t k = 0; k < n; ++k) {
        if (!is_used(a, k, UNUSED * largest)) continue;
        a->set.component[kept] = a->set.component[k];
        a->set.set[kept] = a->set.set[k];
        memmove(a->x + 2 * kept, a->x + 2 * k, 2 * sizeof *a->x);
        memmove(a->x + 2 * n + 2 * kept, a->x + 2 * n + 2 * k, 2 * sizeof *a->x);
        ++kept;
    }
    memmove(a->x + 2 * kept, a->x + 2 * n, 2 * kept * sizeof *a->x);
    a->set.count = kept;
}

hci_status hci_choose_all(const hci_task *task, double tolerance_Nm, double limit_mean_square_A2,
                          hci_answer *answer, hci_note *note)
{
    search s = {.task = task, .tolerance_Nm = tolerance_Nm, .limit_A2 = limit_mean_square_A2};
    double torque_order, emf_order, below = 0.0, top;
    bool found;
    hci_status status;
    hci_candidates_span(task, &torque_order, &emf_order);
    top = ceil(torque_order + emf_order);
    status = find_upper(&s, &below, &top, &found, note);
    if (!status && found) status = bisect(&s, below, top, note);
    if (status) {
        hci_choice_release(&s.best);
        return status;
    }
    drop_unused(&s.best.answer);
    *answer = s.best.answer;
    return HCI_OK;
}
