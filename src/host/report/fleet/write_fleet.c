/* fleet.csv, line.csv, deviations.csv, report.html and summary.json of a fleet. */
#include <math.h>
#include <string.h>

#include "hci/host/base/output.h"
#include "hci/host/report/fleet/write.h"
#include "host/csv/write.h"
#include "host/fleet/pooled.h"
#include "host/fleet/row.h"
#include "host/report/fleet/page_fleet.h"
#include "host/report/summary.h"

static void put(hci_output *out, double value, char end)
{
    if (isfinite(value))
        hci_output_number(out, value, end);
    else
        hci_output_text(out, "%c", end);
}

/* ---- fleet.csv: the rows of all folders ---- */

static void write_rows(const hci_line *l, hci_output *out)
{
    char header[HCI_FLEET_ROW_SIZE];
    hci_fleet_header(l->command, header);
    hci_output_text(out, "%s\n", header);
    for (size_t k = 0; k < l->motors; ++k)
        hci_output_text(out, "%s\n", l->motor[k].row);
}

/* ---- line.csv: a row for each parameter ---- */

static void write_parameters(const hci_line *l, hci_output *out)
{
    hci_output_text(out, "effect,parameter,unit,motors,median,standard_deviation,low,high,outside,mean,mean_"
                         "std_error,between,noise,per_day,"
                         "per_day_std_error,batch_deviation,batch_criterion\n");
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_line_parameter *p = &l->parameter[k];
        hci_output_text(out, "%s,%s,%s,%zu,", p->name.effect, p->name.parameter, p->name.unit, p->motors);
        put(out, p->median, ',');
        put(out, p->scale, ',');
        put(out, p->low, ',');
        put(out, p->high, ',');
        hci_output_text(out, "%zu,", p->outside);
        put(out, p->mean, ',');
        put(out, p->mean_std_error, ',');
        put(out, p->between, ',');
        put(out, p->noise, ',');
        put(out, p->per_day, ',');
        put(out, p->per_day_std_error, ',');
        put(out, p->batch_deviation, ',');
        put(out, p->batch_criterion, '\n');
    }
}

/* ---- deviations.csv: a row for each motor ---- */

static void write_names(const hci_line *l, hci_output *out)
{
    hci_output_text(out, "motor,state,stands_out,described,effect,parameter,deviation");
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_fleet_parameter *p = &l->parameter[k].name;
        const bool has_unit = strcmp(p->unit, "1") != 0;
        hci_output_text(out, ",%s_%s%s%s", p->effect, p->parameter, has_unit ? "_" : "",
                        has_unit ? p->unit : "");
    }
    hci_output_text(out, "\n");
}

/* Whether its parameter is all that a motor has; "" where it does not stand out. */
static const char *described(const hci_line *l, const hci_line_motor *m)
{
    if (!m->stands_out) return "";
    return m->worst + 1 == l->parameters ? "no" : m->leaves_more ? "part" : "yes";
}

static void write_motor(const hci_line *l, size_t motor, hci_output *out)
{
    const hci_line_motor *m = &l->motor[motor];
    const hci_fleet_parameter *worst = m->worst == HCI_LINE_NONE ? NULL : &l->parameter[m->worst].name;
    hci_csv_write_cell(out, m->name, true);
    hci_output_text(out, "%s,%s,%s,%s,%s,", hci_fleet_state_name(m->state), m->stands_out ? "yes" : "no",
                    described(l, m), worst ? worst->effect : "", worst ? worst->parameter : "");
    put(out, m->deviation, l->parameters > 0 ? ',' : '\n');
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_line_parameter *p = &l->parameter[k];
        const hci_pooled in_common = {p->mean, p->mean_std_error, p->between};
        const size_t at = motor * l->parameters + k;
        double open;
        const double as_fitted = l->value[at] - p->mean, /* of one that is not like the others */
            drawn = hci_pooled_shrunken(&in_common, l->value[at], l->std_error[at], &open);
        put(out, m->stands_out ? as_fitted : drawn, k + 1 < l->parameters ? ',' : '\n');
    }
}

static void write_motors(const hci_line *l, hci_output *out)
{
    write_names(l, out);
    for (size_t k = 0; k < l->motors; ++k)
        write_motor(l, k, out);
}

/* ---- summary.json ---- */

char *hci_line_json(const hci_line *l)
{
    hci_json json;
    hci_summary_begin(&json, "fleet");
    hci_json_number(&json, "motors", (double)l->motors);
    hci_json_number(&json, "dates_unread", (double)l->dates_unread);
    hci_json_number(&json, "stand_out", (double)hci_line_outside(l));
    hci_json_number(&json, "false_alarms", l->false_alarms);
    hci_json_number(&json, "limit", l->limit);
    hci_json_array(&json, "outside");
    for (size_t k = 0; k < l->motors; ++k) {
        const hci_line_motor *m = &l->motor[k];
        if (!m->stands_out) continue;
        hci_json_object(&json, NULL);
        hci_json_text(&json, "motor", m->name);
        hci_json_text(&json, "effect", l->parameter[m->worst].name.effect);
        hci_json_text(&json, "parameter", l->parameter[m->worst].name.parameter);
        hci_json_number(&json, "deviation", m->deviation);
        hci_json_close(&json);
    }
    hci_json_close(&json);
    return hci_json_end(&json);
}

/* ---- files ---- */

static hci_status write_all(const hci_line *l, hci_output *out, hci_note *note)
{
    hci_status status = hci_output_file(out, "fleet.csv", note);
    if (!status) write_rows(l, out);
    if (!status) status = hci_output_file(out, "line.csv", note);
    if (!status) write_parameters(l, out);
    if (!status) status = hci_output_file(out, "deviations.csv", note);
    if (!status) write_motors(l, out);
    if (!status) status = hci_output_file(out, "report.html", note);
    if (!status) hci_page_fleet(out, l);
    return status ? status : hci_summary_write(out, hci_line_json(l), note);
}

hci_status hci_line_write(const hci_line *line, const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_all(line, out, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
