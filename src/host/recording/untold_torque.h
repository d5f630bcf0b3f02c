/* The torque of a run that has no column of it: of a free shaft, of one that control turns slowly, or none.
 */
#ifndef HCI_SRC_HOST_RECORDING_UNTOLD_TORQUE_H
#define HCI_SRC_HOST_RECORDING_UNTOLD_TORQUE_H

#include "hci/host/recording/run.h"

/* Sets torque_Nm and where it is from, as hci_run_read says; of a slow turn what accelerates is taken out of
 * the currents. no_currents: the file has no column of them. HCI_ERROR_MEMORY. */
hci_status hci_untold_torque_set(hci_run *run, const hci_run_options *options, bool no_currents,
                                 hci_note *note);

/* The same of slow turns that tell more beside each other than alone: forward in one recording and back in
 * another, or at two speeds; and an inertia that some of them tell is that of the others too. Of an inertia
 * that is known nothing changes. HCI_ERROR_MEMORY. */
hci_status hci_untold_torques_join(hci_run *runs, size_t count, const hci_run_options *options,
                                   hci_note *note);

#endif
