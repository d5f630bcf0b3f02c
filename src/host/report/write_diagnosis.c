/* effects.csv, errors.csv, residual_spectrum.csv, summary.json, report.html and the corrected machine of a
 * diagnosis. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "host/csv/write.h"
#include "host/diagnose/findings.h"
#include "host/machine/folder.h"
#include "host/report/page/page.h"
#include "host/report/summary.h"
#include "host/report/write_next.h"
#include "host/report/write_runs.h"
#include "host/report/write_solution.h"

enum { PATH_SIZE = 4096 };

/* ---- tables ---- */

/* NAN is an empty cell. */
static void cell(hci_output *out, double value, char end)
{
    if (isfinite(value))
        hci_output_number(out, value, end);
    else
        hci_output_text(out, "%c", end);
}

static hci_status findings_write(hci_output *out, const hci_diagnosis *d, hci_note *note)
{
    const hci_status status = hci_output_file(out, "effects.csv", note);
    if (status) return status;
    hci_output_text(out, "rank,effect,verdict,delta_bic,residual_share,detail,stays,left_out\n");
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        hci_output_text(out, "%zu,%s,%s,", k + 1, f->effect, hci_finding_verdict_name(f->verdict));
        cell(out, hci_finding_delta_bic(f), ',');
        cell(out, f->residual_share, ',');
        hci_output_text(out, "\"%s\",", f->detail);
        if (f->left_out > 0) hci_output_text(out, "%zu,%zu", f->stays, f->left_out);
        hci_output_text(out, f->left_out > 0 ? "\n" : ",\n");
    }
    return HCI_OK;
}

static hci_status errors_write(hci_output *out, const hci_diagnosis *d, hci_note *note)
{
    const hci_status status = hci_output_file(out, "errors.csv", note);
    if (status) return status;
    hci_output_text(out,
                    "file,role,mean_torque_Nm,rms_before_Nm,rms_after_Nm,noise_floor_Nm,rms_after_low_Nm,"
                    "rms_after_high_Nm,error_mean_before_Nm,error_mean_after_Nm,ripple_before_Nm,"
                    "ripple_after_Nm\n");
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        hci_csv_write_cell(out, e->file, true);
        hci_output_text(out, "%s,", e->role == HCI_ROLE_FIT ? "fit" : "holdout");
        cell(out, e->mean_torque_Nm, ',');
        cell(out, e->rms_before_Nm, ',');
        cell(out, e->rms_after_Nm, ',');
        cell(out, e->noise_floor_Nm, ',');
        cell(out, e->after_low_Nm, ',');
        cell(out, e->after_high_Nm, ',');
        cell(out, e->error_mean_before_Nm, ',');
        cell(out, e->error_mean_after_Nm, ',');
        cell(out, e->ripple_before_Nm, ',');
        cell(out, e->ripple_after_Nm, '\n');
    }
    return HCI_OK;
}

static hci_status spectrum_write(hci_output *out, const hci_diagnosis *d, const hci_runs *runs,
                                 hci_note *note)
{
    const hci_status status = hci_output_file(out, "residual_spectrum.csv", note);
    if (status) return status;
    hci_output_text(out, "file,order,before_Nm,after_Nm,noise_Nm\n");
    for (size_t k = 0; k < d->lines; ++k) {
        const hci_residual_line *x = &d->line[k];
        hci_csv_write_cell(out, runs->run[x->run].name, true);
        cell(out, x->order, ',');
        cell(out, x->before_Nm, ',');
        cell(out, x->after_Nm, ',');
        cell(out, x->noise_Nm, '\n');
    }
    return HCI_OK;
}

/* A description of what is not understood, for those who want to subtract it: not physics. */
static hci_status unexplained_write(hci_output *out, const hci_diagnosis *d, hci_note *note)
{
    hci_status status;
    if (d->unexplained_count == 0) return hci_output_without(out, "unexplained.csv", note);
    status = hci_output_file(out, "unexplained.csv", note);
    if (status) return status;
    hci_output_text(out, "# not physics: T = (S sin n theta + C cos n theta) |i|^a |omega|^b sign(omega)^c\n"
                         "order,sine_Nm,cosine_Nm,current_exponent,speed_exponent,direction_exponent\n");
    for (size_t k = 0; k < d->unexplained_count; ++k) {
        const hci_unexplained *u = &d->unexplained[k];
        const double values[] = {u->order, u->sine_Nm, u->cosine_Nm, u->current_exponent, u->speed_exponent};
        for (size_t j = 0; j < sizeof values / sizeof *values; ++j)
            hci_output_number(out, values[j], ',');
        hci_output_text(out, "%d\n", u->turns_sign ? 1 : 0);
    }
    return HCI_OK;
}

static hci_status report_write(hci_output *out, const hci_diagnosis *d, const hci_resolution *resolution,
                               const hci_runs *runs, const char *machine_folder, hci_note *note)
{
    const hci_status status = hci_output_file(out, "report.html", note);
    return status ? status : hci_page_diagnosis(out, d, resolution, runs, machine_folder, note);
}

/* ---- the corrected machine ---- */

/* A table of the machine as it is, in UTF-8; one that is not there is none. */
static hci_status table_copy(hci_output *out, const char *folder, const char *name, hci_note *note)
{
    char path[PATH_SIZE];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", folder);
    if (!hci_machine_has(path)) return hci_output_without(out, name, note);
    const hci_status status = hci_output_file(out, name, note);
    return status ? status : hci_csv_copy(path, out, note);
}

static hci_status folder_within(const char *folder, const char *name, char path[PATH_SIZE], hci_note *note)
{
    if (snprintf(path, PATH_SIZE, "%s/%s", folder, name) < PATH_SIZE) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_OUTPUT, "%.200s…: the path is too long", folder);
}

/* A folder within that of the results, with the tables of the machine as they are. */
static hci_status tables_write(const hci_diagnosis *d, const char *machine_folder, const char *folder,
                               const char *name, hci_output **out, hci_note *note)
{
    static const char *const TABLES[] = {"machine.csv", "back_emf.csv", "inductance.csv", "cogging.csv"};
    char path[PATH_SIZE];
    hci_status status = folder_within(folder, name, path, note);
    if (!status) status = hci_output_open(path, out, note);
    for (size_t k = 0; k < 3 && !status; ++k)
        status = table_copy(*out, machine_folder, TABLES[k], note);
    if (status) return status;
    return d->without_cogging ? hci_output_without(*out, TABLES[3], note)
                              : table_copy(*out, machine_folder, TABLES[3], note);
}

/* What the diagnosis started from, for the next one: the machine, and where the recordings are. */
static hci_status declared_write(const hci_diagnosis *d, const char *machine_folder, const hci_runs *runs,
                                 const char *folder, hci_output **out, hci_note *note)
{
    char path[PATH_SIZE];
    hci_status status = folder_within(folder, "declared", path, note);
    if (!status) status = tables_write(d, machine_folder, folder, "declared", out, note);
    if (!status) status = table_copy(*out, machine_folder, "effects.csv", note);
    return status ? status : hci_runs_write(*out, runs, path, note);
}

static hci_status machine_write(const hci_diagnosis *d, const char *machine_folder, const char *folder,
                                hci_output **out, hci_note *note)
{
    hci_status status = tables_write(d, machine_folder, folder, "machine", out, note);
    if (!status) status = hci_uncertainty_write(*out, &d->uncertainty, note);
    if (status) return status;
    if (d->effects.list.count > 0) return hci_effects_write(*out, &d->effects.list, note);
    return hci_output_without(*out, "effects.csv", note);
}

/* ---- all of it ---- */

static hci_status results_write(hci_output *out, const hci_diagnosis *d, const hci_resolution *resolution,
                                const hci_runs *runs, const char *machine_folder, hci_note *note)
{
    hci_status status = findings_write(out, d, note);
    if (!status) status = errors_write(out, d, note);
    if (!status) status = spectrum_write(out, d, runs, note);
    if (!status) status = unexplained_write(out, d, note);
    if (!status) status = hci_next_points_write(out, d, note);
    if (!status) status = report_write(out, d, resolution, runs, machine_folder, note);
    return status ? status : hci_summary_write(out, hci_diagnosis_json(d, resolution), note);
}

/* The currents for the corrected machine; without any none are written. */
static hci_status solution_write(const hci_new_currents *currents, const char *machine_folder,
                                 const char *folder, hci_output **out, hci_note *note)
{
    char path[PATH_SIZE];
    if (!currents) return HCI_OK;
    const hci_report_sources sources = {.machine = machine_folder, .target = currents->target};
    const hci_resolution *r = currents->resolution;
    hci_status status = folder_within(folder, "solution", path, note);
    if (!status) status = hci_output_open(path, out, note);
    return status
               ? status
               : hci_solution_write_into(*out, currents->machine, &r->after, r->after_status, &sources, note);
}

hci_status hci_diagnosis_write(const hci_diagnosis *d, const hci_new_currents *currents, const hci_runs *runs,
                               const char *machine_folder, const char *folder, hci_note *note)
{
    enum { SOLUTION, DECLARED, MACHINE, FOLDER, SETS }; /* the folder itself is the last */
    hci_output *set[SETS] = {NULL};
    const hci_resolution *resolution = currents ? currents->resolution : NULL;
    hci_status status = hci_output_open(folder, &set[FOLDER], note);
    if (!status) status = results_write(set[FOLDER], d, resolution, runs, machine_folder, note);
    if (!status) status = declared_write(d, machine_folder, runs, folder, &set[DECLARED], note);
    if (!status) status = machine_write(d, machine_folder, folder, &set[MACHINE], note);
    if (!status) status = solution_write(currents, machine_folder, folder, &set[SOLUTION], note);
    const size_t first = currents ? SOLUTION : DECLARED;
    if (!status) return hci_output_commit_together(set + first, SETS - first, note);
    for (size_t k = 0; k < SETS; ++k)
        hci_output_discard(set[k]);
    return status;
}
