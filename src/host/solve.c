#include "hci/host/solve.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "balance.h"
#include "hci/dense.h"
#include "limits.h"
#include "memory.h"

#define DEFAULT_TOLERANCE      1e-6
#define DEFAULT_LOSS_ALLOWANCE 1.10
#define WORST_CONDITION        1e12 /* above it a square system is solved by QR instead */
#define MOST_TURNS             4096

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory while solving");
}

const char *hci_method_name(hci_method method)
{
    static const char *const NAME[] = {"auto", "lu", "umfpack", "qr", "pointwise"};
    return NAME[method];
}

const char *hci_order_verdict_name(hci_order_verdict verdict)
{
    static const char *const NAME[] = {"reached", "free", "missed", "parasitic", "unreachable"};
    return NAME[verdict];
}

/* ---- the task -------------------------------------------------------------------------------------------------- */

static bool all_whole(const hci_task *t, const hci_component_set *set, size_t turns)
{
#define IS_WHOLE(order) (fabs((order) * (double)turns - floor((order) * (double)turns + 0.5)) < HCI_ORDER_TOLERANCE * (double)turns)
    bool whole = !t->held || IS_WHOLE(t->held->order);
    for (size_t k = 0; k < t->target->count; ++k) whole = whole && IS_WHOLE(t->target->order[k].torque_Nm.order);
    for (size_t k = 0; k < t->machine->cogging_count; ++k) whole = whole && IS_WHOLE(t->machine->cogging[k].order);
    for (size_t k = 0; set && k < set->count; ++k) whole = whole && IS_WHOLE(set->component[k].order);
#undef IS_WHOLE
    return whole;
}

static hci_status find_period(hci_task *t, const hci_component_set *set, hci_note *note)
{
    for (t->period_turns = 1; t->period_turns <= MOST_TURNS; ++t->period_turns)
        if (all_whole(t, set, t->period_turns)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "the orders have no common period of at most %d electrical turns; write fractional orders as "
                        "k/pole_pairs with at least 7 digits",
                        MOST_TURNS);
}

static hci_status check_machine(const hci_machine_data *m, hci_note *note)
{
    if (m->has_inductance)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "inductance.csv makes this an interior-magnet machine, which this version does not solve; "
                            "without that file its reluctance torque is left out");
    if (m->has_effects)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "effects.csv holds effects that this version does not know; without that file they are left out");
    return HCI_OK;
}

static hci_status make_task(const hci_machine_data *m, const hci_solve_options *o, hci_task *t, hci_note *note)
{
    const hci_status status = check_machine(m, note);
    *t = (hci_task){&m->model, m->has_neutral, o->target, o->held, 1, o->progress, o->progress_context};
    if (status) return status;
    for (size_t k = 0; o->held && o->set && k < o->set->count; ++k)
        if (o->set->component[k].sequence == o->held->sequence &&
            fabs(o->set->component[k].order - o->held->order) < HCI_ORDER_TOLERANCE)
            return hci_note_set(note, HCI_ERROR_INPUT,
                                "the set of harmonics names %s %g, which is held fixed; leave it out of the set or do "
                                "not hold the fundamental",
                                hci_set_name(o->set->set[k]), o->held->order);
    return find_period(t, o->set, note);
}

/* ---- one set of components ------------------------------------------------------------------------------------- */

/* A set with the coordinates of both right-hand sides. */
typedef struct {
    hci_component_set set;
    double *x; /* 2·count × 2 */
} answer;

static void answer_release(answer *a)
{
    hci_component_set_release(&a->set);
    hci_memory_free(a->x);
}

/* The given set, with the fundamental in front when it is neither held nor named. */
static hci_status copy_given_set(const hci_solve_options *o, answer *a, hci_note *note)
{
    const hci_component fundamental = {1.0, 1};
    bool add = !o->held;
    size_t n = 0;
    for (size_t k = 0; k < o->set->count; ++k)
        if (o->set->component[k].sequence == 1 && fabs(o->set->component[k].order - 1.0) < HCI_ORDER_TOLERANCE)
            add = false;
    a->set.component = hci_memory_new(o->set->count + 1, sizeof *a->set.component);
    a->set.set = hci_memory_new(o->set->count + 1, sizeof *a->set.set);
    a->x = hci_memory_new(4 * (o->set->count + 1), sizeof *a->x);
    if (!a->set.component || !a->set.set || !a->x) return no_memory(note);
    if (add) {
        a->set.component[n] = fundamental;
        a->set.set[n++] = HCI_SET_POS;
    }
    for (size_t k = 0; k < o->set->count; ++k, ++n) {
        a->set.component[n] = o->set->component[k];
        a->set.set[n] = o->set->set[k];
    }
    a->set.count = n;
    return HCI_OK;
}

/* Dense LU of the core with refinement, both right-hand sides. */
static hci_status dense_lu_in(const hci_balance *b, double *a, double *lu, double *work, size_t *pivot, double *x,
                              double *condition)
{
    const size_t n = b->rows;
    hci_status status;
    for (size_t j = 0; j < n; ++j)
        for (int64_t k = b->u.column_start[j]; k < b->u.column_start[j + 1]; ++k)
            a[(size_t)b->u.row[k] + j * n] = b->u.value[k];
    memcpy(lu, a, n * n * sizeof *a);
    status = hci_lu_factor(n, lu, pivot);
    if (status) return status;
    *condition = hci_lu_condition(n, lu, pivot, hci_norm_1(n, n, a), work);
    if (!(*condition * (double)n * DBL_EPSILON < 1.0)) return HCI_ERROR_SINGULAR;
    memcpy(x, b->h, 2 * n * sizeof *x);
    for (size_t side = 0; side < 2; ++side) {
        hci_lu_solve(n, lu, pivot, x + side * n);
        hci_lu_refine(n, a, lu, pivot, b->h + side * n, x + side * n, work);
    }
    return HCI_OK;
}

static hci_status dense_lu(const hci_balance *b, double *x, double *condition, hci_note *note)
{
    const size_t n = b->rows;
    double *room = hci_memory_new(2 * n * n + 2 * n, sizeof *room);
    size_t *pivot = hci_memory_new(n, sizeof *pivot);
    const hci_status status =
        room && pivot ? dense_lu_in(b, room, room + n * n, room + 2 * n * n, pivot, x, condition) : no_memory(note);
    hci_memory_free(room);
    hci_memory_free(pivot);
    return status;
}

static hci_status square_solve(const hci_balance *b, hci_method method, double *x, double *condition, hci_note *note)
{
    if (method == HCI_METHOD_LU) return dense_lu(b, x, condition, note);
    return hci_sparse_lu_solve(&b->u, b->h, 2, x, condition, note);
}

/* LU where the system is square and regular, the orthogonal solve elsewhere; a named method is taken at its word. */
static hci_status solve_balance(const hci_balance *b, hci_method wanted, double *x, hci_solution *s, hci_note *note)
{
    const bool square = b->rows == b->unknowns && b->rows > 0;
    hci_status status;
    if (!square && (wanted == HCI_METHOD_LU || wanted == HCI_METHOD_UMFPACK))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "method %s needs a square system, but there are %zu equations for %zu unknowns; use --method qr, "
                            "or --compare square with a held fundamental",
                            hci_method_name(wanted), b->rows, b->unknowns);
    s->method = wanted == HCI_METHOD_AUTO ? HCI_METHOD_UMFPACK : wanted;
    if (square && s->method != HCI_METHOD_QR) {
        s->rank = b->rows;
        status = square_solve(b, s->method, x, &s->condition, note);
        if (status == HCI_ERROR_SINGULAR && wanted != HCI_METHOD_AUTO)
            return hci_note_set(note, status, "method %s: U is singular; use --method qr", hci_method_name(wanted));
        if (status != HCI_ERROR_SINGULAR && (status || wanted != HCI_METHOD_AUTO || s->condition <= WORST_CONDITION))
            return status;
    }
    s->method = HCI_METHOD_QR;
    return hci_sparse_qr_solve(&b->u, b->h, 2, x, &s->rank, &s->condition, note);
}

/* Size, rank and condition of a chosen set, whose solution is known already. */
static hci_status describe(const hci_task *t, const answer *a, hci_solution *s, hci_note *note)
{
    hci_balance b;
    double *x;
    hci_status status = hci_balance_make(t, a->set.component, a->set.count, HCI_COMPARE_ALL, &b, note);
    if (status) return status;
    x = hci_memory_new(2 * b.unknowns, sizeof *x);
    status = x ? hci_sparse_qr_solve(&b.u, b.h, 2, x, &s->rank, &s->condition, note) : no_memory(note);
    s->rows = b.rows;
    s->unknowns = b.unknowns;
    s->method = HCI_METHOD_QR;
    hci_memory_free(x);
    hci_balance_release(&b);
    return status;
}

static hci_status solve_given(const hci_task *t, const hci_solve_options *o, answer *a, hci_solution *s, hci_note *note)
{
    hci_balance b;
    hci_status status = copy_given_set(o, a, note);
    if (!status) status = hci_balance_make(t, a->set.component, a->set.count, o->compare, &b, note);
    if (status) return status;
    s->rows = b.rows;
    s->unknowns = b.unknowns;
    status = solve_balance(&b, o->method, a->x, s, note);
    hci_balance_release(&b);
    return status;
}

static hci_status solve_pointwise(const hci_task *t, answer *a, hci_solution *s, hci_note *note)
{
    if (t->held)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "method pointwise finds the whole current; it cannot hold the fundamental fixed");
    s->method = HCI_METHOD_POINTWISE;
    s->condition = NAN;
    return hci_pointwise_waves(t, &a->set, &a->x, note);
}

static hci_status find_answer(const hci_task *t, const hci_solve_options *o, answer *a, hci_solution *s, hci_note *note)
{
    const double allowance = o->loss_allowance > 0.0 ? o->loss_allowance : DEFAULT_LOSS_ALLOWANCE;
    const double limit_A2 = s->limit_mean_square_A2;
    hci_status status;
    if (o->method == HCI_METHOD_POINTWISE) return solve_pointwise(t, a, s, note);
    if (o->set) return solve_given(t, o, a, s, note);
    if (o->choose_at_most > 0)
        status = hci_choose_few(t, o->choose_at_most, s->tolerance_Nm, isnan(limit_A2) ? HUGE_VAL : allowance * limit_A2,
                                &a->set, &a->x, note);
    else
        status = hci_choose_all(t, s->tolerance_Nm, limit_A2, &a->set, &a->x, note);
    return status ? status : describe(t, a, s, note);
}

/* ---- what flows ------------------------------------------------------------------------------------------------ */

/* Components below this share of the largest are rounding, not current. */
#define NEGLIGIBLE 1e-12

static bool is_negligible(const answer *a, double mean_Nm, size_t k, double largest)
{
    const double *x = a->x, *rest = x + 2 * a->set.count;
    const double scale = fabs(mean_Nm) > 0.0 ? fabs(mean_Nm) : 1.0;
    const double size = fmax(scale * hypot(x[2 * k], x[2 * k + 1]), hypot(rest[2 * k], rest[2 * k + 1]));
    return size <= NEGLIGIBLE * largest;
}

static double largest_current(const answer *a, double mean_Nm)
{
    double largest = 0.0;
    for (size_t k = 0; k < 2 * a->set.count; ++k)
        largest = fmax(largest, fmax(fabs(mean_Nm * a->x[k]), fabs(a->x[2 * a->set.count + k])));
    return largest;
}

/* Waves of the total, of the part per N·m and of the constant part. A given set keeps all its components, a chosen or
 * pointwise one only those that carry current. */
static hci_status fill_currents(const answer *a, const hci_solve_options *o, hci_solution *s, hci_note *note)
{
    const double mean_Nm = hci_target_mean_Nm(o->target), largest = largest_current(a, mean_Nm);
    const size_t n = a->set.count, most = n + 1;
    size_t out = 0;
    s->current.wave = hci_memory_new(most, sizeof *s->current.wave);
    s->current.set = hci_memory_new(most, sizeof *s->current.set);
    s->per_Nm = o->held ? NULL : hci_memory_new(most, sizeof *s->per_Nm);
    s->constant = o->held ? NULL : hci_memory_new(most, sizeof *s->constant);
    if (!s->current.wave || !s->current.set || (!o->held && (!s->per_Nm || !s->constant))) return no_memory(note);
    if (o->held) {
        s->current.set[out] = HCI_SET_POS;
        s->current.wave[out++] = *o->held;
    }
    for (size_t k = 0; k < n; ++k) {
        const hci_component c = a->set.component[k];
        const double *x = a->x + 2 * k, *rest = x + 2 * n;
        if (!o->set && is_negligible(a, mean_Nm, k, largest)) continue;
        s->current.set[out] = a->set.set[k];
        s->current.wave[out] =
            (hci_wave){c.order, c.sequence, mean_Nm * x[0] + rest[0], mean_Nm * x[1] + rest[1]};
        if (!o->held) {
            s->per_Nm[out] = (hci_wave){c.order, c.sequence, x[0], x[1]};
            s->constant[out] = (hci_wave){c.order, c.sequence, rest[0], rest[1]};
        }
        ++out;
    }
    s->current.count = out;
    return HCI_OK;
}

/* ---- what it does ---------------------------------------------------------------------------------------------- */

/* The plain fundamental: the one that is held, or the least sine that makes the wanted mean torque. */
static hci_wave plain_fundamental(const hci_task *t)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    if (t->held) return *t->held;
    for (size_t k = 0; k < t->machine->back_emf_count; ++k) {
        const hci_wave *e = &t->machine->back_emf[k];
        const double square = e->sine * e->sine + e->cosine * e->cosine;
        if (fabs(e->order - 1.0) < HCI_ORDER_TOLERANCE && square > 0.0) {
            const double scale = mean_Nm / (1.5 * square);
            return (hci_wave){1.0, 1, scale * e->sine, scale * e->cosine};
        }
    }
    return (hci_wave){1.0, 1, 0.0, 0.0};
}

static size_t result_orders(const hci_task *t, const hci_solution *s, const hci_wave *plain, double *order, size_t capacity)
{
    size_t n, more;
    hci_torque_orders(t->machine, s->current.wave, s->current.count, order, capacity, &n);
    hci_torque_orders(t->machine, plain, 1, order + n, capacity - n, &more);
    n += more;
    for (size_t k = 0; k < t->target->count; ++k) order[n++] = t->target->order[k].torque_Nm.order;
    return hci_orders_sort(order, n);
}

/* The component that makes torque order m with the strongest back-EMF wave; the lower of the two possible orders. */
static hci_component remedy_for(const hci_task *t, double m)
{
    const hci_wave *e = &t->machine->back_emf[0];
    for (size_t k = 1; k < t->machine->back_emf_count; ++k) {
        const hci_wave *other = &t->machine->back_emf[k];
        const bool usable = t->has_neutral || other->sequence != 0;
        if (usable && hci_amplitude(other->sine, other->cosine) > hci_amplitude(e->sine, e->cosine)) e = other;
    }
    return m > e->order ? (hci_component){m - e->order, -e->sequence} : (hci_component){m + e->order, e->sequence};
}

/* Whether any component of the answer reaches the order. */
static bool is_touched(const hci_task *t, const answer *a, double order, double *reached)
{
    for (size_t k = 0; k < a->set.count; ++k) {
        const size_t n = hci_component_orders(t->machine->back_emf, t->machine->back_emf_count, a->set.component[k], reached);
        for (size_t j = 0; j < n; ++j)
            if (fabs(reached[j] - order) < HCI_ORDER_TOLERANCE) return true;
    }
    return false;
}

typedef struct {
    const hci_task *task;
    const answer *answer;
    const double *compared; /* NULL: all orders are compared */
    size_t compared_count;
    double *reached; /* room for the orders of one component */
} judge;

static hci_order_verdict judge_order(const judge *j, const hci_solved_order *o, double tolerance_Nm)
{
    const double order = o->torque_Nm.order;
    if (hci_target_at(j->task->target, order).weight <= 0.0) return HCI_ORDER_FREE;
    if (o->error_Nm <= tolerance_Nm) return HCI_ORDER_REACHED;
    if (!is_touched(j->task, j->answer, order, j->reached)) return HCI_ORDER_UNREACHABLE;
    if (j->compared && hci_orders_find(j->compared, j->compared_count, order) == j->compared_count)
        return HCI_ORDER_PARASITIC;
    return HCI_ORDER_MISSED;
}

/* Target, torque and error of every order, and the worst of those cared for. */
static void judge_orders(const judge *j, const hci_harmonic *torque, const hci_harmonic *before, hci_solution *s)
{
    s->worst_error_Nm = -1.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        hci_solved_order *o = &s->order[k];
        o->target_Nm = hci_target_at(j->task->target, torque[k].order).torque_Nm;
        o->torque_Nm = torque[k];
        o->before_Nm = before[k];
        o->error_Nm = hypot(torque[k].sine - o->target_Nm.sine, torque[k].cosine - o->target_Nm.cosine);
        o->verdict = judge_order(j, o, s->tolerance_Nm);
        if (o->verdict == HCI_ORDER_UNREACHABLE) o->remedy = remedy_for(j->task, o->torque_Nm.order);
        if (o->verdict == HCI_ORDER_FREE || o->error_Nm <= s->worst_error_Nm) continue;
        s->worst_error_Nm = o->error_Nm;
        s->worst_order = o->torque_Nm.order;
    }
    if (s->worst_error_Nm < 0.0) s->worst_error_Nm = 0.0;
}

static hci_status fill_orders(const hci_task *t, const answer *a, hci_compare compare, hci_solution *s, hci_note *note)
{
    const hci_wave plain = plain_fundamental(t);
    const size_t capacity = hci_torque_orders_capacity(t->machine, s->current.count) +
                            hci_torque_orders_capacity(t->machine, 1) + t->target->count;
    double *order = hci_memory_new(capacity, sizeof *order);
    double *reached = hci_memory_new(2 * t->machine->back_emf_count, sizeof *reached);
    hci_harmonic *torque = hci_memory_new(2 * capacity, sizeof *torque);
    hci_balance b = {0};
    hci_status status = order && reached && torque ? HCI_OK : no_memory(note);
    if (!status && compare == HCI_COMPARE_SQUARE)
        status = hci_balance_make(t, a->set.component, a->set.count, compare, &b, note);
    if (!status) {
        s->order_count = result_orders(t, s, &plain, order, capacity);
        s->order = hci_memory_new(s->order_count, sizeof *s->order);
        if (!s->order) status = no_memory(note);
    }
    if (!status) {
        const judge j = {t, a, b.order, b.order_count, reached};
        hci_torque_spectrum(t->machine, s->current.wave, s->current.count, order, s->order_count, torque);
        hci_torque_spectrum(t->machine, &plain, 1, order, s->order_count, torque + s->order_count);
        judge_orders(&j, torque, torque + s->order_count, s);
    }
    hci_balance_release(&b);
    hci_memory_free(order);
    hci_memory_free(reached);
    hci_memory_free(torque);
    return status;
}

/* NAN where there is nothing to compare with. */
static double ratio(double value, double reference)
{
    if (!(reference > 0.0)) return NAN;
    return value / reference;
}

static void fill_losses(const hci_task *t, hci_solution *s)
{
    const hci_wave plain = plain_fundamental(t);
    s->mean_square_A2 = hci_waves_mean_square(s->current.wave, s->current.count);
    s->plain_amplitude_A = hci_amplitude(plain.sine, plain.cosine);
    s->loss_to_plain = ratio(s->mean_square_A2, 1.5 * s->plain_amplitude_A * s->plain_amplitude_A);
    s->loss_to_limit = ratio(s->mean_square_A2, s->limit_mean_square_A2);
}

/* ---- all of it ------------------------------------------------------------------------------------------------- */

/* An error is measured against the mean torque, or where none is wanted against the largest wanted or cogging torque. */
static double torque_scale_Nm(const hci_task *t)
{
    double scale = fabs(hci_target_mean_Nm(t->target));
    if (scale > 0.0) return scale;
    for (size_t k = 0; k < t->target->count; ++k)
        scale = fmax(scale, hci_amplitude(t->target->order[k].torque_Nm.sine, t->target->order[k].torque_Nm.cosine));
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        scale = fmax(scale, hci_amplitude(t->machine->cogging[k].sine, t->machine->cogging[k].cosine));
    return scale;
}

static hci_status verdict_of(const hci_solution *s)
{
    for (size_t k = 0; k < s->order_count; ++k)
        if (s->order[k].verdict > HCI_ORDER_FREE) return HCI_NOT_REACHED;
    return s->within_limits ? HCI_OK : HCI_NOT_REACHED;
}

hci_status hci_solve(const hci_machine_data *machine, const hci_solve_options *options, hci_solution *solution,
                     hci_note *note)
{
    const double tolerance = options->tolerance > 0.0 ? options->tolerance : DEFAULT_TOLERANCE;
    hci_task task;
    answer a;
    hci_status status;
    memset(solution, 0, sizeof *solution);
    memset(&a, 0, sizeof a);
    status = make_task(machine, options, &task, note);
    if (status) return status;
    solution->period_turns = task.period_turns;
    solution->tolerance_Nm = tolerance * torque_scale_Nm(&task);
    solution->limit_mean_square_A2 = hci_pointwise_mean_square_A2(&task);
    status = find_answer(&task, options, &a, solution, note);
    if (!status) status = fill_currents(&a, options, solution, note);
    if (!status) status = fill_orders(&task, &a, options->set ? options->compare : HCI_COMPARE_ALL, solution, note);
    if (!status) status = hci_limits_check(machine, options, solution, note);
    answer_release(&a);
    if (status) {
        hci_solution_release(solution);
        return status;
    }
    fill_losses(&task, solution);
    return verdict_of(solution);
}

void hci_solution_release(hci_solution *solution)
{
    hci_currents_release(&solution->current);
    hci_memory_free(solution->per_Nm);
    hci_memory_free(solution->constant);
    hci_memory_free(solution->order);
    memset(solution, 0, sizeof *solution);
}
