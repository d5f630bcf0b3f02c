/* The recordings of a diagnosis, made ready: cells with their angles put right, and what they are worth. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_DATASET_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_DATASET_H

#include "hci/host/machine/machine.h"
#include "host/diagnose/fit/evidence.h"

/* Start with {0}; it must not be moved. */
typedef struct {
    hci_cells cells;
    hci_evidence evidence; /* uses the runs to be fitted */
    bool *fit, *any;       /* of each run */
    double *slip_rad;      /* of each run: its angle was ahead by this and has been turned back */
} hci_bench;

/* declared: effects of the machine, for the residual in which slipped angles show. On failure *bench is
 * empty. HCI_ERROR_MEMORY. O(samples + runs²). */
hci_status hci_bench_make(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                          hci_bench *bench, hci_note *note);
void hci_bench_release(hci_bench *bench);

/* The largest rms torque, rms current and mean speed of all runs. */
typedef struct {
    double torque_Nm, current_A, speed_rad_per_s;
} hci_bench_range;

hci_bench_range hci_bench_range_of(const hci_bench *bench);

#endif
