#include "host/report/write_runs.h"

#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/csv/write.h"

static hci_status row_write(hci_output *out, const hci_runs *runs, size_t k, const char *folder,
                            hci_note *note)
{
    char *file;
    const hci_status status = hci_path_relative(runs->origin[k].path, folder, &file, note);
    if (status) return status;
    const bool holding = runs->run[k].torque_source == HCI_TORQUE_HOLDING;
    hci_csv_write_cell(out, file, true);
    hci_csv_write_cell(out, runs->role[k] == HCI_ROLE_FIT ? "fit" : "holdout", false);
    hci_csv_write_cell(out, runs->origin[k].columns, false);
    hci_output_text(out, "%s\n", holding ? "holding" : "");
    hci_memory_free(file);
    return HCI_OK;
}

hci_status hci_runs_write(hci_output *out, const hci_runs *runs, const char *folder, hci_note *note)
{
    if (!runs->origin) return hci_output_without(out, "runs.csv", note);
    hci_status status = hci_output_file(out, "runs.csv", note);
    if (!status) hci_output_text(out, "file,role,columns,test\n");
    for (size_t k = 0; k < runs->count && !status; ++k)
        if (!hci_runs_is_further_point(runs, k)) status = row_write(out, runs, k, folder, note);
    return status;
}
