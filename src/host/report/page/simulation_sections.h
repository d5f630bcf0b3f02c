/* Sections of the page of a simulation, each in a file of its own. origin: as of hci_page_origin. */
#ifndef HCI_SRC_HOST_REPORT_PAGE_SIMULATION_SECTIONS_H
#define HCI_SRC_HOST_REPORT_PAGE_SIMULATION_SECTIONS_H

#include "hci/host/base/output.h"
#include "hci/host/simulate/simulate.h"
#include "host/simulate/traces.h"

/* ---- simulation_baseline.c: the plain sine that a drive is compared with ---- */

/* Whether there is one. */
bool hci_page_has_before(const hci_simulation *simulation);

/* Its torque at an order; NAN where there is nothing to compare with. */
double hci_page_before_Nm(const hci_simulation *simulation, double order);

/* "Before: …", or nothing. */
enum { HCI_PAGE_BASELINE_SIZE = 256 };
void hci_page_say_baseline(char text[HCI_PAGE_BASELINE_SIZE], const hci_simulation *simulation);

/* ---- the sections ---- */

/* Torque and current vector over one electrical turn; nothing where the rotor has not turned a period.
 * HCI_ERROR_MEMORY. */
hci_status hci_page_turn(hci_output *out, const hci_simulation *simulation, const hci_turn_means *turn,
                         const char *origin, hci_note *note);

/* Torque ripple by order; nothing where there is no spectrum. HCI_ERROR_MEMORY. */
hci_status hci_page_spectrum(hci_output *out, const hci_simulation *simulation, const char *origin,
                             hci_note *note);

/* Torque, speed and currents over the time. */
void hci_page_traces(hci_output *out, const hci_simulation *simulation, const hci_traces *traces,
                     const char *origin);

#endif
