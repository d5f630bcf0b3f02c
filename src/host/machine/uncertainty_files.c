/* uncertainty.csv, measured.csv and diagnosis.csv. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/machine/machine.h"
#include "hci/host/machine/uncertainty.h"
#include "host/base/memory.h"
#include "host/csv/write.h"
#include "host/machine/effect_rows.h"
#include "host/machine/folder.h"

enum { PATH_SIZE = 4096 };

#define UNCERTAINTY "uncertainty.csv"
#define MEASURED    "measured.csv"
#define DIAGNOSIS   "diagnosis.csv"
#define DEPARTURES  "departures"

/* ---- reading uncertainty.csv ---- */

static hci_status departures_error(const hci_csv *csv, size_t row, hci_note *note)
{
    return hci_csv_error(csv, DEPARTURES, row, note, "numbers divided by blanks, as many in each row",
                         "let diagnose write the file again");
}

static size_t words_in(const char *text)
{
    size_t count = 0;
    for (text += strspn(text, " "); *text; text += strspn(text, " "), ++count)
        text += strcspn(text, " ");
    return count;
}

/* Takes the next word of a text as a number. */
static bool word_take(const char **text, double *value)
{
    char word[64];
    *text += strspn(*text, " ");
    const size_t length = strcspn(*text, " ");
    if (length == 0 || length >= sizeof word) return false;
    memcpy(word, *text, length);
    word[length] = '\0';
    *text += length;
    return hci_number_parse(word, value) && isfinite(*value);
}

static hci_status row_read(const hci_csv *csv, size_t row, size_t machines, double *departure, hci_note *note)
{
    const char *text;
    const hci_status status = hci_csv_text(csv, DEPARTURES, row, &text, note);
    if (status) return status;
    if (words_in(text) != machines) return departures_error(csv, row, note);
    for (size_t k = 0; k < machines; ++k)
        if (!word_take(&text, &departure[k])) return departures_error(csv, row, note);
    return HCI_OK;
}

/* Terms and departures; row_of: [rows] of work. */
static hci_status uncertainty_of_csv(const hci_csv *csv, size_t runs, size_t *row_of, hci_uncertainty *u,
                                     hci_note *note)
{
    const char *text = "";
    const size_t rows = hci_csv_rows(csv);
    hci_status status = hci_effects_of_csv(csv, &u->effects, row_of, note);
    if (!status && rows == 0)
        status = hci_note_set(note, HCI_ERROR_INPUT, "%s: found no rows, expected one for each term",
                              hci_csv_path(csv));
    if (!status) status = hci_csv_text(csv, DEPARTURES, 0, &text, note);
    const size_t machines = words_in(text);
    if (!status && machines == 0) status = departures_error(csv, 0, note);
    if (!status) status = hci_uncertainty_reserve(u, runs, machines, note);
    for (size_t k = 0; k < rows && !status; ++k)
        status = row_read(csv, row_of[k], machines, u->departure + k * machines, note);
    return status;
}

/* ---- reading measured.csv ---- */

/* An empty cell is a number that is not known. */
static hci_status cell_read(const hci_csv *csv, const char *column, size_t row, double *value, hci_note *note)
{
    const char *text;
    const hci_status status = hci_csv_text(csv, column, row, &text, note);
    *value = NAN;
    if (status || *text == '\0') return status;
    return hci_csv_number(csv, column, row, value, note);
}

static hci_status run_read(const hci_csv *csv, size_t row, hci_measured_run *run, hci_note *note)
{
    static const char *const COLUMN[] = {
        "id_least_A",           "id_most_A", "iq_least_A", "iq_most_A", "speed_least_rad_per_s",
        "speed_most_rad_per_s", "misfit"};
    double *const value[] = {&run->id_A.least,
                             &run->id_A.most,
                             &run->iq_A.least,
                             &run->iq_A.most,
                             &run->speed_rad_per_s.least,
                             &run->speed_rad_per_s.most,
                             &run->misfit};
    const char *file;
    hci_status status = hci_csv_text(csv, "file", row, &file, note);
    if (status) return status;
    run->file = hci_memory_new(strlen(file) + 1, 1);
    if (!run->file) return hci_note_memory(note, hci_csv_path(csv), "%zu rows", hci_csv_rows(csv));
    memcpy(run->file, file, strlen(file) + 1);
    for (size_t k = 0; k < sizeof value / sizeof *value && !status; ++k)
        status = cell_read(csv, COLUMN[k], row, value[k], note);
    return status;
}

/* ---- both ---- */

static hci_status from_csv(const hci_csv *uncertainty, const hci_csv *measured, hci_uncertainty *u,
                           hci_note *note)
{
    const size_t runs = hci_csv_rows(measured);
    size_t *row_of = hci_memory_new(hci_csv_rows(uncertainty), sizeof *row_of);
    if (!row_of) return hci_note_memory(note, hci_csv_path(uncertainty), "its rows");
    hci_status status = uncertainty_of_csv(uncertainty, runs, row_of, u, note);
    for (size_t k = 0; k < runs && !status; ++k)
        status = run_read(measured, k, &u->run[k], note);
    hci_memory_free(row_of);
    return status;
}

static hci_status both_read(const char *uncertainty, const char *measured, hci_uncertainty *u, hci_note *note)
{
    hci_csv *first = NULL, *second = NULL;
    hci_status status = hci_csv_read(uncertainty, &first, note);
    if (!status) status = hci_csv_read(measured, &second, note);
    if (!status) status = from_csv(first, second, u, note);
    hci_csv_free(first);
    hci_csv_free(second);
    if (status) hci_uncertainty_release(u);
    return status;
}

/* ---- reading diagnosis.csv ---- */

static const char *const VERDICTS[] = {"complete",         "explained", "ambiguous",
                                       "partly explained", "unknown",   NULL};
static const char *const CONSTANTS[] = {"declared", NULL};
static const char *const SEARCHES[] = {"complete", "interrupted", "limited", NULL};

/* One of the words, or an error. */
static hci_status word_of(const hci_csv *csv, size_t row, const char *const *words, size_t size, char *out,
                          hci_note *note)
{
    const char *text;
    const hci_status status = hci_csv_text(csv, "value", row, &text, note);
    if (status) return status;
    for (; *words; ++words)
        if (strcmp(*words, text) == 0) {
            snprintf(out, size, "%s", text);
            return HCI_OK;
        }
    return hci_csv_error(csv, "value", row, note, "a word that diagnose writes there",
                         "let diagnose write the file again, or remove it");
}

/* Torques in N·m that stand in the file where they are above 0. */
enum { OPTIONAL = 4 };
static const char *const OPTIONAL_NAME[OPTIONAL] = {"turning_load", "sensor_zero", "left_orders",
                                                    "left_means"};

static double *optional_of(hci_machine_origin *origin, size_t k)
{
    double *const all[OPTIONAL] = {&origin->turning_load_Nm, &origin->sensor_zero_Nm, &origin->left_Nm,
                                   &origin->left_means_Nm};
    return all[k];
}

static hci_status origin_row(const hci_csv *csv, size_t row, hci_machine_origin *origin, hci_note *note)
{
    const char *name;
    const hci_status status = hci_csv_text(csv, "name", row, &name, note);
    if (status) return status;
    if (strcmp(name, "verdict") == 0)
        return word_of(csv, row, VERDICTS, sizeof origin->verdict, origin->verdict, note);
    if (strcmp(name, "search") == 0)
        return word_of(csv, row, SEARCHES, sizeof origin->search, origin->search, note);
    if (strcmp(name, "unexplained_ripple") == 0)
        return cell_read(csv, "value", row, &origin->unexplained_Nm, note);
    if (strcmp(name, "torque_constant") == 0) {
        char word[sizeof "declared"];
        origin->constant_is_declared = true;
        return word_of(csv, row, CONSTANTS, sizeof word, word, note);
    }
    for (size_t k = 0; k < OPTIONAL; ++k)
        if (strcmp(name, OPTIONAL_NAME[k]) == 0)
            return cell_read(csv, "value", row, optional_of(origin, k), note);
    return hci_csv_error(csv, "name", row, note,
                         "verdict, search, unexplained_ripple, torque_constant, turning_load, sensor_zero, "
                         "left_orders or left_means",
                         "let diagnose write the file again, or remove it");
}

static hci_status origin_read(const char *path, hci_machine_origin *origin, hci_note *note)
{
    hci_csv *csv = NULL;
    origin->unexplained_Nm = NAN;
    if (!hci_machine_has(path)) return HCI_OK;
    hci_status status = hci_csv_read(path, &csv, note);
    for (size_t row = 0; !status && row < hci_csv_rows(csv); ++row)
        status = origin_row(csv, row, origin, note);
    hci_csv_free(csv);
    return status;
}

hci_status hci_uncertainty_read_machine(const char *folder, hci_uncertainty *u, hci_note *note)
{
    char uncertainty[PATH_SIZE], measured[PATH_SIZE], diagnosis[PATH_SIZE];
    hci_machine_origin origin = {"", "", NAN, false, 0.0, 0.0, 0.0, 0.0};
    memset(u, 0, sizeof *u);
    hci_status status = hci_machine_path(uncertainty, sizeof uncertainty, folder, UNCERTAINTY, note);
    if (!status) status = hci_machine_path(measured, sizeof measured, folder, MEASURED, note);
    if (!status) status = hci_machine_path(diagnosis, sizeof diagnosis, folder, DIAGNOSIS, note);
    if (!status) status = origin_read(diagnosis, &origin, note);
    if (!status && (hci_machine_has(uncertainty) || hci_machine_has(measured)))
        status = both_read(uncertainty, measured, u, note);
    if (!status) u->origin = origin;
    return status;
}

/* ---- writing ---- */

/* Four digits: more would be no more true. */
static double rounded(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.3e", value);
    return strtod(text, NULL);
}

static void departures_write(hci_output *out, const double *departure, size_t machines)
{
    for (size_t k = 0; k < machines; ++k)
        hci_output_number(out, rounded(departure[k]), k + 1 < machines ? ' ' : '\n');
}

static hci_status terms_write(hci_output *out, const hci_uncertainty *u, hci_note *note)
{
    const hci_status status = hci_output_file(out, UNCERTAINTY, note);
    const double *departure = u->departure;
    if (status) return status;
    hci_output_text(out, "effect,parameter,value,unit," DEPARTURES "\n");
    for (size_t k = 0; k < u->effects.list.count; ++k)
        for (size_t j = 0; j < u->effects.list.effect[k].count; ++j, departure += u->machines) {
            const hci_effect *effect = &u->effects.list.effect[k];
            hci_effect_term_write(out, effect->type, &effect->term[j]);
            departures_write(out, departure, u->machines);
        }
    return HCI_OK;
}

static void cell_write(hci_output *out, double value, char end)
{
    if (isfinite(value))
        hci_output_number(out, rounded(value), end);
    else
        hci_output_text(out, "%c", end);
}

static hci_status runs_write(hci_output *out, const hci_uncertainty *u, hci_note *note)
{
    const hci_status status = hci_output_file(out, MEASURED, note);
    if (status) return status;
    hci_output_text(out, "file,id_least_A,id_most_A,iq_least_A,iq_most_A,speed_least_rad_per_s,"
                         "speed_most_rad_per_s,misfit\n");
    for (size_t k = 0; k < u->runs; ++k) {
        const hci_measured_run *r = &u->run[k];
        const double value[] = {
            r->id_A.least,          r->id_A.most, r->iq_A.least, r->iq_A.most, r->speed_rad_per_s.least,
            r->speed_rad_per_s.most};
        hci_csv_write_cell(out, r->file, true);
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            cell_write(out, value[j], ',');
        cell_write(out, r->misfit, '\n');
    }
    return HCI_OK;
}

static hci_status origin_write(hci_output *out, const hci_machine_origin *origin, hci_note *note)
{
    if (!origin->verdict[0]) return hci_output_without(out, DIAGNOSIS, note);
    const hci_status status = hci_output_file(out, DIAGNOSIS, note);
    if (status) return status;
    hci_output_text(out, "name,value,unit\nverdict,%s,\nsearch,%s,\nunexplained_ripple,", origin->verdict,
                    origin->search);
    cell_write(out, origin->unexplained_Nm, ',');
    hci_output_text(out, "Nm\n%s", origin->constant_is_declared ? "torque_constant,declared,\n" : "");
    hci_machine_origin of = *origin;
    for (size_t k = 0; k < OPTIONAL; ++k) {
        const double value_Nm = *optional_of(&of, k);
        if (!(value_Nm > 0.0)) continue;
        hci_output_text(out, "%s,", OPTIONAL_NAME[k]);
        cell_write(out, value_Nm, ',');
        hci_output_text(out, "Nm\n");
    }
    return HCI_OK;
}

hci_status hci_uncertainty_write(hci_output *out, const hci_uncertainty *u, hci_note *note)
{
    const hci_status of_origin = origin_write(out, &u->origin, note);
    if (of_origin) return of_origin;
    if (u->machines == 0) {
        const hci_status status = hci_output_without(out, UNCERTAINTY, note);
        return status ? status : hci_output_without(out, MEASURED, note);
    }
    const hci_status status = terms_write(out, u, note);
    return status ? status : runs_write(out, u, note);
}
