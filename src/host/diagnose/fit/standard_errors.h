/* Standard errors where the residual is more correlated than the model of the noise has it.
 *
 * In: a fitted model. Out: the larger of the standard errors of the fit and those of the sandwich
 *
 *     G⁻¹ M G⁻¹,     M = Σ over blocks of (Σ x y)(Σ x y)ᵀ
 *
 * whose blocks are longer than anything in the noise is correlated (Liang and Zeger 1986). */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_STANDARD_ERRORS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_STANDARD_ERRORS_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

/* Raises the standard errors of the candidates that are in where the residual is more correlated than the
 * model of the noise has it: from the scatter of sums over blocks of the recordings. Nothing happens with few
 * recordings. HCI_ERROR_MEMORY. */
hci_status hci_regression_standard_errors(const hci_regression *regression, hci_candidates *candidates,
                                          hci_note *note);

#endif
