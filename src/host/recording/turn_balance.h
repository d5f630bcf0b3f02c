/* J dω/dt = k i_q + T(θ) of slow turns, order by order: what of the torque that follows the angle the current
 * answers, and what the inertia. */
#ifndef HCI_SRC_HOST_RECORDING_TURN_BALANCE_H
#define HCI_SRC_HOST_RECORDING_TURN_BALANCE_H

#include "host/recording/turn_ways.h"

/* The inertia for which T is the same in all directions and runs, by least squares over the orders: 0 where
 * they do not tell it within a tenth, or where it leaves half or more of what their currents differ by.
 * std_error: out, may be NULL; kg·m², of how the ways agree. O(ways·orders). */
double hci_balance_inertia(const hci_turn_ways *ways, size_t count, double torque_constant_Nm_per_A,
                           double *std_error);

/* Between which inertias the two directions of one run can agree on T, whatever noise and torques of other
 * kinds are in their accelerations and currents: from the slope of the currents over the accelerations, which
 * noise of these makes smaller, to that of the other regression, which noise of the currents makes larger;
 * three standard errors beyond. False: they have too little in common to tell. */
bool hci_balance_bounds(const hci_turn_ways *ways, double torque_constant_Nm_per_A, double *least_kgm2,
                        double *most_kgm2);

/* Whether what accelerates may be more than a tenth of T in a rotor as they are: one that swings at 20 Hz in
 * its own cogging torque, J = T n/(2π·20 Hz)² at n events a turn. */
bool hci_balance_needs_inertia(const hci_turn_ways *ways);

/* The inertia that takes a tenth of the torque that the current makes; INFINITY where nothing accelerates. */
double hci_balance_limit(const hci_turn_ways *ways, double torque_constant_Nm_per_A);

#endif
