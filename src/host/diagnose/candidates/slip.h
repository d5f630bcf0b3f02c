/* Whether what a model makes of the declared cogging torque is what a slip makes of it.
 *
 * A cogging torque of its own is beside the declared one, or another share of it. A wrong sign of torque or
 * angle, the other direction and another zero of the angle leave every amplitude as it is declared:
 *
 *     T(θ) = ± Σ S sin n(±θ + δ) + C cos n(±θ + δ).
 *
 * Another number of pole pairs, and another motor, leave nothing at the declared orders; the former has every
 * amplitude at another order, the true pole pairs over the declared ones times its own. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_SLIP_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_SLIP_H

#include "host/diagnose/candidates/candidates.h"

/* What it looks like, in words; NULL: like none, or nothing is declared. held: the model is of currents that
 * hold the shaft, and not of torques without a current. Static. */
const char *hci_slip_of_cogging(const hci_machine *machine, const hci_candidates *model, bool held);

/* The same of a torque with the opposite sign. */
const char *hci_slip_of_load(void);

/* The same of a torque without its sign: none of the samples is below zero, where the machine's is, and the
 * size of that is what was measured. residual_Nm: of each sample, of the machine as declared. runs, use: of
 * each. */
const char *hci_slip_of_size(const hci_binned_samples *samples, const hci_run *runs, const bool *use,
                             const double *residual_Nm);

#endif
