/* A shaft that position or speed control turns so slowly that its current answers cogging torque and
 * friction, as in a holding test. */
#ifndef HCI_SRC_HOST_RECORDING_SLOW_TURN_H
#define HCI_SRC_HOST_RECORDING_SLOW_TURN_H

#include "hci/host/recording/run.h"

/* The most at which control follows cogging torque, up to some ten events a second: 20 rpm. */
#define HCI_SLOW_TURN_RAD_PER_S 2.1

/* Whether a run without a torque column is one. torque_Nm of the run is inertia × acceleration. T is the rms
 * of what varies in torque_constant·i_q: what varies in inertia × acceleration is less than T/5, so that the
 * current does not accelerate, and J ω²/2 of the rms speed is less than the work of T over one electrical
 * radian, so that a rotor without that current would have been stopped. A fast shaft under load has the
 * first, and not the second. O(samples). */
bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A);

/* Whether a run with an angle, a clock and a current turns at no more than 20 rpm. O(samples). */
bool hci_is_slow(const hci_run *run, int pole_pairs);

/* The same where the inertia is not known: a current, and half an electrical turn or more in each direction
 * at no more than 20 rpm. A shaft that another one turns so has no current. O(samples). */
bool hci_is_slow_turn_both_ways(const hci_run *run, int pole_pairs);

/* Takes torque_Nm of the run, inertia × acceleration, out of what torque_constant·i_q is, and says so. */
void hci_slow_turn_correct(hci_run *run, int pole_pairs, double torque_constant_Nm_per_A);

/* Takes the same i_q, in A, out of the current at every angle of the run. */
void hci_slow_turn_take_constant(hci_run *run, int pole_pairs, double iq_A);

/* Gives a run with an angle and without time and speed a slow speed of the sign in which the angle goes, and
 * remarks it. Nothing where a speed is known, or rows that go to and fro have no order. False when memory is
 * out. O(samples). */
bool hci_row_direction_set(hci_run *run);

/* So, but only where the angle goes forward in a tenth of the rows or more, and back in as many: a table of
 * one way has no speed. */
bool hci_row_direction_of_both_set(hci_run *run);

/* Leaves rows out of a run with time and angle, and says how many, in which a shaft that control turns slowly
 * waits, where friction takes of the current anything up to what it brakes with, or turns round, where
 * friction changes its sign and the shaft accelerates: its current does not answer cogging torque and
 * friction alone there. The way is cut where the shaft turns round, or waits as long as it takes for half an
 * electrical turn, at up to three places of the way (at more it goes in steps). From both ends of each part,
 * within half an electrical turn of the shaft, rows are left out up to the last in which its speed over a
 * twentieth of an electrical turn is not that of the rest of the part: away from it by more than a tenth and
 * three times the rms by which it varies there. Parts of less than two electrical turns stay as they are.
 * False: no memory. O(samples). */
bool hci_settled_rows_keep(hci_run *run, int pole_pairs);

/* Leaves the rows out that are marked. out: [count]. */
void hci_run_rows_leave(hci_run *run, const bool *out);

/* Leaves rows out of a free shaft, and says how many, in which it stands before it runs or after: within
 * eight times the noise of the angle of where it stands, but for those that slopes of the others need.
 * Nothing where hardly any would be left. False: no memory. O(samples). */
bool hci_rest_at_ends_leave(hci_run *run);

#endif
