/* The file that a check is written to. */
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "host/report/summary.h"

hci_status hci_check_write(const hci_check *check, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_summary_write(out, hci_check_json(check), note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
