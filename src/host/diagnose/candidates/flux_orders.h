/* At which fractions of the turn the magnets could be unequal.
 *
 * In: the residual r of all runs with its variance. With a flux 1 + M(θ_m) times what it should be, torque
 * with the currents is e·i (1 + M) and cogging T_cog (1 + 2M): for M of k periods in a turn, k below the pole
 * pairs, χ² falls by
 *
 *     Δχ² = 2 |Σ w r x exp(jkθ_m)|² / Σ w x²,     w = 1/σ²
 *
 * with x = e·i alone, 2 T_cog alone, and their sum. Out: those k at which the second stands out and the third
 * is nearly the sum of the others, so that the two have the same M; the strongest first. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_FLUX_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_FLUX_ORDERS_H

#include "host/diagnose/candidates/candidates.h"

enum { HCI_FLUX_ORDERS = 4 };

typedef struct {
    double order[HCI_FLUX_ORDERS]; /* electrical */
    size_t count;
    bool one_gain; /* e·i and T_cog are off by the same factor: a gain of the sensor, where magnets would make
                    * it twice as much of T_cog */
} hci_flux_orders;

/* has_turn: whether the angles tell where in the turn the rotor was. False when memory is out.
 * O(samples·pole pairs). */
bool hci_flux_orders_find(const hci_candidates_source *source, bool has_turn, hci_flux_orders *found);

#endif
