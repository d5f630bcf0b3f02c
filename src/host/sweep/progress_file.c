/* points.csv and sweep.csv: what is solved so far, and of what. */
#include "hci/host/sweep/progress_file.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/csv/csv.h"
#include "host/base/digest.h"
#include "host/base/folder_lock.h"
#include "host/base/quote.h"
#include "host/csv/table.h"
#include "host/machine/folder.h"
#include "host/sweep/columns.h"

#define POINTS "points.csv"
#define INPUTS "sweep.csv"

enum { PATH_SIZE = 4096 };

/* ---- inputs ---- */

static void add_checksum(hci_grid_inputs *inputs, const char *name, uint64_t sum)
{
    char text[32];
    snprintf(text, sizeof text, "checksum %016llx", (unsigned long long)sum);
    hci_grid_inputs_add(inputs, name, text);
}

void hci_grid_inputs_add(hci_grid_inputs *inputs, const char *name, const char *value)
{
    if (inputs->count == HCI_GRID_MOST_INPUTS) return;
    if (strlen(value) >= HCI_GRID_INPUT_SIZE || strpbrk(value, "\n\r")) {
        add_checksum(inputs, name, hci_digest_next(HCI_DIGEST_START, value, strlen(value)));
        return;
    }
    hci_grid_input *i = &inputs->input[inputs->count++];
    snprintf(i->name, sizeof i->name, "%s", name);
    snprintf(i->value, sizeof i->value, "%s", value);
}

void hci_grid_inputs_add_file(hci_grid_inputs *inputs, const char *name, const char *path)
{
    uint64_t sum = HCI_DIGEST_START;
    if (!hci_digest_file(path, &sum)) {
        hci_grid_inputs_add(inputs, name, "none");
        return;
    }
    add_checksum(inputs, name, sum);
}

void hci_grid_inputs_add_machine(hci_grid_inputs *inputs, const char *folder)
{
    for (size_t k = 0; k < HCI_MACHINE_FILES; ++k) {
        char path[PATH_SIZE];
        hci_note ignored = {{0}};
        if (hci_machine_path(path, sizeof path, folder, hci_machine_files[k], &ignored) == HCI_OK)
            hci_grid_inputs_add_file(inputs, hci_machine_files[k], path);
    }
}

static void write_inputs(hci_output *out, const hci_grid_inputs *inputs)
{
    hci_output_text(out, "name,value\n");
    for (size_t k = 0; k < inputs->count; ++k) {
        hci_output_text(out, "%s,", inputs->input[k].name);
        hci_grid_put_text(out, inputs->input[k].value, '\n');
    }
}

/* The value that a table has for a name, NULL: none. */
static const char *value_of(const hci_csv *csv, const char *name)
{
    hci_note ignored = {{0}};
    const char *text;
    for (size_t row = 0; row < hci_csv_rows(csv); ++row)
        if (hci_csv_text(csv, "name", row, &text, &ignored) == HCI_OK && strcmp(text, name) == 0 &&
            hci_csv_text(csv, "value", row, &text, &ignored) == HCI_OK)
            return text;
    return NULL;
}

static hci_status differs(const hci_csv *csv, const char *name, const char *was, const char *is,
                          hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: the points there are of other inputs: `%s` was %s, and is %s; expected the same "
                        "command: give another --out, or delete that folder",
                        hci_csv_path(csv), name, was ? was : "not given", is ? is : "not given");
}

/* Names that the table has and the inputs have not. */
static hci_status check_names(const hci_csv *csv, const hci_grid_inputs *inputs, hci_note *note)
{
    const char *name;
    hci_status status = HCI_OK;
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row) {
        bool is_known = false;
        status = hci_csv_text(csv, "name", row, &name, note);
        for (size_t k = 0; k < inputs->count && !status; ++k)
            is_known = is_known || strcmp(inputs->input[k].name, name) == 0;
        if (!status && !is_known) status = differs(csv, name, value_of(csv, name), NULL, note);
    }
    return status;
}

static hci_status check_inputs(const hci_grid_inputs *inputs, const char *folder, hci_note *note)
{
    char path[PATH_SIZE];
    hci_csv *csv;
    hci_status status = hci_machine_path(path, sizeof path, folder, INPUTS, note);
    if (!status && !hci_machine_has(path))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: is not there; expected it and points.csv, as sweep leaves both: give another "
            "folder, or delete points.csv to begin anew",
            path);
    if (!status) status = hci_csv_read(path, &csv, note);
    if (status) return status;
    for (size_t k = 0; k < inputs->count && !status; ++k) {
        const hci_grid_input *i = &inputs->input[k];
        const char *was = value_of(csv, i->name);
        if (!was || strcmp(was, i->value) != 0) status = differs(csv, i->name, was, i->value, note);
    }
    if (!status) status = check_names(csv, inputs, note);
    hci_csv_free(csv);
    return status;
}

/* ---- points, written ---- */

static void write_row(hci_output *out, size_t index, const hci_grid_row *r)
{
    hci_output_text(out, "%zu,", index + 1);
    hci_grid_put(out, r->point.torque_Nm, ',');
    hci_grid_put(out, r->point.speed_rad_per_s, ',');
    hci_grid_put(out, r->point.link_V, ',');
    hci_grid_put(out, r->point.limit_current_A, ',');
    hci_grid_put(out, r->point.limit_copper, ',');
    hci_grid_put_figures(out, &r->best);
    hci_grid_put_figures(out, &r->most);
    hci_grid_put_figures(out, &r->sine);
    hci_output_text(out, "%s,", hci_grid_verdict_name(r->verdict));
    hci_grid_put_text(out, r->reason, '\n');
}

static void write_points(hci_output *out, const hci_grid *s)
{
    hci_output_text(out, "point,torque_Nm,speed_rad_per_s,dc_link_V,limit_phase_A,limit_loss_to_plain,");
    hci_grid_put_names(out, "");
    hci_grid_put_names(out, "most_");
    hci_grid_put_names(out, "sine_");
    hci_output_text(out, "verdict,reason\n");
    for (size_t k = 0; k < s->plan.count; ++k)
        if (s->done[k]) write_row(out, k, &s->row[k]);
}

static hci_status write_both(hci_output *out, const hci_grid *s, const hci_grid_inputs *inputs,
                             hci_note *note)
{
    hci_status status = hci_output_file(out, INPUTS, note);
    if (!status) write_inputs(out, inputs);
    if (!status) status = hci_output_file(out, POINTS, note);
    if (!status) write_points(out, s);
    return status;
}

hci_status hci_grid_keep_points(const hci_grid *sweep, const hci_grid_inputs *inputs, const char *folder,
                                hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_both(out, sweep, inputs, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

/* ---- points, read ---- */

/* Where a row is read, and what goes wrong. */
typedef struct {
    const hci_csv *csv;
    size_t row;
    hci_status status;
    hci_note *note;
} reader;

static const char *text_of(reader *r, const char *column)
{
    const char *text = "";
    if (!r->status) r->status = hci_csv_text(r->csv, column, r->row, &text, r->note);
    return r->status ? "" : text;
}

/* NAN: the cell is empty. */
static double number_of(reader *r, const char *column)
{
    const char *text = text_of(r, column);
    double value = NAN;
    if (text[0] != '\0' && !hci_number_parse(text, &value) && !r->status)
        r->status = hci_csv_error(r->csv, column, r->row, r->note, "a number or nothing",
                                  "points.csv is written by hci-solve sweep; delete it and begin anew");
    return value;
}

static void read_binds(const char *text, hci_grid_figures *f)
{
    for (int k = 0; k <= HCI_LIMIT_COPPER; ++k)
        f->binds[k] = strstr(text, hci_limit_kind_name((hci_limit_kind)k)) != NULL;
}

static void read_figures(reader *r, const char *prefix, hci_grid_figures *f)
{
    char column[64];
#define READ(field, name)                                                                                    \
    snprintf(column, sizeof column, "%s" name, prefix);                                                      \
    f->field = number_of(r, column);
    HCI_GRID_FIGURES(READ)
#undef READ
    snprintf(column, sizeof column, "%sbinds", prefix);
    read_binds(text_of(r, column), f);
}

static void read_verdict(reader *r, hci_grid_row *row)
{
    const char *word = text_of(r, "verdict");
    int k = 0;
    while (k <= HCI_GRID_FAILED && strcmp(word, hci_grid_verdict_name((hci_grid_verdict)k)) != 0)
        ++k;
    if (k > HCI_GRID_FAILED && !r->status)
        r->status = hci_csv_error(r->csv, "verdict", r->row, r->note,
                                  "one of reached, ripple, torque, limits, failed",
                                  "points.csv is written by hci-solve sweep; delete it and begin anew");
    row->verdict = k > HCI_GRID_FAILED ? HCI_GRID_FAILED : (hci_grid_verdict)k;
}

static void read_point(reader *r, hci_grid_point *p)
{
    p->torque_Nm = number_of(r, "torque_Nm");
    p->speed_rad_per_s = number_of(r, "speed_rad_per_s");
    p->link_V = number_of(r, "dc_link_V");
    p->limit_current_A = number_of(r, "limit_phase_A");
    p->limit_copper = number_of(r, "limit_loss_to_plain");
}

static bool is_same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static bool is_same_point(const hci_grid_point *a, const hci_grid_point *b)
{
    return is_same(a->torque_Nm, b->torque_Nm) && is_same(a->speed_rad_per_s, b->speed_rad_per_s) &&
           is_same(a->link_V, b->link_V) && is_same(a->limit_current_A, b->limit_current_A) &&
           is_same(a->limit_copper, b->limit_copper);
}

static hci_status read_row(reader *r, hci_grid *s)
{
    hci_grid_row row = {.verdict = HCI_GRID_FAILED};
    const double number = number_of(r, "point");
    const size_t at = number >= 1.0 && number <= (double)s->plan.count ? (size_t)number - 1 : s->plan.count;
    read_point(r, &row.point);
    read_figures(r, "", &row.best);
    read_figures(r, "most_", &row.most);
    read_figures(r, "sine_", &row.sine);
    read_verdict(r, &row);
    snprintf(row.reason, sizeof row.reason, "%s", text_of(r, "reason"));
    if (r->status) return r->status;
    if (at == s->plan.count || !is_same_point(&row.point, &s->plan.point[at]))
        return hci_csv_error(r->csv, "point", r->row, r->note, "a point of this grid",
                             "points.csv is written by hci-solve sweep; delete it and begin anew");
    s->row[at] = row;
    s->done[at] = true;
    return HCI_OK;
}

/* The end of the file may be missing, and with it the last row; no other may be torn. */
static hci_status take_torn(hci_grid *s, const hci_csv *csv, hci_note *note)
{
    const size_t records = csv->records;
    if (csv->torn == 0) return HCI_OK;
    if (csv->torn > 1 || (records > 0 && csv->hole.line < hci_csv_record_line(csv, records - 1)))
        return hci_note_set(note, HCI_ERROR_INPUT, "%s", csv->hole.error.text);
    hci_note_add(&s->remark, "%s:%zu: the row ends before its last column; it is left out, and solved again",
                 csv->path, csv->hole.line);
    return HCI_OK;
}

static hci_status read_points(hci_grid *s, const char *path, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read_recording(path, &csv, note);
    if (status) return status;
    status = take_torn(s, csv, note);
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row) {
        reader r = {csv, row, HCI_OK, note};
        status = read_row(&r, s);
    }
    hci_csv_free(csv);
    return status;
}

hci_status hci_grid_take_points(hci_grid *sweep, const hci_grid_inputs *inputs, const char *folder,
                                bool must_be, hci_note *note)
{
    char path[PATH_SIZE];
    hci_status status = hci_machine_path(path, sizeof path, folder, POINTS, note);
    if (status) return status;
    if (!hci_machine_has(path) && !must_be) return HCI_OK;
    status = check_inputs(inputs, folder, note);
    return status ? status : read_points(sweep, path, note);
}

/* ---- one sweep at a time ---- */

enum { WAIT_ms = 500 };

hci_status hci_grid_lock(const char *folder, void **lock, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    bool is_alone;
    if (*lock) return HCI_OK;
    *lock = hci_folder_lock_take(folder, WAIT_ms, &is_alone);
    if (*lock || errno != EWOULDBLOCK) return HCI_OK; /* what cannot be written is told by who writes */
    return hci_note_set(note, HCI_ERROR_OUTPUT,
                        "%s: another process works at the sweep there, and each would write its points over "
                        "those of the other; expected one at a time: wait for it, or give each --shard its "
                        "own --out and put them together with --join",
                        hci_quote_path(folder, shown));
}

void hci_grid_unlock(void *lock)
{
    hci_folder_lock_release(lock);
}
