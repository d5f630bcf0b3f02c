#include "host/fleet/row.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/csv/csv.h"
#include "hci/host/report/summary.h"
#include "host/base/json.h"
#include "host/base/words.h"

enum { PATH_SIZE = 4096, CELL_SIZE = 256, BEFORE_FINDINGS = 6 /* columns, to exit_code */ };

/* ---- figures of a summary ---- */

/* A column, and where summary.json has it. */
typedef struct {
    const char *column, *object, *name; /* object: NULL for the outermost one; column NULL ends a list */
} figure;

static const figure FIGURES[][8] = {
    [HCI_FLEET_DIAGNOSE] = {{"rms_before_Nm", NULL, "rms_before_Nm"},
                            {"rms_after_Nm", NULL, "rms_after_Nm"},
                            {"noise_Nm", NULL, "noise_Nm"},
                            {"holdout_rms_before_Nm", NULL, "holdout_rms_before_Nm"},
                            {"holdout_rms_after_Nm", NULL, "holdout_rms_after_Nm"}},
    [HCI_FLEET_TUNE] = {{"before_peak_to_peak_Nm", "before", "peak_to_peak_Nm"},
                        {"after_peak_to_peak_Nm", "after", "peak_to_peak_Nm"},
                        {"after_mean_Nm", "after", "mean_Nm"},
                        {"expected_peak_to_peak_Nm", "expected", "peak_to_peak_Nm_95"}},
    [HCI_FLEET_SOLVE] = {{"mean_Nm", "torque", "mean_Nm"},
                         {"worst_error_Nm", "torque", "worst_error_Nm"},
                         {"worst_order", "torque", "worst_order"},
                         {"peak_phase_A", "current", "peak_phase_A"},
                         {"loss_ratio_to_plain", "current", "loss_ratio_to_plain"}},
    [HCI_FLEET_FIT] = {{"samples", NULL, "samples"},
                       {"recordings_unused", NULL, "recordings_unused"},
                       {"rows_unused", NULL, "rows_unused"},
                       {"rms_before_Nm", NULL, "rms_before_Nm"},
                       {"rms_after_Nm", NULL, "rms_after_Nm"}},
};

static bool has_effects(hci_fleet_command command)
{
    return command == HCI_FLEET_DIAGNOSE || command == HCI_FLEET_TUNE;
}

/* ---- cells ---- */

/* A text as a cell: in quotes where CSV needs them, and in one line. */
static void put_text(const hci_words *row, const char *text)
{
    const bool quoted = strpbrk(text, ",;\"#") != NULL;
    hci_words_say(row, "%s", quoted ? "\"" : "");
    for (const char *c = text; *c != '\0'; ++c)
        hci_words_say(row, "%s%c", *c == '"' ? "\"" : "", (unsigned char)*c < ' ' ? ' ' : *c);
    hci_words_say(row, "%s,", quoted ? "\"" : "");
}

static void put_figure(const hci_words *row, const char *summary, const figure *f)
{
    char text[32] = "";
    double value;
    if (summary && hci_json_find_number(summary, f->object, f->name, &value)) hci_number_text(value, text);
    hci_words_say(row, "%s,", text);
}

static void put_verdict(const hci_words *row, hci_fleet_command command, const char *summary)
{
    char text[CELL_SIZE] = "";
    bool reached = false;
    if (summary && command == HCI_FLEET_SOLVE && hci_json_find_bool(summary, NULL, "reached", &reached))
        snprintf(text, sizeof text, "%s", reached ? "reached" : "not reached");
    else if (summary)
        (void)hci_json_find_text(summary, NULL, "verdict", text, sizeof text);
    put_text(row, text);
}

/* Why there is no result, or what a fit says of the recordings. */
static void put_reason(const hci_words *row, const hci_fleet_outcome *outcome, const char *summary)
{
    char text[HCI_FLEET_REASON_SIZE];
    snprintf(text, sizeof text, "%s", outcome->reason);
    if (summary && text[0] == '\0') (void)hci_json_find_text(summary, NULL, "remark", text, sizeof text);
    put_text(row, text);
}

/* Effects with a verdict, joined by +. */
static void list_effects(const hci_csv *csv, const char *verdict, char text[CELL_SIZE])
{
    hci_note ignored = {{0}};
    const hci_words list = {text, CELL_SIZE};
    const char *is, *effect;
    text[0] = '\0';
    for (size_t row = 0; row < hci_csv_rows(csv); ++row)
        if (!hci_csv_text(csv, "verdict", row, &is, &ignored) && strcmp(is, verdict) == 0 &&
            !hci_csv_text(csv, "effect", row, &effect, &ignored))
            hci_words_say(&list, "%s%s", text[0] ? "+" : "", effect);
}

static void put_effects(const hci_words *row, hci_fleet_command command, const char *part)
{
    static const char *const VERDICT[] = {"added", "ambiguous"};
    char path[PATH_SIZE], text[CELL_SIZE];
    hci_note ignored = {{0}};
    hci_csv *csv = NULL;
    if (!has_effects(command)) return;
    snprintf(path, sizeof path, "%s/%seffects.csv", part, command == HCI_FLEET_TUNE ? "diagnose/" : "");
    (void)hci_csv_read(path, &csv, &ignored);
    for (int k = 0; k < 2; ++k) {
        text[0] = '\0';
        if (csv) list_effects(csv, VERDICT[k], text);
        put_text(row, text);
    }
    hci_csv_free(csv);
}

/* ---- the row ---- */

void hci_fleet_header(hci_fleet_command command, char header[HCI_FLEET_ROW_SIZE])
{
    const hci_words row = {header, HCI_FLEET_ROW_SIZE};
    header[0] = '\0';
    hci_words_say(&row, "motor,serial,batch,date,state,exit_code,verdict,reason,");
    if (has_effects(command)) hci_words_say(&row, "effects,ambiguous,");
    for (const figure *f = FIGURES[command]; f->column; ++f)
        hci_words_say(&row, "%s,", f->column);
    hci_words_say(&row, "words_digest");
}

void hci_fleet_row_make(const hci_fleet_results *results, size_t motor, const hci_fleet_outcome *outcome,
                        const hci_fleet_digest *digest, const char *part, char text[HCI_FLEET_ROW_SIZE])
{
    static const char *const COLUMN[] = {"motor", "serial", "batch", "date"};
    const hci_words row = {text, HCI_FLEET_ROW_SIZE};
    const bool has_result = outcome->state <= HCI_FLEET_OPEN;
    char *summary = has_result ? hci_summary_read(part) : NULL;
    text[0] = '\0';
    for (int k = 0; k < 4; ++k)
        put_text(&row, hci_fleet_cell(results->list, motor, COLUMN[k]));
    hci_words_say(&row, "%s,", hci_fleet_state_name(outcome->state));
    if (outcome->exit_code >= 0) hci_words_say(&row, "%d", outcome->exit_code);
    hci_words_say(&row, ",");
    put_verdict(&row, results->command, summary);
    put_reason(&row, outcome, summary);
    put_effects(&row, results->command, has_result ? part : "");
    for (const figure *f = FIGURES[results->command]; f->column; ++f)
        put_figure(&row, summary, f);
    hci_words_say(&row, "%s", digest->text);
    hci_text_free(summary);
}

/* ---- a cell of a row ---- */

/* Copies the cell that begins at `at`, without its quotes, and returns where the next one begins; NULL: none.
 */
static const char *next_cell(const char *at, char *cell, size_t size)
{
    const bool quoted = *at == '"';
    size_t used = 0;
    at += quoted;
    for (; *at && (quoted || *at != ','); ++at) {
        if (quoted && *at == '"' && *++at != '"') break;
        if (used + 1 < size) cell[used++] = *at;
    }
    cell[used] = '\0';
    return *at == ',' ? at + 1 : NULL;
}

void hci_fleet_row_cell(const char *row, const char *header, const char *column, char *cell, size_t size)
{
    char name[64];
    while (row && header) {
        header = next_cell(header, name, sizeof name);
        row = next_cell(row, cell, size);
        if (strcmp(name, column) == 0) return;
    }
    cell[0] = '\0';
}

const char *hci_fleet_row_findings(const char *row)
{
    char cell[HCI_FLEET_ROW_SIZE];
    for (int k = 0; k < BEFORE_FINDINGS && row; ++k)
        row = next_cell(row, cell, sizeof cell);
    return row ? row : "";
}
