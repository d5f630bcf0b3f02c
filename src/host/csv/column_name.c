/* Names of columns: which unit a name gives, and whether it is the canonical name of a quantity or the one of
 * another tool. */
#include "host/csv/column_name.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "host/csv/channel_name.h"
#include "host/csv/table.h"

hci_wanted_column hci_wanted_column_of(const char *name)
{
    hci_wanted_column want = {.base = name};
    want.unit = hci_unit_of_name(name, &want.base_length);
    return want;
}

const hci_unit *hci_column_unit_of_tail(const char *tail)
{
    if (*tail == '_') return hci_unit_of_suffix(tail + 1);
    const bool is_apart = *tail == ' ';
    tail += strspn(tail, " \t");
    if (is_apart && hci_text_begins(tail, "in ", 3)) return hci_csv_cell_unit(tail + 3);
    if (*tail == '/' || *tail == ',') return hci_csv_cell_unit(tail + 1 + strspn(tail + 1, " \t"));
    return *tail == '(' || *tail == '[' ? hci_csv_cell_unit(tail) : NULL;
}

/* ---- a word for the amplitude behind the name ---- */

#define SQRT2 1.4142135623730951

/* "peak" or "rms", in whatever brackets, from `at` on; where it ends, or NULL: there is none. */
static const char *amplitude_end(const char *at, double *factor)
{
    static const struct {
        const char *word;
        double factor;
    } WORDS[] = {{"peak", 1.0},  {"pk", 1.0},    {"crest", 1.0},     {"scheitelwert", 1.0},
                 {"rms", SQRT2}, {"eff", SQRT2}, {"effektiv", SQRT2}};
    at += strspn(at, " _,");
    const char *close = *at == '(' ? ")" : *at == '[' ? "]" : "";
    at += *close != '\0';
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k) {
        const size_t length = strlen(WORDS[k].word);
        if (!hci_text_begins(at, WORDS[k].word, length)) continue;
        const char *end = at + length;
        if (*close != '\0' && *end != *close) continue;
        end += *close != '\0';
        if (*end != '\0' && strchr(" _([/,", *end) == NULL) continue;
        *factor = WORDS[k].factor;
        return end;
    }
    return NULL;
}

bool hci_column_is_along_axis(const hci_wanted_column *want)
{
    return want->base_length == 2 && strchr("iv", want->base[0]) != NULL &&
           strchr("dq", want->base[1]) != NULL;
}

bool hci_column_without_amplitude(const char *header, char plain[HCI_CHANNEL_SIZE], double *factor)
{
    for (size_t k = 1; header[0] != '\0' && header[k] != '\0'; ++k) {
        const char *end = strchr(" _,([", header[k]) != NULL ? amplitude_end(header + k, factor) : NULL;
        if (end == NULL) continue;
        const int used = snprintf(plain, HCI_CHANNEL_SIZE, "%.*s%s", (int)k, header, end);
        return used > 0 && used < HCI_CHANNEL_SIZE;
    }
    return false;
}

/* ---- a word for the quantity before the name ---- */

enum { MOST_BARE = 64 };

/* What follows such a word, with the letter of the quantity before it: "Strom Iq" is iq and i_Iq, "Current a"
 * i_a. True where there is a word, of currents or voltages. */
typedef struct {
    char bare[MOST_BARE], with_letter[MOST_BARE];
    int dimension;
} worded_name;

static const char *skip_word(const char *name, const char *const *words)
{
    for (; *words != NULL; ++words) {
        const size_t length = strlen(*words);
        if (hci_text_begins(name, *words, length) && (name[length] == ' ' || name[length] == '_'))
            return name + length + 1 + strspn(name + length + 1, " _");
    }
    return NULL;
}

static bool take_word(const char *name, worded_name *w)
{
    static const char *const CURRENT[] = {"Strom", "Courant", "Corrente", "Corriente", "Current", NULL};
    static const char *const VOLTAGE[] = {"Spannung",       "Tension", "Tensione",
                                          "Tensi\xC3\xB3n", "Voltage", NULL};
    static const char *const PHASE[] = {"Phase", "Fase", NULL};
    const char *current = skip_word(name, CURRENT), *rest = current ? current : skip_word(name, VOLTAGE);
    const char *after = rest ? skip_word(rest, PHASE) : NULL;
    if (after) rest = after;
    if (!rest || *rest == '\0' || strlen(rest) + 3 > MOST_BARE) return false;
    if (strcmp(rest, current ? "A" : "V") == 0) return false; /* likely to be the unit */
    const bool is_between = rest[1] == '-' && rest[2] != '\0' &&
                            strchr(" [(", rest[3]) != NULL; /* U-V: from one terminal to the other */
    snprintf(w->bare, sizeof w->bare, "%s", is_between ? "" : rest);
    snprintf(w->with_letter, sizeof w->with_letter, "%c_%s", current ? 'i' : 'u', rest);
    w->dimension = hci_unit_find(current ? "A" : "V", 1)->dimension;
    return true;
}

/* ---- names as they are asked for ---- */

static bool split(const char *name, const hci_wanted_column *want, const hci_unit **unit)
{
    if (!hci_text_begins(name, want->base, want->base_length)) return false;
    const char *rest = name + want->base_length;
    *unit = NULL;
    if (rest[strspn(rest, " \t")] == '\0') return true;
    *unit = hci_column_unit_of_tail(rest);
    return *unit != NULL;
}

static bool split_worded(const char *name, const hci_wanted_column *want, const hci_unit **unit)
{
    worded_name w;
    if (split(name, want, unit)) return true;
    return take_word(name, &w) && want->unit->dimension == w.dimension && split(w.bare, want, unit);
}

bool hci_column_split(const char *name, const hci_wanted_column *want, const hci_unit **unit)
{
    char channel[HCI_CHANNEL_SIZE];
    bool is_of_place;
    if (split_worded(name, want, unit)) return true;
    return hci_channel_name(name, channel, &is_of_place) && split_worded(channel, want, unit) &&
           (*unit != NULL || !is_of_place);
}

static bool split_alias(const char *name, const hci_alias *alias, const hci_unit **unit)
{
    const size_t length = strlen(name);
    *unit = NULL;
    if (hci_alias_is_name(alias, name, length)) return true;
    for (size_t end = 1; end < length; ++end) {
        if (strchr("_([/, ", name[end]) == NULL || !hci_alias_is_name(alias, name, end)) continue;
        *unit = hci_column_unit_of_tail(name + end);
        if (*unit != NULL) return true;
    }
    return false;
}

static bool split_alias_worded(const char *name, const hci_alias *alias, const hci_unit **unit)
{
    worded_name w;
    if (split_alias(name, alias, unit)) return true;
    if (alias->unit == NULL || alias->beside != NULL || !take_word(name, &w)) return false;
    const hci_unit *of_alias = hci_unit_find(alias->unit, strlen(alias->unit));
    return of_alias != NULL && of_alias->dimension == w.dimension &&
           (split_alias(w.bare, alias, unit) || split_alias(w.with_letter, alias, unit));
}

bool hci_column_split_alias(const char *name, const hci_alias *alias, const hci_unit **unit)
{
    char channel[HCI_CHANNEL_SIZE];
    bool is_of_place;
    if (split_alias_worded(name, alias, unit)) return true;
    return hci_channel_name(name, channel, &is_of_place) && split_alias_worded(channel, alias, unit) &&
           (!is_of_place || (*unit != NULL && alias->meaning == NULL));
}
