/* A solution as one picture: torque, its spectrum, phase currents and current vector. */
#ifndef HCI_SRC_HOST_PLOT_H
#define HCI_SRC_HOST_PLOT_H

#include "hci/host/output.h"
#include "hci/host/solve.h"

/* Appends one <svg> element to the current file of `out`: a file of its own, or part of an HTML page. No
 * script, font or other reference; same input, same bytes. Allocates nothing and cannot fail: write errors
 * are kept by `out`. O(samples·(orders + components)), at most 23040 samples. */
void hci_plot_solution(hci_output *out, const hci_machine_data *machine, const hci_solution *solution);

#endif
