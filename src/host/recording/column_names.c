#include "hci/host/recording/column_names.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/base/spelling.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/column_name.h"
#include "host/csv/table.h"
#include "host/recording/run_columns.h"

#define FILE_NAME "columns.csv"

static char *copy_of(const char *text, size_t length)
{
    char *copy = hci_memory_malloc(length + 1);
    if (copy == NULL) return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

/* ---- quantities ---- */

/* The quantity that a name asks for, in whatever unit; HCI_RUN_COLUMN_COUNT: none. */
static unsigned quantity_of(const char *name)
{
    const hci_unit *unit;
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT; ++k) {
        const hci_wanted_column want = hci_wanted_column_of(hci_run_column_name(k));
        if (hci_column_split(name, &want, &unit) && (unit == NULL || unit->dimension == want.unit->dimension))
            return k;
    }
    return HCI_RUN_COLUMN_COUNT;
}

static bool is_quantity(const char *name)
{
    return quantity_of(name) != HCI_RUN_COLUMN_COUNT && strlen(name) < 32;
}

/* "; did you mean `torque_Nm`?", or all that there is. */
static void suggest_quantity(const char *name, char *text, size_t size)
{
    const char *names[HCI_RUN_COLUMN_COUNT + 1] = {NULL};
    size_t used = 0;
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
        names[k] = hci_run_column_name(k);
    const char *nearest = hci_nearest(name, names);
    if (nearest != NULL) {
        snprintf(text, size, "did you mean `%s`?", nearest);
        return;
    }
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT && used < size; ++k)
        used += (size_t)snprintf(text + used, size - used, "%s%s", k > 0 ? ", " : "write one of ", names[k]);
}

static hci_status unknown_name(const char *from, const char *name, hci_status status, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE], remedy[400];
    suggest_quantity(name, remedy, sizeof remedy);
    return hci_note_set(note, status, "%.300s: found %s, expected a quantity of a recording; %s", from,
                        hci_quote(name, quoted), remedy);
}

/* ---- the list ---- */

/* Takes the three texts, whatever is returned. */
static hci_status add(hci_column_names *names, hci_column_name item, hci_note *note)
{
    hci_column_name *larger = hci_memory_resize(names->item, names->count + 1, sizeof *larger);
    if (larger != NULL) names->item = larger;
    if (larger != NULL && item.name != NULL && item.column != NULL && item.from != NULL) {
        names->item[names->count++] = item;
        return HCI_OK;
    }
    hci_memory_free(item.name);
    hci_memory_free(item.column);
    hci_memory_free(item.from);
    return hci_note_memory(note, NULL, "names of columns");
}

hci_status hci_column_names_add(hci_column_names *names, const char *text, hci_note *note)
{
    char from[400];
    const char *equals = strchr(text, '=');
    snprintf(from, sizeof from, "--column %s", text);
    if (equals == NULL || equals == text || equals[1] == '\0')
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "--column: found `%.200s`, expected NAME=COLUMN such as torque_Nm=AI3", text);
    const hci_column_name item = {copy_of(text, (size_t)(equals - text)),
                                  copy_of(equals + 1, strlen(equals + 1)), copy_of(from, strlen(from))};
    if (item.name != NULL && !is_quantity(item.name)) {
        unknown_name(from, item.name, HCI_ERROR_ARGUMENT, note);
        hci_memory_free(item.name);
        hci_memory_free(item.column);
        hci_memory_free(item.from);
        return HCI_ERROR_ARGUMENT;
    }
    return add(names, item, note);
}

hci_status hci_column_names_add_text(hci_column_names *names, const char *text, const char *from,
                                     hci_note *note)
{
    hci_status status = HCI_OK;
    for (const char *part = text; *part != '\0' && !status; part += *part == ';') {
        const size_t length = strcspn(part, ";"), name = strcspn(part, "=;");
        if (name == 0 || name + 1 >= length)
            return hci_note_set(note, HCI_ERROR_INPUT,
                                "%.300s: found `%.200s`, expected NAME=COLUMN;NAME=COLUMN such as "
                                "torque_Nm=AI3",
                                from, part);
        const hci_column_name item = {copy_of(part, name), copy_of(part + name + 1, length - name - 1),
                                      copy_of(from, strlen(from))};
        const bool known = item.name == NULL || is_quantity(item.name);
        if (!known) status = unknown_name(from, item.name, HCI_ERROR_INPUT, note);
        const hci_status added = add(names, item, note);
        if (!status) status = added;
        part += length;
    }
    return status;
}

static size_t text_append(char *text, size_t used, const char *part, char end)
{
    const size_t length = strlen(part);
    if (text != NULL) memcpy(text + used, part, length);
    if (text != NULL) text[used + length] = end;
    return used + length + 1;
}

/* Into text, or only its length with the 0 at the end. */
static size_t text_make(const hci_column_names *const *names, size_t count, char *text)
{
    size_t used = 0;
    for (size_t j = 0; j < count; ++j)
        for (size_t k = 0; names[j] != NULL && k < names[j]->count; ++k) {
            used = text_append(text, used, names[j]->item[k].name, '=');
            used = text_append(text, used, names[j]->item[k].column, ';');
        }
    if (text != NULL) text[used > 0 ? used - 1 : 0] = '\0';
    return used + 1;
}

char *hci_column_names_text(const hci_column_names *const *names, size_t count)
{
    char *text = hci_memory_malloc(text_make(names, count, NULL));
    if (text != NULL) text_make(names, count, text);
    return text;
}

void hci_column_names_text_free(char *text)
{
    hci_memory_free(text);
}

static hci_status read_row(hci_column_names *names, const hci_csv *csv, size_t row, hci_note *note)
{
    const char *name, *column;
    char from[HCI_QUOTE_PATH_SIZE + 32], path[HCI_QUOTE_PATH_SIZE];
    hci_status status = hci_csv_text(csv, "name", row, &name, note);
    if (!status) status = hci_csv_text(csv, "column", row, &column, note);
    if (status) return status;
    snprintf(from, sizeof from, "%s:%zu", hci_quote_path(hci_csv_path(csv), path), hci_csv_line(csv, row));
    if (!is_quantity(name)) return unknown_name(from, name, HCI_ERROR_INPUT, note);
    const hci_column_name item = {copy_of(name, strlen(name)), copy_of(column, strlen(column)),
                                  copy_of(from, strlen(from))};
    return add(names, item, note);
}

hci_status hci_column_names_read(hci_column_names *names, const char *path, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row)
        status = read_row(names, csv, row, note);
    hci_csv_free(csv);
    return status;
}

hci_status hci_column_names_beside(hci_column_names *names, const char *file, hci_note *note)
{
    const char *slash = strrchr(file, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - file) + 1 : 0;
    char *path = hci_memory_malloc(folder + sizeof FILE_NAME);
    if (path == NULL) return hci_note_memory(note, NULL, "names of columns");
    memcpy(path, file, folder);
    memcpy(path + folder, FILE_NAME, sizeof FILE_NAME);
    FILE *there = fopen(path, "rb");
    if (there != NULL) fclose(there);
    const hci_status status = there != NULL ? hci_column_names_read(names, path, note) : HCI_OK;
    hci_memory_free(path);
    return status;
}

void hci_column_names_release(hci_column_names *names)
{
    for (size_t k = 0; k < names->count; ++k) {
        hci_memory_free(names->item[k].name);
        hci_memory_free(names->item[k].column);
        hci_memory_free(names->item[k].from);
    }
    hci_memory_free(names->item);
    memset(names, 0, sizeof *names);
}

/* ---- in a file ---- */

/* A column by its header, as it stands or without regard to case. */
static bool find_header(const hci_csv *csv, const char *header, size_t *column)
{
    for (int pass = 0; pass < 2; ++pass)
        for (*column = 0; *column < hci_csv_columns(csv); ++*column) {
            const char *name = hci_csv_name(csv, *column);
            if (pass == 0 ? strcmp(name, header) == 0 : hci_csv_same_name(name, header)) return true;
        }
    return false;
}

/* "COLUMN/COUNTS": an angle in the counts of an encoder, of which a turn has COUNTS. length: out, of COLUMN.
 */
static double counts_of(const hci_column_name *item, size_t *length)
{
    const char *slash = strrchr(item->column, '/');
    double counts;
    if (slash == NULL || slash == item->column || !hci_number_parse(slash + 1, &counts)) return 0.0;
    *length = (size_t)(slash - item->column);
    return counts >= 1.0 ? counts : 0.0;
}

/* An angle, of whatever unit. */
static bool is_angle(const char *name)
{
    static const hci_run_column ANGLES[] = {HCI_RUN_THETA_M, HCI_RUN_THETA_E};
    const hci_unit *unit;
    for (size_t k = 0; k < 2; ++k) {
        const hci_wanted_column want = hci_wanted_column_of(hci_run_column_name(ANGLES[k]));
        if (hci_column_split(name, &want, &unit)) return true;
    }
    return false;
}

static hci_status counts_error(const hci_csv *csv, const hci_column_name *item, bool given, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    if (given)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%.300s: found counts of a turn, expected them with an angle; write %s=COLUMN",
                            item->from, item->name);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: found %s in %s, which looks like the counts of an encoder, expected how many a turn has; "
        "write %s=%s/COUNTS, such as %s/4096, or its unit if it has one, such as theta_m_deg=%s",
        item->from, hci_quote(item->column, quoted), hci_quote_path(hci_csv_path(csv), path), item->name,
        item->column, item->column, item->column);
}

static hci_status no_such_column(const hci_csv *csv, const hci_column_name *item, hci_note *note)
{
    enum { MOST = 64 };
    const char *names[MOST + 1] = {NULL};
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE], other[HCI_QUOTE_SIZE], list[300] = "";
    size_t used = 0;
    for (size_t k = 0; k < hci_csv_columns(csv) && k < MOST; ++k)
        names[k] = hci_csv_name(csv, k);
    const char *nearest = hci_nearest(item->column, names);
    for (size_t k = 0; names[k] != NULL && used < sizeof list && nearest == NULL; ++k)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k > 0 ? ", " : "; it has ",
                                 hci_quote(names[k], other));
    return hci_note_set(note, HCI_ERROR_INPUT, "%.300s: found no column %s in %s%s%s%s%s", item->from,
                        hci_quote(item->column, quoted), hci_quote_path(hci_csv_path(csv), path),
                        nearest != NULL ? "; did you mean " : "",
                        nearest != NULL ? hci_quote(nearest, other) : "", nearest != NULL ? "?" : "", list);
}

/* Whether the file has the quantity under a name of its own. */
static bool has_quantity(const hci_csv *csv, const char *name)
{
    const unsigned which = quantity_of(name);
    return which != HCI_RUN_COLUMN_COUNT && hci_csv_has(csv, hci_run_column_name(which));
}

/* In what is no radian: that nobody counts in. */
static bool has_unit(const char *name, const hci_csv *csv, size_t column)
{
    size_t length;
    const hci_unit *said = hci_unit_of_name(name, &length);
    return (name[length] != '\0' && !hci_unit_equal(said, hci_unit_find("rad", 3))) ||
           hci_column_unit(csv, column) != NULL;
}

static hci_status give(hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    if (is_angle(item->name) && hci_csv_counts(item->column) && !has_unit(item->name, csv, column))
        return counts_error(csv, item, false, note);
    return hci_csv_give(csv, item->name, column, note);
}

/* The column before the "/COUNTS". */
static bool find_counted(const hci_csv *csv, const hci_column_name *item, size_t *column)
{
    char header[256];
    size_t length;
    if (counts_of(item, &length) <= 0.0 || length >= sizeof header) return false;
    memcpy(header, item->column, length);
    header[length] = '\0';
    return find_header(csv, header, column);
}

/* Whether another row names the column of the same quantity, as where one list serves recordings of two
 * languages. */
static bool is_named_otherwise(const hci_column_names *names, const hci_column_name *item, const hci_csv *csv)
{
    for (size_t k = 0; k < names->count; ++k) {
        const hci_column_name *other = &names->item[k];
        size_t column;
        if (other == item || quantity_of(other->name) != quantity_of(item->name)) continue;
        if (find_header(csv, other->column, &column) || find_counted(csv, other, &column)) return true;
    }
    return false;
}

static hci_status give_counted(hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    size_t length;
    return is_angle(item->name) ? hci_csv_give_counts(csv, item->name, column, counts_of(item, &length), note)
                                : counts_error(csv, item, true, note);
}

/* *found: whether the file has the column. */
static hci_status apply(hci_csv *csv, const hci_column_name *item, bool *found, hci_note *note)
{
    size_t column;
    *found = true;
    if (find_header(csv, item->column, &column)) return give(csv, item, column, note);
    if (find_counted(csv, item, &column)) return give_counted(csv, item, column, note);
    *found = false;
    return HCI_OK;
}

hci_status hci_column_names_apply(const hci_column_names *names, bool optional, hci_csv *csv, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; names != NULL && k < names->count && !status; ++k) {
        const hci_column_name *item = &names->item[k];
        bool found;
        status = apply(csv, item, &found, note);
        if (!found && !is_named_otherwise(names, item, csv) && (!optional || !has_quantity(csv, item->name))) status = no_such_column(csv, item, note);
    }
    return status;
}

hci_status hci_column_names_apply_found(const hci_column_names *names, size_t *found, hci_csv *csv, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; names != NULL && k < names->count && !status; ++k) {
        bool has;
        status = apply(csv, &names->item[k], &has, note);
        if (has || is_named_otherwise(names, &names->item[k], csv)) ++found[k];
    }
    return status;
}
