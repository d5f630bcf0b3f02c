#define _POSIX_C_SOURCE 200809L

#include "hci/host/currents/solution_folder.h"

#include <stdio.h>
#include <sys/stat.h>

#include "hci/host/csv/csv.h"

enum { PATH_SIZE = 4096 + 32 };

const char *hci_solution_file_name(hci_solution_file file)
{
    static const char *const NAME[HCI_SOLUTION_FILES] = {
        "currents.csv", "currents_per_Nm.csv", "currents_constant.csv", "spectrum.csv",
        "waveform.csv", "solution.svg",        "summary.json",          "report.html"};
    return NAME[file];
}

bool hci_solution_is_folder(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static hci_status path_of(const char *folder, hci_solution_file file, char path[PATH_SIZE], hci_note *note)
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, hci_solution_file_name(file));
    if (length >= 0 && length < PATH_SIZE) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", folder);
}

bool hci_solution_has_parts(const char *folder)
{
    char path[PATH_SIZE];
    struct stat info;
    return !path_of(folder, HCI_SOLUTION_CURRENTS_PER_NM, path, NULL) && stat(path, &info) == 0;
}

hci_status hci_solution_read_currents(const char *path, hci_solution_file part, hci_currents *currents,
                                      hci_note *note)
{
    char file[PATH_SIZE];
    hci_status status;
    if (part == HCI_SOLUTION_CURRENTS && !hci_solution_is_folder(path))
        return hci_currents_read(path, false, currents, note);
    status = path_of(path, part, file, note);
    return status ? status : hci_currents_read(file, part == HCI_SOLUTION_CURRENTS_PER_NM, currents, note);
}

hci_status hci_solution_read_wanted_torque(const char *folder, double *torque_Nm, hci_note *note)
{
    char path[PATH_SIZE];
    hci_csv *csv;
    double order = 1.0;
    hci_status status = path_of(folder, HCI_SOLUTION_SPECTRUM, path, note);
    *torque_Nm = 0.0;
    if (!status) status = hci_csv_read(path, &csv, note);
    if (status) return status;
    if (hci_csv_rows(csv) > 0) status = hci_csv_number(csv, "order", 0, &order, note);
    if (!status && order == 0.0) status = hci_csv_number(csv, "target_Nm", 0, torque_Nm, note);
    hci_csv_free(csv);
    return status;
}

hci_status hci_solution_read_mean_torque(const char *folder, double *torque_Nm, hci_note *note)
{
    char path[PATH_SIZE];
    double mean_Nm;
    hci_status status = hci_solution_read_wanted_torque(folder, &mean_Nm, note);
    if (!status) status = path_of(folder, HCI_SOLUTION_SPECTRUM, path, note);
    if (status) return status;
    if (mean_Nm == 0.0)
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: no mean torque in it; give --reference-torque NM",
                            path);
    *torque_Nm = mean_Nm;
    return HCI_OK;
}
