/* The pages of report.html, appended to the current file of `out`. */
#ifndef HCI_SRC_HOST_REPORT_REPORT_H
#define HCI_SRC_HOST_REPORT_REPORT_H

#include "hci/host/report/write.h"
#include "host/simulate/traces.h"

/* The files that are named, in one line, which ends in between where it is too long. */
enum { HCI_REPORT_ORIGIN_SIZE = 1024 };
void hci_report_origin(char text[HCI_REPORT_ORIGIN_SIZE], const hci_report_sources *sources);

/* A section that names them one by one. */
void hci_report_show_sources(hci_output *out, const hci_report_sources *sources);

/* HCI_ERROR_MEMORY. */
hci_status hci_report_diagnosis(hci_output *out, const hci_diagnosis *diagnosis,
                                const hci_resolution *resolution, const hci_runs *runs,
                                const char *machine_folder, hci_note *note);

/* NAN where it is not known: the search looks no further at an effect of which no part by itself lets the
 * criterion fall. */
double hci_report_delta_bic(const hci_finding *finding);

/* verdict: what hci_solve returned. */
void hci_report_solution(hci_output *out, const hci_solution *solution, hci_status verdict,
                         const hci_report_sources *sources);

/* Its section about the system that was solved; origin: as of hci_report_origin. */
void hci_report_solution_system(hci_output *out, const hci_solution *solution, const char *origin);

/* HCI_ERROR_MEMORY. */
hci_status hci_report_simulation(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                                 const hci_report_sources *sources, hci_note *note);

#endif
