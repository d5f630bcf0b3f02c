#define _POSIX_C_SOURCE 200809L

#include "hci/host/currents/solution_folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/base/output.h"
#include "hci/host/csv/csv.h"
#include "host/base/json.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/base/whole_file.h"
#include "host/currents/own_files.h"

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
    return hci_unread_stat(path, &info) && S_ISDIR(info.st_mode);
}

static hci_status path_of(const char *folder, hci_solution_file file, char path[PATH_SIZE], hci_note *note)
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, hci_solution_file_name(file));
    if (length >= 0 && length < PATH_SIZE) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", folder);
}

/* The text of its summary, to be freed; NULL where it has none. */
static char *summary_of(const char *folder)
{
    char path[PATH_SIZE];
    return path_of(folder, HCI_SOLUTION_SUMMARY, path, NULL) ? NULL : hci_whole_file(path);
}

#define REMEDY "solve again, or give the path of this file alone to use it as it is"

/* The path of a file of a folder of results, which is to be the one that was written with the others. */
static hci_status find_file(const char *folder, hci_solution_file file, char path[PATH_SIZE], hci_note *note)
{
    hci_output_finish_interrupted(folder);
    hci_status status = path_of(folder, file, path, note);
    return status ? status : hci_own_file_check_beside(path, REMEDY, note);
}

bool hci_solution_has_parts(const char *folder)
{
    char path[PATH_SIZE];
    struct stat info;
    return !path_of(folder, HCI_SOLUTION_CURRENTS_PER_NM, path, NULL) && hci_unread_stat(path, &info);
}

static bool has_file(const char *folder, const char *file)
{
    char path[PATH_SIZE];
    struct stat info;
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, file);
    return length > 0 && length < PATH_SIZE && hci_unread_stat(path, &info);
}

bool hci_solution_has_spectrum(const char *folder)
{
    return has_file(folder, hci_solution_file_name(HCI_SOLUTION_SPECTRUM));
}

/* Folders of results that have the folder of a solution in them. */
static const struct {
    const char *command, *part, *currents;
} HOLDING_SOLUTION[] = {{"tune", "currents", "currents/currents.csv"},
                        {"diagnose", "solution", "solution/currents.csv"}};

/* A folder without currents: what it is, and what makes some. */
static hci_status no_currents(const char *folder, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    const char *shown = hci_quote_path(folder, path);
    for (size_t k = 0; k < sizeof HOLDING_SOLUTION / sizeof *HOLDING_SOLUTION; ++k)
        if (has_file(folder, HOLDING_SOLUTION[k].currents))
            return hci_note_set(note, HCI_ERROR_INPUT,
                                "%s: found the results of %s, expected a folder that solve wrote, with "
                                "currents.csv; it stands in there: give %s/%s",
                                shown, HOLDING_SOLUTION[k].command, shown, HOLDING_SOLUTION[k].part);
    if (has_file(folder, "machine.csv"))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found the folder of a machine, expected one that solve wrote, with currents.csv; find the "
            "currents first: hci-solve solve %s --target TARGET -o OUT, and then give OUT",
            shown, shown);
    if (has_file(folder, "machine/machine.csv"))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found the results of diagnose, expected a folder that solve wrote, with currents.csv; find "
            "the currents of the corrected machine first: hci-solve solve %s/machine --target TARGET -o OUT, "
            "and then give OUT",
            shown, shown);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found a folder without currents.csv, expected one that solve wrote; give the folder of its -o, "
        "or a file of currents",
        shown);
}

hci_status hci_solution_check_folder(const char *folder, hci_note *note)
{
    hci_output_finish_interrupted(folder);
    return has_file(folder, hci_solution_file_name(HCI_SOLUTION_CURRENTS)) ? HCI_OK
                                                                           : no_currents(folder, note);
}

hci_status hci_solution_read_currents(const char *path, hci_solution_file part, hci_currents *currents,
                                      hci_note *note)
{
    char file[PATH_SIZE];
    hci_status status;
    if (part == HCI_SOLUTION_CURRENTS && !hci_solution_is_folder(path))
        return hci_currents_read(path, false, currents, note);
    status = hci_solution_check_folder(path, note);
    if (!status) status = find_file(path, part, file, note);
    return status ? status : hci_currents_read(file, part == HCI_SOLUTION_CURRENTS_PER_NM, currents, note);
}

hci_status hci_solution_read_wanted_torque(const char *folder, double *torque_Nm, hci_note *note)
{
    char path[PATH_SIZE];
    hci_csv *csv;
    double order = 1.0;
    hci_status status = find_file(folder, HCI_SOLUTION_SPECTRUM, path, note);
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

double hci_solution_read_made_torque(const char *path)
{
    double mean_Nm = 0.0;
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    if (text) hci_json_find_number(text, "torque", "mean_Nm", &mean_Nm);
    hci_memory_free(text);
    return mean_Nm;
}

double hci_solution_read_expected_ripple(const char *path)
{
    double ripple_Nm = 0.0;
    bool is_known = false;
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    if (text && hci_json_find_bool(text, "expected", "known", &is_known) && is_known)
        hci_json_find_number(text, "expected", "peak_to_peak_Nm_95", &ripple_Nm);
    hci_memory_free(text);
    return ripple_Nm;
}

double hci_solution_read_current_limit(const char *path)
{
    double limit_A = (double)NAN;
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    if (text) hci_json_find_number(text, "limits", "phase_current_A", &limit_A);
    hci_memory_free(text);
    return limit_A;
}

hci_solution_verdict hci_solution_read_verdict(const char *path)
{
    bool reached = true, within = true;
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    if (text) {
        hci_json_find_bool(text, NULL, "reached", &reached);
        hci_json_find_bool(text, "current", "within_limits", &within);
    }
    hci_memory_free(text);
    return !within ? HCI_SOLUTION_OUT_OF_LIMITS : reached ? HCI_SOLUTION_GOOD : HCI_SOLUTION_NOT_REACHED;
}

/* By how much the torque misses what was wanted, where summary.json has it. */
static void say_missed(const char *path, char *words, size_t size)
{
    double worst_Nm, order;
    char *text = summary_of(path);
    if (text && hci_json_find_number(text, "torque", "worst_error_Nm", &worst_Nm) &&
        hci_json_find_number(text, "torque", "worst_order", &order))
        snprintf(words, size, ", by %.2g N·m at most, in order %.4g", worst_Nm, order);
    hci_memory_free(text);
}

void hci_solution_verdict_words(const char *path, char *words, size_t size)
{
    const hci_solution_verdict verdict = hci_solution_read_verdict(path);
    char missed[80] = "";
    words[0] = '\0';
    if (verdict == HCI_SOLUTION_OUT_OF_LIMITS)
        snprintf(words, size, "these currents do not keep the limits with which they were solved");
    if (verdict != HCI_SOLUTION_NOT_REACHED) return;
    say_missed(path, missed, sizeof missed);
    snprintf(
        words, size,
        "the torque of these currents is not as it was wanted%s: `solve` says not reached, the nearest is "
        "given",
        missed);
}

/* Where the machine that summary.json names is not the given one. */
static void remark_machine(const char *path, const hci_machine_identity *is, hci_note *remark)
{
    hci_machine_identity was = {{0}, {0}};
    char shown[HCI_QUOTE_PATH_SIZE];
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    const bool is_known = text && hci_json_find_text(text, "machine", "name", was.name, sizeof was.name) &&
                          hci_json_find_text(text, "machine", "digest", was.digest, sizeof was.digest);
    hci_memory_free(text);
    if (!is_known || !is->digest[0] || strcmp(was.digest, is->digest) == 0) return;
    hci_note_add(remark,
                 "%s: these currents were solved for the machine %s (digest %s), and this is %s "
                 "(%s); right if both are the same motor, else solve again for this one",
                 hci_quote_path(path, shown), was.name, was.digest, is->name, is->digest);
}

/* Where currents were solved with phases that carry none. */
static void remark_open(const char *path, hci_note *remark)
{
    char open[4] = "", shown[HCI_QUOTE_PATH_SIZE];
    char *text = hci_solution_is_folder(path) ? summary_of(path) : NULL;
    if (text && hci_json_find_text(text, "limits", "open_phases", open, sizeof open) && open[0])
        hci_note_add(
            remark,
            "%s: these currents were solved with an open phase (%s); they are for a drive in which it is "
            "disconnected, while what controls or simulates three phases drives all of them",
            hci_quote_path(path, shown), open);
    hci_memory_free(text);
}

void hci_solution_remark(const char *path, const hci_machine_data *machine, hci_note *remark)
{
    char shown[HCI_QUOTE_PATH_SIZE], words[HCI_SOLUTION_WORDS];
    hci_solution_verdict_words(path, words, sizeof words);
    if (words[0]) hci_note_add(remark, "%s: %s (summary.json)", hci_quote_path(path, shown), words);
    remark_open(path, remark);
    if (machine) remark_machine(path, &machine->identity, remark);
}
