/* What was found of the iron and no iron makes: a mean torque that keeps its sign with the load, and one that
 * grows faster than the current. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_UNLIKE_IRON_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_UNLIKE_IRON_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/dataset.h"

/* Whether candidate k is in, of the mean of the co-energy, makes a torque that keeps its sign when i_q turns
 * its own, and all such torques together are larger, at the mean currents of the runs in use, than those of
 * the mean that turn with i_q. Those are none of a rotor that is its own mirror image; of one with skew poles
 * they tell by how much its axis is turned: as much is an eighth of a turn. false beside declared
 * inductances, which may make the other part. O(candidates·runs). */
bool hci_mirror_is_broken(const hci_regression *regression, const hci_candidates *candidates, size_t k);

/* Whether candidate k is in, of a higher power of the currents in the mean of the co-energy, and all such
 * together make more torque per ampere at the largest recorded current along q than at small ones, by more
 * than 3 %. Iron that saturates makes less; current sensors that read large currents too small look like it.
 * false where no run has its current along q. O(candidates + runs). */
bool hci_iron_would_rise(const hci_regression *regression, const hci_candidates *candidates, size_t k);

#endif
