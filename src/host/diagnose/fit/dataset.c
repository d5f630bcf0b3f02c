#include "host/diagnose/fit/dataset.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/prepare/index_alignment.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/machine/torque_constant.h"

#define WORSE    1.02 /* of the residual with smoothed readings, beside that with readings as they are */
#define ROUNDING 1e-6 /* noise of a sum of currents, as a share of them, that was not measured */

enum { LEAST_SAMPLES = 16 }; /* for the noise of that sum */

enum { MOST_PARTS = 200000 }; /* samples of which the torque is kept in parts: 35 MB */

/* Noise of i_a + i_b + i_c from its changes between samples; where it is nothing but rounding it was not
 * measured. */
static double sum_deviation_A(const hci_run *r)
{
    double square = 0.0, largest = 0.0;
    if (!r->has_sum || r->count < LEAST_SAMPLES) return NAN;
    for (size_t k = 1; k < r->count; ++k) {
        const double *i = r->i_A + 3 * k, *j = i - 3;
        const double change = i[0] + i[1] + i[2] - j[0] - j[1] - j[2];
        square += change * change;
        largest = fmax(largest, fabs(i[0]) + fabs(i[1]) + fabs(i[2]));
    }
    const double deviation = sqrt(0.5 * square / (double)(r->count - 1));
    return deviation > ROUNDING * largest ? deviation : (double)NAN;
}

/* Of no angle yet. */
static hci_torque_parts *parts_new(size_t samples)
{
    hci_torque_parts *parts = hci_memory_new(samples + 1, sizeof *parts);
    for (size_t k = 0; parts && k < samples; ++k)
        parts[k].theta_rad = NAN;
    return parts;
}

/* How many times as many rows as a usual list has. */
static double work_times(const hci_runs *runs)
{
    double rows = 0.0;
    for (size_t k = 0; k < runs->count; ++k)
        rows += (double)runs->run[k].count;
    return fmin(fmax(rows / HCI_USUAL_ROWS, 1.0), HCI_LONG_TIMES);
}

static hci_status evidence_make(const hci_machine_data *machine, const hci_effects *declared,
                                const hci_runs *runs, hci_dataset *b, hci_note *note)
{
    hci_regression *e = &b->regression;
    b->fit = hci_memory_new(2 * runs->count + 1, sizeof *b->fit);
    b->index_offset_rad = hci_memory_new(runs->count + 1, sizeof *b->index_offset_rad);
    *e = (hci_regression){.machine = &machine->model,
                          .declared = declared,
                          .declared_constant = hci_torque_constant(&machine->model, declared),
                          .samples = &b->samples,
                          .runs = runs->run,
                          .use = b->fit,
                          .known = &b->known,
                          .columns = &b->columns,
                          .work = &b->work,
                          .work_times = work_times(runs)};
    e->saliency = hci_saliency_width_of(machine);
    e->noise = hci_memory_new(b->samples.segment_count + 1, sizeof *e->noise);
    e->sum_deviation_A = hci_memory_new(runs->count + 1, sizeof *e->sum_deviation_A);
    const bool keeps = b->samples.count < MOST_PARTS;
    if (keeps) e->parts = parts_new(b->samples.count);
    if (!b->fit || !b->index_offset_rad || !e->noise || !e->sum_deviation_A || (keeps && !e->parts))
        return hci_note_memory(note, NULL, "the recordings");
    b->any = b->fit + runs->count;
    for (size_t k = 0; k < runs->count; ++k) {
        b->any[k] = true;
        b->fit[k] = runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_source != HCI_TORQUE_NONE;
        e->sum_deviation_A[k] = machine->has_neutral ? (double)NAN : sum_deviation_A(&runs->run[k]);
    }
    return HCI_OK;
}

static hci_status indices_align(const hci_runs *runs, hci_dataset *b, hci_note *note)
{
    double *residual_Nm = hci_memory_new(b->samples.count + 1, sizeof *residual_Nm);
    if (!residual_Nm) return hci_note_memory(note, NULL, "comparing recordings");
    b->regression.use = b->any;
    hci_status status = hci_regression_residual(&b->regression, b->regression.declared, residual_Nm, note);
    b->regression.use = b->fit;
    if (!status)
        status = hci_index_alignment_find(&b->samples, runs->run, residual_Nm, b->index_offset_rad, note);
    for (size_t k = 0; k < runs->count && !status; ++k)
        if (b->index_offset_rad[k] != 0.0)
            hci_index_alignment_apply(&b->samples, k, b->regression.machine->pole_pairs,
                                      b->index_offset_rad[k]);
    hci_memory_free(residual_Nm);
    return status;
}

/* Of a shaft that hardly accelerates the torque is the one that its current makes. */
static void torques_count(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                          hci_dataset *b)
{
    const double constant = fabs(hci_torque_constant(&machine->model, declared));
    for (size_t k = 0; k < runs->count; ++k) {
        hci_run_statistics *f = &b->samples.statistics[k];
        if (runs->run[k].hardly_accelerates)
            f->rms_torque_Nm = fmax(f->rms_torque_Nm, constant * f->current_A);
    }
}

/* Mean square of a run's residual. */
static double square_of(const hci_binned_samples *samples, size_t run, const double *residual_Nm)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j, count += 1.0)
            sum += residual_Nm[j] * residual_Nm[j];
    return count > 0.0 ? sum / count : 0.0;
}

/* Readings as they are in place of smoothed ones. */
static void readings_restore(hci_binned_samples *samples, size_t run)
{
    for (const hci_segment *s = NULL; (s = hci_segment_next(samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j)
            samples->sample[j].reading = samples->sample[j].raw;
}

/* Smoothing takes noise away, and with it what the series of a run cannot hold, such as current ripple of
 * high orders: where the residual of the declared machine is larger for it, the readings stay as they are.
 * residual_Nm: [2 samples]. */
static hci_status smoothing_check(hci_dataset *b, double *residual_Nm, hci_note *note)
{
    hci_regression *e = &b->regression;
    double *of_raw_Nm = residual_Nm + b->samples.count;
    hci_status status = hci_regression_residual(e, e->declared, residual_Nm, note);
    e->raw = true;
    if (!status) status = hci_regression_residual(e, e->declared, of_raw_Nm, note);
    e->raw = false;
    for (size_t k = 0; k < b->samples.run_count && !status; ++k)
        if (square_of(&b->samples, k, residual_Nm) > WORSE * WORSE * square_of(&b->samples, k, of_raw_Nm))
            readings_restore(&b->samples, k);
    return status;
}

static hci_status smoothing_settle(hci_dataset *b, hci_note *note)
{
    double *residual_Nm = hci_memory_new(2 * b->samples.count + 1, sizeof *residual_Nm);
    if (!residual_Nm) return hci_note_memory(note, NULL, "comparing recordings");
    b->regression.use = b->any;
    const hci_status status = smoothing_check(b, residual_Nm, note);
    b->regression.use = b->fit;
    hci_memory_free(residual_Nm);
    return status;
}

/* In a holding test the noise of the sum of the currents leaves the currents: a gain of all three sensors,
 * which no torque contradicts there, would make that sum smaller, and so describe noise. The sum itself, as
 * it was read, stays. */
static void sums_leave(const hci_runs *runs, hci_dataset *b)
{
    for (size_t r = 0; r < runs->count; ++r) {
        if (runs->run[r].torque_source != HCI_TORQUE_HOLDING || !isfinite(b->regression.sum_deviation_A[r]))
            continue;
        for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, r, s)) != NULL;)
            for (size_t j = s->first; j < s->first + s->count; ++j)
                for (size_t phase = 0; phase < 3; ++phase) {
                    hci_binned_sample *x = &b->samples.sample[j];
                    x->reading.i_abc[phase] -= x->sum_A / 3.0;
                    x->raw.i_abc[phase] -= x->sum_A / 3.0;
                }
    }
}

hci_status hci_dataset_make(const hci_machine_data *machine, const hci_effects *declared,
                            const hci_runs *runs, hci_dataset *b, hci_note *note)
{
    memset(b, 0, sizeof *b);
    hci_status status = hci_binned_samples_make(&machine->model, machine->rated_current_A, runs->run,
                                                runs->count, &b->samples, note);
    if (!status) torques_count(machine, declared, runs, b);
    if (!status) status = evidence_make(machine, declared, runs, b, note);
    if (!status) status = indices_align(runs, b, note);
    if (!status) status = smoothing_settle(b, note);
    if (!status) sums_leave(runs, b);
    if (status) hci_dataset_release(b);
    return status;
}

void hci_dataset_release(hci_dataset *b)
{
    hci_known_equations_release(&b->known);
    hci_known_columns_release(&b->columns);
    hci_memory_free(b->index_offset_rad);
    hci_memory_free(b->fit);
    hci_memory_free(b->regression.noise);
    hci_memory_free(b->regression.parts);
    hci_memory_free(b->regression.sum_deviation_A);
    hci_binned_samples_release(&b->samples);
    memset(b, 0, sizeof *b);
}

/* Of a holding test, whose readings are currents against no torque, that which the current makes. */
static double torque_of_run(const hci_dataset *b, size_t run)
{
    const hci_run_statistics *f = &b->samples.statistics[run];
    const bool holds = b->regression.runs[run].torque_source == HCI_TORQUE_HOLDING;
    return hypot(f->rms_torque_Nm, holds ? b->regression.declared_constant * f->current_A : 0.0);
}

hci_dataset_range hci_dataset_range_of(const hci_dataset *b)
{
    hci_dataset_range x = {0.0, 0.0, 0.0};
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        const hci_run_statistics *f = &b->samples.statistics[r];
        x.torque_Nm = fmax(x.torque_Nm, torque_of_run(b, r));
        x.current_A = fmax(x.current_A, f->current_A);
        x.speed_rad_per_s = fmax(x.speed_rad_per_s, f->pace_rad_per_s);
    }
    return x;
}
