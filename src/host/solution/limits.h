/* How currents stand to the limits of current, voltage and copper. */
#ifndef HCI_SRC_HOST_SOLUTION_LIMITS_H
#define HCI_SRC_HOST_SOLUTION_LIMITS_H

#include "host/limit/bounds.h"
#include "host/limit/program.h"

/* Names the limits there are in solution->limit, without values. */
void hci_limits_list(const hci_bounds *bounds, hci_solution *solution);

/* Fills peaks, values, touches and within_limits of a solution whose currents are filled. HCI_ERROR_INPUT
 * when the voltage needs a value that machine.csv lacks, _MEMORY. */
hci_status hci_limits_check(const hci_machine_data *machine, const hci_solve_options *options,
                            const hci_bounds *bounds, hci_solution *solution, hci_note *note);

/* Says in the remark what of the currents is beyond rated_current, which is no limit, unless a limit of that
 * kind was given. */
void hci_limits_remark_rated(const hci_machine_data *machine, hci_solution *solution);

/* Says where limits were given that are wider than what the machine declares, which they replace. */
void hci_limits_remark_declared(const hci_machine_data *machine, const hci_bounds *bounds,
                                hci_solution *solution);

/* Says in the remark where an open phase shows more than the dc link. */
void hci_limits_remark_open(const hci_bounds *bounds, hci_solution *solution);

/* Fills torque_at_limit_Nm of currents that are not shaped by limits. */
void hci_limits_scale(const hci_bounds *bounds, double wanted_Nm, hci_solution *solution);

/* What 1 more of each limit gives, of the stage that says what limits cost. */
void hci_limits_take_gains(const hci_limit_optimum *cost, hci_solution *solution);

#endif
