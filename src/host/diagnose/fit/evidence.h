/* How well a machine with effects describes recordings: residuals, their noise, and weighted normal
 * equations.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_EVIDENCE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_EVIDENCE_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/prepare/binned_samples.h"
#include "host/numeric/noise.h"
#include "host/numeric/normal_equations.h"

typedef struct {
    const hci_machine *machine;
    const hci_effects *declared; /* those that the machine has already */
    const hci_binned_samples *samples;
    const hci_run *runs;
    const bool *use;         /* of each run */
    bool raw;                /* readings as they are, not smoothed */
    hci_noise *noise;        /* of each segment */
    double *sum_deviation_A; /* of each run: noise of i_a + i_b + i_c; NAN where that says nothing */
} hci_regression;

/* The segment of a run in use that follows `after` (NULL: the first one); NULL behind the last. */
const hci_segment *hci_regression_next(const hci_regression *regression, const hci_segment *after);
hci_noise *hci_regression_noise(const hci_regression *regression, const hci_segment *segment);

/* Measured less modelled torque of each sample of the runs in use, others 0: residual_Nm[samples].
 * HCI_ERROR_MEMORY. O(samples·terms). */
hci_status hci_regression_residual(const hci_regression *regression, const hci_effects *effects,
                                   double *residual_Nm, hci_note *note);

/* Sets the noise of each segment in use from the residual of a model with so many parameters: where a segment
 * is long enough from its spectrum between the orders, otherwise from what all short ones leave. floor_Nm:
 * rms of white noise that is added. HCI_ERROR_MEMORY. */
hci_status hci_regression_noise_estimate(const hci_regression *regression, const double *residual_Nm,
                                         size_t parameters, double floor_Nm, hci_note *note);

/* Normal equations with a column for each term of the candidates that are in (or of all of them), at their
 * present values: rows are torques and, where they say something, sums of the phase currents. On failure
 * *normal is empty. HCI_ERROR_MEMORY. O(samples·columns²). */
hci_status hci_regression_normal(const hci_regression *regression, const hci_candidates *candidates, bool all,
                                 hci_normal *normal, hci_note *note);

/* What x·y, whose sum is 0 at the solution, scatters over blocks of the recordings. Start with {0}. */
typedef struct {
    double *square; /* Σ over blocks of (Σ xy)(Σ xy)ᵀ: [n][n], and behind it n of work */
    size_t blocks;
} hci_scatter;

/* The same with the scatter, of the candidates that are in. Free scatter->square. On failure both are empty.
 */
hci_status hci_regression_scatter(const hci_regression *regression, const hci_candidates *candidates,
                                  hci_normal *normal, hci_scatter *scatter, hci_note *note);

#endif
