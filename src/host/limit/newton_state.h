/* Where Newton's method of a stage stands (newton.c), which its parts share. */
#ifndef HCI_SRC_HOST_LIMIT_NEWTON_STATE_H
#define HCI_SRC_HOST_LIMIT_NEWTON_STATE_H

#include "host/limit/build.h"

/* The top of a quantity next to its limit. */
typedef struct {
    hci_limit_point at;
    const hci_limit_grid *grid;
    double weight; /* multiplier, not negative */
} hci_newton_peak;

/* Constraints that act as columns: gradient, what the constraint is beyond 0, multiplier. */
typedef struct {
    double *gradient, *solved; /* n each: ∇c, H⁻¹∇c */
    double *beyond, *weight;
    bool *is_equation;
    size_t *row; /* of a peak its number; behind the peaks in the build; of an equation behind its rows */
    size_t count;
} hci_newton_columns;

typedef struct {
    const hci_limit_build *near;
    hci_limit_program program; /* without grids and points */
    hci_limit_build build;     /* its rows, which are those of no angle */
    size_t n, coordinates;
    hci_newton_peak *peak;
    size_t peaks;
    double *block, *x, *rest_weight, *hessian, *factor, *slope, *around, *row;
    hci_newton_columns act;
    double *gram, *few; /* few: 3·most */
    size_t *kept, keeps;
    double moved; /* by the last step, as a share of the currents */
    bool has_failed;
} hci_newton;

#endif
