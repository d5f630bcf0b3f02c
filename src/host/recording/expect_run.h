/* What the real machine is expected to do with the currents of a run. */
#ifndef HCI_SRC_HOST_RECORDING_EXPECT_RUN_H
#define HCI_SRC_HOST_RECORDING_EXPECT_RUN_H

#include "hci/host/machine/expected_ripple.h"
#include "hci/host/machine/machine.h"
#include "hci/host/recording/run.h"

/* The torque is that of the machine for the true angle and the true currents behind the readings, without
 * what stands between it and a sensor. Of a run of more than 4096 samples every second, third … is taken.
 * uncertainty: NULL or empty: nothing is known. *expected: out. HCI_ERROR_INPUT for a run without an angle,
 * HCI_ERROR_MEMORY. */
hci_status hci_expect_run(const hci_machine_data *machine, const hci_effects *effects,
                          const hci_uncertainty *uncertainty, const hci_run *run,
                          hci_expected_ripple *expected, hci_note *note);

#endif
