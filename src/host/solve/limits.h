/* Whether a solution keeps the limits of current and voltage. */
#ifndef HCI_SRC_HOST_SOLVE_LIMITS_H
#define HCI_SRC_HOST_SOLVE_LIMITS_H

#include "hci/host/solve/solve.h"

/* Fills the peaks and the limits of *solution. HCI_ERROR_INPUT when the voltage needs a value that
 * machine.csv lacks. */
hci_status hci_limits_check(const hci_machine_data *machine, const hci_solve_options *options,
                            hci_solution *solution, hci_note *note);

#endif
