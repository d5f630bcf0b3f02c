#define _POSIX_C_SOURCE 200809L

#include "hci/host/recording/column_names.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/base/spelling.h"
#include "hci/host/base/text.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/column_name.h"
#include "host/csv/table.h"
#include "host/recording/run_columns.h"

#define FILE_NAME "columns.csv"

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

/* Of a column that is not to be read. */
static bool is_left_out(const char *name)
{
    return strcmp(name, HCI_CSV_LEFT_OUT) == 0;
}

/* Names in the units that logs have, as people would write them. */
static const char *const USUAL[] = {
    "time_ms",    "time_us",     "theta_m_deg",        "theta_m_turn", "theta_e_deg", "theta_e_turn",
    "speed_rpm",  "speed_e_rpm", "speed_turn_per_s",   "iq_mA",        "id_mA",       "torque_mNm",
    "torque_Ncm", "va_mV",       "speed_e_turn_per_s", "ia_mA",        "ib_mA",       "ic_mA"};

enum { USUAL_COUNT = sizeof USUAL / sizeof *USUAL, NAMES_COUNT = HCI_RUN_COLUMN_COUNT + USUAL_COUNT };

static void list_names(const char *names[NAMES_COUNT + 1])
{
    size_t count = 0;
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
        names[count++] = hci_run_column_name(k);
    for (size_t k = 0; k < USUAL_COUNT; ++k)
        names[count++] = USUAL[k];
    names[count] = NULL;
}

/* The quantity that a name begins with, whatever stands behind it as a unit; HCI_RUN_COLUMN_COUNT: none. */
static unsigned quantity_before_unit(const char *name)
{
    unsigned found = HCI_RUN_COLUMN_COUNT;
    size_t longest = 0;
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT; ++k) {
        const hci_wanted_column want = hci_wanted_column_of(hci_run_column_name(k));
        if (want.base_length <= longest || strncmp(name, want.base, want.base_length) != 0 ||
            name[want.base_length] != '_')
            continue;
        found = k;
        longest = want.base_length;
    }
    return found;
}

/* "units of it are those of `theta_m_rad`, `theta_m_deg`, `theta_m_turn`". */
static void suggest_units(unsigned quantity, char *text, size_t size)
{
    const char *name = hci_run_column_name(quantity);
    const size_t base = hci_wanted_column_of(name).base_length;
    size_t used = (size_t)snprintf(text, size, "it has units as in `%s`", name);
    for (size_t k = 0; k < USUAL_COUNT && used < size; ++k)
        if (quantity_before_unit(USUAL[k]) == quantity && strncmp(USUAL[k], name, base) == 0)
            used += (size_t)snprintf(text + used, size - used, ", `%s`", USUAL[k]);
}

/* "did you mean `torque_Nm`?", the units of a quantity, or all quantities that there are. */
static void suggest_quantity(const char *name, char *text, size_t size)
{
    const char *names[NAMES_COUNT + 1], *nearest;
    char plain[32];
    size_t used = 0;
    list_names(names);
    snprintf(plain, sizeof plain, "%s", name);
    for (char *at = plain; *at != '\0'; ++at)
        if (*at == '-' || *at == ' ') *at = '_';
    nearest = hci_nearest(plain, names);
    if (nearest != NULL) {
        snprintf(text, size, "did you mean `%s`?", nearest);
        return;
    }
    if (quantity_before_unit(plain) != HCI_RUN_COLUMN_COUNT) {
        suggest_units(quantity_before_unit(plain), text, size);
        return;
    }
    for (unsigned k = 0; k < HCI_RUN_COLUMN_COUNT && used < size; ++k)
        used += (size_t)snprintf(text + used, size - used, "%s%s", k > 0 ? ", " : "write one of ", names[k]);
    if (used < size)
        snprintf(text + used, size - used,
                 ", its unit that of the column (torque_mNm), or without it where the header says one");
}

/* ---- the zero of the angle, which is no column ---- */

#define OFFSET "angle_offset"

/* "angle_offset", or with a unit of angle behind it. unit: out, degrees without it. */
static bool is_offset(const char *name, const hci_unit **unit)
{
    const hci_unit *degree = hci_unit_find("deg", 3);
    const size_t length = strlen(OFFSET);
    *unit = degree;
    if (!hci_text_begins(name, OFFSET, length)) return false;
    if (name[length] == '\0') return true;
    *unit = name[length] == '_' ? hci_unit_of_suffix(name + length + 1) : NULL;
    return *unit != NULL && (*unit)->dimension == degree->dimension;
}

/* "-31", "-31 deg", "-0.54rad", in the unit of the name where it has none itself. */
static bool offset_of(const hci_column_name *item, double *offset_rad)
{
    static const char MINUS[] = "\xE2\x88\x92"; /* − */
    const hci_unit *unit, *own;
    char number[40];
    const char *text = item->column;
    const bool is_negative = strncmp(text, MINUS, sizeof MINUS - 1) == 0;
    if (is_negative) text += sizeof MINUS - 1;
    const size_t length = strspn(text, "+-.0123456789eE");
    if (!is_offset(item->name, &unit) || length == 0 || length >= sizeof number) return false;
    memcpy(number, text, length);
    number[length] = '\0';
    text += length + strspn(text + length, " ");
    own = *text != '\0' ? hci_unit_find(text, strlen(text)) : unit;
    if (own == NULL || own->dimension != unit->dimension || !hci_number_parse(number, offset_rad))
        return false;
    *offset_rad *= own->factor * (is_negative ? -1.0 : 1.0);
    return true;
}

/* Whether it is an offset. *status: out, whether a good one. */
static bool check_offset(const hci_column_name *item, hci_status bad, hci_status *status, hci_note *note)
{
    const hci_unit *unit;
    double offset_rad;
    char quoted[HCI_QUOTE_SIZE];
    if (!is_offset(item->name, &unit)) return false;
    *status = offset_of(item, &offset_rad)
                  ? HCI_OK
                  : hci_note_set(note, bad,
                                 "%.300s: found %s, expected an electrical angle to be added to that of the "
                                 "recording, in degrees or with its unit, such as -31.5 or -0.55rad",
                                 item->from, hci_quote(item->column, quoted));
    return true;
}

/* "iq [A]", which is a header and no name of a quantity: the quantity as it is written before the sign. */
static void suggest_before_header(const hci_column_name *item, char *text, size_t size)
{
    const char *name = hci_run_column_name(quantity_of(item->column));
    const int base = (int)hci_wanted_column_of(name).base_length;
    snprintf(text, size, "the column `%.200s` is read by %.*s=%.200s, and the column `%.200s` by %.*s=%.200s",
             item->column, base, name, item->column, item->name, base, name, item->name);
}

/* Also of the two exchanged: "Winkel=theta_m"; or with the sign before the name: "-iq=current". */
static hci_status unknown_name(const hci_column_name *item, hci_status status, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE], remedy[900];
    if (item->name[0] == '-' && is_quantity(item->name + 1))
        snprintf(remedy, sizeof remedy, "the opposite sign stands before the column: %.200s=-%.200s",
                 item->name + 1, item->column);
    else if (is_quantity(item->column) && strchr(item->column, ' '))
        suggest_before_header(item, remedy, sizeof remedy);
    else if (is_quantity(item->column))
        snprintf(
            remedy, sizeof remedy,
            "the column stands behind the sign: %s=%.200s, of a column of that name; one that is called %s "
            "needs none",
            item->column, item->name, item->column);
    else
        suggest_quantity(item->name, remedy, sizeof remedy);
    return hci_note_set(note, status, "%.300s: found %s, expected a quantity of a recording; %s", item->from,
                        hci_quote(item->name, quoted), remedy);
}

/* ---- the list ---- */

static void release(hci_column_name *item)
{
    hci_memory_free(item->name);
    hci_memory_free(item->column);
    hci_memory_free(item->from);
}

/* Takes the three texts, whatever is returned. */
static hci_status append(hci_column_names *names, hci_column_name item, hci_note *note)
{
    hci_column_name *larger = hci_memory_resize(names->item, names->count + 1, sizeof *larger);
    if (larger != NULL) names->item = larger;
    if (larger != NULL && item.name != NULL && item.column != NULL && item.from != NULL) {
        names->item[names->count++] = item;
        return HCI_OK;
    }
    release(&item);
    return hci_note_memory(note, NULL, "names of columns");
}

/* Of "-COLUMN/NUMBER" the column, with where it ends. */
static const char *plain_column(const char *text, size_t *length)
{
    double number;
    text += text[0] == '-' && text[1] != '\0';
    const char *slash = strrchr(text, '/');
    *length = slash != NULL && slash > text && hci_number_parse(slash + 1, &number) ? (size_t)(slash - text)
                                                                                    : strlen(text);
    return text;
}

static bool is_same_column(const hci_column_name *a, const hci_column_name *b)
{
    size_t of_a, of_b;
    const char *x = plain_column(a->column, &of_a), *y = plain_column(b->column, &of_b);
    return of_a == of_b && memcmp(x, y, of_a) == 0;
}

/* The same words twice do no harm, and a column in two units, signs or counts would be read by the last. */
static bool is_said_otherwise(const hci_column_name *a, const hci_column_name *b)
{
    const hci_unit *unit;
    const bool is_again = strcmp(a->name, b->name) == 0 && strcmp(a->column, b->column) == 0;
    if (is_offset(a->name, &unit) && is_offset(b->name, &unit)) return !is_again;
    return is_quantity(a->name) && quantity_of(a->name) == quantity_of(b->name) && is_same_column(a, b) &&
           !is_again;
}

/* One column cannot be two quantities, nor one quantity twice. */
static hci_status check_one_meaning(const hci_column_names *names, const hci_column_name *item,
                                    hci_status bad, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE];
    for (size_t k = 0; k < names->count; ++k) {
        const hci_column_name *before = &names->item[k];
        const bool is_left = is_left_out(before->name) != is_left_out(item->name);
        if (is_said_otherwise(before, item) || (is_left && is_same_column(before, item)))
            return hci_note_set(note, bad,
                                "%.300s: found it beside `%.80s=%.200s`, expected one of the two; leave the "
                                "other out",
                                item->from, before->name, before->column);
        if (strcmp(before->column, item->column) == 0 && is_quantity(item->name) &&
            quantity_of(before->name) != quantity_of(item->name))
            return hci_note_set(note, bad, "%.300s: found %s, which is `%s` already, expected another column",
                                item->from, hci_quote(item->column, quoted), before->name);
    }
    return HCI_OK;
}

/* "i_d" and "v_ab_mV", as messages and pages write them: "id", "vab_mV". */
static void drop_subscript(char *name)
{
    static const char *const SUBSCRIPTS[] = {"d", "q", "a", "b", "c", "ab", "bc", "ca"};
    if ((name[0] != 'i' && name[0] != 'v') || name[1] != '_') return;
    const size_t length = strcspn(name + 2, "_");
    for (size_t k = 0; k < sizeof SUBSCRIPTS / sizeof *SUBSCRIPTS; ++k)
        if (strlen(SUBSCRIPTS[k]) == length && memcmp(SUBSCRIPTS[k], name + 2, length) == 0) {
            memmove(name + 1, name + 2, strlen(name + 2) + 1);
            return;
        }
}

/* The same of what may be no name of a quantity: then `bad`. */
static hci_status add(hci_column_names *names, hci_column_name item, hci_status bad, hci_note *note)
{
    hci_status status = HCI_OK;
    const bool is_whole = item.name != NULL && item.column != NULL && item.from != NULL;
    if (is_whole) drop_subscript(item.name);
    if (is_whole && !check_offset(&item, bad, &status, note) && !is_quantity(item.name) &&
        !is_left_out(item.name))
        status = unknown_name(&item, bad, note);
    if (is_whole && !status) status = check_one_meaning(names, &item, bad, note);
    if (!status) return append(names, item, note);
    release(&item);
    return status;
}

hci_status hci_column_names_add(hci_column_names *names, const char *text, hci_note *note)
{
    char from[400];
    const char *equals = strchr(text, '=');
    snprintf(from, sizeof from, "--column %s", text);
    if (equals == NULL || equals == text || equals[1] == '\0')
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "--column: found `%.200s`, expected NAME=COLUMN such as torque_Nm=AI3; quote a name with "
            "blanks: --column 'torque_Nm=Torque [Nm]'",
            text);
    size_t length = (size_t)(equals - text);
    while (length > 1 && text[length - 1] == ' ')
        --length;
    const char *column = equals + 1 + (equals[2] != '\0' ? strspn(equals + 1, " ") : 0);
    const hci_column_name item = {hci_memory_text_part(text, length), hci_memory_text(column),
                                  hci_memory_text(from)};
    return add(names, item, HCI_ERROR_ARGUMENT, note);
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
        const hci_column_name item = {hci_memory_text_part(part, name),
                                      hci_memory_text_part(part + name + 1, length - name - 1),
                                      hci_memory_text(from)};
        status = add(names, item, HCI_ERROR_INPUT, note);
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
    const hci_column_name item = {hci_memory_text(name), hci_memory_text(column), hci_memory_text(from)};
    return add(names, item, HCI_ERROR_INPUT, note);
}

/* Without it the first row would be taken for it, and be passed over. */
static hci_status check_header(const hci_csv *csv, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], one[HCI_QUOTE_SIZE];
    if (hci_csv_has(csv, "name") && hci_csv_has(csv, "column")) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:1: found %s, expected the header name,column; write it above the rows",
                        hci_quote_path(hci_csv_path(csv), path),
                        hci_csv_columns(csv) > 0 ? hci_quote(hci_csv_name(csv, 0), one) : "no column");
}

hci_status hci_column_names_read(hci_column_names *names, const char *path, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    status = check_header(csv, note);
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
    struct stat info;
    const bool is_there = hci_unread_stat(path, &info);
    const hci_status status = is_there ? hci_column_names_read(names, path, note) : HCI_OK;
    hci_memory_free(path);
    return status;
}

void hci_column_names_release(hci_column_names *names)
{
    for (size_t k = 0; k < names->count; ++k)
        release(&names->item[k]);
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

/* "COLUMN/NUMBER": an angle in the counts of an encoder, of which a turn has NUMBER, or a quantity that is
 * the column over the number. length: out, of COLUMN; 0: there is no such number. */
static double divisor_of(const hci_column_name *item, size_t *length)
{
    const char *slash = strrchr(item->column, '/');
    double divisor;
    if (slash == NULL || slash == item->column || !hci_number_parse(slash + 1, &divisor)) return 0.0;
    *length = (size_t)(slash - item->column);
    return isfinite(divisor) ? divisor : 0.0;
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

static hci_status given_counts_error(const hci_column_name *item, hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: found counts of a turn, expected them with an angle; write %s=COLUMN",
                        item->from, item->name);
}

static hci_status counts_error(const hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    double of_turn;
    if (!hci_csv_is_counted(csv, column, &of_turn) || !(of_turn > 0.0)) of_turn = 4096.0;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: found %s in %s, which looks like the counts of an encoder, expected how many a turn has; "
        "write %s=%s/COUNTS, such as %s/%.0f, or its unit if it has one, such as theta_m_deg=%s",
        item->from, hci_quote(item->column, quoted), hci_quote_path(hci_csv_path(csv), path), item->name,
        item->column, item->column, of_turn, item->column);
}

/* "torque_Nm=cell_N*0.2": a number divides a column and does not multiply it. */
static hci_status times_column(const hci_column_name *item, bool *is_times, hci_note *note)
{
    const char *star = strrchr(item->column, '*');
    double number = 0.0;
    char column[HCI_QUOTE_SIZE];
    *is_times = star != NULL && hci_number_parse(star + 1, &number) && number != 0.0;
    if (!*is_times) return HCI_OK;
    snprintf(column, sizeof column, "%.*s", (int)(star - item->column), item->column);
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: found a column times %s, expected one divided by a number: %s=%s/%.10g",
                        item->from, star + 1, item->name, column, 1.0 / number);
}

static hci_status no_such_column(const hci_csv *csv, const hci_column_name *item, hci_note *note)
{
    enum { MOST = 64 };
    const char *names[MOST + 1] = {NULL};
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE], other[HCI_QUOTE_SIZE], list[300] = "";
    size_t used = 0;
    bool is_times;
    const hci_status times = times_column(item, &is_times, note);
    if (is_times) return times;
    for (size_t k = 0; k < hci_csv_columns(csv) && k < MOST; ++k)
        names[k] = hci_csv_name(csv, k);
    const char *nearest = hci_nearest(item->column, names);
    for (size_t k = 0; names[k] != NULL && used < sizeof list; ++k)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s",
                                 k > 0             ? ", "
                                 : nearest != NULL ? " It has "
                                                   : "; it has ",
                                 hci_quote(names[k], other));
    double place;
    if (hci_number_parse(item->column, &place) && place >= 1.0 && place == floor(place) &&
        place <= (double)hci_csv_columns(csv))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%.300s: found no column %s in %s, expected a column by its name; column %.0f is %s", item->from,
            hci_quote(item->column, quoted), hci_quote_path(hci_csv_path(csv), path), place,
            hci_quote(hci_csv_name(csv, (size_t)place - 1), other));
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

/* Numbers of a firmware, of which nobody but it knows the unit. */
static hci_status digits_error(const hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%.300s: found %s in %s, whose numbers are 16 bits of a firmware and in no unit, "
                        "expected how many of them are 1 of the quantity, which the firmware knows; write "
                        "%s=%s/NUMBER, such as %s/%s",
                        item->from, hci_quote(hci_csv_name(csv, column), quoted),
                        hci_quote_path(hci_csv_path(csv), path), item->name, item->column, item->column,
                        is_angle(item->name) ? "65536 for an angle" : "1638 where 1638 are 1 A");
}

static hci_status give(hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    double of_turn;
    if (!is_left_out(item->name) && hci_csv_is_sixteen_bits(hci_csv_name(csv, column)))
        return digits_error(csv, item, column, note);
    if (is_angle(item->name) && !has_unit(item->name, csv, column) &&
        (hci_csv_counts(item->column) || hci_csv_is_counted(csv, column, &of_turn)))
        return counts_error(csv, item, column, note);
    return hci_csv_give(csv, item->name, column, note);
}

/* The column before the "/NUMBER". */
static bool find_divided(const hci_csv *csv, const hci_column_name *item, size_t *column)
{
    char header[256];
    size_t length;
    if (divisor_of(item, &length) == 0.0 || length >= sizeof header) return false;
    memcpy(header, item->column, length);
    header[length] = '\0';
    return find_header(csv, header, column);
}

/* "-COLUMN" as "COLUMN". */
static hci_column_name without_sign(const hci_column_name *item)
{
    return (hci_column_name){item->name, item->column + (item->column[0] == '-'), item->from};
}

/* Whether another row names the column of the same quantity, as where one list serves recordings of two
 * languages. */
static bool is_named_otherwise(const hci_column_names *names, const hci_column_name *item, const hci_csv *csv)
{
    for (size_t k = 0; k < names->count && !is_left_out(item->name); ++k) {
        const hci_column_name *other = &names->item[k];
        size_t column;
        if (other == item || quantity_of(other->name) != quantity_of(item->name)) continue;
        const hci_column_name plain = without_sign(other);
        if (find_header(csv, other->column, &column) || find_header(csv, plain.column, &column) ||
            find_divided(csv, &plain, &column))
            return true;
    }
    return false;
}

/* Counts that begin again before there are as many as a turn is said to have. */
static hci_status check_counts(const hci_csv *csv, const hci_column_name *item, size_t column, double said,
                               hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    const char *header = hci_csv_name(csv, column);
    const double of_turn = hci_csv_counts_that_begin_again(csv, column);
    if (!(of_turn > 0.0) || !(said > of_turn)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%.300s: found %.10g counts of a turn, but %.100s in %s goes from 0 to %.0f and begins "
        "again, expected no more than it has; write %s=%.100s/%.0f",
        item->from, said, header, hci_quote_path(hci_csv_path(csv), path), of_turn - 1.0, item->name, header,
        of_turn);
}

static hci_status give_divided(hci_csv *csv, const hci_column_name *item, size_t column, hci_note *note)
{
    size_t length;
    const double divisor = divisor_of(item, &length);
    if (is_angle(item->name) && divisor >= 1.0) {
        const hci_status status = check_counts(csv, item, column, divisor, note);
        return status ? status : hci_csv_give_counts(csv, item->name, column, divisor, note);
    }
    if (is_angle(item->name) ||
        (hci_csv_counts(hci_csv_name(csv, column)) && quantity_of(item->name) == HCI_RUN_TORQUE))
        return given_counts_error(item, note);
    const hci_status status = hci_csv_give(csv, item->name, column, note);
    if (!status) csv->given[csv->given_count - 1].divisor = divisor;
    return status;
}

/* *found: whether the file has the column. */
static hci_status apply_column(hci_csv *csv, const hci_column_name *item, bool *found, hci_note *note)
{
    size_t column;
    *found = true;
    if (find_header(csv, item->column, &column)) return give(csv, item, column, note);
    if (find_divided(csv, item, &column)) return give_divided(csv, item, column, note);
    *found = false;
    return HCI_OK;
}

/* "-COLUMN", where no header is written so, has the opposite sign. *found: whether the file has the column,
 * or needs none. */
static hci_status apply(hci_csv *csv, const hci_column_name *item, bool *found, hci_note *note)
{
    size_t column;
    if (offset_of(item, &csv->angle_offset_rad)) {
        csv->has_angle_offset = *found = true;
        return HCI_OK;
    }
    if (item->column[0] != '-' || find_header(csv, item->column, &column))
        return apply_column(csv, item, found, note);
    const hci_column_name opposite = without_sign(item);
    const hci_status status = apply_column(csv, &opposite, found, note);
    if (!status && *found) csv->given[csv->given_count - 1].divisor *= -1.0;
    return status;
}

/* A file that has two columns which one list names for the same quantity: one would be passed over. */
static hci_status check_given_once(const hci_csv *csv, size_t first, const hci_column_name *item,
                                   hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], one[HCI_QUOTE_SIZE], other[HCI_QUOTE_SIZE];
    const hci_csv_given *last = csv->given_count > first ? &csv->given[csv->given_count - 1] : NULL;
    if (last != NULL && is_left_out(last->name)) return HCI_OK;
    for (size_t k = first; last != NULL && k + 1 < csv->given_count; ++k)
        if (quantity_of(csv->given[k].name) == quantity_of(last->name) &&
            csv->given[k].column != last->column)
            return hci_note_set(
                note, HCI_ERROR_INPUT,
                "%.300s: found %s beside %s in %s, expected one column for a quantity; leave one "
                "of the two out",
                item->from, hci_quote(hci_csv_name(csv, last->column), one),
                hci_quote(hci_csv_name(csv, csv->given[k].column), other),
                hci_quote_path(hci_csv_path(csv), path));
    return HCI_OK;
}

hci_status hci_column_names_apply(const hci_column_names *names, bool optional, hci_csv *csv, hci_note *note)
{
    hci_status status = HCI_OK;
    const size_t first = csv->given_count;
    for (size_t k = 0; names != NULL && k < names->count && !status; ++k) {
        const hci_column_name *item = &names->item[k];
        bool found;
        status = apply(csv, item, &found, note);
        if (!status && found) status = check_given_once(csv, first, item, note);
        if (!status && !found && !is_named_otherwise(names, item, csv) &&
            (!optional || !has_quantity(csv, item->name)))
            status = no_such_column(csv, item, note);
    }
    return status;
}

hci_status hci_column_names_apply_found(const hci_column_names *names, size_t *found, hci_csv *csv,
                                        hci_note *note)
{
    hci_status status = HCI_OK;
    const size_t first = csv->given_count;
    for (size_t k = 0; names != NULL && k < names->count && !status; ++k) {
        bool has;
        status = apply(csv, &names->item[k], &has, note);
        if (!status && has) status = check_given_once(csv, first, &names->item[k], note);
        if (has || is_named_otherwise(names, &names->item[k], csv)) ++found[k];
    }
    return status;
}

hci_status hci_column_names_check_found(const hci_column_names *names, const size_t *found, const char *path,
                                        hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t k = 0; names != NULL && k < names->count && !status; ++k) {
        const hci_column_names one = {&names->item[k], 1};
        hci_csv *csv;
        if (found[k] > 0) continue;
        status = hci_csv_read_recording(path, &csv, note);
        if (status) return status;
        status = hci_column_names_apply(&one, false, csv, note);
        hci_csv_free(csv);
    }
    return status;
}
