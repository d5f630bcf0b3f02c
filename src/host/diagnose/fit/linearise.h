/* The fit linearised about the present values: rows y ≈ X·step, whitened, as normal equations.
 *
 * In: the residual y and the exact derivatives X of the predicted reading by each value. Out: G = XᵀX, Xᵀy
 * and yᵀy. Rows are torques in units of their noise; where all three phase currents were recorded and no
 * neutral is connected, their sum gives rows more (gains and offsets must explain it); a value that is
 * expected within a deviation d of 0 gives a row value/d. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_LINEARISE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_LINEARISE_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/reading/regression.h"
#include "host/numeric/normal_equations.h"

/* Normal equations with a column for each term of the candidates that are in (or of all of them), at their
 * present values: rows are torques and, where they say something, sums of the phase currents. On failure
 * *normal is empty. HCI_ERROR_MEMORY. O(samples·columns²). */
hci_status hci_regression_normal(const hci_regression *regression, const hci_candidates *candidates, bool all,
                                 hci_normal_equations *normal, hci_note *note);

/* What x·y, whose sum is 0 at the solution, scatters over blocks of the recordings. Start with {0}. */
typedef struct {
    double *square; /* Σ over blocks of (Σ xy)(Σ xy)ᵀ: [n][n], and behind it n of work */
    size_t blocks;
} hci_scatter;

/* The same with the scatter, of the candidates that are in. Free scatter->square. On failure both are empty.
 */
hci_status hci_regression_scatter(const hci_regression *regression, const hci_candidates *candidates,
                                  hci_normal_equations *normal, hci_scatter *scatter, hci_note *note);

#endif
