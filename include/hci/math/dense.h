/* Dense linear algebra without a heap: LU with partial pivoting for square systems, a complete orthogonal
 * decomposition for rank-deficient and rectangular ones, Cholesky for normal equations.
 *
 * Matrices are column-major: element (i, j) of an m×n matrix a is a[i + j·m]. Vectors and workspace are the
 * caller's. */
#ifndef HCI_MATH_DENSE_H
#define HCI_MATH_DENSE_H

#include <stddef.h>

#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* P A = L U in place. a: in/out, n×n; pivot: out, n entries, row exchanged with row k at step k.
 * HCI_ERROR_SINGULAR when a pivot is exactly zero, HCI_ERROR_NOT_FINITE when a is not finite or the
 * elimination overflows; a is then undefined. O(n³) by halves, which suits any cache; the call depth is
 * log2(n). */
hci_status hci_lu_factor(size_t n, double *a, size_t *pivot);

/* Solves A x = b from the factors. x: in b, out x, n entries. O(n²). */
void hci_lu_solve(size_t n, const double *lu, const size_t *pivot, double *x);

/* Solves Aᵀ x = b from the factors. O(n²). */
void hci_lu_solve_transposed(size_t n, const double *lu, const size_t *pivot, double *x);

/* Largest column sum of |a|: the 1-norm of an m×n matrix; NaN where an entry is NaN. */
double hci_norm_1(size_t m, size_t n, const double *a);

/* Estimate of the 1-norm condition number ‖A‖₁‖A⁻¹‖₁ (a lower bound, rarely below a third of it; Higham
 * 1988). norm_1: of the unfactored A; work: 2n doubles. Infinite where A⁻¹ overflows; 1 for n = 0. O(n²). */
double hci_lu_condition(size_t n, const double *lu, const size_t *pivot, double norm_1, double *work);

/* Iterative refinement of x until the componentwise backward error stops falling; at most 5 steps. A step
 * that would raise the error is not taken.
 * a: the unfactored n×n matrix; b: right-hand side; x: in/out; work: n doubles. Returns the backward error
 * max_i |b − A x|_i / (|A||x| + |b|)_i. O(n²) a step. */
double hci_lu_refine(size_t n, const double *a, const double *lu, const size_t *pivot, const double *b,
                     double *x, double *work);

/* Doubles of workspace that hci_orthogonal_factor needs for an m×n matrix. */
size_t hci_orthogonal_workspace(size_t m, size_t n);

/* A complete orthogonal decomposition, in arrays of the caller. */
typedef struct {
    size_t m, n;    /* rows and columns of A */
    double *a;      /* m×n, column-major: in A, out the factors */
    size_t *column; /* out, n entries: the permutation of the columns */
    double *work;   /* hci_orthogonal_workspace(m, n) doubles, kept with a for the solve */
    size_t rank;    /* out */
} hci_orthogonal;

/* A P = Q [T 0; 0 0] Zᵀ of an m×n matrix: the least-squares solution of least norm for every shape and rank.
 * relative_tolerance: a column whose remaining norm is below it times the largest first norm counts as
 * dependent; 0 picks 2⁻⁵²·max(m, n). condition: out, may be NULL: |R_11|/|R_rr|, a cheap estimate (1 at rank
 * 0). Elements near the ends of the range of a double are no
 * danger: the factors are those of A times a power of two. HCI_ERROR_NOT_FINITE when a is not finite. O(m n
 * min(m, n)). */
hci_status hci_orthogonal_factor(hci_orthogonal *q, double relative_tolerance, double *condition);

/* x: out, n entries: minimises ‖A x − b‖ and then ‖x‖. b: in, m entries, overwritten by Qᵀb.
 * work: n doubles. O(m n). */
void hci_orthogonal_solve(const hci_orthogonal *q, double *b, double *x, double *work);

/* A = L Lᵀ of a symmetric positive definite n×n matrix in its lower triangle, in place; the upper is not
 * touched. HCI_ERROR_SINGULAR when it is not positive definite to working precision (a pivot below n·2⁻⁵² of
 * its diagonal element) or not finite. O(n³). */
hci_status hci_cholesky_factor(size_t n, double *a);

/* Solves A x = b from the factor. x: in b, out x, n entries. O(n²). */
void hci_cholesky_solve(size_t n, const double *l, double *x);

#ifdef __cplusplus
}
#endif

#endif
