/* Sparse solves. sparse.c is the only file that includes SuiteSparse. */
#ifndef HCI_SRC_HOST_NUMERIC_SPARSE_H
#define HCI_SRC_HOST_NUMERIC_SPARSE_H

#include <stddef.h>
#include <stdint.h>

#include "hci/host/base/note.h"

/* A matrix in compressed columns, as hci_system_sparse makes it; the arrays are borrowed. */
typedef struct {
    size_t rows, columns;
    int64_t *column_start, *row;
    double *value;
} hci_sparse;

/* Solves A X = B by UMFPACK's LU. b: rows × right_sides, x: columns × right_sides, column-major. condition:
 * out, estimate. HCI_ERROR_SINGULAR (without a note) when A is singular to working precision,
 * HCI_ERROR_MEMORY, HCI_ERROR_NUMERIC. */
hci_status hci_sparse_lu_solve(const hci_sparse *a, const double *b, size_t right_sides, double *x,
                               double *condition, hci_note *note);

/* Rank and condition of a matrix, from its orthogonal factors. */
typedef struct {
    size_t rank;
    double condition; /* estimate of the ratio of the largest to the smallest non-zero singular value; NAN:
                         rank 0 */
} hci_sparse_rank;

/* The least-squares solution of least norm for any shape and rank, by two SPQR factorisations. found: out. */
hci_status hci_sparse_qr_solve(const hci_sparse *a, const double *b, size_t right_sides, double *x,
                               hci_sparse_rank *found, hci_note *note);

#endif
