#include "hci/host/recording/predict.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/write.h"
#include "host/numeric/derivative.h"
#include "host/recording/free_shaft.h"

/* ---- readings ---- */

static hci_status memory_error(const hci_run *run, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_MEMORY, "%s: not enough memory for a prediction of %zu samples",
                        hci_quote_path(run->name, path), run->count);
}

/* The slopes of i_d, i_q and the zero sequence over time, as phase quantities. work: 6 count. */
static void set_changes(const hci_run *run, int pole_pairs, hci_sample *reading, double *work)
{
    const size_t n = run->count;
    double *x[3] = {work, work + n, work + 2 * n}, *slope[3] = {work + 3 * n, work + 4 * n, work + 5 * n};
    for (size_t k = 0; k < n; ++k) {
        const hci_dq i = hci_park(hci_clarke(run->i_A + 3 * k), pole_pairs * run->theta_m_rad[k]);
        x[0][k] = i.d;
        x[1][k] = i.q;
        x[2][k] = i.zero;
    }
    for (int c = 0; c < 3; ++c)
        hci_slope(run->time_s, x[c], n, slope[c]);
    for (size_t k = 0; k < n; ++k) {
        const hci_dq change = {slope[0][k], slope[1][k], slope[2][k]};
        hci_clarke_inverse(hci_park_inverse(change, pole_pairs * run->theta_m_rad[k]),
                           reading[k].change_A_per_s);
    }
}

hci_status hci_predict_readings(const hci_run *run, int pole_pairs, bool with_change, hci_sample *reading,
                                hci_note *note)
{
    if (run->theta_m_rad == NULL) {
        char path[HCI_QUOTE_PATH_SIZE];
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: found no angle, expected theta_m_rad or theta_e_rad; add the column",
                            hci_quote_path(run->name, path));
    }
    for (size_t k = 0; k < run->count; ++k) {
        hci_sample *x = &reading[k];
        *x = (hci_sample){.theta_m_rad = run->theta_m_rad[k]};
        x->speed_rad_per_s = run->speed_rad_per_s != NULL ? run->speed_rad_per_s[k] : 0.0;
        x->temperature_C = run->temperature_C != NULL ? run->temperature_C[k] : (double)NAN;
        for (int s = 0; s < 3; ++s)
            x->i_abc[s] = run->i_A[3 * k + (size_t)s];
    }
    if (!with_change || run->time_s == NULL || run->count < 2) return HCI_OK;
    double *work = hci_memory_new(run->count, 6 * sizeof *work);
    if (work == NULL) return memory_error(run, note);
    set_changes(run, pole_pairs, reading, work);
    hci_memory_free(work);
    return HCI_OK;
}

/* ---- prediction ---- */

static const hci_effect *find_effect(const hci_effects *effects, const char *name)
{
    for (size_t k = 0; k < effects->count; ++k)
        if (strcmp(effects->effect[k].type->name, name) == 0) return &effects->effect[k];
    return NULL;
}

hci_status hci_predict(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                       double *torque_Nm, hci_note *note)
{
    hci_sample *reading = hci_memory_new(run->count, sizeof *reading);
    if (reading == NULL) return memory_error(run, note);
    const bool with_change = find_effect(effects, "channel_delay") != NULL;
    const hci_status status =
        hci_predict_readings(run, machine->model.pole_pairs, with_change, reading, note);
    for (size_t k = 0; k < run->count && status == HCI_OK; ++k)
        torque_Nm[k] = hci_effects_predict(&machine->model, effects, &reading[k], NULL);
    if (status == HCI_OK && run->time_s != NULL)
        hci_effects_filter(effects, run->time_s, run->count, torque_Nm, NULL);
    hci_memory_free(reading);
    return status;
}

/* ---- in sum ---- */

static double mean_of(const double *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k];
    return sum / (double)n;
}

static double rms_about(const double *x, size_t n, double centre)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += (x[k] - centre) * (x[k] - centre);
    return sqrt(sum / (double)n);
}

static void sum_up(const hci_run *run, const double *model, const double *residual, hci_prediction *p)
{
    const size_t n = run->count;
    p->count = n;
    p->source = run->torque_source;
    p->mean_model_Nm = mean_of(model, n);
    p->ripple_model_Nm = rms_about(model, n, p->mean_model_Nm);
    p->mean_torque_Nm = p->ripple_torque_Nm = p->mean_residual_Nm = p->rms_residual_Nm = NAN;
    p->worst_residual_Nm = NAN;
    if (residual == NULL) return;
    p->mean_torque_Nm = mean_of(run->torque_Nm, n);
    p->ripple_torque_Nm = rms_about(run->torque_Nm, n, p->mean_torque_Nm);
    p->mean_residual_Nm = mean_of(residual, n);
    p->rms_residual_Nm = rms_about(residual, n, 0.0);
    p->worst_residual_Nm = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!(fabs(residual[k]) > p->worst_residual_Nm)) continue;
        p->worst_residual_Nm = fabs(residual[k]);
        p->worst_sample = k;
    }
}

static void add_remark(hci_note *remark, const char *text)
{
    const size_t used = strlen(remark->text);
    if (*text != '\0')
        snprintf(remark->text + used, sizeof remark->text - used, "%s%s", used > 0 ? "; " : "", text);
}

/* Effects that act along time or speed need them. */
static void remark_missing(const hci_run *run, const hci_effects *effects, hci_note *remark)
{
    if (run->time_s == NULL && find_effect(effects, "torque_sensor") != NULL)
        add_remark(remark, "without time the torque sensor's lag is left out");
    if (run->speed_rad_per_s == NULL &&
        (find_effect(effects, "friction") != NULL || find_effect(effects, "channel_delay") != NULL))
        add_remark(remark, "without a speed friction and delays are left out");
    if (run->temperature_C == NULL && find_effect(effects, "magnet_temperature") != NULL)
        add_remark(remark, "without a temperature the magnets are at the reference");
    if (!run->turn_known && find_effect(effects, "mechanical_order") != NULL)
        add_remark(remark,
                   "the angle does not tell where in the mechanical turn the rotor was: orders k/p have "
                   "any phase");
}

/* ---- files ---- */

typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_csv *csv;
    hci_run run;
    hci_note loaded;          /* why a shaft without a torque column is not free, or "" */
    double *model, *residual; /* residual: NULL where the run has no torque */
} task;

/* A shaft that drives something has a torque that is not known, and no residual. */
static hci_status keep_free(task *t, hci_note *note)
{
    hci_run *run = &t->run;
    const hci_status status = hci_free_shaft_check(&t->machine, &t->effects.list, run, 1, &t->loaded);
    if (status != HCI_ERROR_INPUT)
        return status == HCI_OK ? status : hci_note_set(note, status, "%s", t->loaded.text);
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    run->torque_source = HCI_TORQUE_NONE;
    return HCI_OK;
}

static hci_status read_task(task *t, const char *machine, const char *run, hci_note *note)
{
    hci_status status = hci_machine_read(machine, &t->machine, note);
    if (status == HCI_OK) status = hci_effects_read_machine(machine, &t->effects, note);
    if (status == HCI_OK) status = hci_csv_read(run, &t->csv, note);
    if (status == HCI_OK)
        status = hci_run_of_csv(t->csv, t->machine.model.pole_pairs, t->machine.inertia_kgm2, &t->run, note);
    if (status == HCI_OK) status = keep_free(t, note);
    return status;
}

static hci_status predict_task(task *t, hci_note *note)
{
    const size_t n = t->run.count;
    t->model = hci_memory_new(n, sizeof(double));
    if (t->run.torque_Nm != NULL) t->residual = hci_memory_new(n, sizeof(double));
    if (t->model == NULL || (t->run.torque_Nm != NULL && t->residual == NULL))
        return memory_error(&t->run, note);
    const hci_status status = hci_predict(&t->machine, &t->effects.list, &t->run, t->model, note);
    for (size_t k = 0; k < n && status == HCI_OK && t->residual != NULL; ++k)
        t->residual[k] = t->run.torque_Nm[k] - t->model[k];
    return status;
}

static hci_status write_task(const task *t, const char *out, hci_note *note)
{
    hci_csv_added added[3] = {{"torque_model_Nm", "Nm", t->model}};
    size_t count = 1;
    if (t->run.torque_source == HCI_TORQUE_INERTIA)
        added[count++] = (hci_csv_added){"torque_inertia_Nm", "Nm", t->run.torque_Nm};
    if (t->residual != NULL) added[count++] = (hci_csv_added){"residual_Nm", "Nm", t->residual};
    return hci_csv_write_with(t->csv, added, count, out, note);
}

static void release_task(task *t)
{
    hci_memory_free(t->model);
    hci_memory_free(t->residual);
    hci_run_release(&t->run);
    hci_csv_free(t->csv);
    hci_effects_release(&t->effects);
    hci_machine_release(&t->machine);
}

hci_status hci_predict_file(const char *machine, const char *run, const char *out, hci_prediction *prediction,
                            hci_note *note)
{
    task t;
    memset(&t, 0, sizeof t);
    memset(prediction, 0, sizeof *prediction);
    hci_status status = read_task(&t, machine, run, note);
    if (status == HCI_OK) status = predict_task(&t, note);
    if (status == HCI_OK && out != NULL) status = write_task(&t, out, note);
    if (status == HCI_OK) {
        sum_up(&t.run, t.model, t.residual, prediction);
        add_remark(&prediction->remark, t.machine.remark.text);
        add_remark(&prediction->remark, t.run.remark.text);
        add_remark(&prediction->remark, t.loaded.text);
        remark_missing(&t.run, &t.effects.list, &prediction->remark);
    }
    release_task(&t);
    return status;
}
