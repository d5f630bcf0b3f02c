/* The linear problem U x = h of a task: a given set of components, or a chosen one. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/solve/harmonic_system.h"

#define DEFAULT_LOSS_ALLOWANCE 1.10
#define WORST_CONDITION        1e12 /* above it a square system is solved by QR instead */

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory while solving");
}

void hci_answer_release(hci_answer *answer)
{
    hci_component_set_release(&answer->set);
    hci_memory_free(answer->x);
    memset(answer, 0, sizeof *answer);
}

/* The given set, with the fundamental in front when it is neither held nor named. */
static hci_status copy_given_set(const hci_solve_options *o, hci_answer *a, hci_note *note)
{
    const hci_component fundamental = {1.0, 1};
    bool add = !o->held;
    size_t n = 0;
    for (size_t k = 0; k < o->set->count; ++k)
        if (o->set->component[k].sequence == 1 &&
            fabs(o->set->component[k].order - 1.0) < HCI_ORDER_TOLERANCE)
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
static hci_status dense_lu_in(const hci_harmonic_system *b, double *a, double *lu, double *work,
                              size_t *pivot, double *x, double *condition)
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

static hci_status dense_lu(const hci_harmonic_system *b, double *x, double *condition, hci_note *note)
{
    const size_t n = b->rows;
    double *room = hci_memory_new(2 * n * n + 2 * n, sizeof *room);
    size_t *pivot = hci_memory_new(n, sizeof *pivot);
    const hci_status status = room && pivot
                                  ? dense_lu_in(b, room, room + n * n, room + 2 * n * n, pivot, x, condition)
                                  : no_memory(note);
    hci_memory_free(room);
    hci_memory_free(pivot);
    return status;
}

static hci_status square_solve(const hci_harmonic_system *b, hci_method method, double *x, double *condition,
                               hci_note *note)
{
    if (method == HCI_METHOD_LU) return dense_lu(b, x, condition, note);
    return hci_sparse_lu_solve(&b->u, b->h, 2, x, condition, note);
}

/* LU where the system is square and regular, the orthogonal solve elsewhere; a named method is taken at its
 * word. */
static hci_status solve_balance(const hci_harmonic_system *b, hci_method wanted, double *x, hci_solution *s,
                                hci_note *note)
{
    const bool square = b->rows == b->unknowns && b->rows > 0;
    hci_status status;
    if (!square && (wanted == HCI_METHOD_LU || wanted == HCI_METHOD_UMFPACK))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "method %s needs a square system, but there are %zu equations for %zu unknowns; use --method qr, "
            "or --compare square with a held fundamental",
            hci_method_name(wanted), b->rows, b->unknowns);
    s->method = wanted == HCI_METHOD_AUTO ? HCI_METHOD_UMFPACK : wanted;
    if (square && s->method != HCI_METHOD_QR) {
        s->rank = b->rows;
        status = square_solve(b, s->method, x, &s->condition, note);
        if (status == HCI_ERROR_SINGULAR && wanted != HCI_METHOD_AUTO)
            return hci_note_set(note, status, "method %s: U is singular; use --method qr",
                                hci_method_name(wanted));
        if (status != HCI_ERROR_SINGULAR &&
            (status || wanted != HCI_METHOD_AUTO || s->condition <= WORST_CONDITION))
            return status;
    }
    s->method = HCI_METHOD_QR;
    return hci_sparse_qr_solve(&b->u, b->h, 2, x, &s->rank, &s->condition, note);
}

/* Size, rank and condition of a chosen set, whose solution is known already. */
static hci_status describe(const hci_task *t, const hci_answer *a, hci_solution *s, hci_note *note)
{
    hci_harmonic_system b;
    double *x;
    hci_status status =
        hci_harmonic_system_make(t, a->set.component, a->set.count, HCI_COMPARE_ALL, &b, note);
    if (status) return status;
    x = hci_memory_new(2 * b.unknowns, sizeof *x);
    status = x ? hci_sparse_qr_solve(&b.u, b.h, 2, x, &s->rank, &s->condition, note) : no_memory(note);
    s->rows = b.rows;
    s->unknowns = b.unknowns;
    s->method = HCI_METHOD_QR;
    hci_memory_free(x);
    hci_harmonic_system_release(&b);
    return status;
}

static hci_status solve_given(const hci_task *t, const hci_solve_options *o, hci_answer *a, hci_solution *s,
                              hci_note *note)
{
    hci_harmonic_system b;
    hci_status status = copy_given_set(o, a, note);
    if (!status) status = hci_harmonic_system_make(t, a->set.component, a->set.count, o->compare, &b, note);
    if (status) return status;
    s->rows = b.rows;
    s->unknowns = b.unknowns;
    status = solve_balance(&b, o->method, a->x, s, note);
    hci_harmonic_system_release(&b);
    return status;
}

hci_status hci_linear_answer(const hci_task *task, const hci_solve_options *options,
                             const hci_component_set *only, hci_answer *answer, hci_solution *solution,
                             hci_note *note)
{
    const double allowance = options->loss_allowance > 0.0 ? options->loss_allowance : DEFAULT_LOSS_ALLOWANCE;
    const double limit_A2 = solution->limit_mean_square_A2;
    hci_solve_options given = *options;
    hci_status status;
    given.set = options->set ? options->set : only;
    given.method = options->set ? options->method : HCI_METHOD_QR;
    if (options->choose_at_most > 0)
        status =
            hci_choose_few(task, only, options->choose_at_most, solution->tolerance_Nm,
                           isnan(limit_A2) ? HUGE_VAL : allowance * limit_A2, &answer->set, &answer->x, note);
    else if (given.set)
        return solve_given(task, &given, answer, solution, note);
    else
        status = hci_choose_all(task, solution->tolerance_Nm, limit_A2, &answer->set, &answer->x, note);
    return status ? status : describe(task, answer, solution, note);
}
