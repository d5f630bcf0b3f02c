/* In: where the method stands; out: the step to where the conditions of Karush, Kuhn and Tucker hold of what
 * is linear, by the Schur complement of the Hessian. */
#include "host/limit/newton_step.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"
#include "host/limit/newton_columns.h"

enum {
    REFINEMENTS = 2,
    MOST_SETS = 30, /* of constraints that act, in one step */
};

#define LONGEST 0.3 /* step as a share of the currents with which it was not near enough */

/* Multipliers of the columns that are kept: ∇cᵀH⁻¹∇c λ = c − ∇cᵀH⁻¹∇f. few: ∇cᵀH⁻¹∇f of every column. */
static bool solve_kept(hci_newton *w, size_t count, double *weight)
{
    const hci_newton_columns *a = &w->act;
    for (size_t q = 0; q < count; ++q) {
        const double *g = a->gradient + w->kept[q] * w->n;
        weight[q] = a->beyond[w->kept[q]] - w->few[w->kept[q]];
        for (size_t p = q; p < count; ++p)
            w->gram[p + q * count] = hci_vector_dot(w->n, a->solved + w->kept[p] * w->n, g);
    }
    if (hci_cholesky_factor(count, w->gram)) return false;
    hci_cholesky_solve(count, w->gram, weight);
    return true;
}

/* Leaves out constraints that would pull, until none does; weights of the columns are then those of this
 * step. */
static bool choose_columns(hci_newton *w)
{
    hci_newton_columns *a = &w->act;
    double *weight = w->few + a->count;
    size_t count = a->count, left = 0;
    for (size_t q = 0; q < count; ++q)
        w->kept[q] = q;
    for (int k = 0; k < MOST_SETS; ++k, count = left) {
        if (!solve_kept(w, count, weight)) return false;
        left = 0;
        for (size_t q = 0; q < count; ++q)
            if (a->is_equation[w->kept[q]] || weight[q] >= 0.0) w->kept[left++] = w->kept[q];
        if (left == count) break;
    }
    w->keeps = count;
    memset(a->weight, 0, a->count * sizeof *a->weight);
    for (size_t q = 0; q < count; ++q)
        a->weight[w->kept[q]] = weight[q];
    return left == count;
}

/* out = H u, of the lower triangle */
static void times_hessian(const hci_newton *w, const double *u, double *out)
{
    const size_t n = w->n;
    memset(out, 0, n * sizeof *out);
    for (size_t j = 0; j < n; ++j) {
        const double *column = w->hessian + j * n;
        hci_vector_add(n - j, u[j], column + j, out + j);
        out[j] += hci_vector_dot(n - j - 1, column + j + 1, u + j + 1);
    }
}

/* What rounding leaves of H dx + Σ λ∇c = −∇f and ∇cᵀdx = −c is solved for again. */
static void refine(hci_newton *w, const double *f, double *dx)
{
    const size_t n = w->n;
    hci_newton_columns *a = &w->act;
    double *lack = w->around, *weight = w->few + a->count;
    times_hessian(w, dx, lack);
    for (size_t j = 0; j < n; ++j)
        lack[j] = -lack[j] - f[j];
    for (size_t q = 0; q < w->keeps; ++q)
        hci_vector_add(n, -a->weight[w->kept[q]], a->gradient + w->kept[q] * n, lack);
    for (size_t q = 0; q < w->keeps; ++q) {
        const size_t k = w->kept[q];
        weight[q] = a->beyond[k] + hci_vector_dot(n, a->gradient + k * n, dx) +
                    hci_vector_dot(n, a->solved + k * n, lack);
    }
    hci_cholesky_solve(w->keeps, w->gram, weight);
    for (size_t q = 0; q < w->keeps; ++q) {
        a->weight[w->kept[q]] += weight[q];
        hci_vector_add(n, -weight[q], a->gradient + w->kept[q] * n, lack);
    }
    hci_cholesky_solve(n, w->factor, lack);
    hci_vector_add(n, 1.0, lack, dx);
}

/* x += dx = −H⁻¹(∇f + Σ λ∇c). f, solved_f: ∇f, H⁻¹∇f. */
static void move(hci_newton *w, const double *f, const double *solved_f)
{
    double *dx = w->around + w->n, size = 0.0;
    for (size_t j = 0; j < w->n; ++j)
        dx[j] = -solved_f[j];
    for (size_t q = 0; q < w->act.count; ++q)
        hci_vector_add(w->n, -w->act.weight[q], w->act.solved + q * w->n, dx);
    for (int k = 0; k < REFINEMENTS; ++k)
        refine(w, f, dx);
    for (size_t j = 0; j < w->n; ++j)
        size = fmax(size, fabs(w->x[j]));
    w->moved = fabs(dx[hci_vector_largest(w->n, dx)]) / fmax(size, 1e-300);
    hci_vector_add(w->n, 1.0, dx, w->x);
}

static void keep_weights(hci_newton *w)
{
    for (size_t k = 0; k < w->peaks; ++k)
        w->peak[k].weight = 0.0;
    memset(w->rest_weight, 0, w->build.rows * sizeof *w->rest_weight);
    for (size_t q = 0; q < w->act.count; ++q) {
        const size_t row = w->act.row[q];
        if (row < w->peaks)
            w->peak[row].weight = w->act.weight[q];
        else if (row < w->peaks + w->build.rows)
            w->rest_weight[row - w->peaks] = w->act.weight[q];
    }
}

hci_status hci_newton_step(hci_newton *w)
{
    const size_t n = w->n;
    hci_newton_columns *a = &w->act;
    double *f = w->slope, *solved_f = f + n;
    const hci_status status = hci_newton_linearise(w, f);
    if (status || w->has_failed) return status;
    memcpy(solved_f, f, n * sizeof *f);
    hci_cholesky_solve(n, w->factor, solved_f);
    memcpy(a->solved, a->gradient, a->count * n * sizeof *a->solved);
    for (size_t q = 0; q < a->count; ++q) {
        hci_cholesky_solve(n, w->factor, a->solved + q * n);
        w->few[q] = hci_vector_dot(n, a->solved + q * n, f);
    }
    w->has_failed = !choose_columns(w);
    if (w->has_failed) return HCI_OK;
    move(w, f, solved_f);
    keep_weights(w);
    w->has_failed = !(w->moved < LONGEST);
    return HCI_OK;
}
