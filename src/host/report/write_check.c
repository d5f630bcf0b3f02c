/* The file that a check is written to. */
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"

static hci_status write_text(const char *json, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_output_file(out, "summary.json", note);
    if (!status) hci_output_text(out, "%s\n", json);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

hci_status hci_check_write(const hci_check *check, const char *folder, hci_note *note)
{
    char *json = hci_check_json(check);
    hci_status status;
    if (!json) return hci_note_memory(note, NULL, "the summary");
    status = write_text(json, folder, note);
    hci_text_free(json);
    return status;
}
