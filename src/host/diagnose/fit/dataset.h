/* The recordings of a diagnosis, made ready for fits.
 *
 * In: machine and runs. Out: binned samples with the angles of all runs aligned, which runs are fitted, and
 * the regression that all later steps work on. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_DATASET_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_DATASET_H

#include "hci/host/machine/machine.h"
#include "host/diagnose/fit/known_columns.h"
#include "host/diagnose/fit/known_equations.h"
#include "host/diagnose/reading/regression.h"

/* Start with {0}; it must not be moved. */
typedef struct {
    hci_binned_samples samples;
    hci_regression regression; /* uses the runs to be fitted */
    hci_known_equations known;
    hci_known_columns columns;
    double work;              /* as hci_regression.work */
    bool *fit, *any;          /* of each run */
    double *index_offset_rad; /* of each run: its angle was ahead by this and has been turned back */
} hci_dataset;

/* declared: effects of the machine, for the residual in which misaligned angles show. On failure *dataset is
 * empty. HCI_ERROR_MEMORY. O(samples + runs²). */
hci_status hci_dataset_make(const hci_machine_data *machine, const hci_effects *declared,
                            const hci_runs *runs, hci_dataset *dataset, hci_note *note);
void hci_dataset_release(hci_dataset *dataset);

/* The largest rms torque (of a holding test that of its current), rms current and mean speed of all runs. */
typedef struct {
    double torque_Nm, current_A, speed_rad_per_s;
} hci_dataset_range;

hci_dataset_range hci_dataset_range_of(const hci_dataset *dataset);

#endif
