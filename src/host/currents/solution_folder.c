#define _POSIX_C_SOURCE 200809L

#include "hci/host/currents/solution_folder.h"

#include <stdio.h>
#include <sys/stat.h>

#include "hci/host/csv/csv.h"
#include "host/base/json.h"
#include "host/base/memory.h"
#include "host/base/quote.h"

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

/* ---- what solve said of them ---- */

/* A file as text, to be freed; NULL where it cannot be had. */
static char *text_of(const char *path)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    char *text = NULL;
    if (file && stat(path, &info) == 0 && S_ISREG(info.st_mode)) {
        text = hci_memory_new((size_t)info.st_size + 1, 1);
        if (text) text[fread(text, 1, (size_t)info.st_size, file)] = '\0';
    }
    if (file) fclose(file);
    return text;
}

hci_solution_verdict hci_solution_read_verdict(const char *path)
{
    bool reached = true, within = true;
    char file[PATH_SIZE];
    char *text = NULL;
    if (hci_solution_is_folder(path) && !path_of(path, HCI_SOLUTION_SUMMARY, file, NULL))
        text = text_of(file);
    if (text) {
        hci_json_find_bool(text, NULL, "reached", &reached);
        hci_json_find_bool(text, "current", "within_limits", &within);
    }
    hci_memory_free(text);
    return !within ? HCI_SOLUTION_OUT_OF_LIMITS : reached ? HCI_SOLUTION_GOOD : HCI_SOLUTION_NOT_REACHED;
}

const char *hci_solution_verdict_words(hci_solution_verdict verdict)
{
    static const char *const WORDS[] = {"",
                                        "the torque of these currents is not as it was wanted: `solve` says "
                                        "not reached, the nearest is given",
                                        "these currents do not keep the limits with which they were solved"};
    return WORDS[verdict];
}

void hci_solution_remark(const char *path, hci_note *remark)
{
    const hci_solution_verdict verdict = hci_solution_read_verdict(path);
    char shown[HCI_QUOTE_PATH_SIZE];
    if (verdict == HCI_SOLUTION_GOOD) return;
    hci_note_add(remark, "%s: %s (summary.json)", hci_quote_path(path, shown),
                 hci_solution_verdict_words(verdict));
}
