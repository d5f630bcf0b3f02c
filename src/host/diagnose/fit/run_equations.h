/* The normal equations of a model, run by run, in the values of its terms.
 *
 * In: a regression and a fitted model. Out: for each run in use XᵀX, Xᵀy and yᵀy of its rows, linearised
 * where the model stands and counted from the values of
 * the declared machine, so that runs can be left out by subtraction. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_RUN_EQUATIONS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_RUN_EQUATIONS_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/run_parts.h"
#include "host/numeric/left_out.h"

/* Start with {0}. */
typedef struct {
    hci_groups groups;         /* the runs in use in their order, or parts of them */
    hci_normal_equations *run; /* what groups stands for */
    bool *beyond;              /* of each group, whether its load is beyond those of all other runs */
    double *precision; /* of each column: one over the variance that is expected of its value; 0: any */
} hci_run_equations;

/* candidates: those that are in are the columns; what is expected of their values is in `precision` only. On
 * failure *equations is empty. few: as of hci_run_parts; where that is
 * more than HCI_LEAST_GROUPS, runs that are not alone stay whole. HCI_ERROR_MEMORY. O(samples·columns²). */
hci_status hci_run_equations_make(const hci_regression *regression, const hci_candidates *candidates,
                                  size_t few, hci_run_equations *equations, hci_note *note);
void hci_run_equations_release(hci_run_equations *equations);

#endif
