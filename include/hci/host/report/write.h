/* Results as files in a folder: tables for programs, pictures and, where it is asked for, a page for people.
 * The files of a folder appear together or not at all. */
#ifndef HCI_HOST_REPORT_WRITE_H
#define HCI_HOST_REPORT_WRITE_H

#include "hci/host/check/check.h"
#include "hci/host/diagnose/diagnose.h"
#include "hci/host/drive/drive_facts.h"
#include "hci/host/report/page/sources.h"
#include "hci/host/simulate/simulate.h"
#include "hci/host/simulate/speeds.h"
#include "hci/host/solve/solve.h"
#include "hci/host/waveform/waveform.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes currents.csv, waveform.csv, spectrum.csv, solution.svg, summary.json and, where currents are linear
 * in the mean torque, currents_per_Nm.csv and currents_constant.csv into `folder`; all or none. */
hci_status hci_solution_write(const hci_machine_data *machine, const hci_solution *solution,
                              hci_status verdict, const char *folder, hci_note *note);

/* The same, and report.html beside them; NULL: without. */
hci_status hci_solution_write_with_report(const hci_machine_data *machine, const hci_solution *solution,
                                          hci_status verdict, const hci_report_sources *sources,
                                          const char *folder, hci_note *note);

/* Currents for a target torque, which are written beside a diagnosis. */
typedef struct {
    const hci_resolution *resolution; /* of hci_diagnosis_resolve */
    const hci_machine_data *machine;  /* that the recordings are of, as read */
    const char *target;               /* file of the torque, as the user named it, or NULL */
} hci_new_currents;

/* Writes effects.csv, errors.csv, residual_spectrum.csv, summary.json, report.html, where something is
 * not explained unexplained.csv, and where something is left open measure_next.csv into `folder`, and the
 * corrected machine into `folder`/machine: the tables of machine_folder as they are, with effects.csv.
 * currents: for summary and report, and those for the corrected machine in `folder`/solution, with
 * report.html; NULL: none, and a folder of that name stays as it is. All appear together or not at all.
 * `folder`/declared gets what the diagnosis started from: the machine, and runs.csv where the runs are from
 * files. */
hci_status hci_diagnosis_write(const hci_diagnosis *diagnosis, const hci_new_currents *currents,
                               const hci_runs *runs, const char *machine_folder, const char *folder,
                               hci_note *note);

/* Writes back_emf.csv (order,amplitude_Nm_per_A,phase_rad,std_error_Nm_per_A) or cogging.csv
 * (order,amplitude_Nm,phase_rad,std_error_Nm) into a folder, and a picture of it, back_emf.svg or
 * cogging.svg. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_waveform_write(const hci_waveform *waveform, const char *folder, hci_note *note);

/* Writes summary.json of a check into `folder`. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_check_write(const hci_check *check, const char *folder, hci_note *note);

/* The same of `check --drive`. */
hci_status hci_drive_facts_write(const hci_drive_facts *facts, const char *folder, hci_note *note);

/* Writes speeds.csv, speeds.svg, summary.json and, with sources, report.html into `folder`; all or none.
 * HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_speeds_write(const hci_speeds *speeds, const hci_report_sources *sources, const char *folder,
                            hci_note *note);

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
