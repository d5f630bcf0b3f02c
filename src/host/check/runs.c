/* Recordings: reads each, keeps its statistics, forgets the samples. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/run_samples.h"

#define DEGREE (HCI_PI / 180.0)

static hci_status run_take(const hci_csv *csv, check_data *data, check_run *run, hci_note *remark,
                           hci_note *note)
{
    check_samples s = {0};
    const hci_status status = hci_check_samples_read(csv, run, &s, remark, note);
    run->count = s.count;
    if (!status) {
        hci_check_run_means(&s, run);
        if (s.theta) hci_check_run_frames(data, &s, run);
        run->theta = hci_run_column_take(&s.columns, run->is_electrical ? HCI_RUN_THETA_E : HCI_RUN_THETA_M);
        run->torque = hci_run_column_take(&s.columns, HCI_RUN_TORQUE);
    }
    hci_check_samples_release(&s);
    return status;
}

static hci_status run_read(const char *path, const hci_run_options *reading, check_data *data, check_run *run,
                           hci_note *remark, hci_note *note)
{
    hci_csv *csv;
    hci_status status;
    if (snprintf(run->path, sizeof run->path, "%s", path) >= (int)sizeof run->path)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is longer than %d bytes", path,
                            HCI_CHECK_PATH - 1);
    status = hci_run_csv(path, reading, &csv, note);
    if (status) return status;
    status = run_take(csv, data, run, remark, note);
    hci_csv_free(csv);
    return status;
}

static void add_scale(check_data *data, double scale)
{
    for (size_t k = 0; k < data->scales; ++k)
        if (fabs(data->scale[k] / scale - 1.0) < 1e-9) return;
    data->scale[data->scales++] = scale;
}

/* 1, p and p/2 electrical radians for a recorded one, and so for degrees. */
static void scales_make(check_data *data)
{
    const double p = data->value[CHECK_pole_pairs];
    for (int degrees = 0; degrees <= 1; ++degrees) {
        const double unit = degrees ? DEGREE : 1.0;
        add_scale(data, unit);
        add_scale(data, unit * p);
        if (fmod(p, 2.0) == 0.0) add_scale(data, unit * 0.5 * p);
    }
}

static double no_current(const check_data *data)
{
    double most = data->value[CHECK_rated_current_A];
    for (size_t k = 0; k < data->runs; ++k)
        most = fmax(most, sqrt(data->run[k].current_square)); /* of NAN and a number the number */
    return CHECK_NO_CURRENT * most;
}

hci_status hci_check_runs_read(const char *const *path, size_t count, const hci_run_options *reading,
                               check_data *data, hci_note *remark, hci_note *note)
{
    hci_status status = HCI_OK;
    scales_make(data);
    data->run = hci_memory_new(count, sizeof *data->run);
    if (!data->run) return hci_note_memory(note, NULL, "%zu runs", count);
    for (size_t k = 0; k < count && !status; ++k) {
        status = run_read(path[k], reading, data, &data->run[k], &remark[k], note);
        ++data->runs;
    }
    data->no_current_A = no_current(data);
    return status;
}

void hci_check_data_release(check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k) {
        hci_memory_free(data->run[k].theta);
        hci_memory_free(data->run[k].torque);
    }
    hci_memory_free(data->run);
    hci_memory_free(data->emf.order);
    hci_memory_free(data->cogging.order);
    memset(data, 0, sizeof *data);
}

bool hci_check_has_current(const check_data *data, const check_run *run)
{
    return sqrt(run->current_square) > data->no_current_A && run->current_square > 0.0;
}
