/* Sections of the page of a diagnosis, each in a file of its own. origin: as of hci_page_origin. */
#ifndef HCI_SRC_HOST_REPORT_PAGE_DIAGNOSIS_SECTIONS_H
#define HCI_SRC_HOST_REPORT_PAGE_DIAGNOSIS_SECTIONS_H

#include "hci/host/base/output.h"
#include "hci/host/diagnose/diagnose.h"

/* Effects in order of importance. */
void hci_page_findings(hci_output *out, const hci_diagnosis *diagnosis, const char *origin);

/* Errors run by run, and which runs had a slip of the index. */
void hci_page_run_errors(hci_output *out, const hci_diagnosis *diagnosis, const char *origin);

/* Whether no amplitude that is left, of a run and an order, is larger than chance makes one in so many, once
 * in twenty times; of a single one the noise is that. */
bool hci_page_is_chance(const hci_diagnosis *diagnosis);

/* What is left by order, and by run and order. HCI_ERROR_MEMORY. */
hci_status hci_page_residual(hci_output *out, const hci_diagnosis *diagnosis, const hci_runs *runs,
                             const char *origin, hci_note *note);

/* Parameters of each effect of the corrected machine, folded away; nothing where it has none. */
void hci_page_parameters(hci_output *out, const hci_diagnosis *diagnosis);

/* Orders that no effect explains; nothing where there are none. */
void hci_page_unexplained(hci_output *out, const hci_diagnosis *diagnosis);

/* What new recordings say of the last diagnosis. */
void hci_page_again(hci_output *out, const hci_again *again);

/* What the currents of the declared machine and those of the corrected one do on the corrected one. */
void hci_page_resolution(hci_output *out, const hci_resolution *resolution);

#endif
