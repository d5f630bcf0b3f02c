/* Newton's method for a torque that is not linear in the currents (theory.md, section 7). In: a task; out:
 * components and currents. Each step makes the torque linear at the last current (linearise.c), solves that
 * problem (linear.c), and moves the current towards its answer. Least-norm answers converge to the currents
 * of least copper loss that make the torque. */
#include "host/solve/newton.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/anderson.h"
#include "host/solve/damped.h"
#include "host/solve/linear.h"
#include "host/solve/linearise.h"
#include "host/solve/pointwise.h"
#include "host/solve/torque_spectrum.h"

enum {
    MOST_STEPS = 60,
    MOST_SOLVED = 12000, /* components solved for in all steps: the time of one grows with their number */
    MOST_AT_FIRST = 500, /* waves of the current that it begins with */
    PATIENCE_FREE = 25,  /* steps without coming nearer to the target after which it ends */
    PATIENCE_FEW = 8     /* the same for a choice of few components, which is never exact and need not rest */
};

#define CONVERGED  1e-9  /* change of the current as a share of it */
#define NEARLY     1e-4  /* the same for a choice of few components, which jumps a little to the end */
#define NEARER     1e-6  /* share by which an error has to fall to be called nearer */
#define NEGLIGIBLE 1e-12 /* share of the largest current */
#define LEAST_STEP 1e-3  /* share of the way to an answer below which no descent is looked for */

/* How the current follows the answers. */
typedef enum {
    MIX,    /* a free choice: the linear problem is solved exactly every time; Anderson's acceleration */
    MIDDLE, /* few components: the choice jumps between prices of copper, which no acceleration can follow */
    DESCEND /* a given set, which may be far from reaching the target */
} manner;

typedef struct {
    hci_task *task;
    const hci_solve_options *options;
    hci_linear_torque *at;
    hci_solution *solution;
    manner manner;
    hci_wave_list current; /* where the torque is made linear */
    double *x;             /* its coordinates on the set of the answer; NULL before the first step */
    hci_anderson mixing;
    hci_answer answer; /* of the last step */
} newton;

/* ---- currents ---- */

/* Coordinates of an answer at the wanted mean torque, to be freed; NULL when memory is out. */
static double *coordinates(const hci_task *t, const hci_answer *a)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    const size_t n = 2 * a->set.count;
    double *x = hci_memory_new(n, sizeof *x);
    for (size_t k = 0; x && k < n; ++k)
        x[k] = hci_coordinate(a->x, n, mean_Nm, k);
    return x;
}

/* The current of an answer with what is held, each wave once. */
static hci_status current_of(const hci_task *t, const hci_answer *a, hci_wave_list *i, hci_note *note)
{
    double *x = coordinates(t, a);
    const hci_status status =
        x ? hci_set_waves(&a->set, x, t->held, i, note) : hci_note_memory(note, NULL, "Newton's method");
    if (!status) i->count = hci_waves_join(i->wave, i->count, NEGLIGIBLE);
    hci_memory_free(x);
    return status;
}

/* ---- where to begin ---- */

/* Currents with kinks have no end of orders, and each costs as much: to begin with, the largest will do. */
static void keep_largest(hci_wave_list *i)
{
    for (double share = 10.0 * NEGLIGIBLE; i->count > MOST_AT_FIRST && share < 0.1; share *= 10.0)
        i->count = hci_waves_join(i->wave, i->count, share);
}

/* The shortest currents angle by angle; none at angles where there are none. */
static hci_status begin(newton *n, hci_note *note)
{
    hci_solution ignored;
    hci_answer a = {{0}, NULL};
    hci_task start = *n->task;
    hci_status status;
    memset(&ignored, 0, sizeof ignored);
    start.strategy = HCI_STRATEGY_MTPA;
    start.held = NULL;
    status = hci_pointwise_answer(&start, &a, &ignored, note);
    if (!status) status = current_of(&start, &a, &n->current, note);
    if (!status) keep_largest(&n->current);
    hci_answer_release(&a);
    return status;
}

static bool is_same(hci_component c, const hci_wave *w)
{
    return c.sequence == w->sequence && fabs(c.order - w->order) < HCI_ORDER_TOLERANCE;
}

/* Whether a set can carry a wave; one yet to be chosen carries all. */
static bool is_carried(const hci_component_set *set, const hci_wave *w)
{
    if (!set) return true;
    for (size_t k = 0; k < set->count; ++k)
        if (is_same(set->component[k], w)) return true;
    return false;
}

/* Keeps of the starting currents what the set can carry, lest the first step be linearised where no step can
 * get to. */
static void keep_in_set(newton *n)
{
    const hci_component fundamental = {1.0, 1};
    const hci_wave *held = n->options->held;
    size_t kept = 0;
    for (size_t k = 0; k < n->current.count; ++k) {
        const hci_wave w = n->current.wave[k];
        const bool is_fundamental = is_same(fundamental, &w);
        if (is_fundamental ? !held : is_carried(n->options->set, &w)) n->current.wave[kept++] = w;
    }
    if (held) n->current.wave[kept++] = *held;
    n->current.count = kept;
}

/* ---- one step ---- */

static double relative_change(const double *x, const double *g, size_t n)
{
    double change = 0.0, size = 0.0;
    for (size_t k = 0; k < n; ++k) {
        change += (g[k] - x[k]) * (g[k] - x[k]);
        size += g[k] * g[k];
    }
    return size > 0.0 ? sqrt(change / size) : 0.0;
}

/* x as far towards g as lowers the squared error of the true torque: the accelerated step if that does, else
 * the whole way, half of it, and so on. from: x before, before_Nm2: its error. */
static hci_status search_line(newton *n, const hci_component_set *set, const double *from, const double *g,
                              double before_Nm2, hci_note *note)
{
    hci_torque_error now = {0.0, 0.0};
    hci_status status = HCI_OK;
    for (double share = 2.0; share > LEAST_STEP && !status;
         share *= 0.5) { /* 2 stands for the accelerated step */
        for (size_t k = 0; share < 2.0 && k < 2 * set->count; ++k)
            n->x[k] = from[k] + share * (g[k] - from[k]);
        status = hci_set_waves(set, n->x, n->task->held, &n->current, note);
        if (!status)
            status = hci_torque_error_evaluate(n->task, n->current.wave, n->current.count, &now, note);
        if (now.square_sum <= before_Nm2) break;
    }
    return status;
}

/* For a given set a whole step can lead away from the best. */
static hci_status descend(newton *n, const hci_component_set *set, const double *g, hci_note *note)
{
    const size_t size = 2 * set->count * sizeof *g;
    double *from = hci_memory_new(2 * set->count, sizeof *from);
    hci_torque_error before = {0.0, 0.0};
    hci_status status =
        from ? hci_torque_error_evaluate(n->task, n->current.wave, n->current.count, &before, note)
             : hci_note_memory(note, NULL, "Newton's method");
    if (!status) {
        memcpy(from, n->x, size);
        hci_anderson_step(&n->mixing, n->x, g);
        status = search_line(n, set, from, g, before.square_sum, note);
    }
    hci_memory_free(from);
    return status;
}

/* x towards the answer g of the same set. */
static hci_status follow(newton *n, const hci_component_set *set, const double *g, hci_note *note)
{
    n->solution->newton_change = relative_change(n->x, g, 2 * set->count);
    if (n->manner == DESCEND) return descend(n, set, g, note);
    if (n->manner == MIX) hci_anderson_step(&n->mixing, n->x, g);
    for (size_t k = 0; n->manner == MIDDLE && k < 2 * set->count; ++k)
        n->x[k] = 0.5 * (n->x[k] + g[k]);
    return HCI_OK;
}

/* Moves the current: to the answer itself at first and where the number of components has changed, else as
 * the manner says. */
static hci_status move_on(newton *n, const hci_answer *next, hci_note *note)
{
    const bool is_new = !n->x || n->answer.set.count != next->set.count;
    double *g = coordinates(n->task, next);
    hci_status status = HCI_OK;
    n->solution->newton_change = 1.0;
    if (!g) return hci_note_memory(note, NULL, "Newton's method");
    if (is_new) {
        hci_memory_free(n->x);
        n->x = g;
        if (hci_anderson_reset(&n->mixing, 2 * next->set.count))
            status = hci_note_memory(note, NULL, "Newton's method");
    } else {
        status = follow(n, &next->set, g, note);
        hci_memory_free(g);
    }
    return status ? status : hci_set_waves(&next->set, n->x, n->task->held, &n->current, note);
}

static double top_order(const hci_component_set *set)
{
    double top = 0.0;
    for (size_t k = 0; k < set->count; ++k)
        top = fmax(top, set->component[k].order);
    return top;
}

/* Linearise, solve, move. From the second step on the set of the first is kept. */
static hci_status step(newton *n, hci_note *note)
{
    const bool is_first = !n->answer.x;
    hci_answer next = {{0}, NULL};
    hci_status status = hci_task_linearise(n->task, n->current.wave, n->current.count, n->at, note);
    if (!is_first && n->manner == MIX && n->task->offset_count > 0)
        n->task->compared_up_to = top_order(&n->answer.set); /* as hci_choose_all did */
    if (!status)
        status = hci_linear_answer(n->task, n->options, is_first ? NULL : &n->answer.set, &next, n->solution,
                                   note);
    if (!status) status = move_on(n, &next, note);
    if (status) {
        hci_answer_release(&next);
        return status;
    }
    hci_answer_release(&n->answer);
    n->answer = next;
    ++n->solution->newton_steps;
    return HCI_OK;
}

/* ---- until it rests ---- */

/* The answer whose true torque came nearest to the target. */
typedef struct {
    hci_answer answer;
    double worst_Nm;
    size_t steps_since;
} nearest;

/* Largest error of the true torque of the last answer. */
static hci_status true_error(const newton *n, double *worst_Nm, hci_note *note)
{
    hci_wave_list i = {NULL, 0};
    hci_torque_error error = {0.0, 0.0};
    hci_status status = current_of(n->task, &n->answer, &i, note);
    if (!status) status = hci_torque_error_evaluate(n->task, i.wave, i.count, &error, note);
    *worst_Nm = error.worst_Nm;
    hci_memory_free(i.wave);
    return status;
}

static hci_status keep_nearest(const newton *n, nearest *best, hci_note *note)
{
    double worst_Nm = HUGE_VAL;
    const hci_status status = true_error(n, &worst_Nm, note);
    ++best->steps_since;
    if (status || !(worst_Nm < (1.0 - NEARER) * best->worst_Nm)) return status;
    best->worst_Nm = worst_Nm;
    best->steps_since = 0;
    return hci_answer_copy(&n->answer, &best->answer) ? hci_note_memory(note, NULL, "Newton's method")
                                                      : HCI_OK;
}

static size_t patience(const newton *n)
{
    return n->manner == MIDDLE ? PATIENCE_FEW : PATIENCE_FREE;
}

static size_t most_steps(const newton *n)
{
    const size_t count = n->answer.set.count;
    return count * MOST_STEPS > MOST_SOLVED ? MOST_SOLVED / count : MOST_STEPS;
}

/* Until the current rests; or, where no step has come nearer to the wanted torque for a while, in vain. */
static bool goes_on(const newton *n, const nearest *best)
{
    return n->solution->newton_change > CONVERGED && n->solution->newton_steps < most_steps(n) &&
           best->steps_since < patience(n);
}

/* How near the end is, by whatever may bring it. */
static double share_done(const newton *n, const nearest *best)
{
    const double steps = (double)n->solution->newton_steps / (double)most_steps(n),
                 rest = log(fmax(n->solution->newton_change, CONVERGED)) / log(CONVERGED),
                 wait = (double)best->steps_since / (double)patience(n);
    return fmax(fmax(steps, rest), wait);
}

static hci_status iterate(newton *n, nearest *best, hci_note *note)
{
    hci_task *t = n->task;
    hci_progress *const progress = t->progress;
    double share = 0.0;
    hci_status status;
    do {
        status = step(n, note);
        if (!status) status = keep_nearest(n, best, note);
        share = fmax(share, share_done(n, best));
        if (progress) progress(t->progress_context, "Newton's method", share);
        t->progress = NULL; /* from the second step on the choice is made, and takes no time of its own */
    } while (!status && goes_on(n, best));
    t->progress = progress;
    return status;
}

/* The last answer where the current rests, else the nearest. */
static hci_status find(newton *n, hci_answer *answer, hci_note *note)
{
    const bool is_few = n->manner == MIDDLE;
    nearest best = {{{0}, NULL}, HUGE_VAL, 0};
    hci_status status = iterate(n, &best, note);
    const double change = n->solution->newton_change;
    n->solution->newton_converged = change <= (is_few ? NEARLY : CONVERGED);
    if (!status && !best.answer.x)
        status =
            hci_note_set(note, HCI_ERROR_NUMERIC, "Newton's method leads nowhere; try --method pointwise");
    if (status || (change <= CONVERGED && !is_few)) {
        hci_answer_release(&best.answer);
        *answer = n->answer;
        return status;
    }
    hci_answer_release(&n->answer);
    *answer = best.answer;
    return HCI_OK;
}

static manner manner_of(const hci_solve_options *o)
{
    return o->choose_at_most > 0 ? MIDDLE : o->set ? DESCEND : MIX;
}

hci_status hci_newton_answer(hci_task *task, const hci_solve_options *options, hci_linear_torque *at,
                             hci_answer *answer, hci_solution *solution, hci_note *note)
{
    newton n = {.task = task, .options = options, .at = at, .solution = solution};
    hci_status status;
    n.manner = manner_of(options);
    status = begin(&n, note);
    if (!status) {
        keep_in_set(&n);
        status = find(&n, answer, note);
    }
    task->compared_up_to = 0.0;
    hci_memory_free(n.current.wave);
    hci_memory_free(n.x);
    hci_anderson_release(&n.mixing);
    return status;
}

/* ---- where it does not rest ---- */

/* What a component has of the currents that Newton's method begins with. */
static void take_wave(const hci_wave_list *i, hci_component c, double *x)
{
    x[0] = x[1] = 0.0;
    for (size_t k = 0; k < i->count; ++k)
        if (is_same(c, &i->wave[k])) {
            x[0] = i->wave[k].sine;
            x[1] = i->wave[k].cosine;
        }
}

/* Where damped steps begin: at the nearest answer, or at the shortest currents angle by angle, which Newton's
 * method may have left far behind; from which the torque comes nearer. */
static hci_status descend_from(newton *n, const hci_answer *a, bool is_anew, hci_damped *d, hci_note *note)
{
    const size_t unknowns = 2 * a->set.count;
    hci_status status = is_anew ? begin(n, note) : HCI_OK;
    *d = (hci_damped){.task = n->task, .at = n->at, .set = &a->set, .enough_Nm = n->solution->tolerance_Nm};
    d->x = is_anew ? hci_memory_new(unknowns, sizeof *d->x) : coordinates(n->task, a);
    if (!status && !d->x) status = hci_note_memory(note, NULL, "Newton's method");
    for (size_t k = 0; is_anew && k < a->set.count && !status; ++k)
        take_wave(&n->current, a->set.component[k], d->x + 2 * k);
    return status ? status : hci_damped_descend(d, note);
}

/* Puts currents into the answer that has their components. */
static void put(const hci_damped *d, hci_answer *a)
{
    const size_t unknowns = 2 * a->set.count;
    memset(a->x, 0, unknowns * sizeof *a->x);
    memcpy(a->x + unknowns, d->x, unknowns * sizeof *a->x);
}

/* The least squared error with the components of the answer, from either beginning. */
static hci_status descend_again(newton *n, hci_answer *a, hci_note *note)
{
    hci_damped from_here, anew = {0};
    hci_status status = descend_from(n, a, false, &from_here, note);
    if (!status) status = descend_from(n, a, true, &anew, note);
    if (!status) {
        const hci_damped *const best = anew.square_Nm2 < from_here.square_Nm2 ? &anew : &from_here;
        put(best, a);
        n->solution->newton_steps += from_here.steps + anew.steps;
        n->solution->newton_change = best->change;
        n->solution->newton_converged = best->is_at_rest;
    }
    hci_memory_free(from_here.x);
    hci_memory_free(anew.x);
    return status;
}

/* Makes the task linear at an answer, and says which system that is. */
static hci_status describe(newton *n, const hci_answer *a, hci_note *note)
{
    hci_status status = current_of(n->task, a, &n->current, note);
    if (!status) status = hci_task_linearise(n->task, n->current.wave, n->current.count, n->at, note);
    return status ? status : hci_linear_describe(n->task, a, n->solution, note);
}

/* Components that cannot make the torque have one best answer, to which full steps need not lead. */
static bool is_to_descend(const newton *n, const hci_answer *a)
{
    const bool is_all = !n->options->set || n->options->compare == HCI_COMPARE_ALL;
    return n->manner != MIDDLE && is_all && a->set.count <= HCI_DAMPED_MOST;
}

hci_status hci_newton_come_nearer(hci_task *task, const hci_solve_options *options, hci_linear_torque *at,
                                  hci_answer *answer, hci_solution *solution, hci_note *note)
{
    newton n = {.task = task, .options = options, .at = at, .solution = solution};
    hci_status status = HCI_OK;
    n.manner = manner_of(options);
    if (is_to_descend(&n, answer)) {
        status = descend_again(&n, answer, note);
        if (!status) status = describe(&n, answer, note);
    }
    hci_memory_free(n.current.wave);
    return status;
}
