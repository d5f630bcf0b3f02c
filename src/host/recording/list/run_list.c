#define _POSIX_C_SOURCE 200809L

#include "hci/host/recording/run.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/base/text.h"
#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/csv/table.h"
#include "host/recording/computed_torque.h"
#include "host/recording/list/torque_clock.h"
#include "host/recording/list/torque_map.h"
#include "host/recording/run_columns.h"
#include "host/recording/untold_torque.h"

typedef struct {
    const hci_csv *csv;
    const hci_runs_options *options;
    hci_run_options run; /* of each, but for the cells of its row */
    hci_runs *runs;
    hci_note *note;
} list_reader;

static hci_status memory_error(const list_reader *l)
{
    return hci_note_memory(l->note, hci_csv_path(l->csv), "its runs");
}

static hci_status read_role(const list_reader *l, size_t row, hci_role *role)
{
    const char *text;
    const hci_status status = hci_csv_text(l->csv, "role", row, &text, l->note);
    if (status) return status;
    *role = hci_text_is(text, "holdout") ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT;
    if (*role == HCI_ROLE_HOLDOUT || hci_text_is(text, "fit")) return HCI_OK;
    return hci_csv_error(l->csv, "role", row, l->note, "`fit` or `holdout`",
                         "say whether the model is fitted to this run or tested on it");
}

/* A run that is fitted and held out too would make the model look better than it is. */
static hci_status check_once(const list_reader *l, size_t row, const char *file)
{
    for (size_t other = 0; other < row; ++other)
        if (strcmp(l->runs->run[other].name, file) == 0)
            return hci_csv_error(l->csv, "file", row, l->note, "each file once",
                                 "remove one of the two rows");
    return HCI_OK;
}

/* `file` relative to the folder of the list; the caller frees it. */
static char *path_of(const char *list, const char *file)
{
    const char *slash = file[0] == '/' ? NULL : strrchr(list, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - list) + 1 : 0;
    char *path = hci_memory_malloc(folder + strlen(file) + 1);
    if (path == NULL) return NULL;
    memcpy(path, list, folder);
    memcpy(path + folder, file, strlen(file) + 1);
    return path;
}

/* A cell of a column that a list may have; "" where it has none. */
static hci_status optional_cell(const list_reader *l, const char *column, size_t row, const char **text)
{
    *text = "";
    return hci_csv_has(l->csv, column) ? hci_csv_text(l->csv, column, row, text, l->note) : HCI_OK;
}

/* How the run of a row is read. columns: released by the caller. */
static hci_status row_options(const list_reader *l, size_t row, hci_run_options *options,
                              hci_column_names *columns)
{
    const char *test, *names;
    char from[HCI_QUOTE_PATH_SIZE + 64], path[HCI_QUOTE_PATH_SIZE];
    hci_status status = optional_cell(l, "test", row, &test);
    if (!status) status = optional_cell(l, "columns", row, &names);
    if (status) return status;
    options->holding = options->holding || hci_text_is(test, "holding");
    if (*names == '\0') return HCI_OK;
    options->list_columns = columns;
    snprintf(from, sizeof from, "%s:%zu: column `columns`", hci_quote_path(hci_csv_path(l->csv), path),
             hci_csv_line(l->csv, row));
    return hci_column_names_add_text(columns, names, from, l->note);
}

/* ---- what was not measured ---- */

#define EXACT 1e-9 /* of the largest current, to which phase currents sum to 0 */

/* Whether a run is currents over an electrical turn as solve writes them, without a time, with i_d and i_q
 * and a torque beside the phases, in even steps from 0, to more digits than anything is measured with. */
static bool is_calculated(const hci_run *run)
{
    double most_A = 0.0, sum_A = 0.0;
    if (run->time_s || !run->has_both_frames || !run->is_electrical || !run->theta_m_rad || !run->i_A ||
        !run->has_sum || run->count < 2)
        return false;
    if (run->torque_source != HCI_TORQUE_MEASURED && !run->torque_is_typed) return false;
    if (fabs(run->theta_m_rad[0]) > 0.0) return false;
    const double step_rad = run->theta_m_rad[1];
    for (size_t k = 0; k < run->count; ++k) {
        const double *i_A = run->i_A + 3 * k;
        if (fabs(run->theta_m_rad[k] - (double)k * step_rad) > EXACT * (double)run->count) return false;
        most_A = fmax(most_A, fabs(i_A[0]));
        sum_A = fmax(sum_A, fabs(i_A[0] + i_A[1] + i_A[2]));
    }
    return most_A > 0.0 && sum_A < EXACT * most_A;
}

static hci_status refuse_calculated(const char *path, hci_run *run, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    if (!is_calculated(run)) return HCI_OK;
    hci_run_release(run);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: found calculated currents, as solve writes them in waveform.csv, expected a log that was "
        "measured; record the machine while they are played",
        hci_quote_path(path, shown));
}

/* ---- columns that only some recordings have ---- */

/* Reads one that may lack columns which options name, and says so of it. */
static hci_status read_lacking(const list_reader *l, const hci_run_options *options, const char *path,
                               hci_run *run)
{
    const hci_column_names *names = options->columns;
    const size_t count = names != NULL ? names->count : 0;
    size_t *before = hci_memory_new(count + 1, sizeof *before);
    if (before == NULL) return memory_error(l);
    for (size_t k = 0; k < count; ++k)
        before[k] = options->columns_found[k];
    const hci_status status = hci_run_read(path, options, run, l->note);
    for (size_t k = 0; k < count && !status; ++k)
        if (options->columns_found[k] == before[k])
            hci_note_add(&run->remark, "no column `%.60s`: read without %.40s", names->item[k].column,
                         names->item[k].name);
    hci_memory_free(before);
    return status ? status : refuse_calculated(path, run, l->note);
}

/* Counts in `found` which columns that options name a recording of the list has; one that cannot be read has
 * none. */
static void look_into(const list_reader *l, size_t row, size_t *found)
{
    hci_csv *csv;
    const char *file;
    hci_note unused = {{0}};
    if (hci_csv_text(l->csv, "file", row, &file, &unused)) return;
    char *path = path_of(hci_csv_path(l->csv), file);
    if (path != NULL && !hci_csv_read_recording(path, &csv, &unused)) {
        (void)hci_column_names_apply_found(l->run.columns, found, csv, &unused);
        hci_csv_free(csv);
    }
    hci_memory_free(path);
}

/* A recording is refused while a column that options name is in none: the error of the first file that is
 * there, which tells more than what is missed without it. */
static hci_status refuse_absent(const list_reader *l, hci_status refused)
{
    const hci_column_names *names = l->run.columns;
    const size_t rows = hci_csv_rows(l->csv), failed = l->runs->count;
    const char *file;
    hci_csv *csv;
    hci_note absent = {{0}};
    hci_status status = HCI_OK;
    if (names == NULL || refused != HCI_ERROR_INPUT || failed >= rows) return refused;
    for (size_t row = failed; row < rows; ++row)
        look_into(l, row, l->run.columns_found);
    if (hci_csv_text(l->csv, "file", failed, &file, &absent)) return refused;
    char *path = path_of(hci_csv_path(l->csv), file);
    if (path == NULL || hci_csv_read_recording(path, &csv, &absent)) {
        hci_memory_free(path);
        return refused;
    }
    for (size_t k = 0; k < names->count && !status; ++k)
        if (l->run.columns_found[k] == 0)
            status = hci_column_names_apply(&(hci_column_names){&names->item[k], 1}, false, csv, &absent);
    hci_csv_free(csv);
    hci_memory_free(path);
    if (status == HCI_ERROR_INPUT && l->note != NULL) *l->note = absent;
    return refused;
}

/* ---- one run ---- */

static hci_status read_named(const list_reader *l, size_t row, const hci_run_options *options,
                             const char *file, char *path)
{
    const hci_column_names *const names[] = {options->list_columns, options->columns};
    hci_run *run = &l->runs->run[row];
    const hci_status status = read_lacking(l, options, path, run);
    if (status) {
        hci_memory_free(path);
        return status;
    }
    l->runs->count = row + 1;
    l->runs->origin[row] = (hci_run_origin){path, hci_column_names_text(names, 2), row};
    hci_memory_free(run->name);
    run->name = hci_memory_text(file);
    return run->name != NULL && l->runs->origin[row].columns != NULL ? HCI_OK : memory_error(l);
}

static hci_status read_one(const list_reader *l, size_t row, const char *file)
{
    hci_run_options options = l->run;
    hci_column_names columns = {0};
    char *path = path_of(hci_csv_path(l->csv), file);
    if (path == NULL) return memory_error(l);
    hci_status status = row_options(l, row, &options, &columns);
    if (status)
        hci_memory_free(path);
    else
        status = read_named(l, row, &options, file, path);
    hci_column_names_release(&columns);
    return status;
}

/* The list names a file that is not there: which row does, and what its path begins from. */
static hci_status check_there(const list_reader *l, size_t row, const char *file)
{
    char *path = path_of(hci_csv_path(l->csv), file), remedy[HCI_QUOTE_PATH_SIZE + 80];
    char shown[HCI_QUOTE_PATH_SIZE];
    if (path == NULL) return memory_error(l);
    const bool is_there = l->run.memory_count > 0 || access(path, R_OK) == 0;
    const char *why = strerror(errno);
    if (!is_there)
        snprintf(remedy, sizeof remedy, "%s: %s; a path begins at the folder of the list",
                 hci_quote_path(path, shown), why);
    hci_memory_free(path);
    return is_there ? HCI_OK
                    : hci_csv_error(l->csv, "file", row, l->note, "a recording that can be read", remedy);
}

static hci_status read_row(const list_reader *l, size_t row)
{
    const char *file;
    hci_status status = hci_csv_text(l->csv, "file", row, &file, l->note);
    if (!status) status = read_role(l, row, &l->runs->role[row]);
    if (!status && *file == '\0')
        status =
            hci_csv_error(l->csv, "file", row, l->note, "the path of a run", "fill it or remove the row");
    if (!status) status = check_once(l, row, file);
    if (!status) status = check_there(l, row, file);
    return status ? status : read_one(l, row, file);
}

/* A recording, or a list without its header, in place of a list. */
static hci_status check_columns(const list_reader *l)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    const char *shown = hci_quote_path(hci_csv_path(l->csv), path);
    if (hci_csv_has(l->csv, "file")) return HCI_OK;
    for (int k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
        if (hci_csv_has(l->csv, hci_run_column_name((hci_run_column)k)))
            return hci_note_set(
                l->note, HCI_ERROR_INPUT,
                "%s: found a recording with %s, expected a list of recordings; write one with the header "
                "file,role and a row for each recording, such as %s,fit",
                shown, hci_run_column_name((hci_run_column)k), shown);
    return hci_note_set(
        l->note, HCI_ERROR_INPUT,
        "%s:1: found no column `file` but %s, expected a list of recordings with the header file,role; "
        "write that header as the first line",
        shown, hci_quote(hci_csv_name(l->csv, 0), quoted));
}

static hci_status read_rows(const list_reader *l)
{
    const size_t rows = hci_csv_rows(l->csv);
    hci_status status = check_columns(l);
    if (status) return status;
    if (rows == 0) {
        char path[HCI_QUOTE_PATH_SIZE];
        return hci_note_set(l->note, HCI_ERROR_INPUT, "%s: found no run, expected a row for each; add one",
                            hci_quote_path(hci_csv_path(l->csv), path));
    }
    status =
        hci_csv_check_rows(l->csv, HCI_MOST_RUNS_LISTED, "join short recordings, or leave some out", l->note);
    if (status) return status;
    l->runs->run = hci_memory_new(rows, sizeof *l->runs->run);
    l->runs->role = hci_memory_new(rows, sizeof *l->runs->role);
    l->runs->origin = hci_memory_new(rows, sizeof *l->runs->origin);
    l->runs->list = hci_memory_text(hci_csv_path(l->csv));
    if (l->runs->run == NULL || l->runs->role == NULL || l->runs->origin == NULL || l->runs->list == NULL)
        return memory_error(l);
    for (size_t row = 0; row < rows && !status; ++row) {
        if (l->options->progress != NULL)
            l->options->progress(l->options->context, "reading runs", (double)row / (double)rows);
        status = read_row(l, row);
    }
    return status;
}

hci_status hci_runs_read(const char *path, const hci_runs_options *options, hci_runs *runs, hci_note *note)
{
    hci_csv *csv;
    memset(runs, 0, sizeof *runs);
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    hci_column_names columns = {0};
    list_reader l = {csv, options, options->run, runs, note};
    l.run.list_columns = &columns;
    status = hci_column_names_beside(&columns, path, note);
    l.run.columns_found =
        hci_memory_new((options->run.columns != NULL ? options->run.columns->count : 0) + 1, sizeof(size_t));
    if (!status && l.run.columns_found == NULL) status = memory_error(&l);
    if (!status) status = read_rows(&l);
    if (!status)
        status = hci_column_names_check_found(l.run.columns, l.run.columns_found, runs->origin[0].path, note);
    else if (l.run.columns_found != NULL)
        status = refuse_absent(&l, status);
    if (!status) status = hci_torque_maps_split(runs, 0, note);
    if (!status) hci_torque_maps_tell(runs);
    if (!status) hci_torques_typed_leave(runs->run, runs->count);
    if (!status) hci_torques_at_one_end_tell(runs->run, runs->count);
    if (!status) status = hci_torque_clock_align(runs->run, runs->count, note);
    if (!status) status = hci_estimated_torques_leave(runs->run, runs->count, &options->run, note);
    if (!status) status = hci_untold_torques_join(runs->run, runs->count, &options->run, note);
    hci_memory_free(l.run.columns_found);
    hci_column_names_release(&columns);
    hci_csv_free(csv);
    if (status) hci_runs_release(runs);
    return status;
}

/* ---- two lists ---- */

static hci_status files_differ(const hci_runs *a, const hci_runs *b, hci_note *note)
{
    for (size_t j = 0; j < a->count; ++j)
        for (size_t k = 0; k < b->count; ++k)
            if (hci_path_is_same(a->origin[j].path, b->origin[k].path))
                return hci_note_set(note, HCI_ERROR_INPUT,
                                    "%.200s: found `%.200s`, expected new recordings only; it is among those "
                                    "of last time, remove its row",
                                    b->list, b->run[k].name);
    return HCI_OK;
}

/* False when memory is out; nothing is lost then. */
static bool append(void **to, size_t count, const void *from, size_t more, size_t size)
{
    char *larger = hci_memory_resize(*to, count + more, size);
    if (larger == NULL) return false;
    memcpy(larger + count * size, from, more * size);
    *to = larger;
    return true;
}

hci_status hci_runs_join(hci_runs *runs, hci_runs *more, hci_note *note)
{
    void *run = runs->run, *role = runs->role, *origin = runs->origin;
    const hci_status status = files_differ(runs, more, note);
    if (status) return status;
    const bool done = append(&run, runs->count, more->run, more->count, sizeof *more->run) &&
                      append(&role, runs->count, more->role, more->count, sizeof *more->role) &&
                      append(&origin, runs->count, more->origin, more->count, sizeof *more->origin);
    runs->run = run;
    runs->role = role;
    runs->origin = origin;
    if (!done) return hci_note_memory(note, NULL, "both lists of recordings");
    runs->count += more->count;
    more->count = 0;
    hci_memory_free(runs->list);
    runs->list = more->list;
    more->list = NULL;
    hci_runs_release(more);
    return HCI_OK;
}

/* ---- a list without a file ---- */

static hci_status check_new(const hci_runs *runs, const char *path, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    if (runs->origin)
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "a list that was read from a file takes no more runs; join it with another list");
    for (size_t k = 0; k < runs->count; ++k)
        if (strcmp(runs->run[k].name, path) == 0)
            return hci_note_set(
                note, HCI_ERROR_INPUT,
                "%s: found it a second time, expected each recording once; remove one of them",
                hci_quote_path(path, shown));
    return HCI_OK;
}

hci_status hci_runs_add(hci_runs *runs, const char *path, hci_role role, const hci_run_options *options,
                        hci_note *note)
{
    void *all = runs->run, *roles = runs->role;
    hci_run run = {0};
    hci_status status = check_new(runs, path, note);
    if (!status) status = hci_run_read(path, options, &run, note);
    if (!status) status = refuse_calculated(path, &run, note);
    if (status) return status;
    const bool done =
        append(&all, runs->count, &run, 1, sizeof run) && append(&roles, runs->count, &role, 1, sizeof role);
    runs->run = all;
    runs->role = roles;
    if (done) {
        ++runs->count;
        return hci_torque_maps_split(runs, runs->count - 1, note);
    }
    hci_run_release(&run);
    return hci_note_memory(note, path, "a list of recordings");
}

void hci_runs_release(hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        hci_run_release(&runs->run[k]);
    for (size_t k = 0; k < runs->count && runs->origin != NULL; ++k) {
        hci_memory_free(runs->origin[k].path);
        hci_column_names_text_free(runs->origin[k].columns);
    }
    hci_memory_free(runs->origin);
    hci_memory_free(runs->run);
    hci_memory_free(runs->role);
    hci_memory_free(runs->list);
    memset(runs, 0, sizeof *runs);
}
