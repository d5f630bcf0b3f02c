/* A table of torques over the angle at several constant currents, as finite elements give it in one file: a
 * run for each of its operating points.
 *
 * In: a list of runs as they were read. Out: the same list, with the rows of each such table by their
 * currents, whether the angle or the currents change first. */
#ifndef HCI_SRC_HOST_RECORDING_LIST_TORQUE_MAP_H
#define HCI_SRC_HOST_RECORDING_LIST_TORQUE_MAP_H

#include "hci/host/recording/run.h"

enum { HCI_MOST_MAP_POINTS = 400 }; /* of a file; of more, each row may have its own currents */

/* Replaces run `first` and those after it that are tables of 2 to HCI_MOST_MAP_POINTS points; their
 * order stays. A table has no time, a measured torque and all its rows at points whose currents agree to 5e-4
 * of the largest and whose eight or more angles are evenly spaced and the same at each. Remarks on the first
 * run of each; marks them, and a run that is a table of one point, as tabulated. runs->origin, where there is
 * one, is of the file for each of its points. HCI_ERROR_MEMORY, the list then being as it was or split in
 * part. O(samples · points). */
hci_status hci_torque_maps_split(hci_runs *runs, size_t first, hci_note *note);

/* Remarks on the first recording over time with a measured torque beside tabulated ones. */
void hci_torque_maps_tell(hci_runs *runs);

#endif
