/* Choice of current components: how high to go when their number is free, which ones when it is not. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/choose.h"

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory while choosing harmonics");
}

/* ---- measures of a solution ---- */

/* x = mean × first column + second column. */
static double total(const double *x, size_t unknowns, double mean_Nm, size_t j)
{
    return mean_Nm * x[j] + x[unknowns + j];
}

/* (3/2) Σ I² over components that are all different. Order 0 of the zero sequence counts double. */
double hci_coordinates_mean_square_A2(const hci_component_set *set, const double *x, double mean_Nm)
{
    double sum = 0.0;
    for (size_t k = 0; k < set->count; ++k) {
        const double s = total(x, 2 * set->count, mean_Nm, 2 * k),
                     c = total(x, 2 * set->count, mean_Nm, 2 * k + 1);
        const bool constant =
            set->component[k].order < HCI_ORDER_TOLERANCE && set->component[k].sequence == 0;
        sum += constant ? 3.0 * c * c : 1.5 * (s * s + c * c);
    }
    return sum;
}

/* r = U x − h for the total of both columns; rows are weighted. */
static void residual(const hci_harmonic_system *b, const double *x, double mean_Nm, double *r)
{
    for (size_t i = 0; i < b->rows; ++i)
        r[i] = -(mean_Nm * b->h[i] + b->h[b->rows + i]);
    for (size_t j = 0; j < b->unknowns; ++j) {
        const double value = total(x, b->unknowns, mean_Nm, j);
        for (int64_t k = b->u.column_start[j]; k < b->u.column_start[j + 1]; ++k)
            r[b->u.row[k]] += b->u.value[k] * value;
    }
}

/* Amplitude of the residual at compared order k. */
double hci_residual_amplitude_Nm(const hci_harmonic_system *b, const double *r, size_t k)
{
    const size_t row = hci_orders_row(b->order, b->order_count, k);
    return b->order[k] < HCI_ORDER_TOLERANCE ? fabs(r[row]) : hypot(r[row], r[row + 1]);
}

/* Largest weighted error of any compared order; r: workspace of b->rows. */
double hci_worst_error_Nm(const hci_harmonic_system *b, const double *x, double mean_Nm, double *r)
{
    double worst = 0.0;
    residual(b, x, mean_Nm, r);
    for (size_t k = 0; k < b->order_count; ++k)
        worst = fmax(worst, hci_residual_amplitude_Nm(b, r, k));
    return worst;
}

/* A set with its solution and what it is worth. */
typedef struct {
    hci_component_set set;
    double *x; /* unknowns × 2 */
    hci_set_cost worth;
} attempt;

static void attempt_release(attempt *a)
{
    hci_component_set_release(&a->set);
    hci_memory_free(a->x);
    memset(a, 0, sizeof *a);
}

/* The least-norm solution of a balance of the set that `a` holds, and its worth. a->x: room for it. */
static hci_status attempt_balance(const hci_task *t, const hci_harmonic_system *b, attempt *a, hci_note *note)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    double *r = hci_memory_new(b->rows, sizeof *r), condition;
    size_t rank;
    const hci_status status =
        r ? hci_sparse_qr_solve(&b->u, b->h, 2, a->x, &rank, &condition, note) : no_memory(note);
    if (!status) {
        a->worth.worst_Nm = hci_worst_error_Nm(b, a->x, mean_Nm, r);
        a->worth.mean_square_A2 = hci_coordinates_mean_square_A2(&a->set, a->x, mean_Nm);
    }
    hci_memory_free(r);
    return status;
}

/* The same with all orders compared. */
static hci_status attempt_solve(const hci_task *t, attempt *a, hci_note *note)
{
    hci_harmonic_system b;
    hci_status status =
        hci_harmonic_system_make(t, a->set.component, a->set.count, HCI_COMPARE_ALL, &b, note);
    if (status) return status;
    a->x = hci_memory_new(2 * b.unknowns, sizeof *a->x);
    status = a->x ? attempt_balance(t, &b, a, note) : no_memory(note);
    hci_harmonic_system_release(&b);
    return status;
}

static void report(const hci_task *t, double share)
{
    if (t->progress) t->progress(t->progress_context, "choosing harmonics", share);
}

/* ---- without a limit to their number ---- */

#define LOSS_MARGIN 1.01 /* copper over the pointwise limit at which no further orders are worth it */
#define DOUBLINGS   5

/* A current that needs more than this of a torque that is sampled has a kink, and no order would be enough.
 */
#define MOST_SAMPLED_ORDER 512.0

/* The worst error with all orders compared, for a solution that was found with fewer. */
static hci_status attempt_check(const hci_task *t, attempt *a, hci_note *note)
{
    hci_harmonic_system b;
    double *r;
    const hci_status status =
        hci_harmonic_system_make(t, a->set.component, a->set.count, HCI_COMPARE_ALL, &b, note);
    if (status) return status;
    r = hci_memory_new(b.rows, sizeof *r);
    if (r) a->worth.worst_Nm = hci_worst_error_Nm(&b, a->x, hci_target_mean_Nm(t->target), r);
    hci_memory_free(r);
    hci_harmonic_system_release(&b);
    return r ? HCI_OK : no_memory(note);
}

/* The back-EMF of a surface-magnet machine ends at some order, and every order that the components reach can
 * be made right. e + L'i does not end: there the orders above the components' own are left to fall off by
 * themselves, or they would take all the freedom that is to save copper. */
static hci_status attempt_up_to(const hci_task *t, double top_order, attempt *a, hci_note *note)
{
    hci_task limited = *t;
    hci_status status;
    memset(a, 0, sizeof *a);
    if (t->offset_count > 0) limited.compared_up_to = top_order;
    status = hci_candidates(&limited, top_order, &a->set, note);
    if (!status) status = attempt_solve(&limited, a, note);
    if (!status && t->offset_count > 0) status = attempt_check(t, a, note);
    if (status) attempt_release(a);
    return status;
}

static bool good_enough(const attempt *a, double tolerance_Nm, double limit_A2)
{
    return a->worth.worst_Nm <= 0.1 * tolerance_Nm &&
           (isnan(limit_A2) || a->worth.mean_square_A2 <= LOSS_MARGIN * limit_A2);
}

/* Fewer and fewer orders: the lowest top order in (bad, good] that is still good enough. */
static hci_status bisect(const hci_task *t, double bad, double good, double tolerance_Nm, double limit_A2,
                         attempt *best, hci_note *note)
{
    const double step = 1.0 / (double)t->period_turns;
    while (good - bad > 1.5 * step) {
        const double middle = floor(0.5 * (bad + good) / step + 0.5) * step;
        attempt a;
        const hci_status status = attempt_up_to(t, middle, &a, note);
        if (status) return status;
        if (good_enough(&a, tolerance_Nm, limit_A2)) {
            attempt_release(best);
            *best = a;
            good = middle;
        } else {
            attempt_release(&a);
            bad = middle;
        }
        report(t, 1.0 - 0.5 * (good - bad) / good);
    }
    return HCI_OK;
}

/* Components that the solution does not use are dropped. */
static void drop_unused(attempt *a)
{
    const size_t n = a->set.count;
    double largest = 0.0;
    size_t kept = 0;
    for (size_t k = 0; k < 4 * n; ++k)
        largest = fmax(largest, fabs(a->x[k]));
    for (size_t k = 0; k < n; ++k) {
        const double *s = a->x + 2 * k, *c = s + 2 * n;
        if (fmax(fmax(fabs(s[0]), fabs(s[1])), fmax(fabs(c[0]), fabs(c[1]))) <= 1e-13 * largest) continue;
        a->set.component[kept] = a->set.component[k];
        a->set.set[kept] = a->set.set[k];
        for (size_t q = 0; q < 2; ++q)
            a->x[2 * kept + q] = s[q];
        for (size_t q = 0; q < 2; ++q)
            a->x[2 * n + 2 * kept + q] = c[q];
        ++kept;
    }
    memmove(a->x + 2 * kept, a->x + 2 * n, 2 * kept * sizeof *a->x);
    a->set.count = kept;
}

hci_status hci_choose_all(const hci_task *task, double tolerance_Nm, double limit_mean_square_A2,
                          hci_component_set *set, double **x, hci_note *note)
{
    double torque_order, emf_order, below, top;
    attempt best;
    hci_status status = HCI_OK;
    memset(&best, 0, sizeof best);
    hci_candidates_span(task, &torque_order, &emf_order);
    below = 0.0;
    top = ceil(torque_order + emf_order);
    for (int doubling = 0; !status; ++doubling) {
        attempt_release(&best);
        report(task, 0.5 * doubling / DOUBLINGS);
        status = attempt_up_to(task, top, &best, note);
        if (status || good_enough(&best, tolerance_Nm, limit_mean_square_A2)) break;
        if (doubling == DOUBLINGS || (task->beyond && 2.0 * top > MOST_SAMPLED_ORDER))
            goto done; /* the best there is; the caller sees what it is worth */
        below = top;
        top *= 2.0;
    }
    if (!status) status = bisect(task, below, top, tolerance_Nm, limit_mean_square_A2, &best, note);
done:
    if (status) {
        attempt_release(&best);
        return status;
    }
    drop_unused(&best);
    *set = best.set;
    *x = best.x;
    return HCI_OK;
}

/* ---- at most K ---- */

/* Prices of copper (ρ as a share of the largest diagonal of UᵀU) at which subsets are searched, and at which
 * each is solved. */
static const double SEARCH_PRICE[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5};
static const double SOLVE_PRICE[] = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-6};
enum {
    SEARCHES = sizeof SEARCH_PRICE / sizeof SEARCH_PRICE[0],
    SOLVES = sizeof SOLVE_PRICE / sizeof SOLVE_PRICE[0]
};

bool hci_set_cost_less(const hci_set_preference *p, hci_set_cost a, hci_set_cost b)
{
    const bool a_allowed = a.mean_square_A2 <= p->allowed_A2, b_allowed = b.mean_square_A2 <= p->allowed_A2;
    if (a_allowed != b_allowed) return a_allowed;
    if (!a_allowed) return a.mean_square_A2 < b.mean_square_A2;
    if (a.worst_Nm <= p->tolerance_Nm && b.worst_Nm <= p->tolerance_Nm)
        return a.mean_square_A2 < b.mean_square_A2;
    return a.worst_Nm < b.worst_Nm;
}

/* Makes `best` the better of the two and releases the other. */
static void keep_better(const hci_set_preference *p, attempt *best, attempt *a)
{
    if (!best->x || hci_set_cost_less(p, a->worth, best->worth)) {
        attempt_release(best);
        *best = *a;
    } else {
        attempt_release(a);
    }
    memset(a, 0, sizeof *a);
}

static hci_status copy_set(const hci_component_set *from, const size_t *pick, size_t count, attempt *to,
                           hci_note *note)
{
    memset(to, 0, sizeof *to);
    to->set.component = hci_memory_new(count, sizeof *to->set.component);
    to->set.set = hci_memory_new(count, sizeof *to->set.set);
    to->x = hci_memory_new(4 * count, sizeof *to->x);
    if (!to->set.component || !to->set.set || !to->x) {
        attempt_release(to);
        return no_memory(note);
    }
    to->set.count = count;
    for (size_t k = 0; k < count; ++k) {
        to->set.component[k] = from->component[pick[k]];
        to->set.set[k] = from->set[pick[k]];
    }
    return HCI_OK;
}

/* The set solved for level errors at one price of copper. */
static hci_status attempt_level(const hci_task *t, const hci_harmonic_system *b, const hci_component_set *all,
                                const size_t *pick, double ridge, const hci_set_preference *p, attempt *best,
                                hci_note *note)
{
    attempt a;
    double *room = hci_memory_new(hci_minimax_workspace(b), sizeof *room);
    hci_status status = room ? copy_set(all, pick, b->unknowns / 2, &a, note) : no_memory(note);
    if (!status) {
        const hci_status solved =
            hci_minimax_solve(b, &a.set, hci_target_mean_Nm(t->target), ridge, p, room, a.x, &a.worth);
        if (solved == HCI_OK)
            keep_better(p, best, &a);
        else
            attempt_release(&a); /* not positive definite at this price: no attempt, no error */
    }
    hci_memory_free(room);
    return status;
}

static hci_status attempt_exact(const hci_task *t, const hci_harmonic_system *b, const hci_component_set *all,
                                const size_t *pick, const hci_set_preference *p, attempt *best,
                                hci_note *note)
{
    attempt a;
    hci_status status = copy_set(all, pick, b->unknowns / 2, &a, note);
    if (!status) status = attempt_balance(t, b, &a, note);
    if (status)
        attempt_release(&a);
    else
        keep_better(p, best, &a);
    return status;
}

/* Solves one subset at every price and exactly, and keeps the best. */
static hci_status try_subset(const hci_task *t, const hci_component_set *all, const size_t *pick,
                             size_t count, double scale, const hci_set_preference *p, attempt *best,
                             hci_note *note)
{
    hci_harmonic_system b;
    hci_component_set chosen = {hci_memory_new(count, sizeof *chosen.component), NULL, count, {{0}}};
    hci_status status = chosen.component ? HCI_OK : no_memory(note);
    for (size_t k = 0; k < count && !status; ++k)
        chosen.component[k] = all->component[pick[k]];
    if (!status) status = hci_harmonic_system_make(t, chosen.component, count, HCI_COMPARE_ALL, &b, note);
    hci_memory_free(chosen.component);
    if (status) return status;
    hci_minimax_weight_mean(&b);
    status = attempt_exact(t, &b, all, pick, p, best, note);
    for (size_t k = 0; k < SOLVES && !status; ++k)
        status = attempt_level(t, &b, all, pick, SOLVE_PRICE[k] * scale, p, best, note);
    hci_harmonic_system_release(&b);
    return status;
}

/* G = UᵀU and b = Uᵀh from sparse columns; returns the largest diagonal of G. column: workspace of rows. */
static double fill_cost(const hci_harmonic_system *b, double mean_Nm, hci_subset_cost *c, double *column)
{
    const hci_sparse *u = &b->u;
    double largest = 0.0;
    for (size_t i = 0; i < b->rows; ++i)
        column[i] = 0.0;
    for (size_t j = 0; j < c->n; ++j) {
        c->b[j] = 0.0;
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k) {
            column[u->row[k]] = u->value[k];
            c->b[j] += u->value[k] * (mean_Nm * b->h[u->row[k]] + b->h[b->rows + (size_t)u->row[k]]);
        }
        for (size_t i = 0; i < c->n; ++i) {
            double sum = 0.0;
            for (int64_t k = u->column_start[i]; k < u->column_start[i + 1]; ++k)
                sum += u->value[k] * column[u->row[k]];
            c->gram[i + j * c->n] = sum;
        }
        largest = fmax(largest, c->gram[j + j * c->n]);
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
            column[u->row[k]] = 0.0;
    }
    return largest;
}

/* Searches at every price of copper. */
static hci_status search(const hci_task *t, const hci_component_set *all, size_t most, hci_subset_cost *c,
                         double scale, hci_subset_workspace *room, const hci_set_preference *p, attempt *best,
                         hci_note *note)
{
    hci_status status = HCI_OK;
    const size_t searches = most < all->count ? (size_t)SEARCHES : 1; /* else there is one subset only */
    for (size_t k = 0; k < searches && !status; ++k) {
        report(t, (double)k / SEARCHES);
        c->ridge = SEARCH_PRICE[k] * scale;
        if (hci_subset_eliminate(c, most, room) || hci_subset_exchange(c, room, most)) continue;
        status = try_subset(t, all, room->active, most, scale, p, best, note);
    }
    if (!status && !best->x)
        status = hci_note_set(note, HCI_ERROR_NUMERIC, "no subset of %zu components could be solved", most);
    return status;
}

static bool reserve(const hci_harmonic_system *b, hci_subset_cost *c, hci_subset_workspace *room,
                    double **column)
{
    const size_t n = b->unknowns;
    c->n = n;
    c->gram = hci_memory_new(n * n, sizeof *c->gram);
    c->b = hci_memory_new(n, sizeof *c->b);
    room->p = hci_memory_new(n * n, sizeof *room->p);
    room->work = hci_memory_new(n * n, sizeof *room->work);
    room->x = hci_memory_new(n, sizeof *room->x);
    room->v = hci_memory_new(2 * n, sizeof *room->v);
    room->active = hci_memory_new(n, sizeof *room->active);
    room->in = hci_memory_new(n, sizeof *room->in);
    *column = hci_memory_new(b->rows, sizeof **column);
    return c->gram && c->b && room->p && room->work && room->x && room->v && room->active && room->in &&
           *column;
}

static void release(hci_subset_cost *c, hci_subset_workspace *room, double *column)
{
    hci_memory_free(c->gram);
    hci_memory_free(c->b);
    hci_memory_free(room->p);
    hci_memory_free(room->work);
    hci_memory_free(room->x);
    hci_memory_free(room->v);
    hci_memory_free(room->active);
    hci_memory_free(room->in);
    hci_memory_free(column);
}

static hci_status choose_among(const hci_task *t, const hci_component_set *all, size_t most,
                               const hci_set_preference *p, attempt *best, hci_note *note)
{
    hci_harmonic_system b;
    hci_subset_cost cost = {0};
    hci_subset_workspace room = {0};
    double *column = NULL;
    hci_status status = hci_harmonic_system_make(t, all->component, all->count, HCI_COMPARE_ALL, &b, note);
    if (status) return status;
    if (reserve(&b, &cost, &room, &column)) {
        const double scale = fill_cost(&b, hci_target_mean_Nm(t->target), &cost, column);
        status = search(t, all, most < all->count ? most : all->count, &cost, scale, &room, p, best, note);
    } else {
        status = no_memory(note);
    }
    release(&cost, &room, column);
    hci_harmonic_system_release(&b);
    return status;
}

#define PASS   0.4 /* of the work that is left that a pass is thought to be, unless it is the last */
#define CHOICE 3   /* candidates for each component that are a choice */

/* One of several passes: its shares are those of a part of the work. */
typedef struct {
    hci_task task;
    const hci_task *whole;
    double from, until;
} pass;

static void tell_pass(void *context, const char *what, double share)
{
    const pass *p = context;
    p->whole->progress(p->whole->progress_context, what, p->from + share * (p->until - p->from));
}

/* Chooses among all candidates up to `top`; `best` is kept where it is better. count: out, how many there
 * are. */
static hci_status choose_up_to(pass *part, double top, size_t most, const hci_set_preference *p,
                               attempt *best, size_t *count, hci_note *note)
{
    hci_component_set all;
    hci_status status = hci_candidates(part->whole, top, &all, note);
    *count = all.count;
    part->from = part->until;
    part->until = all.count < CHOICE * most ? part->from + PASS * (1.0 - part->from) : 1.0;
    if (!status) status = choose_among(&part->task, &all, most, p, best, note);
    hci_component_set_release(&all);
    return status;
}

/* Up to somewhat above the orders that matter, and higher until there was a choice among several times
 * `most`. */
static hci_status choose_freely(const hci_task *t, size_t most, const hci_set_preference *p, attempt *best,
                                hci_note *note)
{
    double torque_order, emf_order, top;
    size_t count = 0;
    pass part = {*t, t, 0.0, 0.0};
    hci_status status;
    if (t->progress) part.task.progress = tell_pass;
    part.task.progress_context = &part;
    hci_candidates_span(t, &torque_order, &emf_order);
    top = ceil(torque_order + 2.0 * emf_order);
    status = choose_up_to(&part, top, most, p, best, &count, note);
    for (int doubling = 0;
         !status && count < CHOICE * most && doubling < DOUBLINGS && 2.0 * top < HCI_MOST_ORDER; ++doubling)
        status = choose_up_to(&part, top *= 2.0, most, p, best, &count, note);
    return status;
}

hci_status hci_choose_few(const hci_task *task, const hci_component_set *only, size_t most,
                          double tolerance_Nm, double loss_A2, hci_component_set *set, double **x,
                          hci_note *note)
{
    const hci_set_preference p = {tolerance_Nm, loss_A2};
    attempt best;
    hci_status status;
    memset(&best, 0, sizeof best);
    status =
        only ? choose_among(task, only, most, &p, &best, note) : choose_freely(task, most, &p, &best, note);
    if (status) {
        attempt_release(&best);
        return status;
    }
    *set = best.set;
    *x = best.x;
    return HCI_OK;
}
