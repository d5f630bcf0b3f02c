/* The linear equations of one step of a conic program: (P + GᵀW⁻²G) dx = right side, by Cholesky with
 * refinement. */
#ifndef HCI_SRC_HOST_CONIC_DIRECTION_H
#define HCI_SRC_HOST_CONIC_DIRECTION_H

#include "host/conic/state.h"

/* Factors P + GᵀW⁻²G of the scaling, with as little added to the diagonal as it takes; false where nothing
 * does. */
bool hci_cone_normal_factor(hci_cone_state *solver);

/* (P + GᵀW⁻²G) dx = right */
void hci_cone_normal_solve(const hci_cone_state *solver);

/* dx, ds, dz of P dx + Gᵀdz = −share·rx, G dx + ds = −share·rs, λ∘(W dz + W⁻¹ds) = d. d: in solver->ds, which
 * becomes ds. refinements: how often what rounding leaves of the first equation is solved for again. */
void hci_cone_direction(hci_cone_state *solver, double share, int refinements);

#endif
