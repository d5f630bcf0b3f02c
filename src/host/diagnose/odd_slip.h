/* What would make one recording agree with a machine: a slip of its file, another zero of its angle or
 * torque.
 *
 * In: one run, and its error with the machine. Out: the slip that leaves least of that error, in words. */
#ifndef HCI_SRC_HOST_DIAGNOSE_ODD_SLIP_H
#define HCI_SRC_HOST_DIAGNOSE_ODD_SLIP_H

#include "hci/host/diagnose/diagnose.h"
#include "hci/host/machine/machine.h"

/* One run by itself. */
typedef struct {
    const hci_machine_data *machine;
    const hci_effects *effects; /* that the machine has */
    hci_run run;
    hci_role role;
    double least_Nm; /* error that is none whatever the noise */
} hci_lone_run;

/* Whether the error of a run is that of its noise. */
bool hci_error_is_noise(const hci_run_errors *errors, double least_Nm);

/* Sets odd->slip, and with it mended, mended_Nm and angle_rad; nothing where no slip would do. Of the run one
 * dataset is made, in whose samples the slips are mended. HCI_ERROR_MEMORY. O(samples of the run), and of
 * what is left of them when they are binned some hundred times. */
hci_status hci_odd_slip_find(const hci_lone_run *lone, const hci_run_errors *errors, hci_odd_run *odd,
                             hci_note *note);

#endif
