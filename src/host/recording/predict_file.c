/* A run file and a machine folder: the run's columns with the predicted torque beside them, and a summary. */
#include <math.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "hci/host/recording/predict.h"
#include "host/base/memory.h"
#include "host/csv/write.h"
#include "host/machine/expected_ripple.h"
#include "host/numeric/statistics.h"
#include "host/recording/free_shaft.h"

/* ---- what is to be expected ---- */

enum { MOST_EXPECTED = 4096 };

/* In place: every stride-th reading to the true sample, and its torque. Returns how many. */
static size_t path_fill(const hci_machine *machine, const hci_effects *effects, size_t count,
                        hci_sample *sample, double *torque_Nm)
{
    const size_t stride = (count + MOST_EXPECTED - 1) / MOST_EXPECTED;
    size_t taken = 0;
    for (size_t k = 0; k < count; k += stride, ++taken) {
        const hci_sample x = hci_effects_undo(effects, machine->pole_pairs, &sample[k]);
        const double theta_rad = machine->pole_pairs * x.theta_m_rad;
        sample[taken] = x;
        torque_Nm[taken] = hci_torque_at(machine, theta_rad, x.i_abc) +
                           hci_effects_torque(machine, effects, &x, NULL).torque_Nm;
    }
    return taken;
}

static double speed_of(const hci_run *run)
{
    double most = 0.0;
    for (size_t k = 0; run->speed_rad_per_s && k < run->count; ++k)
        if (fabs(run->speed_rad_per_s[k]) > fabs(most)) most = run->speed_rad_per_s[k];
    return run->speed_rad_per_s ? most : (double)NAN;
}

/* What the real machine is expected to do with the currents of a run: the torque is that of the machine for
 * the true angle and the true currents behind the readings, without what stands between it and a sensor. Of a
 * run of more than 4096 samples every second, third … is taken. uncertainty: NULL or empty: nothing is known.
 * *expected: out. HCI_ERROR_INPUT for a run without an angle, HCI_ERROR_MEMORY. */
static hci_status expect_run(const hci_machine_data *machine, const hci_effects *effects,
                             const hci_uncertainty *uncertainty, const hci_run *run,
                             hci_expected_ripple *expected, hci_note *note)
{
    hci_sample *sample = hci_memory_new(run->count, sizeof *sample);
    double *torque_Nm = hci_memory_new(run->count, sizeof *torque_Nm);
    hci_status status =
        sample && torque_Nm ? HCI_OK : hci_note_memory(note, run->name, "%zu samples", run->count);
    if (!status)
        status =
            hci_predict_readings(run, machine->model.pole_pairs, hci_effects_needs(effects), sample, note);
    if (!status) {
        hci_ripple_path path = {.machine = &machine->model,
                                .effects = effects,
                                .sample = sample,
                                .torque_Nm = torque_Nm,
                                .speed_rad_per_s = speed_of(run)};
        path.count = path_fill(&machine->model, effects, run->count, sample, torque_Nm);
        status = hci_expected_ripple_find(&path, uncertainty, expected, note);
    }
    hci_memory_free(sample);
    hci_memory_free(torque_Nm);
    return status;
}

/* ---- in sum ---- */

static void sum_up(const hci_run *run, const double *model, const double *residual, hci_prediction *p)
{
    const size_t n = run->count;
    p->count = n;
    p->source = run->torque_source;
    p->mean_model_Nm = hci_mean(model, n);
    p->ripple_model_Nm = sqrt(hci_mean_square_about(model, n, p->mean_model_Nm));
    p->mean_torque_Nm = p->ripple_torque_Nm = p->mean_residual_Nm = p->rms_residual_Nm = NAN;
    p->worst_residual_Nm = p->peak_to_peak_Nm = NAN;
    if (residual == NULL) return;
    p->mean_torque_Nm = hci_mean(run->torque_Nm, n);
    p->ripple_torque_Nm = sqrt(hci_mean_square_about(run->torque_Nm, n, p->mean_torque_Nm));
    p->peak_to_peak_Nm = hci_peak_to_peak(run->torque_Nm, n);
    p->mean_residual_Nm = hci_mean(residual, n);
    p->rms_residual_Nm = sqrt(hci_mean_square_about(residual, n, 0.0));
    p->worst_residual_Nm = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!(fabs(residual[k]) > p->worst_residual_Nm)) continue;
        p->worst_residual_Nm = fabs(residual[k]);
        p->worst_sample = k;
    }
}

static void add_remark(hci_note *remark, const char *text)
{
    if (*text != '\0') hci_note_add(remark, "%s", text);
}

/* What effects need and a run lacks. */
static unsigned lacking(const hci_run *run)
{
    unsigned lacks = 0;
    if (run->time_s == NULL) lacks |= HCI_EFFECT_NEEDS_TIME;
    if (run->speed_rad_per_s == NULL) lacks |= HCI_EFFECT_NEEDS_SPEED;
    if (run->temperature_C == NULL) lacks |= HCI_EFFECT_NEEDS_TEMPERATURE;
    if (!run->turn_known) lacks |= HCI_EFFECT_NEEDS_TURN;
    return lacks;
}

/* Whether an effect before this one has the same text. */
static bool is_said(const hci_effects *effects, size_t at, unsigned lacks)
{
    for (size_t k = 0; k < at; ++k)
        if ((effects->effect[k].type->needs & lacks) &&
            strcmp(effects->effect[k].type->without, effects->effect[at].type->without) == 0)
            return true;
    return false;
}

/* What is left out of the prediction since the run lacks it. */
static void remark_missing(const hci_run *run, const hci_effects *effects, hci_note *remark)
{
    const unsigned lacks = lacking(run);
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect_type *type = effects->effect[k].type;
        if ((type->needs & lacks) && !is_said(effects, k, lacks)) hci_note_add(remark, "%s", type->without);
    }
}

/* ---- files ---- */

typedef struct {
    hci_machine_data machine;
    hci_effects_data effects;
    hci_uncertainty uncertainty;
    hci_csv *csv;
    hci_predicted_run done;
} task;

/* A shaft that drives something has a torque that is not known, and no residual. */
static hci_status keep_free(task *t, hci_note *note)
{
    hci_run *run = &t->done.run;
    const hci_status status = hci_free_shafts_find(&t->machine, &t->effects.list, run, 1, NULL, note);
    if (status || !run->mean_is_unknown) return status;
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    run->torque_source = HCI_TORQUE_NONE;
    return HCI_OK;
}

static hci_status read_task(task *t, const char *machine, const char *run, hci_run_options reading,
                            hci_note *note)
{
    hci_status status = hci_machine_read_orders(machine, reading.order_base, &t->machine, note);
    if (!status) status = hci_effects_read_machine(machine, &t->effects, note);
    if (!status) status = hci_uncertainty_read_machine(machine, &t->uncertainty, note);
    reading.pole_pairs = t->machine.model.pole_pairs;
    reading.inertia_kgm2 = t->machine.inertia_kgm2;
    reading.torque_constant_Nm_per_A = hci_machine_torque_constant(&t->machine);
    if (!status) status = hci_run_csv(run, &reading, &t->csv, note);
    if (!status) status = hci_run_of_csv(t->csv, &reading, &t->done.run, note);
    if (!status) status = keep_free(t, note);
    return status;
}

static hci_status predict_task(task *t, hci_note *note)
{
    const size_t n = t->done.run.count;
    t->done.model_Nm = hci_memory_new(n, sizeof(double));
    if (t->done.run.torque_Nm != NULL) t->done.residual_Nm = hci_memory_new(n, sizeof(double));
    if (t->done.model_Nm == NULL || (t->done.run.torque_Nm != NULL && t->done.residual_Nm == NULL))
        return hci_note_memory(note, t->done.run.name, "a prediction");
    const hci_status status =
        hci_predict(&t->machine, &t->effects.list, &t->done.run, t->done.model_Nm, note);
    for (size_t k = 0; k < n && !status && t->done.residual_Nm != NULL; ++k)
        t->done.residual_Nm[k] = t->done.run.torque_Nm[k] - t->done.model_Nm[k];
    return status;
}

/* Values of samples to their rows of the file; NAN where a row was left out. Returns the end of the rows. */
static double *spread(const task *t, const double *value, double *by_row)
{
    const size_t rows = hci_csv_rows(t->csv);
    for (size_t row = 0; row < rows; ++row)
        by_row[row] = NAN;
    for (size_t k = 0; k < t->done.run.count; ++k)
        by_row[t->done.run.row != NULL ? t->done.run.row[k] : k] = value[k];
    return by_row + rows;
}

static hci_status write_task(const task *t, const char *out, hci_note *note)
{
    double *room = hci_memory_new(hci_csv_rows(t->csv), 3 * sizeof *room), *next = room;
    hci_csv_added added[3] = {{"torque_model_Nm", "Nm", room}};
    size_t count = 1;
    if (room == NULL) return hci_note_memory(note, t->done.run.name, "a prediction");
    next = spread(t, t->done.model_Nm, next);
    if (t->done.run.torque_source == HCI_TORQUE_INERTIA) {
        added[count++] = (hci_csv_added){"torque_inertia_Nm", "Nm", next};
        next = spread(t, t->done.run.torque_Nm, next);
    }
    if (t->done.residual_Nm != NULL) {
        added[count++] = (hci_csv_added){"residual_Nm", "Nm", next};
        spread(t, t->done.residual_Nm, next);
    }
    const hci_status status = hci_csv_write_with(t->csv, added, count, out, note);
    hci_memory_free(room);
    return status;
}

static void release_task(task *t)
{
    hci_csv_free(t->csv);
    hci_effects_release(&t->effects);
    hci_uncertainty_release(&t->uncertainty);
    hci_machine_release(&t->machine);
}

void hci_predicted_run_release(hci_predicted_run *predicted)
{
    hci_memory_free(predicted->model_Nm);
    hci_memory_free(predicted->residual_Nm);
    hci_run_release(&predicted->run);
    memset(predicted, 0, sizeof *predicted);
}

/* Predicts; out: path of the file, or NULL. */
static hci_status perform(task *t, const char *out, hci_prediction *prediction, hci_note *note)
{
    hci_status status = predict_task(t, note);
    if (!status)
        status = expect_run(&t->machine, &t->effects.list, &t->uncertainty, &t->done.run,
                            &prediction->expected, note);
    if (!status && out != NULL) status = write_task(t, out, note);
    if (status) return status;
    sum_up(&t->done.run, t->done.model_Nm, t->done.residual_Nm, prediction);
    add_remark(&prediction->remark, t->machine.remark.text);
    add_remark(&prediction->remark, t->done.run.remark.text);
    remark_missing(&t->done.run, &t->effects.list, &prediction->remark);
    return HCI_OK;
}

hci_status hci_predict_file(const char *machine, const char *run, const hci_run_options *reading,
                            const char *out, hci_prediction *prediction, hci_note *note)
{
    task t;
    memset(&t, 0, sizeof t);
    memset(prediction, 0, sizeof *prediction);
    hci_status status = read_task(&t, machine, run, *reading, note);
    if (!status) status = perform(&t, out, prediction, note);
    release_task(&t);
    hci_predicted_run_release(&t.done);
    return status;
}

hci_status hci_predict_samples(const char *machine, const char *run, const hci_run_options *reading,
                               hci_predicted_run *predicted, hci_prediction *prediction, hci_note *note)
{
    task t;
    memset(&t, 0, sizeof t);
    memset(prediction, 0, sizeof *prediction);
    hci_status status = read_task(&t, machine, run, *reading, note);
    if (!status) status = perform(&t, NULL, prediction, note);
    release_task(&t);
    if (status) hci_predicted_run_release(&t.done);
    *predicted = t.done;
    return status;
}
