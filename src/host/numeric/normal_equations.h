/* Weighted least squares by normal equations in which columns come and go: the sweep operator. */
#ifndef HCI_SRC_HOST_NUMERIC_NORMAL_EQUATIONS_H
#define HCI_SRC_HOST_NUMERIC_NORMAL_EQUATIONS_H

#include <stdbool.h>
#include <stddef.h>

/* XᵀX, Xᵀy and yᵀy of rows that are weighted to a variance of 1. Start with {0}. */
typedef struct {
    size_t n;       /* columns */
    double *gram;   /* n×n, symmetric, both halves */
    double *moment; /* n */
    double square;  /* yᵀy */
    double rows;
} hci_normal_equations;

/* Zeros. False when memory is out, and then *normal is empty. */
bool hci_normal_equations_start(hci_normal_equations *normal, size_t n);
void hci_normal_equations_release(hci_normal_equations *normal);

/* Adds rows: x[row·n + column], y[rows]. Call hci_normal_equations_finish after the last. O(rows·n²/2). */
void hci_normal_equations_add(hci_normal_equations *normal, const double *x, const double *y, size_t rows);
void hci_normal_equations_finish(hci_normal_equations *normal);

/* A copy in which some columns are solved for. */
typedef struct {
    size_t n;
    double *a;        /* swept Gram matrix: inverse for columns that are in, Schur complement for the rest */
    double *b;        /* solution for columns that are in, remaining moment for the rest */
    double *diagonal; /* of the Gram matrix as it was */
    bool *in;
    double square; /* remaining sum of squares */
} hci_sweep;

/* False when memory is out, and then *sweep is empty. O(n²). */
bool hci_sweep_start(hci_sweep *sweep, const hci_normal_equations *normal);
void hci_sweep_copy(hci_sweep *to, const hci_sweep *from); /* of the same size */
void hci_sweep_release(hci_sweep *sweep);

/* Takes a column in. False when it depends on those that are in, to a share 1e-9 of its square; nothing is
 * changed then. O(n²). */
bool hci_sweep_in(hci_sweep *sweep, size_t column);

/* Takes it out again; nothing happens where it is not in. O(n²). */
void hci_sweep_out(hci_sweep *sweep, size_t column);

/* By how much the sum of squares would fall if `count` neighbouring columns that are out came in, or rise if
 * those that are in left; all of them in or all out, at most 8. Dependent columns add nothing. O(count³). */
double hci_sweep_reduction(const hci_sweep *sweep, size_t first, size_t count);

#endif
