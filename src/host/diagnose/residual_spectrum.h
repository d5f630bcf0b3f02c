/* The residual by order, as it is written to residual_spectrum.csv.
 *
 * In: measured less modelled torque before and after the correction. Out: one line for each run and order of
 * the mechanical turn whose amplitude 2/n |Σ r exp(−jkθ)| stands out of what noise alone makes. */
#ifndef HCI_SRC_HOST_DIAGNOSE_RESIDUAL_SPECTRUM_H
#define HCI_SRC_HOST_DIAGNOSE_RESIDUAL_SPECTRUM_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/reading/regression.h"

/* What is transformed. */
typedef struct {
    const double *before_Nm, *after_Nm; /* residual of each sample, without and with the correction */
    const double *noise_Nm;             /* rms for each run */
} hci_residuals;

/* lines: out, by run and order, to be freed; NULL on failure. HCI_ERROR_MEMORY. O(samples·orders). */
hci_status hci_residual_spectrum_make(const hci_regression *regression, const hci_residuals *residuals,
                                      hci_residual_line **lines, size_t *count, hci_note *note);

#endif
