/* The pages of report.html, appended to the current file of `out`. */
#ifndef HCI_SRC_HOST_REPORT_PAGE_PAGE_H
#define HCI_SRC_HOST_REPORT_PAGE_PAGE_H

#include "hci/host/diagnose/diagnose.h"
#include "hci/host/report/page/sources.h"
#include "hci/host/simulate/simulate.h"
#include "hci/host/simulate/speeds.h"
#include "hci/host/solve/solve.h"
#include "host/simulate/traces.h"

/* The files that are named, in one line, which ends in between where it is too long. */
enum { HCI_PAGE_ORIGIN_SIZE = 1024 };
void hci_page_origin(char text[HCI_PAGE_ORIGIN_SIZE], const hci_report_sources *sources);

/* A section that names them one by one. */
void hci_page_show_sources(hci_output *out, const hci_report_sources *sources);

/* HCI_ERROR_MEMORY. */
hci_status hci_page_diagnosis(hci_output *out, const hci_diagnosis *diagnosis,
                              const hci_resolution *resolution, const hci_runs *runs,
                              const char *machine_folder, hci_note *note);

/* verdict: what hci_solve returned. */
void hci_page_solution(hci_output *out, const hci_solution *solution, hci_status verdict,
                       const hci_report_sources *sources);

void hci_page_speeds(hci_output *out, const hci_speeds *speeds, const hci_report_sources *sources);

/* HCI_ERROR_MEMORY. */
hci_status hci_page_simulation(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                               const hci_report_sources *sources, hci_note *note);

#endif
