/* Which runs have a load that the others do not reach. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_LOAD_RANGE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_LOAD_RANGE_H

#include "host/diagnose/reading/regression.h"

/* Whether the mean currents (i_d, i_q) of a run in use lie outside of those of all others and of none, by
 * more than a tenth of the largest current: a power series in the currents, chosen where the others are, says
 * nothing of it. Runs whose currents vary, and direct ones, have no such place: false. O(runs · directions).
 */
bool hci_run_is_beyond(const hci_regression *regression, size_t run);

/* How many of so many runs are asked what others say of them: those that are not beyond; where too few would
 * be left, all, and none is marked. */
size_t hci_asked_count(bool *beyond, size_t count);

#endif
