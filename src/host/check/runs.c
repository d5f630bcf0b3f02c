/* Figures of recordings. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/run_samples.h"

#define DEGREE (HCI_PI / 180.0)

static hci_status run_take(const hci_csv *csv, check_figures *f, check_run *run, hci_note *told,
                           hci_note *note)
{
    check_samples s = {.count = hci_csv_rows(csv), .remark = told};
    hci_status status;
    run->count = s.count;
    if (s.count == 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: found a header and no samples, expected a row for each sample; record the "
                            "run again",
                            run->path);
    s.used = hci_memory_new(hci_csv_columns(csv), sizeof *s.used);
    if (!s.used) return hci_note_set(note, HCI_ERROR_MEMORY, "%s: out of memory", run->path);
    status = hci_check_samples_read(csv, run, &s, note);
    if (!status) {
        hci_check_run_means(&s, run);
        if (s.theta) hci_check_run_frames(f, &s, run);
        run->theta = s.theta;
        run->ripple = s.torque;
        s.theta = s.torque = NULL;
    }
    hci_check_samples_release(&s);
    return status;
}

static hci_status run_read(const char *path, check_figures *f, check_run *run, hci_note *told, hci_note *note)
{
    hci_csv *csv;
    hci_status status;
    if (snprintf(run->path, sizeof run->path, "%s", path) >= (int)sizeof run->path)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %d bytes", path,
                            HCI_CHECK_PATH - 1);
    status = hci_csv_read(path, &csv, note);
    if (status) return status;
    status = run_take(csv, f, run, told, note);
    hci_csv_free(csv);
    return status;
}

static void add_scale(check_figures *f, double scale)
{
    for (size_t k = 0; k < f->scales; ++k)
        if (fabs(f->scale[k] / scale - 1.0) < 1e-9) return;
    f->scale[f->scales++] = scale;
}

/* 1, p and p/2 electrical radians for a recorded one, and so for degrees. */
static void scales_make(check_figures *f)
{
    const double p = f->value[CHECK_pole_pairs];
    for (int degrees = 0; degrees <= 1; ++degrees) {
        const double unit = degrees ? DEGREE : 1.0;
        add_scale(f, unit);
        add_scale(f, unit * p);
        if (fmod(p, 2.0) == 0.0) add_scale(f, unit * 0.5 * p);
    }
}

static double no_current(const check_figures *f)
{
    double most = f->value[CHECK_rated_current_A];
    for (size_t k = 0; k < f->runs; ++k)
        most = fmax(most, sqrt(f->run[k].current_square)); /* of NAN and a number the number */
    return NO_CURRENT * most;
}

hci_status hci_check_runs_read(const char *const *path, size_t count, check_figures *f, hci_note *told,
                               hci_note *note)
{
    hci_status status = HCI_OK;
    scales_make(f);
    f->run = hci_memory_new(count, sizeof *f->run);
    if (!f->run) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for %zu runs", count);
    for (size_t k = 0; k < count && !status; ++k) {
        status = run_read(path[k], f, &f->run[k], &told[k], note);
        ++f->runs;
    }
    f->no_current_A = no_current(f);
    return status;
}

void hci_check_figures_release(check_figures *f)
{
    for (size_t k = 0; k < f->runs; ++k) {
        hci_memory_free(f->run[k].theta);
        hci_memory_free(f->run[k].ripple);
    }
    hci_memory_free(f->run);
    hci_memory_free(f->emf.order);
    hci_memory_free(f->cogging.order);
    memset(f, 0, sizeof *f);
}

bool hci_check_has_current(const check_figures *f, const check_run *run)
{
    return sqrt(run->current_square) > f->no_current_A && run->current_square > 0.0;
}
