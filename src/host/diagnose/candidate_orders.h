/* The residual by order: one line for each order of the mechanical turn that stands out of the noise. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATE_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATE_ORDERS_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/evidence.h"

/* before_Nm, after_Nm: of each sample. noise_Nm: rms for each run. lines: out, by run and order, to be freed;
 * NULL on failure. HCI_ERROR_MEMORY. O(samples·orders). */
hci_status hci_residual_spectrum_make(const hci_regression *regression, const double *before_Nm,
                                      const double *after_Nm, const double *noise_Nm,
                                      hci_residual_line **lines, size_t *count, hci_note *note);

#endif
