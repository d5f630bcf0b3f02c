/* The smallest worst order on a given set of components. */
#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/solve/choose.h"

/* Lawson's iteration: least squares with weights that grow where the error is largest, until the largest
 * errors are level. The mean is held ten times tighter than the rest, so that a small set does not trade it
 * for less ripple. */
enum { LAWSON_STEPS = 60, MEAN_TIGHTER = 10 };

/* Normal equations (Uᵀ W U + ρI) x = Uᵀ W h for both columns of h, solved in place of x. g: unknowns². */
static hci_status weighted_solve(const hci_harmonic_system *b, const double *row_weight, double ridge,
                                 double *g, double *x)
{
    const size_t n = b->unknowns;
    const hci_sparse *u = &b->u;
    double *column = x + 2 * n; /* one dense weighted column of U, in the room behind x */
    for (size_t j = 0; j < n; ++j) {
        for (size_t i = 0; i < b->rows; ++i)
            column[i] = 0.0;
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k)
            column[u->row[k]] = u->value[k] * row_weight[u->row[k]];
        for (size_t i = j; i < n; ++i) {
            double sum = i == j ? ridge : 0.0;
            for (int64_t k = u->column_start[i]; k < u->column_start[i + 1]; ++k)
                sum += u->value[k] * column[u->row[k]];
            g[i + j * n] = sum;
        }
        x[j] = x[n + j] = 0.0;
        for (size_t i = 0; i < b->rows; ++i) {
            x[j] += column[i] * b->h[i];
            x[n + j] += column[i] * b->h[b->rows + i];
        }
    }
    if (hci_cholesky_factor(n, g)) return HCI_ERROR_NUMERIC;
    hci_cholesky_solve(n, g, x);
    hci_cholesky_solve(n, g, x + n);
    return HCI_OK;
}

/* Multiplies each order's weight by its share of the largest error and brings the mean weight back to 1. */
static void lawson_update(const hci_harmonic_system *b, const double *r, double worst, double *order_weight)
{
    double sum = 0.0;
    for (size_t k = 0; k < b->order_count; ++k) {
        order_weight[k] *= hci_residual_amplitude_Nm(b, r, k) / worst + 1e-9;
        sum += order_weight[k];
    }
    for (size_t k = 0; k < b->order_count; ++k)
        order_weight[k] *= (double)b->order_count / sum;
}

static void spread_weights(const hci_harmonic_system *b, const double *order_weight, double *row_weight)
{
    for (size_t k = 0; k < b->order_count; ++k) {
        const size_t row = hci_orders_row(b->order, b->order_count, k);
        row_weight[row] = order_weight[k];
        if (b->order[k] >= HCI_ORDER_TOLERANCE) row_weight[row + 1] = order_weight[k];
    }
}

void hci_minimax_weight_mean(hci_harmonic_system *b)
{
    if (b->order_count == 0 || b->order[0] >= HCI_ORDER_TOLERANCE) return;
    b->h[0] *= MEAN_TIGHTER;
    b->h[b->rows] *= MEAN_TIGHTER;
    for (int64_t k = 0; k < b->u.column_start[b->unknowns]; ++k)
        if (b->u.row[k] == 0) b->u.value[k] *= MEAN_TIGHTER;
}

size_t hci_minimax_workspace(const hci_harmonic_system *b)
{
    return b->unknowns * b->unknowns + 2 * b->unknowns + 3 * b->rows + b->order_count;
}

hci_status hci_minimax_solve(const hci_harmonic_system *b, const hci_component_set *set, double mean_Nm,
                             double ridge, const hci_set_preference *preference, double *room, double *best_x,
                             hci_set_cost *best)
{
    const size_t n = b->unknowns;
    double *g = room, *x = g + n * n, *r = x + 2 * n + b->rows, *row_weight = r + b->rows,
           *order_weight = row_weight + b->rows;
    *best = (hci_set_cost){HUGE_VAL, HUGE_VAL};
    for (size_t k = 0; k < b->order_count; ++k)
        order_weight[k] = 1.0;
    for (int step = 0; step < LAWSON_STEPS; ++step) {
        hci_set_cost worth;
        spread_weights(b, order_weight, row_weight);
        if (weighted_solve(b, row_weight, ridge, g, x)) return HCI_ERROR_NUMERIC;
        worth.worst_Nm = hci_worst_error_Nm(b, x, mean_Nm, r);
        worth.mean_square_A2 = hci_coordinates_mean_square_A2(set, x, mean_Nm);
        if (step == 0 || hci_set_cost_less(preference, worth, *best)) {
            *best = worth;
            memcpy(best_x, x, 2 * n * sizeof *x);
        }
        if (worth.worst_Nm <= 0.0) break;
        lawson_update(b, r, worth.worst_Nm, order_weight);
    }
    return HCI_OK;
}
