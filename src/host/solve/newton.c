/* The harmonic balance of an interior-magnet machine. T = e·i + ½iᵀL'i + T_cog is quadratic in the currents;
 * linearised at i_k,
 *
 *     (e + L'i_k)·i = T* − T_cog + ½i_kᵀL'i_k,
 *
 * which is the linear problem with e + L'i_k in place of the back-EMF and the reluctance torque of i_k added
 * to the wanted one. A torque T_x of a higher degree, as saturation makes it, is linearised alike: ∂T_x/∂i
 * joins the gain and ∂T_x/∂i·i_k − T_x what is added. Least-norm solutions converge to the currents of least
 * copper loss that make the torque. */
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/machine/sampled_torque.h"
#include "host/machine/torque_gradient.h"
#include "host/solve/harmonic_system.h"

enum { MOST_STEPS = 60 };

#define CONVERGED       1e-9  /* change of the current as a share of it */
#define NEARLY          1e-4  /* the same for a choice of few components, which jumps a little to the end */
#define NEGLIGIBLE_GAIN 1e-10 /* share of the largest wave of e + L'i */

/* Currents where the problem is linearised. */
typedef struct {
    hci_wave *wave;
    size_t count;
} point;

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory in Newton's method");
}

/* The current of an answer with what is held. */
static hci_status point_of(const hci_task *t, const hci_answer *a, point *p, hci_note *note)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    const size_t n = a->set.count;
    hci_wave *wave = hci_memory_new(n + 1, sizeof *wave);
    if (!wave) return no_memory(note);
    hci_memory_free(p->wave);
    p->wave = wave;
    p->count = 0;
    if (t->held) wave[p->count++] = *t->held;
    for (size_t k = 0; k < n; ++k) {
        const double *x = a->x + 2 * k, *rest = x + 2 * n;
        wave[p->count++] = (hci_wave){a->set.component[k].order, a->set.component[k].sequence,
                                      mean_Nm * x[0] + rest[0], mean_Nm * x[1] + rest[1]};
    }
    p->count = hci_waves_join(wave, p->count, 1e-12);
    return HCI_OK;
}

/* Reluctance torque ½ i·(L'i) of the point, at every order that it has. */
static hci_status reluctance(const hci_machine *m, const point *p, hci_harmonic **torque, size_t *count,
                             hci_note *note)
{
    const size_t capacity = hci_slope_waves_capacity(m, p->count);
    hci_wave *slope = hci_memory_new(capacity, sizeof *slope);
    double *order = NULL;
    size_t n = 0, slopes;
    *torque = NULL;
    if (!slope) return no_memory(note);
    slopes = hci_slope_waves(m, p->wave, p->count, slope);
    order = hci_memory_new(2 * slopes * p->count + 1, sizeof *order);
    for (size_t k = 0; order && k < p->count; ++k)
        n += hci_component_orders(slope, slopes, (hci_component){p->wave[k].order, p->wave[k].sequence},
                                  order + n);
    if (order) n = hci_orders_sort(order, n);
    *torque = order ? hci_memory_new(n, sizeof **torque) : NULL;
    for (size_t k = 0; *torque && k < n; ++k)
        (*torque)[k] = (hci_harmonic){order[k], 0.0, 0.0};
    if (*torque) hci_system_add_torque(slope, slopes, p->wave, p->count, order, n, *torque);
    for (size_t k = 0; *torque && k < n; ++k) {
        (*torque)[k].sine *= 0.5;
        (*torque)[k].cosine *= 0.5;
    }
    hci_memory_free(slope);
    hci_memory_free(order);
    *count = n;
    return *torque ? HCI_OK : no_memory(note);
}

/* Orders below this share of the largest are rounding, and would only blow up the system. */
static size_t drop_small(hci_harmonic *torque, size_t count)
{
    double largest = 0.0;
    size_t kept = 0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, hypot(torque[k].sine, torque[k].cosine));
    for (size_t k = 0; k < count; ++k)
        if (hypot(torque[k].sine, torque[k].cosine) > 1e-13 * largest) torque[kept++] = torque[k];
    return kept;
}

/* Appends torque and gain of what is beyond the second degree. */
static hci_status append_beyond(hci_task *t, const hci_sampled_linear *x, hci_linearisation *room,
                                hci_note *note)
{
    hci_wave *gain = hci_memory_resize(room->gain, t->gain_count + x->gain_count, sizeof *gain);
    if (gain) room->gain = gain;
    hci_harmonic *offset = hci_memory_resize(room->offset, t->offset_count + x->offset_count, sizeof *offset);
    if (offset) room->offset = offset;
    if (!gain || !offset) return no_memory(note);
    memcpy(gain + t->gain_count, x->gain, x->gain_count * sizeof *gain);
    memcpy(offset + t->offset_count, x->offset, x->offset_count * sizeof *offset);
    t->gain_count = hci_waves_join(gain, t->gain_count + x->gain_count, NEGLIGIBLE_GAIN);
    t->offset_count += x->offset_count;
    return HCI_OK;
}

static hci_status linearise_beyond(hci_task *t, const point *p, hci_linearisation *room, hci_note *note)
{
    hci_sampled_linear x;
    hci_status status = hci_sampled_torque_linearise(t->beyond, t->period_turns, p->wave, p->count, &x, note);
    if (status) return status;
    status = append_beyond(t, &x, room, note);
    hci_sampled_linear_release(&x);
    return status;
}

/* Makes the task linear at the point. */
static hci_status linearise(hci_task *t, const point *p, hci_linearisation *room, hci_note *note)
{
    hci_status status;
    hci_newton_release(room);
    status = hci_torque_gradient(t->machine, p->wave, p->count, 1.0, NEGLIGIBLE_GAIN, &room->gain,
                                 &t->gain_count, note);
    if (!status) status = reluctance(t->machine, p, &room->offset, &t->offset_count, note);
    if (!status && t->beyond) status = linearise_beyond(t, p, room, note);
    if (status) return status;
    t->offset_count = drop_small(room->offset, t->offset_count);
    t->gain = room->gain;
    t->offset = room->offset;
    return HCI_OK;
}

void hci_newton_release(hci_linearisation *room)
{
    hci_memory_free(room->gain);
    hci_memory_free(room->offset);
    room->gain = NULL;
    room->offset = NULL;
}

/* Where to begin: the shortest currents angle by angle, or no current where there are none. */
static hci_status begin(hci_task *t, point *p, hci_note *note)
{
    hci_solution ignored;
    hci_answer a = {{0}, NULL};
    hci_task start = *t;
    hci_status status;
    memset(&ignored, 0, sizeof ignored);
    start.strategy = HCI_STRATEGY_MTPA;
    start.held = NULL;
    status = hci_pointwise_answer(&start, &a, &ignored, note);
    if (!status) status = point_of(&start, &a, p, note);
    hci_answer_release(&a);
    return status;
}

/* Keeps of the starting currents what the set can carry, lest the first step be linearised where no step can
 * get to. set: NULL for a set yet to be chosen. */
static void keep_in_set(point *p, const hci_component_set *set, const hci_wave *held)
{
    size_t kept = 0;
    for (size_t k = 0; k < p->count; ++k) {
        const hci_wave *w = &p->wave[k];
        const bool is_fundamental = fabs(w->order - 1.0) < HCI_ORDER_TOLERANCE && w->sequence == 1;
        bool carried = is_fundamental || !set;
        for (size_t j = 0; set && j < set->count; ++j)
            carried = carried || (set->component[j].sequence == w->sequence &&
                                  fabs(set->component[j].order - w->order) < HCI_ORDER_TOLERANCE);
        if (carried && !(is_fundamental && held)) p->wave[kept++] = *w;
    }
    p->count = kept;
    if (held) p->wave[p->count++] = *held;
}

/* Anderson's acceleration of x ← g(x): with the last few changes of x and of f = g − x, the combination of
 * them that would have made f least. Without it the iteration swings, and where the reluctance torque is
 * large it diverges. */
typedef struct {
    double *x, *f;        /* of the last step, n each */
    double *dx, *df;      /* n × MEMORY, a ring */
    double *a, *b, *work; /* least squares */
    size_t n, steps;
} mixer;

enum { MEMORY = 5 };

static void mixer_release(mixer *m)
{
    hci_memory_free(m->x);
    memset(m, 0, sizeof *m);
}

/* Room for n coordinates, in one block; forgets what went before. */
static hci_status mixer_reset(mixer *m, size_t n, hci_note *note)
{
    mixer_release(m);
    m->x = hci_memory_new((3 + 3 * MEMORY) * n + hci_orthogonal_workspace(n, MEMORY) + MEMORY, sizeof *m->x);
    if (!m->x) return no_memory(note);
    m->f = m->x + n;
    m->dx = m->f + n;
    m->df = m->dx + MEMORY * n;
    m->a = m->df + MEMORY * n;
    m->b = m->a + MEMORY * n;
    m->work = m->b + n;
    m->n = n;
    return HCI_OK;
}

/* x: in the point, out the next one; g: the answer of the step from x. */
static void mix(mixer *m, double *x, const double *g)
{
    const size_t n = m->n, slot = m->steps % MEMORY, known = m->steps < MEMORY ? m->steps : MEMORY;
    size_t column[MEMORY], rank;
    double weight[MEMORY] = {0.0}, room[MEMORY];
    for (size_t k = 0; k < n; ++k) {
        const double f = g[k] - x[k];
        if (m->steps > 0) {
            m->dx[((slot + MEMORY - 1) % MEMORY) * n + k] = x[k] - m->x[k];
            m->df[((slot + MEMORY - 1) % MEMORY) * n + k] = f - m->f[k];
        }
        m->x[k] = x[k];
        m->f[k] = m->b[k] = f;
    }
    memcpy(m->a, m->df, known * n * sizeof *m->a);
    if (known > 0 && hci_orthogonal_factor(n, known, m->a, 1e-10, column, m->work, &rank, NULL) == HCI_OK)
        hci_orthogonal_solve(n, known, m->a, column, m->work, rank, m->b, weight, room);
    for (size_t k = 0; k < n; ++k) {
        x[k] = m->x[k] + m->f[k];
        for (size_t j = 0; j < known; ++j)
            x[k] -= weight[j] * (m->dx[j * n + k] + m->df[j * n + k]);
    }
    ++m->steps;
}

/* ---- the iteration ---- */

typedef struct {
    point p;
    double *x; /* coordinates of p on the set of the answer; NULL before the first step */
    mixer mixer;
} iteration;

/* Total coordinates of an answer. */
static double *coordinates(const hci_task *t, const hci_answer *a)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    const size_t n = 2 * a->set.count;
    double *x = hci_memory_new(n, sizeof *x);
    for (size_t k = 0; x && k < n; ++k)
        x[k] = mean_Nm * a->x[k] + a->x[n + k];
    return x;
}

/* Waves at coordinates x on the set, with what is held. */
static hci_status set_point(const hci_task *t, const hci_component_set *set, const double *x, point *p,
                            hci_note *note)
{
    hci_wave *wave = hci_memory_new(set->count + 1, sizeof *wave);
    if (!wave) return no_memory(note);
    hci_memory_free(p->wave);
    p->wave = wave;
    p->count = 0;
    if (t->held) wave[p->count++] = *t->held;
    for (size_t k = 0; k < set->count; ++k)
        wave[p->count++] =
            (hci_wave){set->component[k].order, set->component[k].sequence, x[2 * k], x[2 * k + 1]};
    return HCI_OK;
}

static double relative_change(const double *x, const double *g, size_t n)
{
    double change = 0.0, size = 0.0;
    for (size_t k = 0; k < n; ++k) {
        change += (g[k] - x[k]) * (g[k] - x[k]);
        size += g[k] * g[k];
    }
    return size > 0.0 ? sqrt(change / size) : 0.0;
}

/* For a given set, which may be far from reaching the target so that a whole step can lead away from the
 * best: the mixture if that lowers the squared error of the true torque, else as far towards g as does. */
static hci_status descend(const hci_task *t, const hci_component_set *set, const double *g, iteration *i,
                          hci_note *note)
{
    const size_t n = 2 * set->count;
    double *from = hci_memory_new(n, sizeof *from);
    hci_torque_error before, now = {0.0, 0.0};
    hci_status status =
        from ? hci_torque_error_evaluate(t, i->p.wave, i->p.count, &before, note) : no_memory(note);
    if (!status) memcpy(from, i->x, n * sizeof *from);
    if (!status) mix(&i->mixer, i->x, g);
    for (double share = 2.0; share > 1e-3 && !status; share *= 0.5) { /* 2 stands for the mixture */
        for (size_t k = 0; share < 2.0 && k < n; ++k)
            i->x[k] = from[k] + share * (g[k] - from[k]);
        status = set_point(t, set, i->x, &i->p, note);
        if (!status) status = hci_torque_error_evaluate(t, i->p.wave, i->p.count, &now, note);
        if (now.square_sum <= before.square_sum) break;
    }
    hci_memory_free(from);
    return status;
}

/* How the point follows the answers. */
typedef enum {
    MIX,     /* a free choice: the linear problem is solved exactly every time */
    MIDDLE,  /* few components: the choice jumps between prices of copper, which no acceleration can follow */
    DESCEND, /* a given set */
} manner;

/* Where to go on from: the answer itself at first and where the set has changed, else as the manner says. */
static hci_status move_on(const hci_task *t, const hci_answer *next, manner how, double *g, size_t count,
                          iteration *i, hci_solution *s, hci_note *note)
{
    const size_t n = 2 * next->set.count;
    hci_status status = HCI_OK;
    s->newton_change = 1.0;
    if (i->x && count == next->set.count) {
        s->newton_change = relative_change(i->x, g, n);
        if (how == MIX) mix(&i->mixer, i->x, g);
        for (size_t k = 0; how == MIDDLE && k < n; ++k)
            i->x[k] = 0.5 * (i->x[k] + g[k]);
        if (how == DESCEND) status = descend(t, &next->set, g, i, note);
        hci_memory_free(g);
    } else {
        hci_memory_free(i->x);
        i->x = g;
        status = mixer_reset(&i->mixer, n, note);
    }
    return status ? status : set_point(t, &next->set, i->x, &i->p, note);
}

static double top_order(const hci_component_set *set)
{
    double top = 0.0;
    for (size_t k = 0; k < set->count; ++k)
        top = fmax(top, set->component[k].order);
    return top;
}

/* One step: linearise, solve, see how far the current moved. From the second step on the set of the first is
 * kept. */
static hci_status step(hci_task *t, const hci_solve_options *o, hci_linearisation *room, hci_answer *a,
                       iteration *i, hci_solution *s, hci_note *note)
{
    hci_answer next = {{0}, NULL};
    double *g = NULL;
    hci_status status = linearise(t, &i->p, room, note);
    if (a->x && !o->set && o->choose_at_most == 0 && t->offset_count > 0)
        t->compared_up_to = top_order(&a->set); /* as hci_choose_all did */
    if (!status) status = hci_linear_answer(t, o, a->x ? &a->set : NULL, &next, s, note);
    if (!status && !(g = coordinates(t, &next))) status = no_memory(note);
    if (!status)
        status = move_on(t, &next,
                         o->choose_at_most > 0 ? MIDDLE
                         : o->set              ? DESCEND
                                               : MIX,
                         g, a->set.count, i, s, note);
    if (status) {
        hci_answer_release(&next);
        return status;
    }
    hci_answer_release(a);
    *a = next;
    ++s->newton_steps;
    return HCI_OK;
}

/* Copies an answer into room that is as large. */
static hci_status keep_answer(const hci_answer *from, hci_answer *to, hci_note *note)
{
    const size_t n = from->set.count;
    hci_answer_release(to);
    to->set.component = hci_memory_new(n, sizeof *to->set.component);
    to->set.set = hci_memory_new(n, sizeof *to->set.set);
    to->x = hci_memory_new(4 * n, sizeof *to->x);
    if (!to->set.component || !to->set.set || !to->x) return no_memory(note);
    memcpy(to->set.component, from->set.component, n * sizeof *to->set.component);
    memcpy(to->set.set, from->set.set, n * sizeof *to->set.set);
    memcpy(to->x, from->x, 4 * n * sizeof *to->x);
    to->set.count = n;
    return HCI_OK;
}

/* True worst error of an answer. */
static hci_status worth_of(const hci_task *t, const hci_answer *a, double *worst_Nm, hci_note *note)
{
    point p = {NULL, 0};
    hci_torque_error error = {0.0, 0.0};
    hci_status status = point_of(t, a, &p, note);
    if (!status) status = hci_torque_error_evaluate(t, p.wave, p.count, &error, note);
    *worst_Nm = error.worst_Nm;
    hci_memory_free(p.wave);
    return status;
}

static size_t patience(const hci_solve_options *o)
{
    return o->choose_at_most > 0 ? 8 : 25;
}

/* Whether to go on: until the current rests; or, where no step has come nearer to the wanted torque for a
 * while, in vain. A choice of few components is never exact and need not rest. */
static bool goes_on(const hci_solve_options *o, const hci_solution *s, size_t since_better)
{
    return s->newton_change > CONVERGED && s->newton_steps < MOST_STEPS && since_better < patience(o);
}

/* How near the end is, by whatever may bring it. */
static double share_of(const hci_solve_options *o, const hci_solution *s, size_t since_better, double before)
{
    const double steps = (double)s->newton_steps / MOST_STEPS,
                 rest = log(fmax(s->newton_change, CONVERGED)) / log(CONVERGED),
                 wait = (double)since_better / (double)patience(o);
    return fmax(before, fmax(fmax(steps, rest), wait));
}

/* Steps until the current rests. Where it does not, the answer whose true torque came nearest is kept. */
static hci_status iterate(hci_task *t, const hci_solve_options *o, hci_linearisation *room, hci_answer *a,
                          iteration *i, hci_solution *s, hci_note *note)
{
    hci_answer best = {{0}, NULL};
    hci_progress *const tell = t->progress;
    double least_Nm = HUGE_VAL, share = 0.0;
    size_t since_better = 0;
    hci_status status;
    do {
        double worst_Nm = HUGE_VAL;
        status = step(t, o, room, a, i, s, note);
        if (!status) status = worth_of(t, a, &worst_Nm, note);
        ++since_better;
        if (!status && worst_Nm < (1.0 - 1e-6) * least_Nm) {
            status = keep_answer(a, &best, note);
            least_Nm = worst_Nm;
            since_better = 0;
        }
        share = share_of(o, s, since_better, share);
        if (tell) tell(t->progress_context, "Newton's method", share);
        t->progress = NULL; /* from the second step on the choice is made, and takes no time of its own */
    } while (!status && goes_on(o, s, since_better));
    t->progress = tell;
    s->newton_converged = s->newton_change <= (o->choose_at_most > 0 ? NEARLY : CONVERGED);
    if (!status && !best.x)
        status =
            hci_note_set(note, HCI_ERROR_NUMERIC, "Newton's method leads nowhere; try --method pointwise");
    if (status || (s->newton_change <= CONVERGED && o->choose_at_most == 0)) {
        hci_answer_release(&best);
        return status;
    }
    hci_answer_release(a);
    *a = best;
    return HCI_OK;
}

hci_status hci_newton_answer(hci_task *task, const hci_solve_options *options, hci_linearisation *room,
                             hci_answer *answer, hci_solution *solution, hci_note *note)
{
    iteration i;
    hci_status status;
    memset(&i, 0, sizeof i);
    status = begin(task, &i.p, note);
    if (!status) keep_in_set(&i.p, options->set, options->held);
    if (!status) status = iterate(task, options, room, answer, &i, solution, note);
    task->compared_up_to = 0.0;
    hci_memory_free(i.p.wave);
    hci_memory_free(i.x);
    mixer_release(&i.mixer);
    return status;
}
