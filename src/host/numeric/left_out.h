/* Least squares with an expectation of each unknown, judged by groups of rows that are left out in turn.
 *
 * In: XᵀX, Xᵀy and yᵀy of each group (one recording, say), and how far from 0 each unknown is expected. Out:
 * the error that the solution from all other groups leaves in each group. Unlike the error of the fit it does
 * not fall just because there are more unknowns. */
#ifndef HCI_SRC_HOST_NUMERIC_LEFT_OUT_H
#define HCI_SRC_HOST_NUMERIC_LEFT_OUT_H

#include "host/numeric/normal_equations.h"

/* Groups of rows with the same columns. The normal equations belong to the caller. */
typedef struct {
    const hci_normal_equations *group;
    size_t count;
} hci_groups;

/* square: out, of each group: Σ (y − Xx)² with the x that makes
 *
 *     Σ (y − Xx)² over the other groups + Σ precision_k x_k²
 *
 * least; precision[k] >= 0, one over the expected variance of an unknown; INFINITY holds it at 0.
 * False when memory is out. O(groups·n³/3). */
bool hci_left_out_squares(const hci_groups *groups, const double *precision, double *square);

/* The same with the x from all groups. O(n³/3). */
bool hci_all_in_squares(const hci_groups *groups, const double *precision, double *square);
/* The sum of those. */
bool hci_all_in_square(const hci_groups *groups, const double *precision, double *sum);

/* fall: out, of each group, by how much the sum of the squares of all, with the x from all, falls without it.
 * It is the square that is left out, each row in units of what noise and the x from the others make it
 * uncertain by: far below that square where the others hardly tell what the group shows. O(groups·n³/3). */
bool hci_left_out_falls(const hci_groups *groups, const double *precision, double *fall);

#endif
