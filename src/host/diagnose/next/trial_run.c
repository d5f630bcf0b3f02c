#include "host/diagnose/next/trial_run.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/recording/rotor_frame.h"

enum { SAMPLES_PER_PERIOD = 96, MOST_SAMPLES = 1024, HOLDING_STEPS = 4 };

size_t hci_trial_run_samples(int pole_pairs)
{
    const size_t wanted = (size_t)(SAMPLES_PER_PERIOD * pole_pairs);
    return wanted < MOST_SAMPLES ? wanted : MOST_SAMPLES;
}

hci_status hci_trial_run_make(const hci_regression *e, const hci_playable *playable, hci_trial_run *b,
                              hci_note *note)
{
    const size_t n = hci_trial_run_samples(e->machine->pole_pairs);
    memset(b, 0, sizeof *b);
    b->sample = hci_memory_new(n, sizeof *b->sample);
    b->residual_Nm = hci_memory_new(n, sizeof *b->residual_Nm);
    b->segment = (hci_segment){0, 0, n, 1, 1.0, true, true, 1.0};
    b->run.torque_source = playable->source == HCI_TORQUE_HOLDING ? HCI_TORQUE_HOLDING : HCI_TORQUE_MEASURED;
    b->run.turn_known = true;
    b->samples = (hci_binned_samples){b->sample, n, &b->segment, 1, &b->statistics, 1};
    b->noise = hci_noise_white(playable->noise_Nm);
    b->sum_deviation_A = NAN;
    b->use = true;
    b->regression = (hci_regression){.machine = e->machine,
                                     .declared = e->declared,
                                     .declared_constant = e->declared_constant,
                                     .samples = &b->samples,
                                     .runs = &b->run,
                                     .use = &b->use,
                                     .noise = &b->noise,
                                     .sum_deviation_A = &b->sum_deviation_A,
                                     .saliency = e->saliency};
    return b->sample && b->residual_Nm ? HCI_OK : hci_note_memory(note, NULL, "what to measure next");
}

void hci_trial_run_release(hci_trial_run *b)
{
    hci_memory_free(b->sample);
    hci_memory_free(b->residual_Nm);
}

static void current_set(hci_binned_sample *x, int pole_pairs, double id_A, double iq_A)
{
    hci_phases_of_dq((hci_dq){id_A, iq_A, 0.0}, pole_pairs * x->reading.theta_m_rad, x->reading.i_abc);
    x->raw = x->reading;
}

static void turn_fill(hci_trial_run *b, const hci_operating_point *at, double temperature_C)
{
    const size_t n = b->samples.count;
    const double turn = at->speed_rad_per_s < 0.0 ? -2.0 * HCI_PI : 2.0 * HCI_PI;
    memset(b->sample, 0, n * sizeof *b->sample);
    for (size_t k = 0; k < n; ++k) {
        hci_binned_sample *x = &b->sample[k];
        x->reading.theta_m_rad = turn * (double)k / (double)n;
        x->reading.speed_rad_per_s = at->speed_rad_per_s;
        x->reading.temperature_C = temperature_C;
        x->time_s = fabs(x->reading.theta_m_rad / at->speed_rad_per_s);
        x->sum_A = NAN;
        x->count = 1.0;
        current_set(x, b->regression.machine->pole_pairs, at->id_A, isfinite(at->iq_A) ? at->iq_A : 0.0);
    }
    b->segment.period_s = 2.0 * HCI_PI / fabs(at->speed_rad_per_s);
}

/* The i_q at each angle that leaves no torque. */
static hci_status hold(hci_trial_run *b, const hci_playable *x, double id_A, const hci_effects *truth,
                       hci_note *note)
{
    const int pole_pairs = b->regression.machine->pole_pairs;
    const double Nm_per_A = 1.5 * x->volts_s;
    hci_status status = HCI_OK;
    for (int step = 0; step < HOLDING_STEPS && Nm_per_A != 0.0 && !status; ++step) {
        status = hci_regression_residual(&b->regression, truth, b->residual_Nm, note);
        for (size_t k = 0; k < b->samples.count && !status; ++k) {
            const hci_dq i = hci_sample_dq(&b->sample[k].reading, pole_pairs);
            current_set(&b->sample[k], pole_pairs, id_A, i.q + b->residual_Nm[k] / Nm_per_A);
        }
    }
    return status;
}

hci_status hci_trial_run_play(hci_trial_run *b, const hci_playable *playable, const hci_operating_point *at,
                              const hci_effects *truth, hci_note *note)
{
    turn_fill(b, at, playable->temperature_C);
    if (b->run.torque_source == HCI_TORQUE_HOLDING) return hold(b, playable, at->id_A, truth, note);
    const hci_status status = hci_regression_residual(&b->regression, truth, b->residual_Nm, note);
    for (size_t k = 0; k < b->samples.count && !status; ++k)
        b->sample[k].torque_Nm = -b->residual_Nm[k];
    return status;
}
