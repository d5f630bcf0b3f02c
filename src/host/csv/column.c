/* Which column of a table holds a quantity that is asked for by its canonical name. */
#include "host/csv/column.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/channel_name.h"
#include "host/csv/column_name.h"
#include "host/csv/name_words.h"
#include "host/csv/table.h"

/* ---- one column and what is asked for ---- */

/* of_name: the unit that the name gives, or NULL; otherwise: what holds where the file says nothing. */
static hci_column_match match_units(const hci_csv *csv, size_t column, const hci_wanted_column *want,
                                    const hci_unit *of_name, const hci_unit *otherwise)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE, .column = column, .factor = 1};
    const hci_unit *of_row = hci_csv_row_unit(csv, column);
    const hci_unit *unit = of_name != NULL ? of_name : of_row != NULL ? of_row : otherwise;
    if (of_name != NULL && of_name->dimension != want->unit->dimension) return result;
    result.has_unit = of_name != NULL || of_row != NULL;
    result.factor = unit->factor / want->unit->factor;
    if (of_row == NULL && csv->has_units && !hci_csv_says_no_unit(hci_csv_cell(csv, 1, column)))
        result.kind = HCI_COLUMN_UNKNOWN_UNIT;
    else if (unit->dimension != want->unit->dimension)
        result.kind = HCI_COLUMN_OTHER_UNIT;
    else
        result.kind = of_row != NULL && !hci_unit_equal(unit, of_row) ? HCI_COLUMN_CONFLICT : HCI_COLUMN_ONE;
    return result;
}

/* A header as it is compared, and what its numbers are times for the peak. */
typedef struct {
    const char *text;
    char plain[HCI_CHANNEL_SIZE];
    double amplitude;
} compared_header;

static void compare_header(const hci_csv *csv, size_t column, const hci_wanted_column *want,
                           compared_header *h)
{
    h->text = hci_csv_cell(csv, 0, column);
    h->amplitude = 1.0;
    if (hci_column_is_along_axis(want) && hci_column_without_amplitude(h->text, h->plain, &h->amplitude))
        h->text = h->plain;
}

/* unit: in the header or in the row of units, or NULL: Arms has the factor itself. */
static void take_amplitude(hci_column_match *found, double amplitude, const hci_unit *unit)
{
    found->is_rms = amplitude > 1.0 && (unit == NULL || !hci_unit_equal(unit, hci_unit_find("Arms", 4)));
    if (found->is_rms) found->factor *= amplitude;
}

static hci_column_match match_column(const hci_csv *csv, size_t column, const hci_wanted_column *want)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE, .column = column, .factor = 1};
    const hci_unit *of_name;
    compared_header header;
    compare_header(csv, column, want, &header);
    if (!hci_column_split(header.text, want, &of_name)) return result;
    result = match_units(csv, column, want, of_name, want->unit);
    take_amplitude(&result, header.amplitude, of_name ? of_name : hci_csv_row_unit(csv, column));
    return result;
}

/* A name that has several meanings is what its unit says, so another dimension is no match here. */
static hci_column_match match_alias(const hci_csv *csv, size_t column, const hci_wanted_column *want,
                                    const hci_alias *alias)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE, .column = column, .factor = 1};
    const hci_unit *of_name;
    compared_header header;
    compare_header(csv, column, want, &header);
    if (!hci_column_split_alias(header.text, alias, &of_name)) return result;
    if (alias->unit == NULL && of_name == NULL && hci_csv_row_unit(csv, column) == NULL) return result;
    const hci_unit *otherwise =
        alias->unit != NULL ? hci_unit_find(alias->unit, strlen(alias->unit)) : want->unit;
    result = match_units(csv, column, want, of_name, otherwise);
    if (result.kind == HCI_COLUMN_OTHER_UNIT) result.kind = HCI_COLUMN_NONE;
    result.alias = alias;
    take_amplitude(&result, header.amplitude, of_name ? of_name : hci_csv_row_unit(csv, column));
    return result;
}

/* ---- columns that the user names ---- */

static bool is_given(const hci_csv *csv, size_t column)
{
    for (size_t k = 0; k < csv->given_count; ++k)
        if (csv->given[k].column == column) return true;
    return false;
}

static const hci_unit *unit_of_header(const char *header)
{
    const hci_unit *unit = NULL;
    for (size_t at = 1; *header != '\0' && header[at] != '\0' && unit == NULL; ++at)
        unit = hci_column_unit_of_tail(header + at);
    return unit;
}

const hci_unit *hci_column_unit(const hci_csv *csv, size_t column)
{
    char channel[HCI_CHANNEL_SIZE];
    bool is_of_place;
    const char *header = hci_csv_cell(csv, 0, column);
    const hci_unit *unit = unit_of_header(header);
    if (unit == NULL && hci_channel_name(header, channel, &is_of_place)) unit = unit_of_header(channel);
    return unit != NULL ? unit : hci_csv_row_unit(csv, column);
}

/* What a name without a unit is read in where nobody says what it is, as turn/s for `vel_estimate`; NULL: the
 * name says no such quantity. */
static const hci_unit *usual_unit(const hci_csv *csv, size_t column, const hci_unit *want)
{
    const char *header = hci_csv_cell(csv, 0, column);
    const hci_unit *unit, *of_name;
    for (size_t k = 0; k < hci_alias_count; ++k) {
        if (hci_aliases[k].unit == NULL || hci_aliases[k].beside != NULL) continue;
        unit = hci_unit_find(hci_aliases[k].unit, strlen(hci_aliases[k].unit));
        if (unit->dimension == want->dimension && hci_column_split_alias(header, &hci_aliases[k], &of_name))
            return unit;
    }
    const hci_alias *said = hci_name_words(header, NULL, &of_name);
    if (said == NULL || said->unit == NULL) return NULL;
    unit = hci_unit_find(said->unit, strlen(said->unit));
    return unit->dimension == want->dimension ? unit : NULL;
}

/* Degrees of an electrical turn for a mechanical angle, or the other way. */
static bool is_other_turn(const hci_unit *unit, const hci_wanted_column *want)
{
    const hci_unit_turn turn = hci_unit_turn_of(unit);
    const bool is_electrical = want->base_length == 7 && want->base[6] == 'e';
    return turn == (is_electrical ? HCI_UNIT_TURN_MECHANICAL : HCI_UNIT_TURN_ELECTRICAL);
}

/* In the unit that the user says, or the header, or the row of units, or that is usual for such a name, or in
 * the canonical one. */
static hci_column_match find_given(const hci_csv *csv, const hci_wanted_column *want)
{
    const hci_unit *said;
    for (size_t k = csv->given_count; k-- > 0;) {
        const size_t column = csv->given[k].column;
        compared_header header;
        if (!hci_column_split(csv->given[k].name, want, &said)) continue;
        if (said != NULL && said->dimension != want->unit->dimension) continue;
        hci_column_match result = {.kind = HCI_COLUMN_ONE, .column = column};
        const hci_unit *of_file = hci_column_unit(csv, column);
        const hci_unit *unit = said != NULL ? said : of_file;
        const bool is_counted = csv->given[k].counts > 0.0;
        const bool is_quotient = said != NULL && fabs(csv->given[k].divisor) != 1.0; /* of any quantity */
        if (is_counted) unit = hci_unit_find("turn", 4);
        result.has_unit = unit != NULL;
        if (unit == NULL) unit = usual_unit(csv, column, want->unit);
        if (unit == NULL) unit = want->unit;
        result.factor = unit->factor / want->unit->factor / csv->given[k].divisor;
        compare_header(csv, column, want, &header);
        if (said == NULL) take_amplitude(&result, header.amplitude, of_file);
        if (is_counted) result.factor /= csv->given[k].counts;
        const bool is_other = of_file != NULL && of_file->dimension != want->unit->dimension;
        if (of_file != NULL && !is_counted && !hci_unit_equal(of_file, unit) && !(is_quotient && is_other))
            result.overruled_by = csv->given[k].name;
        if (said != NULL && is_other_turn(of_file, want)) result.overruled_by = csv->given[k].name;
        if (is_other && !is_counted && !is_quotient) result.kind = HCI_COLUMN_GIVEN_UNIT;
        return result;
    }
    return (hci_column_match){.kind = HCI_COLUMN_NONE, .factor = 1};
}

void hci_csv_orders_of(hci_csv *csv, int pole_pairs, hci_order_base base)
{
    csv->pole_pairs = pole_pairs;
    csv->orders_mechanical = base == HCI_ORDER_MECHANICAL;
}

hci_status hci_csv_give(hci_csv *csv, const char *name, size_t column, hci_note *note)
{
    return hci_csv_give_counts(csv, name, column, 0.0, note);
}

/* Without regard to case; the words end with NULL. */
static bool has_word_of(const char *name, const char *const *words)
{
    char lower[64] = "";
    for (size_t k = 0; name[k] != '\0' && k + 1 < sizeof lower; ++k)
        lower[k] = (char)(name[k] >= 'A' && name[k] <= 'Z' ? name[k] - 'A' + 'a' : name[k]);
    for (; *words != NULL; ++words)
        if (strstr(lower, *words) != NULL) return true;
    return false;
}

bool hci_csv_counts(const char *name)
{
    static const char *const WORDS[] = {"count", "cnt", "tick", "pulse", "increment", NULL};
    return has_word_of(name, WORDS);
}

bool hci_csv_is_sixteen_bits(const char *name)
{
    static const char *const WORDS[] = {"s16", "u16", "int16", NULL};
    return has_word_of(name, WORDS);
}

hci_status hci_csv_give_counts(hci_csv *csv, const char *name, size_t column, double counts, hci_note *note)
{
    hci_csv_given *larger = hci_memory_resize(csv->given, csv->given_count + 1, sizeof *larger);
    if (larger == NULL) return hci_note_memory(note, csv->path, "its columns");
    csv->given = larger;
    hci_csv_given *given = &csv->given[csv->given_count++];
    snprintf(given->name, sizeof given->name, "%s", name);
    given->column = column;
    given->counts = counts;
    given->divisor = 1.0;
    return HCI_OK;
}

/* ---- all columns ---- */

/* Is the column's name one that means something else beside another column of this file? */
static bool has_beside(const hci_csv *csv, const hci_alias *alias)
{
    const hci_alias other = {.name = alias->beside};
    const hci_unit *unit;
    for (size_t column = 0; column < csv->columns; column++)
        if (hci_column_split_alias(hci_csv_cell(csv, 0, column), &other, &unit)) return true;
    return false;
}

static bool means_another(const hci_csv *csv, size_t column, const char *name)
{
    const hci_unit *unit;
    for (size_t k = 0; k < hci_alias_count; k++) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->beside == NULL || strcmp(alias->column, name) == 0) continue;
        if (hci_column_split_alias(hci_csv_cell(csv, 0, column), alias, &unit) && has_beside(csv, alias))
            return true;
    }
    return false;
}

/* Joins what was found so far with a further column. False: no need to look further. */
static bool add_match(hci_column_match *result, hci_column_match next)
{
    if (next.kind == HCI_COLUMN_NONE ||
        (next.kind == HCI_COLUMN_OTHER_UNIT && result->kind != HCI_COLUMN_NONE))
        return true;
    const bool twice = result->kind != HCI_COLUMN_NONE && result->kind != HCI_COLUMN_OTHER_UNIT;
    if (twice && result->column == next.column) return true; /* one column by two names */
    *result = next;
    if (twice) result->kind = HCI_COLUMN_TWICE;
    return !twice;
}

static hci_column_match find_own(const hci_csv *csv, const char *name, const hci_wanted_column *want)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE};
    for (size_t column = 0; column < csv->columns; column++) {
        const hci_column_match next = match_column(csv, column, want);
        if (next.kind == HCI_COLUMN_NONE || is_given(csv, column) || means_another(csv, column, name))
            continue;
        if (!add_match(&result, next)) break;
    }
    return result;
}

/* By the names of other tools: those that need another column beside them, or the rest. */
static hci_column_match find_foreign(const hci_csv *csv, const char *name, const hci_wanted_column *want,
                                     bool beside)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE};
    for (size_t k = 0; k < hci_alias_count; k++) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->column == NULL || (alias->beside != NULL) != beside || strcmp(alias->column, name) != 0)
            continue;
        if (beside && !has_beside(csv, alias)) continue;
        for (size_t column = 0; column < csv->columns; column++) {
            const hci_column_match next = match_alias(csv, column, want, alias);
            if (next.kind == HCI_COLUMN_NONE || is_given(csv, column) ||
                (!beside && means_another(csv, column, name)))
                continue;
            if (!add_match(&result, next)) return result;
        }
    }
    return result;
}

/* By the plain words of its name. */
static hci_column_match find_by_words(const hci_csv *csv, const char *name, const hci_wanted_column *want)
{
    hci_column_match result = {.kind = HCI_COLUMN_NONE};
    for (size_t column = 0; column < csv->columns; column++) {
        const hci_unit *of_name, *of_row = hci_csv_row_unit(csv, column);
        compared_header header;
        compare_header(csv, column, want, &header);
        const hci_alias *said = hci_name_words(header.text, of_row, &of_name);
        if (said == NULL || said->column == NULL || strcmp(said->column, name) != 0 ||
            is_given(csv, column) || hci_column_has_known_name(hci_csv_cell(csv, 0, column)))
            continue;
        hci_column_match next =
            match_units(csv, column, want, of_name, hci_unit_find(said->unit, strlen(said->unit)));
        next.alias = said;
        take_amplitude(&next, header.amplitude, of_name ? of_name : of_row);
        if (result.kind == HCI_COLUMN_ONE && strcmp(said->tool, "SINAMICS") == 0) continue; /* smoothed */
        if (next.kind != HCI_COLUMN_OTHER_UNIT && !add_match(&result, next)) break;
    }
    return result;
}

hci_column_match hci_column_find(const hci_csv *csv, const char *name)
{
    const hci_wanted_column want = hci_wanted_column_of(name);
    hci_column_match result = find_given(csv, &want);
    if (result.kind == HCI_COLUMN_NONE) result = find_foreign(csv, name, &want, true);
    if (result.kind == HCI_COLUMN_NONE) result = find_own(csv, name, &want);
    if (result.kind == HCI_COLUMN_NONE) result = find_foreign(csv, name, &want, false);
    if (result.kind == HCI_COLUMN_NONE) result = find_by_words(csv, name, &want);
    return result;
}

/* "`a`, `b`, …" as far as there is room. Columns without a name are left out. */
static void list_columns(const hci_csv *csv, char *out, size_t size)
{
    static const char more[] = ", \xE2\x80\xA6";
    size_t used = 0;
    for (size_t column = 0; column < csv->columns; column++) {
        char quoted[HCI_QUOTE_SIZE];
        const char *name = hci_quote(hci_csv_cell(csv, 0, column), quoted), *between = used > 0 ? ", " : "";
        if (*hci_csv_cell(csv, 0, column) == '\0') continue;
        if (used + strlen(between) + strlen(name) + sizeof more > size) {
            memcpy(out + used, more, sizeof more);
            return;
        }
        used += (size_t)snprintf(out + used, size - used, "%s%s", between, name);
    }
}

static hci_status missing_column(const hci_csv *csv, const char *name, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE], columns[400];
    list_columns(csv, columns, sizeof columns);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s:%zu: found no column %s but %s, expected it in the header; add it or rename a column",
        hci_quote_path(csv->path, path), hci_csv_record_line(csv, 0), hci_quote(name, quoted), columns);
}

/* The error of a column that is there but cannot be used. */
static hci_status match_error(const hci_csv *csv, const char *name, const hci_column_match *found,
                              hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE], text[HCI_QUOTE_SIZE + 32];
    hci_csv_fault fault = {
        .column = found->column, .name = hci_csv_cell(csv, 0, found->column), .found = text};
    fault.line = hci_csv_record_line(csv, found->kind == HCI_COLUMN_TWICE ? 0 : 1);
    if (found->kind == HCI_COLUMN_TWICE) {
        snprintf(text, sizeof text, "%s a second time", hci_quote(name, quoted));
        fault.expected = "one column for it";
        fault.remedy = "remove or rename one of them";
        return hci_csv_fault_note(csv, &fault, note);
    }
    hci_quote(hci_csv_cell(csv, 1, found->column), quoted);
    snprintf(text, sizeof text, "%s%s", found->kind == HCI_COLUMN_UNKNOWN_UNIT ? "" : "the unit ", quoted);
    fault.expected = found->kind == HCI_COLUMN_CONFLICT ? "the unit in the column's name"
                                                        : "a unit of the quantity asked for";
    fault.remedy = "correct the unit";
    if (found->kind == HCI_COLUMN_GIVEN_UNIT) {
        snprintf(text, sizeof text, "a unit that is none of %s", hci_quote(name, quoted));
        fault.line = hci_csv_record_line(csv, 0);
        fault.remedy = "name another column, or correct the unit in the file; of a column over a number say "
                       "the unit of the quotient, as in iq_A=COLUMN/OHM";
    }
    if (found->kind == HCI_COLUMN_UNKNOWN_UNIT) {
        fault.expected = HCI_CSV_UNIT_EXPECTED;
        fault.remedy = HCI_CSV_UNIT_REMEDY;
    }
    return hci_csv_fault_note(csv, &fault, note);
}

hci_status hci_column_error(const hci_csv *csv, const char *name, const hci_column_match *found,
                            hci_note *note)
{
    return found->kind == HCI_COLUMN_NONE ? missing_column(csv, name, note)
                                          : match_error(csv, name, found, note);
}

hci_status hci_columns_check(const hci_csv *csv, const char *const *names, size_t count, hci_note *note)
{
    for (size_t k = 0; k < count; ++k)
        if (hci_column_find(csv, names[k]).kind == HCI_COLUMN_NONE)
            return missing_column(csv, names[k], note);
    return HCI_OK;
}

bool hci_csv_has(const hci_csv *csv, const char *column)
{
    const hci_column_kind kind = hci_column_find(csv, column).kind;
    return kind != HCI_COLUMN_NONE && kind != HCI_COLUMN_OTHER_UNIT;
}

bool hci_csv_find(const hci_csv *csv, const char *name, size_t *column)
{
    const hci_column_match found = hci_column_find(csv, name);
    *column = found.column;
    return found.kind != HCI_COLUMN_NONE;
}

/* A unit of the file that yields to the one that the user says. */
static void tell_overruled(const hci_csv *csv, const hci_column_match *found, hci_note *told)
{
    size_t base;
    char quoted[HCI_QUOTE_SIZE];
    const char *said = found->overruled_by;
    hci_unit_of_name(said, &base);
    hci_note_set(told, HCI_OK, "%s is read in %s, as `%s` says, and not in the unit that the file has for it",
                 hci_quote(hci_csv_cell(csv, 0, found->column), quoted), said + base + 1, said);
}

bool hci_csv_told(const hci_csv *csv, const char *name, hci_note *told)
{
    const hci_column_match found = hci_column_find(csv, name);
    char quoted[HCI_QUOTE_SIZE];
    if (found.overruled_by != NULL) {
        tell_overruled(csv, &found, told);
        return true;
    }
    if (found.is_rms) {
        hci_note_set(told, HCI_OK,
                     "%s is read as the rms of a sine: times \xE2\x88\x9A"
                     "2 for the peak",
                     hci_quote(hci_csv_cell(csv, 0, found.column), quoted));
        return true;
    }
    if (found.alias == NULL || found.alias->meaning == NULL) return false;
    const bool is_by_unit = hci_unit_turn_of(hci_column_unit(csv, found.column)) != HCI_UNIT_TURN_UNSAID;
    if (hci_name_words_are_clear(found.alias) && found.has_unit && !is_by_unit) return false;
    const bool supposed = !found.has_unit && strcmp(found.alias->unit, "1") != 0;
    hci_note_set(told, HCI_OK, "%s is read as %s%s%s", hci_quote(hci_csv_cell(csv, 0, found.column), quoted),
                 found.alias->meaning, supposed ? ", in " : "", supposed ? found.alias->unit : "");
    return true;
}

/* What an angle by this name may be, beyond what is said of all. */
static const char *of_resolver(const char *header)
{
    static const char *const RESOLVER[] = {"resolver", NULL};
    return has_word_of(header, RESOLVER)
               ? "; a resolver of one pole pair has the mechanical angle, one of as "
                 "many as the motor the electrical one"
               : "";
}

static hci_status unclear_error(const hci_csv *csv, size_t column, hci_note *note)
{
    char remedy[340];
    hci_csv_fault fault = {.line = hci_csv_record_line(csv, 0),
                           .column = column,
                           .name = hci_csv_cell(csv, 0, column),
                           .found = "an angle that may be mechanical or electrical",
                           .expected = "theta_m or theta_e",
                           .remedy = remedy};
    if (hci_csv_has(csv, "speed_rad_per_s")) {
        fault.expected = "one that goes where the speed leads";
        snprintf(remedy, sizeof remedy,
                 "by the speed and the time of this file it is neither in its unit: look at the units of the "
                 "three, and rename here the column that is in another one (theta_m_deg, theta_m_rad, "
                 "theta_e_deg, speed_rpm, time_ms)");
    } else
        snprintf(
            remedy, sizeof remedy,
            "rename the column to the one it is, say --column \"theta_m=%.60s\" (theta_m_deg in degrees, "
            "theta_e of an "
            "electrical angle), or add the speed%s",
            hci_csv_cell(csv, 0, column), of_resolver(hci_csv_cell(csv, 0, column)));
    return hci_csv_fault_note(csv, &fault, note);
}

bool hci_csv_unclear(const hci_csv *csv, size_t *column)
{
    const hci_unit *unit;
    for (*column = 0; *column < csv->columns; ++*column) {
        const char *header = hci_csv_cell(csv, 0, *column);
        if (is_given(csv, *column)) continue;
        const hci_alias *said = hci_name_words(header, hci_csv_row_unit(csv, *column), &unit);
        if (said != NULL && said->column == NULL) return true;
        for (size_t k = 0; said == NULL && k < hci_alias_count; k++)
            if (hci_aliases[k].column == NULL && hci_column_split_alias(header, &hci_aliases[k], &unit))
                return true;
    }
    return false;
}

hci_status hci_csv_check_clear(const hci_csv *csv, hci_note *note)
{
    size_t column;
    return hci_csv_unclear(csv, &column) ? unclear_error(csv, column, note) : HCI_OK;
}
