/* Which components to use when their number is limited. In: a task, how many at most, and how much copper is
 * allowed; out: the set and its currents.
 *
 * For a price ρ of copper the cost of a subset is quadratic, and subset.c finds a good one among all
 * candidates. Each subset found, at several prices, is solved for the smallest worst order (minimax.c) at
 * several prices, and exactly; the best of all wins. `--auto K`, theory.md section 5. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/candidates.h"
#include "host/solve/choose.h"
#include "host/solve/minimax.h"
#include "host/solve/subset.h"

/* Prices of copper (ρ as a share of the largest diagonal of UᵀU) at which subsets are searched, and at which
 * each is solved. */
static const double SEARCH_PRICE[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5};
static const double SOLVE_PRICE[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-6};
enum {
    SEARCHES = sizeof SEARCH_PRICE / sizeof SEARCH_PRICE[0],
    SOLVES = sizeof SOLVE_PRICE / sizeof SOLVE_PRICE[0],
    DOUBLINGS = 5, /* of the top order of the candidates */
    CHOICE = 3     /* candidates for each component that are a choice */
};

#define PASS 0.4 /* of the work that is left that a pass is thought to be, unless it is the last */

typedef struct {
    hci_task task;
    const hci_component_set *all; /* candidates */
    size_t most;
    const hci_set_preference *preference;
    hci_choice best;
} selection;

/* One subset of the candidates, and its system with the mean made heavy. */
typedef struct {
    const hci_component_set *all;
    const size_t *member;
    size_t count;
    hci_harmonic_system system;
} subset;

static void tell(const hci_task *t, double share)
{
    if (t->progress) t->progress(t->progress_context, "choosing harmonics", share);
}

static double mean_Nm(const selection *s)
{
    return hci_target_mean_Nm(s->task.target);
}

/* Makes s->best the better of the two and releases the other. */
static void keep_better(selection *s, hci_choice *c)
{
    if (!s->best.answer.x || hci_set_cost_less(s->preference, c->cost, s->best.cost)) {
        hci_choice_release(&s->best);
        s->best = *c;
    } else {
        hci_choice_release(c);
    }
    memset(c, 0, sizeof *c);
}

/* The members as a set, with room for their currents. */
static hci_status take_members(const subset *of, hci_answer *a, hci_note *note)
{
    if (hci_answer_reserve(of->count, a)) {
        hci_answer_release(a);
        return hci_note_memory(note, NULL, "choosing harmonics");
    }
    for (size_t k = 0; k < of->count; ++k) {
        a->set.component[k] = of->all->component[of->member[k]];
        a->set.set[k] = of->all->set[of->member[k]];
    }
    return HCI_OK;
}

/* The smallest worst order at one price of copper. A system that is not positive definite at this price is no
 * attempt and no error. */
static hci_status try_minimax(selection *s, const subset *of, double ridge, hci_note *note)
{
    hci_choice c = {{{0}, NULL}, {0.0, 0.0}};
    const hci_minimax problem = {&of->system, &c.answer.set, mean_Nm(s), ridge, s->preference};
    double *workspace = hci_memory_new(hci_minimax_workspace(&of->system), sizeof *workspace);
    const hci_status status =
        workspace ? take_members(of, &c.answer, note) : hci_note_memory(note, NULL, "choosing harmonics");
    if (!status) {
        if (!hci_minimax_solve(&problem, workspace, c.answer.x, &c.cost))
            keep_better(s, &c);
        else
            hci_choice_release(&c);
    }
    hci_memory_free(workspace);
    return status;
}

/* The least norm of all least-squares solutions. */
static hci_status try_exact(selection *s, const subset *of, hci_note *note)
{
    hci_choice c = {{{0}, NULL}, {0.0, 0.0}};
    hci_status status = take_members(of, &c.answer, note);
    if (!status) status = hci_choice_solve(&of->system, mean_Nm(s), &c, note);
    if (status)
        hci_choice_release(&c);
    else
        keep_better(s, &c);
    return status;
}

static hci_status make_system(const selection *s, subset *of, hci_note *note)
{
    hci_component *component = hci_memory_new(of->count, sizeof *component);
    hci_status status;
    if (!component) return hci_note_memory(note, NULL, "choosing harmonics");
    for (size_t k = 0; k < of->count; ++k)
        component[k] = of->all->component[of->member[k]];
    status = hci_harmonic_system_make(&s->task, component, of->count, HCI_COMPARE_ALL, &of->system, note);
    hci_memory_free(component);
    if (!status) hci_minimax_weight_mean(&of->system);
    return status;
}

/* Solves one subset exactly and at every price. */
static hci_status try_subset(selection *s, const hci_subset_search *found, hci_note *note)
{
    subset of = {.all = s->all, .member = found->member, .count = found->count};
    hci_status status = make_system(s, &of, note);
    if (status) return status;
    status = try_exact(s, &of, note);
    for (size_t k = 0; k < SOLVES && !status; ++k)
        status = try_minimax(s, &of, SOLVE_PRICE[k] * found->scale, note);
    hci_harmonic_system_release(&of.system);
    return status;
}

/* Searches subsets at every price of copper. */
static hci_status search_subsets(selection *s, hci_subset_search *search, hci_note *note)
{
    const size_t most = s->most < s->all->count ? s->most : s->all->count;
    const size_t searches = most < s->all->count ? (size_t)SEARCHES : 1; /* else there is one subset only */
    hci_status status = HCI_OK;
    for (size_t k = 0; k < searches && !status; ++k) {
        tell(&s->task, (double)k / SEARCHES);
        search->ridge = SEARCH_PRICE[k] * search->scale;
        if (hci_subset_eliminate(search, most) || hci_subset_exchange(search)) continue;
        status = try_subset(s, search, note);
    }
    if (!status && !s->best.answer.x)
        status = hci_note_set(
            note, HCI_ERROR_NUMERIC,
            "no subset of %zu components could be solved; try another number for --auto, or name a "
            "set: --harmonics FILE",
            most);
    return status;
}

/* Chooses among s->all; s->best is kept where it is better. */
static hci_status choose_among(selection *s, hci_note *note)
{
    hci_harmonic_system system;
    hci_subset_search search = {0};
    hci_status status =
        hci_harmonic_system_make(&s->task, s->all->component, s->all->count, HCI_COMPARE_ALL, &system, note);
    if (status) return status;
    status = hci_subset_search_make(&system, mean_Nm(s), &search, note);
    if (!status) status = search_subsets(s, &search, note);
    hci_subset_search_release(&search);
    hci_harmonic_system_release(&system);
    return status;
}

/* ---- where the candidates are not given ---- */

/* One of several passes: its shares of progress are those of a part of the work. */
typedef struct {
    const hci_task *whole;
    double from, until;
} pass;

static void tell_pass(void *context, const char *what, double share)
{
    const pass *p = context;
    p->whole->progress(p->whole->progress_context, what, p->from + share * (p->until - p->from));
}

/* Chooses among all candidates up to `top`. count: out, how many there are. */
static hci_status choose_up_to(selection *s, pass *part, double top, size_t *count, hci_note *note)
{
    hci_component_set all;
    hci_status status = hci_candidates(part->whole, top, &all, note);
    *count = all.count;
    part->from = part->until;
    part->until = all.count < CHOICE * s->most ? part->from + PASS * (1.0 - part->from) : 1.0;
    s->all = &all;
    if (!status) status = choose_among(s, note);
    s->all = NULL;
    hci_component_set_release(&all);
    return status;
}

/* Up to somewhat above the orders that matter, and higher until there was a choice among several times
 * `most`. */
static hci_status choose_freely(selection *s, const hci_task *whole, hci_note *note)
{
    double torque_order, emf_order, top;
    size_t count = 0;
    pass part = {whole, 0.0, 0.0};
    hci_status status;
    if (whole->progress) s->task.progress = tell_pass;
    s->task.progress_context = &part;
    hci_candidates_span(whole, &torque_order, &emf_order);
    top = ceil(torque_order + 2.0 * emf_order);
    status = choose_up_to(s, &part, top, &count, note);
    for (int doubling = 0;
         !status && count < CHOICE * s->most && doubling < DOUBLINGS && 2.0 * top < HCI_MOST_ORDER;
         ++doubling)
        status = choose_up_to(s, &part, top *= 2.0, &count, note);
    return status;
}

hci_status hci_choose_few(const hci_task *task, const hci_component_set *only, size_t most,
                          const hci_set_preference *preference, hci_answer *answer, hci_note *note)
{
    selection s = {.task = *task, .all = only, .most = most, .preference = preference};
    const hci_status status = only ? choose_among(&s, note) : choose_freely(&s, task, note);
    if (status)
        hci_choice_release(&s.best);
    else
        *answer = s.best.answer;
    return status;
}
