/* A co-energy that is a polynomial in the rotor-frame currents, and all that follows from it:
 *
 *     W' = c f(θ) g(i_d, i_q)      f = sin nθ or cos nθ      g = i_d^a i_q^b
 *
 * At constant phase currents di_d/dθ = i_q and di_q/dθ = −i_d, so with R g = i_q ∂g/∂i_d − i_d ∂g/∂i_q
 *
 *     T = ∂W'/∂θ_m = p c (f' g + f R g)      ∂T/∂θ_m = p² c (f'' g + 2 f' R g + f R² g)
 *
 * Every such term conserves energy by construction, whatever its coefficient. */
#ifndef HCI_CORE_EFFECT_COENERGY_H
#define HCI_CORE_EFFECT_COENERGY_H

#include "effect_room.h"

typedef struct {
    double order;
    bool cosine;
    int d, q; /* powers a, b */
} hci_coenergy_term;

/* Adds weight × the torque, its derivatives and ∂²W'/∂i² for c = 1; returns the torque for c = 1. The
 * zero-sequence current has no part in it. */
double hci_coenergy_add(hci_effect_torque *sum, double weight, const hci_coenergy_term *term, int pole_pairs,
                        const hci_sample *truth);

#endif
