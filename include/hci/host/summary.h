/* Summaries as JSON text, for scripts. */
#ifndef HCI_HOST_SUMMARY_H
#define HCI_HOST_SUMMARY_H

#include "hci/host/diagnose.h"
#include "hci/host/emit.h"
#include "hci/host/init.h"
#include "hci/host/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in summary.json. To be freed with hci_text_free; NULL when memory is out. A number that does not exist
 * is null. */
char *hci_solution_json(const hci_solution *solution, hci_status verdict);
char *hci_diagnosis_json(const hci_diagnosis *diagnosis, const hci_resolution *resolution);
char *hci_init_json(const hci_sheet *sheet);
char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result);
void hci_text_free(char *text);

#ifdef __cplusplus
}
#endif

#endif
