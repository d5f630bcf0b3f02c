/* The smallest worst order on a given set of components. */
#ifndef HCI_SRC_HOST_SOLVE_MINIMAX_H
#define HCI_SRC_HOST_SOLVE_MINIMAX_H

#include "host/solve/set_cost.h"

typedef struct {
    const hci_harmonic_system *system; /* of the set */
    const hci_component_set *set;
    double mean_Nm; /* wanted mean torque, at which errors are measured */
    double ridge;   /* ρ: price of copper, in the unit of UᵀU */
    const hci_set_preference *preference;
} hci_minimax;

/* Multiplies the row of the mean torque by ten, so that a small set does not trade it for less ripple. */
void hci_minimax_weight_mean(hci_harmonic_system *system);

/* Doubles of workspace that hci_minimax_solve needs. */
size_t hci_minimax_workspace(const hci_harmonic_system *system);

/* The best x (out, unknowns × 2) that is met while the largest errors are made equal, and its cost.
 * HCI_ERROR_NUMERIC when ρ is too small for the normal equations. O(60 (unknowns³/6 + unknowns · nonzeros)).
 */
hci_status hci_minimax_solve(const hci_minimax *problem, double *workspace, double *x, hci_set_cost *cost);

#endif
