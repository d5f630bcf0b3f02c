/* In: a fit and a table of limits. Out: which of its parameters are outside. */
#include <math.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/fleet/fit.h"
#include "host/csv/column.h"

static const char *const COLUMN[] = {"effect", "parameter", "low", "high"};

typedef struct {
    const hci_csv *csv;
    size_t row;
    double low, high;
} limit;

static hci_status read_end(const limit *l, const char *column, double none, double *value, hci_note *note)
{
    const char *cell;
    const hci_status status = hci_csv_text(l->csv, column, l->row, &cell, note);
    *value = none;
    return status || cell[0] == '\0' ? status : hci_csv_number(l->csv, column, l->row, value, note);
}

static hci_status read_limit(limit *l, hci_note *note)
{
    hci_status status = read_end(l, "low", -INFINITY, &l->low, note);
    if (!status) status = read_end(l, "high", INFINITY, &l->high, note);
    if (!status && l->low > l->high)
        status = hci_csv_error(l->csv, "low", l->row, note, "no more than high", "exchange the two");
    return status;
}

/* The value of a row; false where a fit has no such parameter. */
static bool find(const hci_fleet_fit *fit, const char *effect, const char *parameter, double *value)
{
    *value = fit->rms_after_Nm;
    if (strcmp(effect, "residual") == 0 && strcmp(parameter, "rms") == 0) return true;
    for (size_t k = 0; k < fit->count; ++k) {
        *value = fit->parameter[k].value;
        if (strcmp(fit->parameter[k].effect, effect) == 0 &&
            strcmp(fit->parameter[k].parameter, parameter) == 0)
            return true;
    }
    return false;
}

static void judge(const limit *l, const char *effect, const char *parameter, double value, hci_fleet_fit *fit)
{
    if (isinf(l->low) && isinf(l->high)) return;
    ++fit->judged;
    if (value >= l->low && value <= l->high) return;
    ++fit->beyond;
    if (isnan(value))
        hci_note_add(&fit->remark, "%.40s %.40s: not told, expected %.4g … %.4g", effect, parameter, l->low,
                     l->high);
    else
        hci_note_add(&fit->remark, "%.40s %.40s: found %.4g, expected %.4g … %.4g", effect, parameter, value,
                     l->low, l->high);
}

static hci_status judge_row(limit *l, hci_fleet_fit *fit, hci_note *note)
{
    const char *effect = "", *parameter = "";
    double value;
    hci_status status = hci_csv_text(l->csv, "effect", l->row, &effect, note);
    if (!status) status = hci_csv_text(l->csv, "parameter", l->row, &parameter, note);
    if (!status) status = read_limit(l, note);
    if (status) return status;
    if (!find(fit, effect, parameter, &value))
        return hci_csv_error(l->csv, "parameter", l->row, note, "an effect and a parameter of parameters.csv",
                             "take their names from there");
    judge(l, effect, parameter, value, fit);
    return HCI_OK;
}

hci_status hci_fleet_fit_judge(const char *limits, hci_fleet_fit *fit, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(limits, &csv, note);
    if (status) return status;
    fit->judged = fit->beyond = 0;
    status = hci_columns_check(csv, COLUMN, sizeof COLUMN / sizeof *COLUMN, note);
    for (size_t row = 0; row < hci_csv_rows(csv) && !status; ++row)
        status = judge_row(&(limit){.csv = csv, .row = row}, fit, note);
    hci_csv_free(csv);
    return status;
}
