/* The rows of trajectory.csv: what a logger would read of a simulated drive, then the truth where sensors
 * stand between.
 */
#ifndef HCI_SRC_HOST_SAMPLES_TRAJECTORY_H
#define HCI_SRC_HOST_SAMPLES_TRAJECTORY_H

#include "hci/host/base/output.h"
#include "hci/host/samples/samples.h"

enum { HCI_TRAJECTORY_COLUMNS = 32 };

/* Where rows go. */
typedef void hci_trajectory_sink(void *context, const double *row, size_t columns);

/* A row waits for the next one, so that its voltages can be means over the time between. */
typedef struct {
    hci_trajectory_sink *sink;
    void *context; /* of sink */
    hci_simulation_plan plan;
    double row[HCI_TRAJECTORY_COLUMNS];
    size_t columns, waited; /* of the row that waits, 0 for none; steps since then */
    double v_sum_V[2];
} hci_trajectory;

/* The names of the columns with a comma between them: HCI_SAMPLES_COLUMNS bytes will do. */
void hci_trajectory_names(const hci_simulation_plan *plan, char *names, size_t size);

/* Starts with rows to a sink, or with trajectory.csv as the next file, into which nothing else may be written
 * until the end. */
void hci_trajectory_begin(hci_trajectory *trajectory, const hci_simulation_plan *plan,
                          hci_trajectory_sink *sink, void *context);
hci_status hci_trajectory_begin_file(hci_trajectory *trajectory, hci_output *out,
                                     const hci_simulation_plan *plan, hci_note *note);
void hci_trajectory_add(hci_trajectory *trajectory, const hci_simulation_step *step);
void hci_trajectory_end(hci_trajectory *trajectory);

#endif
