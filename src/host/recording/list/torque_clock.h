/* A torque that was logged by a clock of its own, as by a second logger whose file was joined to that of the
 * drive, beside all recordings of a list.
 *
 * A delay turns each order of the torque by the order times the speed times the delay; the ripple of one
 * machine is the same at all speeds but for that. */
#ifndef HCI_SRC_HOST_RECORDING_LIST_TORQUE_CLOCK_H
#define HCI_SRC_HOST_RECORDING_LIST_TORQUE_CLOCK_H

#include "hci/host/recording/run.h"

/* Moves the torque of all recordings with a measured one and a time by a delay of more than 5 ms, up to a
 * quarter of a second, which three recordings or more at two speeds or in two directions tell, turning at a
 * steady speed: by it nine tenths of what their ripples differ by go, and by no other delay as much. Says so
 * in their remarks; rows that have no torque then are left out. Shorter ones the diagnosis finds as an
 * effect. HCI_ERROR_MEMORY. O(samples · orders). */
hci_status hci_torque_clock_align(hci_run *runs, size_t count, hci_note *note);

#endif
