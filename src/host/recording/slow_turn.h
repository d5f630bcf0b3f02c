/* A shaft that position or speed control turns so slowly that its current answers cogging torque and
 * friction, as in a holding test. */
#ifndef HCI_SRC_HOST_RECORDING_SLOW_TURN_H
#define HCI_SRC_HOST_RECORDING_SLOW_TURN_H

#include "hci/host/recording/run.h"

/* Whether a run without a torque column is one. torque_Nm of the run is inertia × acceleration. T is the rms
 * of what varies in torque_constant·i_q: what varies in inertia × acceleration is less than T/5, so that the
 * current does not accelerate, and J ω²/2 of the rms speed is less than the work of T over one electrical
 * radian, so that a rotor without that current would have been stopped. A fast shaft under load has the
 * first, and not the second. O(samples). */
bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A);

#endif
