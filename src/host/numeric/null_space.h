/* All solutions of linear equations: A x = b is met by x = point + basis·y for every y. */
#ifndef HCI_SRC_HOST_NUMERIC_NULL_SPACE_H
#define HCI_SRC_HOST_NUMERIC_NULL_SPACE_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/status.h"

/* Start with {0}. */
typedef struct {
    size_t unknowns, free; /* free: columns of the basis */
    double *point;         /* unknowns; of least norm, and where A x = b has no solution of least error */
    double *basis;         /* unknowns × free, orthonormal, column-major */
    double error;          /* largest |A x − b|, as a share of the largest |b| */
} hci_null_space;

/* a: equalities × unknowns, column-major, rows that depend on one another allowed; no rows: every x.
 * HCI_ERROR_MEMORY, without a note. To be released in any case. O(unknowns² · equalities). */
hci_status hci_null_space_make(size_t equalities, size_t unknowns, const double *a, const double *b,
                               hci_null_space *space);
void hci_null_space_release(hci_null_space *space);

/* out = point + basis·y. */
void hci_null_space_point(const hci_null_space *space, const double *y, double *out);

#endif
