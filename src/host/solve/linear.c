/* The linear problem U x = h of a task. In: a task, and a set of components or none; out: the set and its
 * currents. LU where the system is square and regular, else the least norm of all least-squares solutions
 * (theory.md, section 5). */
#include "host/solve/linear.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/solve/choose.h"
#include "host/solve/harmonic_system.h"

#define DEFAULT_LOSS_ALLOWANCE 1.10
#define WORST_CONDITION        1e12 /* above it a square system is solved by QR instead */

const char *hci_method_name(hci_method method)
{
    static const char *const NAME[] = {"auto", "lu", "umfpack", "qr", "pointwise"};
    return NAME[method];
}

static bool is_fundamental(hci_component c)
{
    return c.sequence == 1 && fabs(c.order - 1.0) < HCI_ORDER_TOLERANCE;
}

/* The given set, with the fundamental in front when it is neither held nor named. */
static hci_status copy_given_set(const hci_solve_options *o, hci_answer *a, hci_note *note)
{
    bool add = !o->held;
    size_t n = 0;
    for (size_t k = 0; k < o->set->count; ++k)
        add = add && !is_fundamental(o->set->component[k]);
    if (hci_answer_reserve(o->set->count + (add ? 1 : 0), a)) return hci_note_memory(note, NULL, "solving");
    if (add) {
        a->set.component[n] = (hci_component){1.0, 1};
        a->set.set[n++] = HCI_SET_POS;
    }
    for (size_t k = 0; k < o->set->count; ++k, ++n) {
        a->set.component[n] = o->set->component[k];
        a->set.set[n] = o->set->set[k];
    }
    return HCI_OK;
}

/* Workspace of the dense LU. */
typedef struct {
    double *a, *lu; /* n×n: U, and its factors */
    double *work;   /* 2n */
    size_t *pivot;  /* n */
} dense;

/* Dense LU of the core with refinement, both right-hand sides. */
static hci_status dense_lu_in(const hci_harmonic_system *s, const dense *d, double *x, double *condition)
{
    const size_t n = s->rows;
    const hci_sparse *u = &s->u;
    hci_status status;
    for (size_t j = 0; j < n; ++j)
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
            d->a[(size_t)u->row[k] + j * n] = u->value[k];
    memcpy(d->lu, d->a, n * n * sizeof *d->a);
    status = hci_lu_factor(n, d->lu, d->pivot);
    if (status) return status;
    *condition = hci_lu_condition(n, d->lu, d->pivot, hci_norm_1(n, n, d->a), d->work);
    if (!(*condition * (double)n * DBL_EPSILON < 1.0)) return HCI_ERROR_SINGULAR;
    memcpy(x, s->h, 2 * n * sizeof *x);
    for (size_t side = 0; side < 2; ++side) {
        hci_lu_solve(n, d->lu, d->pivot, x + side * n);
        hci_lu_refine(n, d->a, d->lu, d->pivot, s->h + side * n, x + side * n, d->work);
    }
    return HCI_OK;
}

static hci_status dense_lu(const hci_harmonic_system *s, double *x, double *condition, hci_note *note)
{
    const size_t n = s->rows;
    double *block = hci_memory_new(2 * n * n + 2 * n, sizeof *block);
    size_t *pivot = hci_memory_new(n, sizeof *pivot);
    hci_status status = block && pivot ? HCI_OK : hci_note_memory(note, NULL, "solving");
    if (!status) {
        const dense d = {block, block + n * n, block + 2 * n * n, pivot};
        status = dense_lu_in(s, &d, x, condition);
    }
    hci_memory_free(block);
    hci_memory_free(pivot);
    return status;
}

static hci_status check_shape(const hci_harmonic_system *s, hci_method wanted, hci_note *note)
{
    if (s->rows == s->unknowns && s->rows > 0) return HCI_OK;
    if (wanted != HCI_METHOD_LU && wanted != HCI_METHOD_UMFPACK) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "method %s needs a square system, but there are %zu equations for %zu unknowns; use --method qr, "
        "or --compare square with a held fundamental",
        hci_method_name(wanted), s->rows, s->unknowns);
}

static hci_status square_solve(const hci_harmonic_system *s, hci_method method, double *x, double *condition,
                               hci_note *note)
{
    if (method == HCI_METHOD_LU) return dense_lu(s, x, condition, note);
    return hci_sparse_lu_solve(&s->u, s->h, 2, x, condition, note);
}

/* LU of a square system by the method named, or UMFPACK. *is_done: false where the orthogonal solve is to be
 * tried instead, which is only done where no method was named. */
static hci_status try_square(const hci_harmonic_system *system, hci_method wanted, double *x, hci_solution *s,
                             bool *is_done, hci_note *note)
{
    const bool is_free = wanted == HCI_METHOD_AUTO;
    hci_status status;
    s->method = is_free ? HCI_METHOD_UMFPACK : wanted;
    s->rank = system->rows;
    status = square_solve(system, s->method, x, &s->condition, note);
    *is_done =
        !is_free || (status && status != HCI_ERROR_SINGULAR) || (!status && s->condition <= WORST_CONDITION);
    if (status == HCI_ERROR_SINGULAR && !is_free)
        hci_note_set(note, status, "method %s: U is singular; use --method qr", hci_method_name(wanted));
    return status;
}

static hci_status orthogonal_solve(const hci_harmonic_system *system, double *x, hci_solution *s,
                                   hci_note *note)
{
    hci_sparse_rank found;
    const hci_status status = hci_harmonic_system_solve(system, x, &found, note);
    s->rank = found.rank;
    s->condition = found.condition;
    return status;
}

/* LU where the system is square and regular, the orthogonal solve elsewhere; a method that the user names is
 * used as it is. */
static hci_status solve_system(const hci_harmonic_system *system, hci_method wanted, double *x,
                               hci_solution *s, hci_note *note)
{
    const bool is_square = system->rows == system->unknowns && system->rows > 0;
    bool is_done = false;
    hci_status status = check_shape(system, wanted, note);
    if (status) return status;
    if (is_square && wanted != HCI_METHOD_QR) status = try_square(system, wanted, x, s, &is_done, note);
    if (is_done) return status;
    s->method = HCI_METHOD_QR;
    return orthogonal_solve(system, x, s, note);
}

hci_status hci_linear_describe(const hci_task *t, const hci_answer *a, hci_solution *s, hci_note *note)
{
    hci_harmonic_system system;
    double *x;
    hci_status status =
        hci_harmonic_system_make(t, a->set.component, a->set.count, HCI_COMPARE_ALL, &system, note);
    if (status) return status;
    x = hci_memory_new(2 * system.unknowns, sizeof *x);
    status = x ? orthogonal_solve(&system, x, s, note) : hci_note_memory(note, NULL, "solving");
    s->rows = system.rows;
    s->unknowns = system.unknowns;
    s->method = HCI_METHOD_QR;
    hci_memory_free(x);
    hci_harmonic_system_release(&system);
    return status;
}

static hci_status solve_given(const hci_task *t, const hci_solve_options *o, hci_answer *a, hci_solution *s,
                              hci_note *note)
{
    hci_harmonic_system system;
    hci_status status = copy_given_set(o, a, note);
    if (!status)
        status = hci_harmonic_system_make(t, a->set.component, a->set.count, o->compare, &system, note);
    if (status) return status;
    s->rows = system.rows;
    s->unknowns = system.unknowns;
    status = solve_system(&system, o->method, a->x, s, note);
    hci_harmonic_system_release(&system);
    return status;
}

/* At most so many components, with the copper that the pointwise limit and the allowance leave. */
static hci_status choose_few(const hci_task *t, const hci_solve_options *o, const hci_component_set *only,
                             const hci_solution *s, hci_answer *a, hci_note *note)
{
    const double allowance = o->loss_allowance > 0.0 ? o->loss_allowance : DEFAULT_LOSS_ALLOWANCE;
    const double limit_A2 = s->limit_mean_square_A2;
    const hci_set_preference preference = {s->tolerance_Nm,
                                           isnan(limit_A2) ? HUGE_VAL : allowance * limit_A2};
    return hci_choose_few(t, only, o->choose_at_most, &preference, a, note);
}

hci_status hci_linear_answer(const hci_task *task, const hci_solve_options *options,
                             const hci_component_set *only, hci_answer *answer, hci_solution *solution,
                             hci_note *note)
{
    hci_solve_options given = *options;
    hci_status status;
    given.set = options->set ? options->set : only;
    given.method = options->set ? options->method : HCI_METHOD_QR;
    if (options->choose_at_most > 0)
        status = choose_few(task, options, only, solution, answer, note);
    else if (given.set)
        return solve_given(task, &given, answer, solution, note);
    else
        status = hci_choose_all(task, solution->tolerance_Nm, solution->limit_mean_square_A2, answer, note);
    return status ? status : hci_linear_describe(task, answer, solution, note);
}
