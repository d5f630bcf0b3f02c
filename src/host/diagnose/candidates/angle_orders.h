/* At which orders of the turn the angle could be read wrong.
 *
 * In: the residual r of all runs with its variance. An angle that is read as θ_m + δ(θ_m) has the model
 * predict ∂T/∂θ_m δ too much at constant phase currents, so that δ = A cos kθ_m + B sin kθ_m lowers χ² by
 *
 *     Δχ²(k) = 2 |Σ w r g exp(jkθ_m)|² / Σ w g²,     w = 1/σ²,  g = ∂T/∂θ_m
 *
 * where one order of torque stands on both sides of all orders of g at once. Out: those k that stand out, and
 * where the torque with the currents and the cogging torque do not ask for two different δ; the strongest
 * first. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_ANGLE_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_ANGLE_ORDERS_H

#include "host/diagnose/candidates/candidates.h"

enum { HCI_ANGLE_ORDERS = 6 };

typedef struct {
    double order[HCI_ANGLE_ORDERS]; /* electrical */
    size_t count;
} hci_angle_orders;

/* stride, resolved: only multiples of so many periods in a mechanical turn, and electrical orders up to that
 * one. False when memory is out. O(samples·orders). */
bool hci_angle_orders_find(const hci_candidates_source *source, size_t stride, double resolved,
                           hci_angle_orders *found);

#endif
