/* The scenario file: name,value,unit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/simulate/simulate.h"
#include "host/base/quote.h"
#include "host/csv/name_values.h"

/* What numbers a scenario may hold, in the order of HCI_SCENARIO_VALUES. */
typedef struct {
    const char *what; /* "" for a name that follows from the one before it */
    double low, high; /* in the unit of the name */
} limits;

enum {
#define COUNT_ONE(field, name, unit, low, high, fallback, what) +1
    ENTRIES = 0 HCI_SCENARIO_VALUES(COUNT_ONE)
#undef COUNT_ONE
};

static const limits LIMITS[ENTRIES] = {
#define LIMITS_OF(field, name, unit, low, high, fallback, what) {what, low, high},
    HCI_SCENARIO_VALUES(LIMITS_OF)
#undef LIMITS_OF
};

static void list_entries(hci_scenario *s, hci_named_value list[ENTRIES])
{
    size_t k = 0;
#define LIST_ONE(field, text, unit_text, low, high, fallback, what)                                          \
    list[k++] = (hci_named_value){text, unit_text, &s->field};
    HCI_SCENARIO_VALUES(LIST_ONE)
#undef LIST_ONE
}

void hci_scenario_init(hci_scenario *scenario)
{
    hci_named_value list[ENTRIES];
    memset(scenario, 0, sizeof *scenario);
    list_entries(scenario, list);
    for (size_t k = 0; k < ENTRIES; ++k)
        *list[k].value = NAN;
    scenario->current_control = HCI_CURRENT_IDEAL;
    scenario->strategy = scenario->strategy_2 = HCI_STRATEGY_MTPA;
}

/* ---- numbers ---- */

static const char REMEDY[] = "see hci-solve simulate --help";

static hci_status read_number(const hci_csv *csv, size_t row, const hci_named_value *e, const limits *l,
                              hci_note *note)
{
    const hci_value_range range = {l->low, l->high, REMEDY};
    return hci_value_read_within(csv, row, e, &range, note);
}

/* ---- words ---- */

enum { CURRENT_CONTROL, STRATEGY, STRATEGY_2, CURRENTS, WORDS };

#define WORD_OF(value, word) [value] = word,
static const char *const CONTROLS[] = {HCI_CURRENT_LOOP_NAMES(WORD_OF) NULL};
static const char *const STRATEGIES[] = {HCI_STRATEGY_NAMES(WORD_OF) NULL};
#undef WORD_OF

/* A path in the file is relative to the file's folder. */
static hci_status read_currents(const hci_csv *csv, size_t row, hci_scenario *s, hci_note *note)
{
    const char *text, *slash = strrchr(s->path, '/');
    const int folder = slash ? (int)(slash - s->path) + 1 : 0;
    int length;
    const hci_status status = hci_csv_text(csv, "value", row, &text, note);
    if (status) return status;
    if (text[0] == '\0')
        return hci_csv_error(csv, "value", row, note, "currents.csv or the folder of a solution",
                             "delete the row for none");
    length = snprintf(s->currents, sizeof s->currents, "%.*s%s", text[0] == '/' ? 0 : folder, s->path, text);
    if (length < (int)sizeof s->currents) return HCI_OK;
    return hci_csv_error(csv, "value", row, note, "a shorter path", "move the folder");
}

static hci_status read_word(const hci_csv *csv, size_t row, int word, hci_scenario *s, hci_note *note)
{
    int choice = 0;
    hci_status status;
    if (word == CURRENTS) return read_currents(csv, row, s, note);
    status = hci_value_read_choice(csv, row, word == CURRENT_CONTROL ? CONTROLS : STRATEGIES, REMEDY, &choice,
                                   note);
    if (word == CURRENT_CONTROL) s->current_control = (hci_current_loop)choice;
    if (word == STRATEGY) s->strategy = (hci_strategy)choice;
    if (word == STRATEGY_2) s->strategy_2 = (hci_strategy)choice;
    return status;
}

/* ---- rows ---- */

static hci_status unknown_name(const hci_csv *csv, size_t row, const char *name, const hci_named_value *list,
                               hci_note *note)
{
#define WORD_NAME(text, choices, fallback, what) text,
    const char *names[WORDS + ENTRIES + 1] = {HCI_SCENARIO_WORDS(WORD_NAME)};
#undef WORD_NAME
    for (size_t k = 0; k < ENTRIES; ++k)
        names[WORDS + k] = list[k].name;
    return hci_unknown_name(csv, row, name, names, "docs/simulate.md", note);
}

static hci_status read_row(const hci_csv *csv, size_t row, hci_scenario *s, bool given[WORDS], hci_note *note)
{
#define WORD_NAME(name, choices, fallback, what) name,
    static const char *const word[WORDS] = {HCI_SCENARIO_WORDS(WORD_NAME)};
#undef WORD_NAME
    hci_named_value list[ENTRIES];
    const char *name;
    size_t at;
    hci_status status = hci_csv_text(csv, "name", row, &name, note);
    if (status) return status;
    for (int k = 0; k < WORDS; ++k) {
        if (strcmp(name, word[k]) != 0) continue;
        if (given[k])
            return hci_csv_error(csv, "name", row, note, "each name once", "delete one of the two rows");
        given[k] = true;
        return read_word(csv, row, k, s, note);
    }
    list_entries(s, list);
    status = hci_named_value_find(csv, row, list, ENTRIES, &at, note);
    if (status) return status;
    return at < ENTRIES ? read_number(csv, row, &list[at], &LIMITS[at], note)
                        : unknown_name(csv, row, name, list, note);
}

/* What one row asks for and another one takes back, as far as no machine is needed to see it. */
static hci_status check_words(const hci_scenario *s, const bool given[WORDS], hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    hci_quote_path(s->path, path);
    if (given[STRATEGY_2] != !isnan(s->strategy_2_from_s))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: `strategy_2` and `strategy_2_from` go together; add the other row", path);
    if (given[CURRENTS] && (given[STRATEGY] || given[STRATEGY_2]))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: `currents` and a strategy both say what flows; delete one of them", path);
    return HCI_OK;
}

/* Another table, such as a recording, in place of a scenario. */
static hci_status check_columns(const hci_csv *csv, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], column[HCI_QUOTE_SIZE];
    if (hci_csv_has(csv, "name")) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s: found a table whose first column is %s, expected a scenario: a table "
                        "name,value,unit, such as data/drive/imposed.csv; give one, and a recording to "
                        "`predict`, `check`, `diagnose` or `tune`",
                        hci_quote_path(hci_csv_path(csv), path), hci_quote(hci_csv_name(csv, 0), column));
}

hci_status hci_scenario_read(const char *path, hci_scenario *scenario, hci_note *note)
{
    bool given[WORDS] = {false};
    hci_csv *csv;
    hci_status status;
    hci_scenario_init(scenario);
    if (snprintf(scenario->path, sizeof scenario->path, "%s", path) >= (int)sizeof scenario->path)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", path);
    status = hci_csv_read(path, &csv, note);
    if (status) return status;
    status = check_columns(csv, note);
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row)
        status = read_row(csv, row, scenario, given, note);
    hci_csv_free(csv);
    return status ? status : check_words(scenario, given, note);
}
