#include "host/recording/run_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/column_name.h"
#include "host/csv/name_words.h"
#include "host/csv/table.h"
#include "host/numeric/statistics.h"

static const char *const NAME[HCI_RUN_COLUMN_COUNT] = {
#define NAME_ONE(name, text) text,
    HCI_RUN_COLUMNS(NAME_ONE)
#undef NAME_ONE
};

static hci_status memory_error(const hci_run_columns *c)
{
    return hci_note_memory(c->note, hci_csv_path(c->csv), "%zu samples", c->count);
}

static hci_status no_samples(const hci_run_columns *c)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(c->note, HCI_ERROR_INPUT,
                        "%s:%zu: found a header and no samples below it, expected a row for each sample; "
                        "record the run again",
                        hci_quote_path(hci_csv_path(c->csv), path), hci_csv_record_line(c->csv, 0));
}

static bool has_any(const hci_run_columns *c)
{
    bool any = false;
    for (int k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
        any = any || c->has[k];
    return any;
}

bool hci_run_columns_suffice(const hci_run_columns *c)
{
    const bool speed = c->has[HCI_RUN_SPEED] || c->has[HCI_RUN_SPEED_E];
    return c->has[HCI_RUN_THETA_M] || c->has[HCI_RUN_THETA_E] || c->has[HCI_RUN_VA] || c->has[HCI_RUN_VAB] ||
           (c->has[HCI_RUN_TIME] && speed) || (c->has[HCI_RUN_TORQUE] && c->has[HCI_RUN_IQ]);
}

/* A torque over currents, with nothing that an angle could come of. */
static bool is_map(const hci_run_columns *c)
{
    const bool speed = c->has[HCI_RUN_SPEED] || c->has[HCI_RUN_SPEED_E];
    return !c->has[HCI_RUN_VA] && !c->has[HCI_RUN_VAB] && !(c->has[HCI_RUN_TIME] && speed);
}

static bool has_word(const char *name, const char *word)
{
    char lower[64] = "";
    for (size_t k = 0; name[k] != '\0' && k + 1 < sizeof lower; ++k)
        lower[k] = (char)(name[k] >= 'A' && name[k] <= 'Z' ? name[k] - 'A' + 'a' : name[k]);
    return strstr(lower, word) != NULL;
}

/* Could a column that is not known be the angle? Counts of an encoder are told apart. */
static bool looks_like_angle(const char *name)
{
    static const char *const WORDS[] = {"angle",    "theta",  "encoder",   "enc_",  "position", "winkel",
                                        "resolver", "angolo", "angulaire", "angul", "rotor"};
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k)
        if (has_word(name, WORDS[k]) && !has_word(name, "current")) return true;
    return hci_name_words_like(HCI_LIKE_POSITION, name, NULL);
}

/* A speed in rpm under a name with "rotor", say, is none. */
static bool has_unit_of_another(const hci_run_columns *c, size_t column)
{
    const hci_unit *unit = hci_column_unit(c->csv, column);
    return unit != NULL && unit->dimension != hci_unit_find("rad", 3)->dimension;
}

/* The header of the first column after another one that is likely to be the angle; NULL: none. */
static const char *next_likely_angle(const hci_run_columns *c, size_t *column_after)
{
    for (size_t column = *column_after; column < hci_csv_columns(c->csv); ++column) {
        const char *name = hci_csv_name(c->csv, column);
        bool known = false;
        for (int k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
            known = known || (c->has[k] && c->at[k] == column);
        *column_after = column + 1;
        if (!known && (hci_csv_counts(name) || (looks_like_angle(name) && !has_unit_of_another(c, column))))
            return name;
    }
    return NULL;
}

static const char *likely_angle(const hci_run_columns *c)
{
    size_t first = 0;
    return next_likely_angle(c, &first);
}

/* Where several may be it, the reader has to choose: that of the rotor, not of a shaft behind a gear. */
static void say_other_angles(const hci_run_columns *c, hci_note *missing)
{
    size_t column = 0;
    next_likely_angle(c, &column);
    for (const char *name; (name = next_likely_angle(c, &column)) != NULL;)
        hci_note_add(missing, "so may `%.60s` be; take that of the rotor, not of a shaft behind a gear",
                     name);
}

/* The first column in volts, under a name that is not known; NULL: none. */
static const char *likely_voltage(const hci_run_columns *c)
{
    const hci_unit *volt = hci_unit_find("V", 1);
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column) {
        const hci_unit *unit = hci_column_unit(c->csv, column);
        if (unit != NULL && unit->dimension == volt->dimension &&
            !hci_column_is_known(hci_csv_name(c->csv, column)))
            return hci_csv_name(c->csv, column);
    }
    return NULL;
}

/* The place of a header. */
static size_t place_of(const hci_run_columns *c, const char *header)
{
    size_t column = 0;
    while (column + 1 < hci_csv_columns(c->csv) && hci_csv_name(c->csv, column) != header)
        ++column;
    return column;
}

/* "_deg", which --column needs where the header has no unit, and which would overrule one that it has. */
static const char *unit_to_say(const hci_run_columns *c, const char *header, const char *unit)
{
    return hci_column_unit(c->csv, place_of(c, header)) == NULL ? unit : "";
}

/* Of what may be the angle: counts by its name or its numbers. of_turn: out, counts of a turn; 0: not told.
 */
static bool is_counted(const hci_run_columns *c, const char *header, double *of_turn)
{
    const bool by_numbers = hci_csv_is_counted(c->csv, place_of(c, header), of_turn);
    return hci_csv_counts(header) || (by_numbers && *unit_to_say(c, header, "_") != '\0');
}

static void say_counts(const char *name, double of_turn, hci_note *missing)
{
    char counts[32] = "COUNTS";
    if (of_turn > 0.0) snprintf(counts, sizeof counts, "%.0f", of_turn);
    hci_note_add(missing,
                 "if `%.60s` is an encoder, say --column \"theta_m=%.60s/%s\" with its counts of a turn%s%s",
                 name, name, counts, of_turn > 0.0 ? "" : ", such as 4096",
                 hci_csv_counts(name) ? "" : " (theta_m_deg if it is in whole degrees)");
}

static void say_voltage(const hci_run_columns *c, hci_note *missing)
{
    const char *voltage = likely_voltage(c);
    if (voltage != NULL)
        hci_note_add(missing,
                     "if `%.60s` is a voltage of the machine turned by another, say --column \"va=%.60s\" "
                     "(vab line to line) and so of the others",
                     voltage, voltage);
}

void hci_run_columns_say_angle(const hci_run_columns *c, hci_note *missing)
{
    const char *name = likely_angle(c);
    double of_turn;
    say_voltage(c, missing);
    if (name == NULL && c->has[HCI_RUN_TIME])
        hci_note_add(
            missing,
            "or say which column it is: --column theta_m_deg=COLUMN; a column `speed_rpm` beside the "
            "time will do, too");
    else if (name == NULL)
        hci_note_add(missing, "or say which column it is: --column theta_m_deg=COLUMN");
    else if (is_counted(c, name, &of_turn))
        say_counts(name, of_turn, missing);
    else if (*unit_to_say(c, name, "_deg") != '\0')
        hci_note_add(missing,
                     "if `%.60s` is the angle of the rotor, say --column \"theta_m_deg=%.60s\" (or "
                     "theta_m_rad; theta_e of an "
                     "electrical angle)",
                     name, name);
    else
        hci_note_add(missing,
                     "if `%.60s` is the angle of the rotor, say --column \"theta_m=%.60s\" (theta_e of an "
                     "electrical angle)",
                     name, name);
    say_other_angles(c, missing);
}

/* ---- counts of an encoder ---- */

#define NEAR 0.05 /* of the counts of a turn, by which those that a speed tells are off */

/* Parts of the recording that each tell them. */
enum { COUNT_PARTS = 100 };

double hci_usual_counts(double found)
{
    const double binary = exp2(round(log2(found)));
    const double decade = pow(10.0, floor(log10(found))),
                 decimal = round(found / decade * 2.0) / 2.0 * decade;
    const double nearest = fabs(found - binary) < fabs(found - decimal) ? binary : decimal;
    return fabs(found / nearest - 1.0) < NEAR ? nearest : 0.0;
}

/* Whether they begin anew, and go over more than `most`: a turn is not less than that. */
static bool is_wrapped_over(const double *counts, size_t n, double most)
{
    double least = counts[0], greatest = counts[0], longest = 0.0;
    for (size_t k = 1; k < n; ++k) {
        least = fmin(least, counts[k]);
        greatest = fmax(greatest, counts[k]);
        longest = fmax(longest, fabs(counts[k] - counts[k - 1]));
    }
    return longest > 0.5 * (greatest - least) && greatest - least > most;
}

/* Of a turn; 0: not told. The median of the parts, of which a few go over the end of a turn or a gap. */
static double counts_of_turn(const double *counts, const double *theta_m_rad, size_t n)
{
    double part[COUNT_PARTS];
    size_t parts = 0;
    for (size_t k = 0; k < COUNT_PARTS && n > COUNT_PARTS; ++k) {
        const size_t from = k * (n - 1) / COUNT_PARTS, to = (k + 1) * (n - 1) / COUNT_PARTS;
        const double turned_rad = theta_m_rad[to] - theta_m_rad[from];
        if (fabs(turned_rad) > 0.0) part[parts++] = 2.0 * HCI_PI * (counts[to] - counts[from]) / turned_rad;
    }
    const double found = parts > 0 ? fabs(hci_median(part, parts)) : 0.0;
    return found > 1.0 && !is_wrapped_over(counts, n, (1.0 + NEAR) * found) ? hci_usual_counts(found) : 0.0;
}

hci_status hci_run_columns_angle_like(const hci_run_columns *c, const double *theta_m_rad,
                                      char text[HCI_RUN_NAME])
{
    const char *name = likely_angle(c);
    double of_turn = 0.0;
    if (name == NULL || strlen(name) + 24 > HCI_RUN_NAME) return HCI_OK;
    if (!is_counted(c, name, &of_turn)) {
        const char *unit = unit_to_say(c, name, "_deg");
        snprintf(text, HCI_RUN_NAME, "theta_m%s=%s", unit, name);
        hci_note_add(c->remark, "`%s` may be the angle: if it is, add --column '%s'%s", name, text,
                     *unit != '\0' ? " (theta_m_rad in rad)" : "");
        return HCI_OK;
    }
    hci_note unused = {{0}};
    double *counts = hci_memory_new(c->count, sizeof *counts);
    if (counts == NULL) return memory_error(c);
    if (!(of_turn > 0.0) && !hci_csv_numbers(c->csv, name, counts, &unused))
        of_turn = counts_of_turn(counts, theta_m_rad, c->count);
    hci_memory_free(counts);
    if (of_turn > 0.0)
        snprintf(text, HCI_RUN_NAME, "theta_m=%s/%.0f", name, of_turn);
    else
        snprintf(text, HCI_RUN_NAME, "theta_m=%s/COUNTS", name);
    hci_note_add(c->remark,
                 "`%s` may be the angle: if it is, add --column '%s', the counts of a turn behind the stroke",
                 name, text);
    return HCI_OK;
}

/* Orders, with amplitudes or components, and nothing of a recording. */
static hci_status refuse_orders(const hci_run_columns *c)
{
    char path[HCI_QUOTE_PATH_SIZE];
    bool has_order = false;
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column)
        has_order = has_order || hci_csv_same_name(hci_csv_name(c->csv, column), "order");
    if (!has_order || has_any(c)) return HCI_OK;
    return hci_note_set(
        c->note, HCI_ERROR_INPUT,
        "%s:%zu: found a table of orders, as a machine or a target has it, expected a recording: "
        "a row for each sample, with its angle; give the log that was measured",
        hci_quote_path(hci_csv_path(c->csv), path), hci_csv_record_line(c->csv, 0));
}

static bool has_names(const hci_csv *csv, const char *first, const char *second)
{
    return hci_csv_columns(csv) >= 2 && hci_csv_same_name(hci_csv_name(csv, 0), first) &&
           hci_csv_same_name(hci_csv_name(csv, 1), second);
}

/* A list of recordings, or of names of columns, where a recording is expected. */
static hci_status refuse_list(const hci_run_columns *c)
{
    char path[HCI_QUOTE_PATH_SIZE];
    const hci_csv *csv = c->csv;
    if (has_names(csv, "name", "column"))
        return hci_note_set(
            c->note, HCI_ERROR_INPUT,
            "%s: found a list of names of columns, expected a recording; leave it out: it is read "
            "with the recordings that it stands beside",
            hci_quote_path(hci_csv_path(csv), path));
    if (!has_names(csv, "file", "role")) return HCI_OK;
    return hci_note_set(c->note, HCI_ERROR_INPUT,
                        "%s: found a list of recordings, expected one of them; name the recordings one by "
                        "one, or give the list to --runs",
                        hci_quote_path(hci_csv_path(csv), path));
}

/* "`a`, `b`", the first columns of the file. */
static void list_columns(const hci_csv *csv, char *text, size_t size)
{
    char quoted[HCI_QUOTE_SIZE];
    size_t used = 0;
    for (size_t column = 0; column < hci_csv_columns(csv) && used < size; ++column)
        used += (size_t)snprintf(text + used, size - used, "%s%s", column > 0 ? ", " : "",
                                 hci_quote(hci_csv_name(csv, column), quoted));
    if (used >= size) snprintf(text + size - 6, 6, ", ...");
}

static hci_status no_angle(const hci_run_columns *c)
{
    char path[HCI_QUOTE_PATH_SIZE], list[240];
    hci_note text = {{0}};
    const bool is_likely = likely_angle(c) != NULL || likely_voltage(c) != NULL;
    list_columns(c->csv, list, sizeof list);
    hci_note_set(&text, HCI_OK,
                 "%s:%zu: found no angle of the rotor%s%s, expected a column theta_m or theta_e",
                 hci_quote_path(hci_csv_path(c->csv), path), hci_csv_record_line(c->csv, 0),
                 is_likely ? "" : " but ", is_likely ? "" : list);
    hci_run_columns_say_angle(c, &text);
    return hci_note_set(c->note, HCI_ERROR_INPUT, "%s", text.text);
}

/* Names of what may be something else, too, as long as its numbers do not go on from row to row. */
static bool may_be_time(const hci_run_columns *c, size_t column)
{
    static const char *const WORDS[] = {"unix", "epoch", "tick",    "milli", "micro",
                                        "msec", "usec",  "elapsed", "second"};
    const char *name = hci_csv_name(c->csv, column);
    bool is_named = hci_csv_same_name(name, "ms") || hci_csv_same_name(name, "us");
    double before = -INFINITY, first = NAN;
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k)
        is_named = is_named || has_word(name, WORDS[k]);
    for (size_t row = 0; row < hci_csv_rows(c->csv) && is_named; ++row) {
        double value;
        const char *cell = hci_csv_cell(c->csv, hci_csv_first_record(c->csv) + row, column);
        if (!hci_number_parse(cell, &value)) continue;
        if (value < before) return false;
        if (isnan(first)) first = value;
        before = value;
    }
    return before > first;
}

/* A column that is not read and is likely to be the time; NULL: none. */
static const char *likely_time(const hci_run_columns *c)
{
    static const char *const WORDS[] = {"time",   "zeit", "uhr",   "temps", "heure",
                                        "tiempo", "hora", "clock", "stamp"};
    const hci_unit *second = hci_unit_find("s", 1);
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column) {
        const char *name = hci_csv_name(c->csv, column);
        const hci_unit *unit = hci_column_unit(c->csv, column);
        if (hci_column_is_known(name)) continue;
        if (unit != NULL && unit->dimension == second->dimension) return name;
        for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS && unit == NULL; ++k)
            if (has_word(name, WORDS[k])) return name;
        if (unit == NULL && may_be_time(c, column)) return name;
    }
    return NULL;
}

/* "_ms" of a name that says milliseconds, and so on; "_s" of another. */
static const char *unit_of_time(const char *name)
{
    if (hci_csv_same_name(name, "ms") || has_word(name, "milli") || has_word(name, "msec")) return "_ms";
    return hci_csv_same_name(name, "us") || has_word(name, "micro") || has_word(name, "usec") ? "_us" : "_s";
}

/* What a tick is, from a name such as tick10ms, "/100"; or that it has to be said; "": no ticks. */
static void say_tick(const char *name, char text[32])
{
    double number = 1.0;
    char unit[3] = "";
    text[0] = '\0';
    if (!has_word(name, "tick")) return;
    snprintf(text, 32, "/TICKS_PER_S");
    const char *digits = name + strcspn(name, "0123456789");
    if (sscanf(digits, "%lf%2s", &number, unit) != 2 || !(number > 0.0)) return;
    const double s = strcmp(unit, "ms") == 0 ? 1e-3 : strcmp(unit, "us") == 0 ? 1e-6 : 0.0;
    if (s > 0.0) snprintf(text, 32, "/%.9g", 1.0 / (number * s));
}

static void tell_lost_time(hci_run_columns *c)
{
    char tick[32];
    const char *name = c->has[HCI_RUN_TIME] ? NULL : likely_time(c);
    if (name == NULL) return;
    say_tick(name, tick);
    const char *unit = tick[0] != '\0' ? "_s" : unit_to_say(c, name, unit_of_time(name));
    if (strlen(name) <= 50) snprintf(c->time_like, HCI_RUN_NAME, "time%.3s=%.50s%.31s", unit, name, tick);
    hci_note_add(
        c->remark, "no column is read as the time: if `%.60s` is it, say --column \"time%s=%.60s%s\"%s", name,
        unit, name, tick, strcmp(unit, "_s") == 0 && tick[0] == '\0' ? " (time_ms in milliseconds)" : "");
}

/* Neither angle nor voltages: most likely a column under another name. Where voltages would do without an
 * angle, one that may be either is refused all the same, and not passed over. */
static hci_status check_angle(const hci_run_columns *c, bool is_needed)
{
    if (c->has[HCI_RUN_THETA_M] || c->has[HCI_RUN_THETA_E]) return HCI_OK;
    hci_status status = refuse_list(c);
    if (!status) status = refuse_orders(c);
    if (!status) status = hci_csv_check_clear(c->csv, c->note);
    if (!status && !is_needed && has_any(c) && !c->has[HCI_RUN_VA] && !c->has[HCI_RUN_VAB]) {
        hci_note_add(c->remark, "no angle: what needs it is not compared");
        hci_run_columns_say_angle(c, c->remark);
    }
    if (status || (!is_needed && has_any(c))) return status;
    if (hci_run_columns_suffice(c) && !(is_map(c) && likely_angle(c) != NULL)) return HCI_OK;
    return no_angle(c);
}

static hci_status find(const hci_csv *csv, bool needs_angle, hci_run_columns *c, hci_note *remark,
                       hci_note *note)
{
    *c = (hci_run_columns){.csv = csv, .count = hci_csv_rows(csv), .remark = remark, .note = note};
    if (c->count == 0) return no_samples(c);
    c->used = hci_memory_new(hci_csv_columns(csv), sizeof *c->used);
    if (!c->used) return memory_error(c);
    for (int k = 0; k < HCI_RUN_COLUMN_COUNT; ++k)
        c->has[k] = hci_csv_find(csv, NAME[k], &c->at[k]);
    const hci_status status = check_angle(c, needs_angle);
    if (!status) tell_lost_time(c);
    if (!status && csv->decided.text[0]) hci_note_add(remark, "%s", csv->decided.text);
    if (!status && hci_csv_header_line(csv) > 0)
        hci_note_add(remark, "line %zu is the header, what stands before it is not read",
                     hci_csv_header_line(csv));
    return status;
}

hci_status hci_run_columns_find(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note)
{
    return find(csv, true, c, remark, note);
}

hci_status hci_run_columns_find_any(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note)
{
    return find(csv, false, c, remark, note);
}

void hci_run_columns_release(hci_run_columns *c)
{
    for (int k = 0; k < HCI_RUN_COLUMN_COUNT; ++k) {
        hci_memory_free(c->value[k]);
        hci_memory_free(c->ready[k]);
    }
    hci_memory_free(c->row);
    hci_memory_free(c->used);
    memset(c, 0, sizeof *c);
}

const char *hci_run_column_name(hci_run_column which)
{
    return NAME[which];
}

/* Do angles turn over at 360, or go round in quarters of whole numbers? */
static bool look_like_degrees(const double *angle, size_t count)
{
    double least = angle[0], most = angle[0], longest = 0.0;
    bool even = true;
    for (size_t k = 0; k < count; ++k) {
        least = fmin(least, angle[k]);
        most = fmax(most, angle[k]);
        if (k > 0) longest = fmax(longest, fabs(angle[k] - angle[k - 1]));
        even = even && fabs(4.0 * angle[k] - round(4.0 * angle[k])) < 1e-9;
    }
    const double range = most - least;
    return range >= 330.0 && range <= 361.0 && most <= 361.0 && least >= -361.0 && (even || longest >= 330.0);
}

/* An angle without a unit is in rad. */
static void tell_degrees(const hci_run_columns *c, hci_run_column which)
{
    char quoted[HCI_QUOTE_SIZE];
    const hci_column_match found = hci_column_find(c->csv, NAME[which]);
    const char *name = which == HCI_RUN_THETA_M ? "theta_m_deg" : "theta_e_deg", *header;
    const char *unit = found.alias != NULL ? found.alias->unit : NULL;
    const bool is_in_rad = found.alias == NULL || (unit != NULL && strcmp(unit, "rad") == 0);
    if ((which != HCI_RUN_THETA_M && which != HCI_RUN_THETA_E) || found.has_unit || !is_in_rad) return;
    if (!look_like_degrees(c->value[which], c->count)) return;
    header = hci_quote(hci_csv_name(c->csv, found.column), quoted);
    hci_note_add(
        c->remark,
        "%s has no unit and is read in rad, but looks like degrees: name it %s, or say --column %s=COLUMN",
        header, name, name);
}

hci_status hci_run_column_read(hci_run_columns *c, hci_run_column which)
{
    hci_note told = {{0}};
    hci_status status = HCI_OK;
    if (!c->has[which] || c->value[which]) return HCI_OK;
    if (hci_csv_told(c->csv, NAME[which], &told)) hci_note_add(c->remark, "%s", told.text);
    c->used[c->at[which]] = true;
    c->value[which] = c->ready[which];
    c->ready[which] = NULL;
    if (!c->value[which]) {
        c->value[which] = hci_memory_new(c->count, sizeof(double));
        if (!c->value[which]) return memory_error(c);
        status = hci_csv_numbers(c->csv, NAME[which], c->value[which], c->note);
    }
    if (!status) tell_degrees(c, which);
    return status;
}

double *hci_run_column_take(hci_run_columns *c, hci_run_column which)
{
    double *value = c->value[which];
    c->value[which] = NULL;
    return value;
}

void hci_run_column_drop(hci_run_columns *c, hci_run_column which)
{
    hci_memory_free(hci_run_column_take(c, which));
}

void hci_run_column_leave(hci_run_columns *c, hci_run_column which)
{
    if (c->has[which]) c->used[c->at[which]] = true;
}

void hci_run_computed_torque_leave(hci_run_columns *c)
{
    char quoted[HCI_QUOTE_SIZE];
    if (!c->has[HCI_RUN_TORQUE_COMPUTED] || c->used[c->at[HCI_RUN_TORQUE_COMPUTED]]) return;
    hci_run_column_leave(c, HCI_RUN_TORQUE_COMPUTED);
    hci_note_add(c->remark, "%s is a torque that the drive has computed from its current: it is not used",
                 hci_quote(hci_csv_name(c->csv, c->at[HCI_RUN_TORQUE_COMPUTED]), quoted));
}

const char *hci_run_column_header(const hci_run_columns *c, hci_run_column which, size_t *line)
{
    if (!c->has[which]) return NULL;
    *line = hci_csv_record_line(c->csv, 0);
    return hci_csv_name(c->csv, c->at[which]);
}

double hci_run_column_factor(const hci_run_columns *c, hci_run_column which)
{
    return fabs(hci_column_find(c->csv, NAME[which]).factor);
}

bool hci_run_column_names_unit(const hci_run_columns *c, hci_run_column which)
{
    return c->has[which] && hci_column_find(c->csv, NAME[which]).has_unit;
}

size_t hci_run_column_unit_line(const hci_run_columns *c, hci_run_column which)
{
    return c->has[which] && hci_csv_row_unit(c->csv, c->at[which]) ? hci_csv_record_line(c->csv, 1) : 0;
}

void hci_run_columns_tell_unused(const hci_run_columns *c)
{
    hci_csv_unused(c->csv, c->used, c->remark);
}

static bool is_of_a_hundred(const hci_run_columns *c, size_t column)
{
    return strchr(hci_csv_name(c->csv, column), '%') != NULL;
}

/* "torque_Nm=NAME", or what there is room for. */
static void remedy_of(const hci_run_columns *c, const char *quantity, const char *unit, const char *name,
                      char text[HCI_RUN_NAME])
{
    snprintf(text, HCI_RUN_NAME, "%s%s=%s", quantity, unit_to_say(c, name, unit), name);
}

/* Whether a column was not read, and there is room to say how. */
static bool is_left(const hci_run_columns *c, size_t column)
{
    return !c->used[column] &&
           strlen(hci_csv_name(c->csv, column)) + 10 + sizeof HCI_RUN_DIGITS_PER_A < HCI_RUN_NAME;
}

/* "Kraft [N]", "F_N" */
static bool is_in_newton(const char *name)
{
    static const char *const ENDS[] = {"_N", " N", "[N]", "(N)", "/N"};
    const size_t length = strlen(name);
    for (size_t k = 0; k < sizeof ENDS / sizeof *ENDS; ++k)
        if (length > strlen(ENDS[k]) && strcmp(name + length - strlen(ENDS[k]), ENDS[k]) == 0) return true;
    return false;
}

static bool is_force(const char *name)
{
    static const char *const WORDS[] = {"force", "kraft", "load", "weight", "gewicht", "fuerza", "forza"};
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k)
        if (has_word(name, WORDS[k])) return true;
    return is_in_newton(name);
}

/* A load cell on a lever. */
static void say_force(const hci_run_columns *c, char text[HCI_RUN_NAME])
{
    char quoted[HCI_QUOTE_SIZE];
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column) {
        const char *name = hci_csv_name(c->csv, column);
        if (!is_left(c, column) || !is_force(name)) continue;
        hci_note_add(c->remark,
                     "%s may be the force of a load cell: the torque is force x lever, --column "
                     "'torque_Nm=%s/NUMBER' with 1 over the lever in m as NUMBER (of a force in kg 0.102 "
                     "over it, in g 102 over it)",
                     hci_quote(name, quoted), name);
        snprintf(text, HCI_RUN_NAME, "%s", name);
        return;
    }
}

void hci_run_columns_torque_like(const hci_run_columns *c, char text[HCI_RUN_NAME], char force[HCI_RUN_NAME])
{
    char quoted[HCI_QUOTE_SIZE];
    for (size_t column = 0; column < hci_csv_columns(c->csv) && text[0] == '\0'; ++column) {
        const char *is = hci_csv_name(c->csv, column);
        if (!is_left(c, column) ||
            !hci_name_words_like(HCI_LIKE_TORQUE, is, hci_csv_row_unit(c->csv, column)))
            continue;
        if (is_of_a_hundred(c, column)) {
            hci_note_add(
                c->remark,
                "%s may be the torque in per cent of another one, which cannot be read: if it is, write a "
                "column torque_Nm with it times that torque in N·m, over 100",
                hci_quote(is, quoted));
            return;
        }
        remedy_of(c, "torque", "_Nm", is, text);
        hci_note_add(c->remark, "%s may be the torque: if it is, add --column '%s'", hci_quote(is, quoted),
                     text);
    }
    if (text[0] == '\0') say_force(c, force);
}

/* Which current a name is likely to be of: along d where it says so, else along q. */
static const char *axis_of(const char *name)
{
    return hci_name_words_along_d(name) ? "id" : "iq";
}

void hci_run_columns_current_like(const hci_run_columns *c, char text[HCI_RUN_NAME])
{
    char quoted[HCI_QUOTE_SIZE], remedy[HCI_RUN_NAME];
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column) {
        const char *name = hci_csv_name(c->csv, column), *axis = axis_of(name);
        if (!is_left(c, column) ||
            !hci_name_words_like(HCI_LIKE_CURRENT, name, hci_csv_row_unit(c->csv, column)))
            continue;
        const bool is_digits = hci_csv_is_sixteen_bits(name);
        remedy_of(c, axis, "_A", name, remedy);
        if (is_digits) strcat(remedy, HCI_RUN_DIGITS_PER_A);
        if (text[0] == '\0' && axis[1] == 'q') memcpy(text, remedy, sizeof remedy);
        hci_note_add(c->remark, "%s is a current that was not read: if it is i_%c, add --column '%s'%s",
                     hci_quote(name, quoted), axis[1], remedy,
                     is_digits ? ", with what the firmware has for 1 A, which the numbers do not tell" : "");
    }
}

void hci_run_columns_speed_like(const hci_run_columns *c)
{
    char quoted[HCI_QUOTE_SIZE], remedy[HCI_RUN_NAME];
    for (size_t column = 0; column < hci_csv_columns(c->csv); ++column) {
        const char *name = hci_csv_name(c->csv, column);
        if (!is_left(c, column) ||
            !hci_name_words_like(HCI_LIKE_SPEED, name, hci_csv_row_unit(c->csv, column)))
            continue;
        remedy_of(c, "speed", "_rpm", name, remedy);
        hci_note_add(
            c->remark, "%s may be the speed: if it is, add --column '%s'%s", hci_quote(name, quoted), remedy,
            *unit_to_say(c, name, "_") != '\0' ? " (speed_rad_per_s in rad/s, speed_rev_per_s in turn/s)"
                                               : "");
        return;
    }
}

/* ---- three phases */

int hci_run_phase_count(const hci_run_columns *c, hci_run_column first)
{
    return c->has[first] + c->has[first + 1] + c->has[first + 2];
}

bool hci_run_voltages(const hci_run_columns *c, hci_run_column *first)
{
    const int phases = hci_run_phase_count(c, HCI_RUN_VA), lines = hci_run_phase_count(c, HCI_RUN_VAB);
    *first = phases == 3 || (phases == 2 && lines < 2) ? HCI_RUN_VA : HCI_RUN_VAB;
    return hci_run_phase_count(c, *first) >= 2;
}

/* ---- phase currents in amperes rms ---- */

#define BOTH_SIDES 0.3 /* of the largest of both ends, that a current which swings has at each */

/* In amperes rms by the file, and not by what the user says. */
static bool is_in_rms(const hci_run_columns *c, hci_run_column which)
{
    for (size_t k = 0; k < c->csv->given_count; ++k)
        if (c->csv->given[k].column == c->at[which]) return false;
    const hci_unit *unit = c->has[which] ? hci_column_unit(c->csv, c->at[which]) : NULL;
    return unit != NULL && hci_unit_equal(unit, hci_unit_find("Arms", 4));
}

static bool swings(const double *value, size_t count)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < count; ++k) {
        least = fmin(least, value[k]);
        most = fmax(most, value[k]);
    }
    return fmin(-least, most) > BOTH_SIDES * fmax(-least, most);
}

/* An rms value has one sign: one that swings to both sides stands for itself. */
static void take_instantaneous(hci_run_columns *c, hci_run_column which)
{
    char quoted[HCI_QUOTE_SIZE];
    double *value = c->value[which];
    if (!value || c->is_instantaneous[which - HCI_RUN_IA] || !is_in_rms(c, which) || !swings(value, c->count))
        return;
    const double factor = hci_run_column_factor(c, which);
    for (size_t k = 0; k < c->count; ++k)
        value[k] /= factor;
    const bool said = c->is_instantaneous[0] || c->is_instantaneous[1] || c->is_instantaneous[2];
    c->is_instantaneous[which - HCI_RUN_IA] = true;
    const char *name = hci_csv_name(c->csv, c->at[which]);
    if (!said)
        hci_note_add(
            c->remark,
            "%s swings to both sides of 0, as no rms value does: phase currents that do are read in A "
            "as they stand; of a drive that logs them over √2 say --column '%.2s_Arms=%.60s', and so "
            "of each",
            hci_quote(name, quoted), NAME[which], name);
}

hci_status hci_run_phases_read(hci_run_columns *c, hci_run_column first)
{
    hci_status status = HCI_OK;
    for (unsigned s = 0; s < 3 && !status; ++s) {
        status = hci_run_column_read(c, first + s);
        if (!status && first == HCI_RUN_IA) take_instantaneous(c, first + s);
    }
    return status;
}

static void lines_to_phases(double v[3])
{
    const double ab = v[0], bc = v[1], ca = v[2];
    v[0] = (ab - ca) / 3.0;
    v[1] = (bc - ab) / 3.0;
    v[2] = (ca - bc) / 3.0;
}

void hci_run_phases_at(const hci_run_columns *c, hci_run_column first, size_t sample, double x[3])
{
    int absent = -1;
    for (unsigned s = 0; s < 3; ++s) {
        const double *value = c->value[first + s];
        if (!value) absent = (int)s;
        x[s] = value ? value[sample] : 0.0;
    }
    if (absent >= 0) x[absent] = -(x[0] + x[1] + x[2]);
    if (first == HCI_RUN_VAB) lines_to_phases(x);
}
