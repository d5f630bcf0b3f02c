/* Which runs have a load that the others do not reach, and whether all lie along one direction. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_LOAD_RANGE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_LOAD_RANGE_H

#include "host/diagnose/reading/regression.h"

/* Whether the mean currents (i_d, i_q) of a run in use lie outside of those of all others and of none, by
 * more than a tenth of the largest current: a power series in the currents, chosen where the others are, says
 * nothing of it. Runs whose currents vary, and direct ones, have no such place: false. O(runs · directions).
 */
bool hci_run_is_beyond(const hci_regression *regression, size_t run);

/* The angle by which all loads in use lead the q axis (atan2(-i_d, i_q), electrical), where it is the same
 * within 5 degrees; NAN: it differs, a run is a direct one or its current varies, or there is no load. One
 * angle does not tell a wrong zero of it from a saliency. O(runs). */
double hci_load_lead_rad(const hci_regression *regression);

/* How many of so many runs are asked what others say of them: those that are not beyond; where too few would
 * be left, all, and none is marked. */
size_t hci_asked_count(bool *beyond, size_t count);

#endif
