/* What `emit` has made, as JSON. */
#include "host/report/summary.h"

char *hci_emit_json(const hci_emit_request *request, const hci_emit_result *result)
{
    hci_json json;
    hci_summary_begin(&json, "emit");
    hci_json_text(&json, "name", request->name);
    hci_json_text(&json, "format", request->format);
    hci_json_text(&json, "frame", request->frame == HCI_TABLE_ABC ? "abc" : "dq");
    hci_json_number(&json, "points", (double)result->points);
    hci_json_number(&json, "columns", (double)result->columns);
    hci_json_number(&json, "parts", (double)result->parts);
    hci_json_number(&json, "period_electrical_turns", (double)result->period_turns);
    hci_json_number(&json, "bytes", (double)result->bytes);
    hci_json_number(&json, "max_error_A", result->max_error_A);
    hci_json_number(&json, "peak_A", result->peak_A);
    hci_json_number(&json, "crc32", result->crc32);
    return hci_json_end(&json);
}
