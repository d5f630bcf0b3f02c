/* Results as files in a folder: tables for programs, pictures and, where it is asked for, a page for people.
 * The files of a folder appear together or not at all. */
#ifndef HCI_HOST_REPORT_WRITE_H
#define HCI_HOST_REPORT_WRITE_H

#include "hci/host/report/report.h"
#include "hci/host/simulate/simulate.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a simulation is written to. */
typedef struct {
    const char *folder;                /* is made where it is missing */
    const hci_report_sources *sources; /* of report.html; NULL: without */
} hci_simulate_output;

/* Runs the scenario as hci_simulate does, and writes trajectory.csv, spectrum.csv, summary.json and, with
 * sources, report.html. An observer of the options is told as well. Errors of hci_simulate; HCI_ERROR_OUTPUT,
 * also before the first step, and _NOT_FINITE. *simulation is then empty, and no file is left. */
hci_status hci_simulate_to_folder(const hci_machine_data *machine, const hci_scenario *scenario,
                                  const hci_simulate_options *options, const hci_simulate_output *where,
                                  hci_simulation *simulation, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
