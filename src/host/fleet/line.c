/* fleet.csv of several folders, and what the motors' recordings tell of each. */
#include "hci/host/fleet/line.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/whole_file.h"
#include "host/currents/own_files.h"
#include "host/fleet/dates.h"
#include "host/fleet/row.h"

enum { PATH_SIZE = 4096, COMMANDS = HCI_FLEET_FIT + 1 };

/* ---- rows ---- */

static hci_status wrong(const char *path, const char *what, hci_note *note)
{
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: %s; expected fleet.csv as hci-solve batch writes it: give the --out of a batch", path, what);
}

/* The command whose header a file has; COMMANDS: none. */
static int command_of(const char *text, char header[HCI_FLEET_ROW_SIZE])
{
    int k = 0;
    for (; k < COMMANDS; ++k) {
        hci_fleet_header((hci_fleet_command)k, header);
        const size_t length = strlen(header);
        if (strncmp(text, header, length) == 0 && text[length] == '\n') break;
    }
    return k;
}

static void read_motor(const char *row, const char *header, hci_line_motor *m)
{
    *m = (hci_line_motor){.row = row, .worst = HCI_LINE_NONE, .deviation = NAN};
    hci_fleet_row_cell(row, header, "motor", m->name, sizeof m->name);
    hci_fleet_row_cell(row, header, "batch", m->batch, sizeof m->batch);
    hci_fleet_row_cell(row, header, "date", m->date, sizeof m->date);
    m->day = NAN;
    m->state = hci_fleet_row_state(row);
}

/* A motor and the folder it is in. */
typedef struct {
    hci_line_motor motor;
    const char *folder;
} placed;

typedef struct {
    placed *item;
    size_t count, room;
    char header[HCI_FLEET_ROW_SIZE];
} rows;

static hci_status add_row(rows *r, const char *row, const char *folder, hci_note *note)
{
    if (r->count == r->room) {
        placed *more = hci_memory_resize(r->item, 2 * r->room + 64, sizeof *more);
        if (!more) return hci_note_memory(note, folder, "its motors");
        r->item = more;
        r->room = 2 * r->room + 64;
    }
    r->item[r->count].folder = folder;
    read_motor(row, r->header, &r->item[r->count++].motor);
    return HCI_OK;
}

static hci_status split(char *text, const char *folder, rows *r, hci_note *note)
{
    hci_status status = HCI_OK;
    char *line = strchr(text, '\n') + 1, *end;
    while (!status && (end = strchr(line, '\n')) != NULL) {
        *end = '\0';
        status = add_row(r, line, folder, note);
        line = end + 1;
    }
    return status;
}

static hci_status read_folder(const char *folder, hci_line *line, rows *r, hci_note *note)
{
    char path[PATH_SIZE];
    if (snprintf(path, sizeof path, "%s/fleet.csv", folder) >= PATH_SIZE)
        return wrong(folder, "the path is too long", note);
    char *text = hci_whole_file(path);
    if (!text && hci_memory_was_short()) return hci_note_memory(note, path, "reading it");
    if (!text) return wrong(path, "cannot be read", note);
    line->text[line->texts++] = text;
    const hci_status status = hci_own_file_check_beside(path, HCI_FLEET_BATCH_AGAIN, note);
    if (status) return status;
    const int command = command_of(text, r->header);
    if (command == COMMANDS) return wrong(path, "found another header", note);
    if (line->texts > 1 && command != (int)line->command)
        return wrong(path, "found the motors of another command than in the first folder", note);
    line->command = (hci_fleet_command)command;
    return split(text, folder, r, note);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const placed *)a)->motor.name, ((const placed *)b)->motor.name);
}

static hci_status join(rows *r, hci_note *note)
{
    size_t kept = 0;
    qsort(r->item, r->count, sizeof *r->item, by_name);
    for (size_t k = 0; k < r->count; ++k) {
        const bool is_same = kept > 0 && by_name(&r->item[kept - 1], &r->item[k]) == 0;
        if (is_same && strcmp(r->item[kept - 1].motor.row, r->item[k].motor.row) != 0)
            return hci_note_set(
                note, HCI_ERROR_INPUT,
                "%.300s and %.300s: found motor `%.100s` in both with different rows, expected each once",
                r->item[kept - 1].folder, r->item[k].folder, r->item[k].motor.name);
        if (!is_same) r->item[kept++] = r->item[k];
    }
    r->count = kept;
    return HCI_OK;
}

/* ---- parameters ---- */

/* Beside what the command wrote: of a diagnosis in a folder of its own. */
static hci_status read_fit(const hci_line *line, const placed *p, hci_fleet_fit *fit, bool *is_there,
                           hci_note *note)
{
    char folder[PATH_SIZE];
    *is_there = false;
    if (p->motor.state > HCI_FLEET_OPEN) return HCI_OK;
    if (snprintf(folder, sizeof folder, "%s/motors/%s%s", p->folder, p->motor.name,
                 line->command == HCI_FLEET_DIAGNOSE ? "/fit" : "") >= PATH_SIZE)
        return wrong(p->folder, "the path is too long", note);
    return hci_fleet_fit_read(folder, fit, is_there, note);
}

/* The first motor with parameters says which there are. */
static hci_status begin(hci_line *line, const hci_fleet_fit *fit, hci_note *note)
{
    line->parameters = fit->count + 1;
    line->parameter = hci_memory_new(line->parameters, sizeof *line->parameter);
    line->value = hci_memory_new(line->motors * line->parameters, sizeof *line->value);
    line->std_error = hci_memory_new(line->motors * line->parameters, sizeof *line->std_error);
    if (!line->parameter || !line->value || !line->std_error)
        return hci_note_memory(note, NULL, "the parameters of a fleet");
    for (size_t k = 0; k < line->motors * line->parameters; ++k)
        line->value[k] = line->std_error[k] = NAN;
    for (size_t k = 0; k < fit->count; ++k)
        line->parameter[k].name = fit->parameter[k];
    line->parameter[fit->count].name = (hci_fleet_parameter){"residual", "rms", "Nm", NAN, NAN};
    return HCI_OK;
}

static hci_status take_fit(hci_line *line, size_t motor, const placed *p, const hci_fleet_fit *fit,
                           hci_note *note)
{
    double *value = line->value + motor * line->parameters,
           *std_error = line->std_error + motor * line->parameters;
    for (size_t k = 0; k < fit->count; ++k) {
        const hci_fleet_parameter *is = &fit->parameter[k], *expected = &line->parameter[k].name;
        if (fit->count + 1 != line->parameters || strcmp(is->effect, expected->effect) != 0 ||
            strcmp(is->parameter, expected->parameter) != 0 || strcmp(is->unit, expected->unit) != 0)
            return hci_note_set(note, HCI_ERROR_INPUT,
                                "%.300s: motor `%.100s` has other parameters than the first one; expected "
                                "motors of one make, "
                                "fitted with one machine folder",
                                p->folder, p->motor.name);
        value[k] = is->value;
        std_error[k] = is->std_error;
    }
    value[fit->count] = fit->rms_after_Nm;
    std_error[fit->count] = 0.0;
    return HCI_OK;
}

static hci_status take_fits(const rows *r, hci_line *line, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < r->count && !status; ++k) {
        hci_fleet_fit fit;
        bool is_there;
        status = read_fit(line, &r->item[k], &fit, &is_there, note);
        if (status || !is_there) continue;
        if (!line->parameter) status = begin(line, &fit, note);
        if (!status) status = take_fit(line, k, &r->item[k], &fit, note);
    }
    return status;
}

static hci_status take_rows(const rows *r, hci_line *line, hci_note *note)
{
    line->motor = hci_memory_new(r->count, sizeof *line->motor);
    if (!line->motor) return hci_note_memory(note, NULL, "the motors of a fleet");
    line->motors = r->count;
    for (size_t k = 0; k < r->count; ++k)
        line->motor[k] = r->item[k].motor;
    return take_fits(r, line, note);
}

/* ---- dates ---- */

/* What dates like 05/10/2026 are, by those of the line that leave it not open; open where these contradict
 * each other. */
static hci_date_order order_of(const hci_line *line)
{
    bool day = false, month = false;
    for (size_t k = 0; k < line->motors; ++k) {
        const hci_date_order order = hci_date_order_of(line->motor[k].date);
        day = day || (order == HCI_DATE_DAY_FIRST && !strchr(line->motor[k].date, '.'));
        month = month || order == HCI_DATE_MONTH_FIRST;
    }
    return day == month ? HCI_DATE_OPEN : day ? HCI_DATE_DAY_FIRST : HCI_DATE_MONTH_FIRST;
}

static void read_dates(hci_line *line)
{
    const hci_date_order order = order_of(line);
    for (size_t k = 0; k < line->motors; ++k) {
        hci_line_motor *m = &line->motor[k];
        m->day = hci_date_day(m->date, order);
        if (!isnan(m->day) || m->date[0] == '\0') continue;
        if (line->dates_unread++ == 0) memcpy(line->date_unread, m->date, sizeof m->date);
    }
}

/* ---- all of it ---- */

hci_status hci_line_read(const char *const *folder, size_t folders, hci_line *line, hci_note *note)
{
    rows r;
    hci_status status = HCI_OK;
    memset(&r, 0, sizeof r);
    line->text = hci_memory_new(folders, sizeof *line->text);
    if (!line->text) return hci_note_memory(note, NULL, "the motors of a fleet");
    for (size_t k = 0; k < folders && !status; ++k)
        status = read_folder(folder[k], line, &r, note);
    if (!status && r.count == 0) status = wrong(folder[0], "no motor is done", note);
    if (!status) status = join(&r, note);
    if (!status) status = take_rows(&r, line, note);
    if (!status) read_dates(line);
    hci_memory_free(r.item);
    return status;
}

void hci_line_release(hci_line *line)
{
    for (size_t k = 0; k < line->texts; ++k)
        hci_memory_free(line->text[k]);
    hci_memory_free(line->text);
    hci_memory_free(line->motor);
    hci_memory_free(line->parameter);
    hci_memory_free(line->value);
    hci_memory_free(line->std_error);
    memset(line, 0, sizeof *line);
}
