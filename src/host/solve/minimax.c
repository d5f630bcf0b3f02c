/* The smallest worst order on a given set of components. In: a harmonic system and a price of copper ρ; out:
 * the currents whose largest error of any order is smallest, as far as least squares can find them.
 *
 * Lawson's iteration (C. L. Lawson, 1961): min Σ w_k |error_k|² + ρ‖x‖² with weights w_k that grow in
 * proportion to the error at order k, until the largest errors are equal. */
#include "host/solve/minimax.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"

enum { STEPS = 60, MEAN_WEIGHT = 10 };

#define LEAST_WEIGHT 1e-9 /* factor of an order without error, lest it be forgotten */

/* Parts of the caller's workspace. */
typedef struct {
    double *gram;   /* unknowns² */
    double *x;      /* unknowns × 2 */
    double *column; /* rows: one weighted column of U, dense */
    double *r;      /* rows: residual */
    double *row_weight, *order_weight;
} parts;

static parts divide(const hci_harmonic_system *s, double *workspace)
{
    parts p;
    p.gram = workspace;
    p.x = p.gram + s->unknowns * s->unknowns;
    p.column = p.x + 2 * s->unknowns;
    p.r = p.column + s->rows;
    p.row_weight = p.r + s->rows;
    p.order_weight = p.row_weight + s->rows;
    return p;
}

size_t hci_minimax_workspace(const hci_harmonic_system *s)
{
    return s->unknowns * s->unknowns + 2 * s->unknowns + 3 * s->rows + s->order_count;
}

/* column = W U_:j */
static void weighted_column(const hci_harmonic_system *s, size_t j, const parts *p)
{
    const hci_sparse *u = &s->u;
    for (size_t i = 0; i < s->rows; ++i)
        p->column[i] = 0.0;
    for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
        p->column[u->row[k]] = u->value[k] * p->row_weight[u->row[k]];
}

/* Column j, from the diagonal on, of G = Uᵀ W U + ρI and row j of Uᵀ W h. */
static void normal_column(const hci_harmonic_system *s, size_t j, double ridge, const parts *p)
{
    const size_t n = s->unknowns;
    const hci_sparse *u = &s->u;
    for (size_t i = j; i < n; ++i) {
        double sum = i == j ? ridge : 0.0;
        for (int64_t k = u->column_start[i]; k < u->column_start[i + 1]; ++k)
            sum += u->value[k] * p->column[u->row[k]];
        p->gram[i + j * n] = sum;
    }
    p->x[j] = p->x[n + j] = 0.0;
    for (size_t i = 0; i < s->rows; ++i) {
        p->x[j] += p->column[i] * s->h[i];
        p->x[n + j] += p->column[i] * s->h[s->rows + i];
    }
}

/* (Uᵀ W U + ρI) x = Uᵀ W h for both columns of h. */
static hci_status weighted_solve(const hci_harmonic_system *s, double ridge, const parts *p)
{
    const size_t n = s->unknowns;
    for (size_t j = 0; j < n; ++j) {
        weighted_column(s, j, p);
        normal_column(s, j, ridge, p);
    }
    if (hci_cholesky_factor(n, p->gram)) return HCI_ERROR_NUMERIC;
    hci_cholesky_solve(n, p->gram, p->x);
    hci_cholesky_solve(n, p->gram, p->x + n);
    return HCI_OK;
}

/* Multiplies each order's weight by its share of the largest error and brings the mean weight back to 1. */
static void update_weights(const hci_harmonic_system *s, double worst_Nm, const parts *p)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        p->order_weight[k] *= hci_residual_amplitude_Nm(s, p->r, k) / worst_Nm + LEAST_WEIGHT;
        sum += p->order_weight[k];
    }
    for (size_t k = 0; k < s->order_count; ++k)
        p->order_weight[k] *= (double)s->order_count / sum;
}

/* Both rows of an order have its weight. */
static void spread_weights(const hci_harmonic_system *s, const parts *p)
{
    for (size_t k = 0; k < s->order_count; ++k) {
        const size_t row = hci_orders_row(s->order, s->order_count, k);
        p->row_weight[row] = p->order_weight[k];
        if (s->order[k] >= HCI_ORDER_TOLERANCE) p->row_weight[row + 1] = p->order_weight[k];
    }
}

void hci_minimax_weight_mean(hci_harmonic_system *s)
{
    if (s->order_count == 0 || s->order[0] >= HCI_ORDER_TOLERANCE) return;
    s->h[0] *= MEAN_WEIGHT;
    s->h[s->rows] *= MEAN_WEIGHT;
    for (int64_t k = 0; k < s->u.column_start[s->unknowns]; ++k)
        if (s->u.row[k] == 0) s->u.value[k] *= MEAN_WEIGHT;
}

hci_status hci_minimax_solve(const hci_minimax *m, double *workspace, double *x, hci_set_cost *best)
{
    const hci_harmonic_system *s = m->system;
    const parts p = divide(s, workspace);
    *best = (hci_set_cost){HUGE_VAL, HUGE_VAL};
    for (size_t k = 0; k < s->order_count; ++k)
        p.order_weight[k] = 1.0;
    for (int step = 0; step < STEPS; ++step) {
        hci_set_cost cost;
        spread_weights(s, &p);
        if (weighted_solve(s, m->ridge, &p)) return HCI_ERROR_NUMERIC;
        cost = hci_set_cost_of(s, m->set, p.x, m->mean_Nm, p.r);
        if (step == 0 || hci_set_cost_less(m->preference, cost, *best)) {
            *best = cost;
            memcpy(x, p.x, 2 * s->unknowns * sizeof *x);
        }
        if (cost.worst_Nm <= 0.0) break;
        update_weights(s, cost.worst_Nm, &p);
    }
    return HCI_OK;
}
