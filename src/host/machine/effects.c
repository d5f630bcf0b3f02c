#define _POSIX_C_SOURCE 200809L

#include "hci/host/machine/effects.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/base/number.h"
#include "hci/host/base/spelling.h"
#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/csv/column.h"
#include "host/csv/name_values.h"
#include "host/machine/effect_rows.h"

#define PATH_SIZE 4096
#define LIST_SIZE 640

/* Of a longer list of parameters, these many are named: half from its start, half from its end. */
enum { MOST_NAMES = 20 };

/* ---- reading ---- */

/* One row of the file; `type` is a place in the registry. */
typedef struct {
    size_t type;
    hci_effect_term term;
    size_t row;
} effect_row;

static void append(char list[LIST_SIZE], const char *before, const char *name, const char *after)
{
    const size_t used = strlen(list);
    snprintf(list + used, LIST_SIZE - used, "%s%s%s", before, name, after);
}

enum { MOST_TYPES = 64, REMEDY_SIZE = 120 };

/* "; did you mean `friction`?", or nothing. */
static void suggest(const char *name, const char *const *names, char remedy[REMEDY_SIZE])
{
    const char *nearest = hci_nearest(name, names);
    const size_t used = strlen(remedy);
    if (nearest != NULL) snprintf(remedy + used, REMEDY_SIZE - used, "; did you mean `%s`?", nearest);
}

static hci_status type_error(const hci_csv *csv, size_t row, const char *name, hci_note *note)
{
    char list[LIST_SIZE] = "one of", remedy[REMEDY_SIZE] = "correct the name or delete the row";
    const char *names[MOST_TYPES + 1] = {NULL};
    const hci_effect_type *type;
    for (size_t k = 0; k < MOST_TYPES && (type = hci_effect_type_at(k)) != NULL; ++k)
        names[k] = type->name;
    suggest(name, names, remedy);
    for (size_t k = 0; (type = hci_effect_type_at(k)) != NULL; ++k)
        append(list, k > 0 ? ", " : " ", type->name, "");
    return hci_csv_error(csv, "effect", row, note, list, remedy);
}

static hci_status parameter_error(const hci_csv *csv, size_t row, const hci_effect_type *type, hci_note *note)
{
    char list[LIST_SIZE] = "one of";
    const size_t count = type->parameter_count;
    const size_t from = count > MOST_NAMES ? MOST_NAMES / 2 : count, to = count - MOST_NAMES / 2;
    for (size_t k = 0; k < count; ++k) {
        if (k == from) append(list, ", ", "…", "");
        if (k < from || k >= to)
            append(list, k > 0 ? ", " : " ", type->parameter[k].name,
                   type->parameter[k].ordered ? "_ORDER" : "");
    }
    return hci_csv_error(csv, "parameter", row, note, list,
                         "these are the parameters of this effect; an order is a number, as in sine_18");
}

static hci_status read_type(const hci_csv *csv, effect_row *r, hci_note *note)
{
    const hci_effect_type *type;
    const char *name;
    const hci_status status = hci_csv_text(csv, "effect", r->row, &name, note);
    if (status) return status;
    for (r->type = 0; (type = hci_effect_type_at(r->type)) != NULL; ++r->type)
        if (strcmp(type->name, name) == 0) return HCI_OK;
    return type_error(csv, r->row, name, note);
}

/* Is `name` the parameter, with its order where it has one? */
static bool is_parameter(const hci_effect_parameter *parameter, const char *name, double *order)
{
    const size_t length = strlen(parameter->name);
    *order = 0.0;
    if (!parameter->ordered) return strcmp(parameter->name, name) == 0;
    return strncmp(parameter->name, name, length) == 0 && name[length] == '_' &&
           hci_number_parse(name + length + 1, order);
}

static hci_status check_order(const hci_csv *csv, const effect_row *r, const hci_effect_parameter *parameter,
                              hci_note *note)
{
    const double order = r->term.order;
    if (!parameter->ordered) return HCI_OK;
    if (order < parameter->least_order)
        return hci_csv_error(csv, "parameter", r->row, note,
                             parameter->least_order >= 1.0  ? "an order from 1"
                             : parameter->least_order > 0.0 ? "an order above 0"
                                                            : "an order of 0 or more",
                             "give a negative order as the positive one; order 0 is a mean and has no sine");
    if (parameter->whole && fabs(order - floor(order + 0.5)) > HCI_ORDER_TOLERANCE)
        return hci_csv_error(csv, "parameter", r->row, note, "a whole order",
                             "fractional electrical orders are what mechanical_order is for");
    return HCI_OK;
}

static hci_status read_parameter(const hci_csv *csv, effect_row *r, hci_note *note)
{
    const hci_effect_type *type = hci_effect_type_at(r->type);
    const char *name;
    const hci_status status = hci_csv_text(csv, "parameter", r->row, &name, note);
    if (status) return status;
    for (size_t k = 0; k < type->parameter_count; ++k) {
        if (!is_parameter(&type->parameter[k], name, &r->term.order)) continue;
        r->term.parameter = k;
        return check_order(csv, r, &type->parameter[k], note);
    }
    return parameter_error(csv, r->row, type, note);
}

/* An empty cell, or no such column, is a standard error that is not known. */
static hci_status read_std_error(const hci_csv *csv, effect_row *r, hci_note *note)
{
    const char *text = "";
    hci_status status = HCI_OK;
    r->term.std_error = NAN;
    if (hci_csv_has(csv, "std_error")) status = hci_csv_text(csv, "std_error", r->row, &text, note);
    if (status || text[0] == '\0') return status;
    status = hci_csv_number(csv, "std_error", r->row, &r->term.std_error, note);
    if (!status && r->term.std_error < 0.0)
        return hci_csv_error(csv, "std_error", r->row, note, "0 or more",
                             "leave it empty when it is not known");
    return status;
}

static hci_status read_value(const hci_csv *csv, effect_row *r, hci_note *note)
{
    const hci_effect_parameter *parameter = &hci_effect_type_at(r->type)->parameter[r->term.parameter];
    double factor;
    char expected[64];
    hci_status status = hci_csv_number(csv, "value", r->row, &r->term.value, note);
    if (!status) status = hci_value_factor(csv, r->row, parameter->unit, &factor, note);
    if (!status) status = read_std_error(csv, r, note);
    if (status) return status;
    r->term.value *= factor;
    r->term.std_error *= factor;
    if (!isfinite(r->term.value) || isinf(r->term.std_error))
        return hci_csv_error(csv, "value", r->row, note, "a smaller number", "check the unit of this value");
    if (r->term.value >= parameter->least) return HCI_OK;
    snprintf(expected, sizeof expected, "at least %g in %s", parameter->least, parameter->unit);
    return hci_csv_error(csv, "value", r->row, note, expected, "check the value and its sign");
}

/* By type, parameter and order; what is the same stays as it stood. */
static int by_place(const void *a, const void *b)
{
    const effect_row *x = a, *y = b;
    if (x->type != y->type) return x->type < y->type ? -1 : 1;
    if (x->term.parameter != y->term.parameter) return x->term.parameter < y->term.parameter ? -1 : 1;
    if (x->term.order != y->term.order) return x->term.order < y->term.order ? -1 : 1;
    return x->row < y->row ? -1 : 1;
}

static hci_status sort_rows(const hci_csv *csv, effect_row *rows, size_t count, hci_note *note)
{
    if (count > 1) qsort(rows, count, sizeof *rows, by_place);
    for (size_t k = 1; k < count; ++k) {
        const effect_row *x = &rows[k - 1], *y = &rows[k];
        if (x->type == y->type && x->term.parameter == y->term.parameter &&
            y->term.order - x->term.order <= HCI_ORDER_TOLERANCE)
            return hci_csv_error(csv, "parameter", x->row > y->row ? x->row : y->row, note,
                                 "each parameter of an effect once", "join the two rows into one");
    }
    return HCI_OK;
}

static hci_status read_rows(const hci_csv *csv, effect_row *rows, size_t count, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; k < count && !status; ++k) {
        rows[k].row = k;
        status = read_type(csv, &rows[k], note);
        if (!status) status = read_parameter(csv, &rows[k], note);
        if (!status) status = read_value(csv, &rows[k], note);
    }
    return status ? status : sort_rows(csv, rows, count, note);
}

/* Sorted rows to effects with their terms. */
static void group(const effect_row *rows, size_t count, hci_effects_data *effects)
{
    size_t n = 0;
    for (size_t k = 0; k < count; ++k) {
        effects->term[k] = rows[k].term;
        if (k == 0 || rows[k].type != rows[k - 1].type)
            effects->effect[n++] = (hci_effect){hci_effect_type_at(rows[k].type), &effects->term[k], 0};
        ++effects->effect[n - 1].count;
    }
    effects->list = (hci_effects){effects->effect, n};
}

/* Without rows as well: a table without effects is one, another table is a mistake. */
static hci_status check_columns(const hci_csv *csv, hci_note *note)
{
    static const char *const NAME[] = {"effect", "parameter", "value"};
    return hci_columns_check(csv, NAME, sizeof NAME / sizeof *NAME, note);
}

hci_status hci_effects_of_csv(const hci_csv *csv, hci_effects_data *effects, size_t *row_of, hci_note *note)
{
    const size_t count = hci_csv_rows(csv);
    effect_row *rows = hci_memory_new(count, sizeof *rows);
    hci_status status = HCI_OK;
    memset(effects, 0, sizeof *effects);
    effects->effect = hci_memory_new(count, sizeof *effects->effect);
    effects->term = hci_memory_new(count, sizeof *effects->term);
    if (!rows || !effects->effect || !effects->term)
        status = hci_note_memory(note, hci_csv_path(csv), "%zu rows", count);
    if (!status) status = check_columns(csv, note);
    if (!status) status = read_rows(csv, rows, count, note);
    if (!status) group(rows, count, effects);
    for (size_t k = 0; k < count && row_of && !status; ++k)
        row_of[k] = rows[k].row;
    hci_memory_free(rows);
    if (status) hci_effects_release(effects);
    return status;
}

hci_status hci_effects_read(const char *path, hci_effects_data *effects, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    memset(effects, 0, sizeof *effects);
    if (status) return status;
    status = hci_effects_of_csv(csv, effects, NULL, note);
    hci_csv_free(csv);
    return status;
}

hci_status hci_effects_read_machine(const char *folder, hci_effects_data *effects, hci_note *note)
{
    char path[PATH_SIZE];
    struct stat info;
    const int length = snprintf(path, sizeof path, "%s/effects.csv", folder);
    memset(effects, 0, sizeof *effects);
    if (length < 0 || length >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %d bytes", folder,
                            PATH_SIZE - 1);
    if (stat(path, &info) != 0 && errno == ENOENT) return HCI_OK;
    return hci_effects_read(path, effects, note);
}

void hci_effects_release(hci_effects_data *effects)
{
    hci_memory_free(effects->effect);
    hci_memory_free(effects->term);
    memset(effects, 0, sizeof *effects);
}

/* ---- writing ---- */

void hci_effect_term_write(hci_output *output, const hci_effect_type *type, const hci_effect_term *term)
{
    const hci_effect_parameter *parameter = &type->parameter[term->parameter];
    hci_output_text(output, "%s,%s", type->name, parameter->name);
    if (parameter->ordered) {
        char order[32];
        hci_number_text(term->order, order);
        hci_output_text(output, "_%s", order);
    }
    hci_output_text(output, ",");
    hci_output_number(output, term->value, ',');
    hci_output_text(output, "%s,", parameter->unit);
}

static void write_term(hci_output *output, const hci_effect_type *type, const hci_effect_term *term)
{
    hci_effect_term_write(output, type, term);
    if (isnan(term->std_error))
        hci_output_text(output, "\n");
    else
        hci_output_number(output, term->std_error, '\n');
}

hci_status hci_effects_write(hci_output *output, const hci_effects *effects, hci_note *note)
{
    const hci_status status = hci_output_file(output, "effects.csv", note);
    if (status) return status;
    hci_output_text(output, "effect,parameter,value,unit,std_error\n");
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j)
            write_term(output, effects->effect[k].type, &effects->effect[k].term[j]);
    return HCI_OK;
}
