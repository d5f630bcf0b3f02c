/* The noise of each segment, which weights its rows in a fit.
 *
 * In: a residual. Out: an autoregression for each long segment, from the spectrum between the orders of the
 * turn; for short segments one white noise from what they leave together, with the degrees of freedom that
 * the parameters take. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_NOISE_ESTIMATE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_NOISE_ESTIMATE_H

#include "host/diagnose/reading/regression.h"

/* Sets the noise of each segment in use from the residual of a model with so many parameters: where a segment
 * is long enough from its spectrum between the orders, otherwise from what all short ones leave. floor_Nm:
 * rms of white noise that is added. HCI_ERROR_MEMORY. */
hci_status hci_regression_noise_estimate(const hci_regression *regression, const double *residual_Nm,
                                         size_t parameters, double floor_Nm, hci_note *note);

#endif
