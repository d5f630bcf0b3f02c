/* Summaries as JSON text, for scripts. */
#ifndef HCI_HOST_REPORT_SUMMARY_H
#define HCI_HOST_REPORT_SUMMARY_H

#include "hci/host/diagnose/diagnose.h"
#include "hci/host/emit/emit.h"
#include "hci/host/machine/init.h"
#include "hci/host/simulate/simulate.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in summary.json of `solve`. To be freed with hci_text_free; NULL when memory is out. A number that does
 * not exist is null; so in the others. */
char *hci_solution_json(const hci_solution *solution, hci_status verdict);

/* As in summary.json of `diagnose`. resolution: or NULL. To be freed with hci_text_free; NULL when memory is
 * out. */
char *hci_diagnosis_json(const hci_diagnosis *diagnosis, const hci_resolution *resolution);

/* As in summary.json of `simulate`. To be freed with hci_text_free; NULL when memory is out. */
char *hci_simulation_json(const hci_simulation *simulation);

/* What `init` has made of a sheet. To be freed with hci_text_free; NULL when memory is out. */
char *hci_init_json(const hci_sheet *sheet);

/* What `emit` has made of a request. To be freed with hci_text_free; NULL when memory is out. */
char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result);

/* Frees a text of this library; NULL is fine. */
void hci_text_free(char *text);

#ifdef __cplusplus
}
#endif

#endif
