/* Currents that a sensor or a limit has cut off: their crests are all of one value. */
#ifndef HCI_SRC_HOST_RECORDING_CLIPPED_H
#define HCI_SRC_HOST_RECORDING_CLIPPED_H

#include "hci/host/recording/run.h"

/* Whether a phase current or i_q stands at its least or its largest value in 1 % of the samples or more, and
 * in fewer than half of them, and five times as often as within a twentieth of it, where there are some: a
 * current that was rounded coarsely stands at its other values as well. Before anything is taken out of the
 * current. O(samples). */
bool hci_run_is_clipped(const hci_run *run);

#endif
