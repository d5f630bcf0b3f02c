/* fleet.csv and summary.json of a fleet. */
#include "hci/host/base/output.h"
#include "hci/host/fleet/results.h"
#include "host/fleet/row.h"
#include "host/report/summary.h"

hci_fleet_count hci_fleet_count_rows(char *const *row, size_t count)
{
    hci_fleet_count c = {.motors = count};
    for (size_t k = 0; k < count; ++k)
        if (row[k]) {
            ++c.of[hci_fleet_row_state(row[k])];
            ++c.done;
        }
    return c;
}

static char *summary_of(const hci_fleet_results *r, char *const *row)
{
    const hci_fleet_count c = hci_fleet_count_rows(row, r->list->count);
    hci_json json;
    hci_summary_begin(&json, "batch");
    hci_json_text(&json, "run", hci_fleet_command_name(r->command));
    hci_json_number(&json, "motors", (double)c.motors);
    for (int k = 0; k <= HCI_FLEET_CRASHED; ++k)
        hci_json_number(&json, hci_fleet_state_name((hci_fleet_state)k), (double)c.of[k]);
    return hci_json_end(&json);
}

static hci_status write_rows(const hci_fleet_results *r, char *const *row, hci_output *out, hci_note *note)
{
    char header[HCI_FLEET_ROW_SIZE];
    const hci_status status = hci_output_file(out, "fleet.csv", note);
    if (status) return status;
    hci_fleet_header(r->command, header);
    hci_output_text(out, "%s\n", header);
    for (size_t k = 0; k < r->list->count; ++k)
        if (row[k]) hci_output_text(out, "%s\n", row[k]);
    return HCI_OK;
}

hci_status hci_fleet_write(const hci_fleet_results *results, char *const *row, bool is_complete,
                           hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(results->folder, &out, note);
    if (status) return status;
    status = write_rows(results, row, out, note);
    if (!status && is_complete) status = hci_summary_write(out, summary_of(results, row), note);
    if (!status && !is_complete) status = hci_output_without(out, "summary.json", note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
