/* What `export-fmu` has made, as JSON. */
#include "hci/host/fmu/fmu.h"
#include "host/report/summary.h"

char *hci_fmu_json(const hci_fmu_result *r)
{
    hci_json json;
    hci_summary_begin(&json, "export-fmu");
    hci_json_text(&json, "name", r->identifier);
    hci_json_number(&json, "fmi_version", r->fmi_version);
    hci_json_number(&json, "inputs", (double)r->inputs);
    hci_json_number(&json, "outputs", (double)r->outputs);
    hci_json_number(&json, "parameters", (double)r->parameters);
    hci_json_number(&json, "effects", (double)r->effects);
    hci_json_number(&json, "sources", (double)r->sources);
    hci_json_number(&json, "binary_bytes", (double)r->binary_bytes);
    hci_json_number(&json, "bytes", (double)r->bytes);
    return hci_json_end(&json);
}
