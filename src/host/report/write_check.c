/* The file that a check is written to. */
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "host/report/summary.h"

static hci_status write_summary(char *json, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) {
        hci_text_free(json);
        return status;
    }
    status = hci_summary_write(out, json, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

hci_status hci_check_write(const hci_check *check, const char *folder, hci_note *note)
{
    return write_summary(hci_check_json(check), folder, note);
}

hci_status hci_drive_facts_write(const hci_drive_facts *facts, const char *folder, hci_note *note)
{
    return write_summary(hci_drive_facts_json(facts), folder, note);
}
