/* Samples of a free shaft that tell no torque, since it is at rest there.
 *
 * In: a run whose torque is inertia × acceleration. Out: which samples are at rest, or within a window of a
 * slope from one that is. Friction takes what it must there, up to what it can: acceleration 0 is no torque
 * 0.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_REST_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_REST_H

#include "hci/host/recording/run.h"

/* A shaft is at rest where its angle moves, over the window of the slope, by no more than the noise of the
 * angle, the steps of its encoder included. at_rest: out, [run->count]. All are false in other runs, and
 * where next to nothing would be left. O(samples). */
void hci_rest_find(const hci_run *run, bool *at_rest);

#endif
