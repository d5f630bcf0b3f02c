/* Whether a rotor that looks alike both ways round could make what was found of the iron. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_MIRROR_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_MIRROR_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/dataset.h"

/* Whether candidate k is in, of the mean of the co-energy, makes a torque that keeps its sign when i_q turns
 * its own, and all such torques together are larger, at the mean currents of the runs in use, than those of
 * the mean that turn with i_q. Those are none of a rotor that is its own mirror image; of one with skew poles
 * they tell by how much its axis is turned: as much is an eighth of a turn. false beside declared
 * inductances, which may make the other part. O(candidates·runs). */
bool hci_mirror_is_broken(const hci_regression *regression, const hci_candidates *candidates, size_t k);

#endif
