#include "hci/host/recording/predict.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/numeric/derivative.h"
#include "host/recording/rotor_frame.h"
#include "host/recording/speed_variation.h"

/* ---- readings ---- */

/* The slopes of i_d, i_q and the zero sequence over time, as phase quantities. work: 6 count. */
static void set_changes(const hci_run *run, int pole_pairs, hci_sample *reading, double *work)
{
    const size_t n = run->count;
    double *x[3] = {work, work + n, work + 2 * n}, *slope[3] = {work + 3 * n, work + 4 * n, work + 5 * n};
    for (size_t k = 0; k < n; ++k) {
        const hci_dq i = hci_run_dq(run, pole_pairs, k);
        x[0][k] = i.d;
        x[1][k] = i.q;
        x[2][k] = i.zero;
    }
    for (int c = 0; c < 3; ++c)
        hci_derivative(run->time_s, x[c], n, slope[c]);
    for (size_t k = 0; k < n; ++k) {
        const hci_dq change = {slope[0][k], slope[1][k], slope[2][k]};
        hci_phases_of_dq(change, pole_pairs * run->theta_m_rad[k], reading[k].change_A_per_s);
    }
}

/* work: count. */
static void set_accelerations(const hci_run *run, hci_sample *reading, double *work)
{
    hci_run_acceleration(run, work);
    for (size_t k = 0; k < run->count; ++k)
        reading[k].acceleration_rad_per_s2 = work[k];
}

hci_sample hci_predict_reading(const hci_run *run, size_t k)
{
    hci_sample x = {.theta_m_rad = run->theta_m_rad[k],
                    .computed_phase = run->computed_phase,
                    .switched_off = run->switched_off};
    x.speed_rad_per_s = run->speed_rad_per_s != NULL ? run->speed_rad_per_s[k] : 0.0;
    x.temperature_C = run->temperature_C != NULL ? run->temperature_C[k] : (double)NAN;
    x.elapsed_s = run->time_s != NULL ? run->time_s[k] - run->time_s[0] : 0.0;
    for (int s = 0; s < 3; ++s)
        x.i_abc[s] = run->i_A[3 * k + (size_t)s];
    return x;
}

hci_status hci_predict_readings(const hci_run *run, int pole_pairs, unsigned needs, hci_sample *reading,
                                hci_note *note)
{
    if (run->theta_m_rad == NULL) {
        char path[HCI_QUOTE_PATH_SIZE];
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found no angle, expected theta_m_rad or theta_e_rad; add the column, or say which it is: "
            "--column theta_m_deg=COLUMN",
            hci_quote_path(run->name, path));
    }
    for (size_t k = 0; k < run->count; ++k)
        reading[k] = hci_predict_reading(run, k);
    const unsigned along_time = HCI_EFFECT_NEEDS_RATE | HCI_EFFECT_NEEDS_ACCELERATION;
    if (!(needs & along_time) || run->time_s == NULL || run->count < 2) return HCI_OK;
    double *work = hci_memory_new(run->count, 6 * sizeof *work);
    if (work == NULL) return hci_note_memory(note, run->name, "a prediction of %zu samples", run->count);
    if (needs & HCI_EFFECT_NEEDS_RATE) set_changes(run, pole_pairs, reading, work);
    if ((needs & HCI_EFFECT_NEEDS_ACCELERATION) && run->speed_rad_per_s != NULL)
        set_accelerations(run, reading, work);
    hci_memory_free(work);
    return HCI_OK;
}

/* ---- prediction ---- */

hci_status hci_predict(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                       double *torque_Nm, hci_note *note)
{
    hci_sample *reading = hci_memory_new(run->count, sizeof *reading);
    if (reading == NULL) return hci_note_memory(note, run->name, "a prediction of %zu samples", run->count);
    const hci_status status =
        hci_predict_readings(run, machine->model.pole_pairs, hci_effects_needs(effects), reading, note);
    for (size_t k = 0; k < run->count && !status; ++k)
        torque_Nm[k] = hci_effects_predict(&machine->model, effects, &reading[k], NULL);
    if (!status && run->time_s != NULL) hci_effects_filter(effects, run->time_s, run->count, torque_Nm, NULL);
    hci_memory_free(reading);
    return status;
}
