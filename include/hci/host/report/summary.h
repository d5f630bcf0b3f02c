/* Results as JSON text, for scripts. Each text is to be freed with hci_text_free, and NULL when memory is
 * out. A number that does not exist is null. */
#ifndef HCI_HOST_REPORT_SUMMARY_H
#define HCI_HOST_REPORT_SUMMARY_H

#include "hci/host/check/check.h"
#include "hci/host/currents/table_rotation.h"
#include "hci/host/diagnose/diagnose.h"
#include "hci/host/drive/drive_facts.h"
#include "hci/host/emit/emit.h"
#include "hci/host/emit/emit_foreign.h"
#include "hci/host/emit/emit_loop.h"
#include "hci/host/machine/init.h"
#include "hci/host/recording/predict.h"
#include "hci/host/simulate/simulate.h"
#include "hci/host/simulate/speeds.h"
#include "hci/host/solve/solve.h"
#include "hci/host/waveform/waveform.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in summary.json of `solve`. verdict: what hci_solve returned. */
char *hci_solution_json(const hci_solution *solution, hci_status verdict);

/* As in summary.json of `diagnose`. resolution: or NULL. */
char *hci_diagnosis_json(const hci_diagnosis *diagnosis, const hci_resolution *resolution);

/* As in summary.json of `simulate`. */
char *hci_simulation_json(const hci_simulation *simulation);

/* As in summary.json of `simulate --table`. */
char *hci_speeds_json(const hci_speeds *speeds);

/* What `emit --drive` has made of a request. */
char *hci_emit_loop_json(const hci_emit_loop_request *request, const hci_emit_loop_result *result);

/* What `check --table` has found. */
char *hci_table_rotation_json(const hci_table_rotation *rotation);

/* What `check --drive` has found. */
char *hci_drive_facts_json(const hci_drive_facts *facts);

/* What `check` has found. */
char *hci_check_json(const hci_check *check);

/* What `harmonics` has measured. */
char *hci_waveform_json(const hci_waveform *waveform);

/* What `predict` has compared. */
char *hci_prediction_json(const hci_prediction *prediction);

/* What `init` has made of a sheet. */
char *hci_init_json(const hci_sheet *sheet);

/* What `emit --for` has made of a request. */
char *hci_emit_foreign_json(const hci_emit_foreign_request *request, const hci_emit_foreign_result *result);

/* What `emit` has made of a request. */
char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result);

/* Why a command failed: an object `error` with exit_code, status and message, and file, line, column,
 * column_name and remedy as far as the note has them. note: its text may be "". */
char *hci_failure_json(hci_status status, const hci_note *note);

/* Frees a text of this library; NULL is fine. */
void hci_text_free(char *text);

/* The summary that was written into a folder, with the checksums of its files; NULL also where it cannot be
 * read. */
char *hci_summary_read(const char *folder);

#ifdef __cplusplus
}
#endif

#endif
