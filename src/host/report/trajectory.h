/* trajectory.csv: what a logger would read of a simulated drive, then the truth where sensors stand between.
 */
#ifndef HCI_SRC_HOST_REPORT_TRAJECTORY_H
#define HCI_SRC_HOST_REPORT_TRAJECTORY_H

#include "hci/host/base/output.h"
#include "hci/host/simulate/simulate.h"

enum { HCI_TRAJECTORY_COLUMNS = 32 };

/* A row waits for the next one, so that its voltages can be means over the time between. */
typedef struct {
    hci_output *out;
    hci_simulation_plan plan;
    double row[HCI_TRAJECTORY_COLUMNS];
    size_t columns, waited; /* of the row that waits, 0 for none; steps since then */
    double v_sum_V[2];
} hci_trajectory;

/* Starts the file; nothing else may be written to `out` until the end. */
hci_status hci_trajectory_begin(hci_trajectory *trajectory, hci_output *out, const hci_simulation_plan *plan,
                                hci_note *note);
void hci_trajectory_add(hci_trajectory *trajectory, const hci_simulation_step *step);
void hci_trajectory_end(hci_trajectory *trajectory);

#endif
