/* parameters.csv and summary.json of a fit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/base/output.h"
#include "hci/host/csv/csv.h"
#include "hci/host/fleet/fit.h"
#include "host/currents/own_files.h"
#include "host/fleet/row.h"
#include "host/machine/folder.h"
#include "host/report/summary.h"

#define PARAMETERS "parameters.csv"

enum { PATH_SIZE = 4096 };

static void add_parameter(hci_json *json, const hci_fleet_parameter *p)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "effect", p->effect);
    hci_json_text(json, "parameter", p->parameter);
    hci_json_number(json, "value", p->value);
    hci_json_text(json, "unit", p->unit);
    hci_json_number(json, "std_error", p->std_error);
    hci_json_close(json);
}

char *hci_fleet_fit_json(const hci_fleet_fit *fit)
{
    hci_json json;
    hci_summary_begin(&json, "fit");
    hci_json_number(&json, "samples", (double)fit->samples);
    hci_json_number(&json, "recordings", (double)fit->recordings);
    hci_json_number(&json, "recordings_unused", (double)fit->recordings_unused);
    hci_json_number(&json, "rows_unused", (double)fit->rows_unused);
    hci_json_text(&json, "remark", fit->remark.text);
    hci_json_bool(&json, "found", fit->is_found);
    if (fit->judged > 0) hci_json_text(&json, "verdict", fit->beyond > 0 ? "fail" : "pass");
    hci_json_number(&json, "judged", (double)fit->judged);
    hci_json_number(&json, "beyond", (double)fit->beyond);
    hci_json_number(&json, "rms_before_Nm", fit->rms_before_Nm);
    hci_json_number(&json, "rms_after_Nm", fit->rms_after_Nm);
    hci_json_array(&json, "parameters");
    for (size_t k = 0; k < fit->count; ++k)
        add_parameter(&json, &fit->parameter[k]);
    hci_json_close(&json);
    return hci_json_end(&json);
}

static void put(hci_output *out, double value, char end)
{
    if (isnan(value))
        hci_output_text(out, "%c", end);
    else
        hci_output_number(out, value, end);
}

static hci_status write_all(const hci_fleet_fit *fit, hci_output *out, hci_note *note)
{
    const hci_status status = hci_output_file(out, PARAMETERS, note);
    if (status) return status;
    hci_output_text(out, "effect,parameter,value,unit,std_error\n");
    for (size_t k = 0; k < fit->count; ++k) {
        const hci_fleet_parameter *p = &fit->parameter[k];
        hci_output_text(out, "%s,%s,", p->effect, p->parameter);
        put(out, p->value, ',');
        hci_output_text(out, "%s,", p->unit);
        put(out, p->std_error, '\n');
    }
    return hci_summary_write(out, hci_fleet_fit_json(fit), note);
}

hci_status hci_fleet_fit_write(const hci_fleet_fit *fit, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_all(fit, out, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

/* ---- reading ---- */

static hci_status read_text(const hci_csv *csv, const char *column, size_t row, char text[], hci_note *note)
{
    const char *cell = "";
    const hci_status status = hci_csv_text(csv, column, row, &cell, note);
    if (!status && strlen(cell) >= HCI_FLEET_PARAMETER_SIZE)
        return hci_csv_error(csv, column, row, note, "a shorter text", "take the file as `fit` writes it");
    snprintf(text, HCI_FLEET_PARAMETER_SIZE, "%s", cell);
    return status;
}

static hci_status read_number(const hci_csv *csv, const char *column, size_t row, double *value,
                              hci_note *note)
{
    const char *cell;
    const hci_status status = hci_csv_text(csv, column, row, &cell, note);
    *value = NAN;
    if (status || cell[0] == '\0' || hci_number_parse(cell, value)) return status;
    return hci_csv_error(csv, column, row, note, "a number or nothing", "take the file as `fit` writes it");
}

static hci_status read_row(const hci_csv *csv, size_t row, hci_fleet_parameter *p, hci_note *note)
{
    hci_status status = read_text(csv, "effect", row, p->effect, note);
    if (!status) status = read_text(csv, "parameter", row, p->parameter, note);
    if (!status) status = read_text(csv, "unit", row, p->unit, note);
    if (!status) status = read_number(csv, "value", row, &p->value, note);
    return status ? status : read_number(csv, "std_error", row, &p->std_error, note);
}

static hci_status read_rows(const char *path, hci_fleet_fit *fit, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    if (status) return status;
    if (hci_csv_rows(csv) > HCI_FLEET_MOST_PARAMETERS)
        status = hci_note_set(note, HCI_ERROR_INPUT, "%.300s: found %zu rows, expected at most %d", path,
                              hci_csv_rows(csv), HCI_FLEET_MOST_PARAMETERS);
    for (size_t k = 0; k < hci_csv_rows(csv) && !status; ++k)
        status = read_row(csv, k, &fit->parameter[fit->count++], note);
    hci_csv_free(csv);
    return status;
}

hci_status hci_fleet_fit_read(const char *folder, hci_fleet_fit *fit, bool *is_there, hci_note *note)
{
    char path[PATH_SIZE];
    memset(fit, 0, sizeof *fit);
    fit->rms_before_Nm = fit->rms_after_Nm = NAN;
    *is_there = false;
    hci_status status = hci_machine_path(path, sizeof path, folder, PARAMETERS, note);
    if (status || !hci_machine_has(path)) return status;
    *is_there = true;
    char *summary = hci_summary_read(folder);
    if (summary) {
        (void)hci_json_find_number(summary, NULL, "rms_before_Nm", &fit->rms_before_Nm);
        (void)hci_json_find_number(summary, NULL, "rms_after_Nm", &fit->rms_after_Nm);
    }
    hci_text_free(summary);
    status = hci_own_file_check_beside(path, HCI_FLEET_BATCH_AGAIN, note);
    return status ? status : read_rows(path, fit, note);
}
