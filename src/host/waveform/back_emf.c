/* Back-EMF: three voltages over speed, and the orders of their balanced part. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/clock.h"
#include "host/waveform/emf_phases.h"
#include "host/waveform/task.h"

/* Samples below this share of the highest speed are mostly offset and noise. */
#define SLOW_SHARE 0.1

typedef struct {
    size_t count;
    double *angle_rad, *speed_rad_per_s; /* electrical; mechanical */
    double *voltage_V;                   /* [count][3] */
    double *value;                       /* [count][HCI_EMF_CHANNELS] */
    bool by_clock;                       /* no angle was recorded */
    hci_emf_phases phases;
} emf_work;

static void release(emf_work *w)
{
    hci_memory_free(w->angle_rad);
    hci_memory_free(w->speed_rad_per_s);
    hci_memory_free(w->voltage_V);
    hci_memory_free(w->value);
}

static hci_status allocate(const hci_waveform_task *t, emf_work *w)
{
    const size_t n = t->run->count;
    w->angle_rad = hci_memory_new(n, sizeof(double));
    w->speed_rad_per_s = hci_memory_new(n, sizeof(double));
    w->voltage_V = hci_memory_new(n, 3 * sizeof(double));
    w->value = hci_memory_new(n, HCI_EMF_CHANNELS * sizeof(double));
    return w->angle_rad && w->speed_rad_per_s && w->voltage_V && w->value ? HCI_OK : hci_waveform_memory(t);
}

/* ---- angle and speed ---- */

static hci_status take_recorded(const hci_waveform_task *t, emf_work *w)
{
    const hci_run *run = t->run;
    double fastest = 0.0;
    for (size_t k = 0; k < run->count; ++k)
        fastest = fmax(fastest, fabs(run->speed_rad_per_s[k]));
    if (!(fastest > 0.0))
        return hci_waveform_refuse(t, "a speed of 0", "a rotor that turns", "drive it and record again");
    for (size_t k = 0; k < run->count; ++k) {
        if (fabs(run->speed_rad_per_s[k]) < SLOW_SHARE * fastest) continue;
        w->angle_rad[w->count] = t->options->pole_pairs * run->theta_m_rad[k];
        w->speed_rad_per_s[w->count] = run->speed_rad_per_s[k];
        memcpy(w->voltage_V + 3 * w->count++, run->v_V + 3 * k, 3 * sizeof(double));
    }
    return HCI_OK;
}

static hci_status take_clock(const hci_waveform_task *t, emf_work *w)
{
    const hci_run *run = t->run;
    hci_voltage_clock clock;
    w->by_clock = true;
    w->count = run->count;
    memcpy(w->voltage_V, run->v_V, 3 * run->count * sizeof(double));
    if (hci_voltage_clock_find(run->time_s, run->v_V, run->count, w->angle_rad, w->speed_rad_per_s, &clock))
        return hci_waveform_refuse(t, "voltages without an even period",
                                   "three periods or more at a speed that changes little and evenly",
                                   "record longer, or record the angle too");
    for (size_t k = 0; k < w->count; ++k)
        w->speed_rad_per_s[k] /= t->options->pole_pairs;
    t->result->frequency_Hz = clock.frequency_Hz;
    t->result->drift_Hz_per_s = clock.drift_Hz_per_s;
    return HCI_OK;
}

static hci_status take_samples(const hci_waveform_task *t, emf_work *w)
{
    const hci_run *run = t->run;
    if (run->v_V == NULL) return hci_waveform_refuse(t, "no voltages", "va_V, vb_V, vc_V", "add the columns");
    if (run->theta_m_rad != NULL && run->speed_rad_per_s != NULL) return take_recorded(t, w);
    if (run->time_s == NULL)
        return hci_waveform_refuse(t, "neither a speed nor the time", "one of them",
                                   "add speed_rad_per_s or time_s");
    return take_clock(t, w);
}

static hci_status fit_turns(const hci_waveform_task *t, emf_work *w, hci_average *average)
{
    const hci_average_samples samples = {w->angle_rad, w->value, w->count, HCI_EMF_CHANNELS};
    for (size_t k = 0; k < w->count; ++k) {
        for (size_t s = 0; s < 3; ++s)
            w->value[HCI_EMF_CHANNELS * k + s] = w->voltage_V[3 * k + s] / w->speed_rad_per_s[k];
        w->value[HCI_EMF_CHANNELS * k + HCI_EMF_INVERSE] = 1.0 / w->speed_rad_per_s[k];
    }
    const hci_status status = hci_waveform_average(t, &samples, 1.0, average);
    if (status == HCI_ERROR_MEMORY) return hci_waveform_memory(t);
    if (status == HCI_ERROR_SINGULAR)
        return hci_waveform_refuse(t, "angles that do not go round an electrical turn",
                                   "samples all around, without large gaps",
                                   "record more of the turn, faster, or ask for lower orders");
    return status;
}

/* ---- sequence, offset, scale ---- */

/* The size of the positive less that of the negative sequence, each channel as if it had the same scale. */
static double sequence_of(const hci_average *average)
{
    double difference = 0.0;
    for (size_t pass = 0; pass < average->count; ++pass)
        for (int sequence = 1; sequence >= -1; sequence -= 2) {
            hci_average_harmonic sum = {0.0, 0.0};
            for (size_t s = 0; s < 3; ++s) {
                const hci_average_harmonic *z = hci_average_at(average, pass, s, 1);
                const hci_average_harmonic a = hci_emf_onto_a(*z, 1, sequence, s);
                const double length = hci_emf_length(a);
                sum.sine += length > 0.0 ? a.sine / length : 0.0;
                sum.cosine += length > 0.0 ? a.cosine / length : 0.0;
            }
            difference += sequence * hci_emf_length(sum);
        }
    return difference;
}

static void turn_backward(const hci_waveform_task *t, emf_work *w)
{
    for (size_t k = 0; k < w->count; ++k) {
        w->angle_rad[k] = -w->angle_rad[k];
        w->speed_rad_per_s[k] = -w->speed_rad_per_s[k];
    }
    t->result->frequency_Hz = -t->result->frequency_Hz;
    t->result->drift_Hz_per_s = -t->result->drift_Hz_per_s;
    hci_note_add(&t->result->remark,
                 "the phases follow each other as a-c-b: taken as turned backward; if it turned "
                 "forward, two phases are swapped");
}

/* Fits, and finds which way round the phases are. Without an angle a-c-b is the machine turned backward. */
static hci_status fit_in_sequence(const hci_waveform_task *t, emf_work *w, hci_average *average)
{
    hci_status status = fit_turns(t, w, average);
    w->phases.sequence = 1;
    if (status || sequence_of(average) >= 0.0) return status;
    if (!w->by_clock) {
        w->phases.sequence = -1;
        hci_note_add(&t->result->remark,
                     "the phases follow the angle as a-c-b: two phases are swapped, or the angle "
                     "counts backward; taken with b and c exchanged");
        return status;
    }
    turn_backward(t, w);
    hci_average_release(average);
    return fit_turns(t, w, average);
}

/* An offset o is o/ω in the values: takes it out of every order. What order 0 then holds is o times the mean
 * of 1/ω over all passes, which is returned. */
static double remove_offsets(const hci_average *average)
{
    const double inverse = hci_average_estimate(average, HCI_EMF_INVERSE, 0).mean.cosine;
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic *speed = hci_average_at(average, pass, HCI_EMF_INVERSE, 0);
        for (size_t s = 0; s < 3; ++s) {
            hci_average_harmonic *z = hci_average_at(average, pass, s, 0);
            const double offset_V = z[0].cosine / speed[0].cosine;
            z[0].cosine = offset_V * inverse;
            for (size_t k = 1; k <= average->highest; ++k) {
                z[k].sine -= offset_V * speed[k].sine;
                z[k].cosine -= offset_V * speed[k].cosine;
            }
        }
    }
    return inverse;
}

/* Without an angle each turn's zero is its own: the rising zero crossing of phase a's fundamental. */
static void align(const hci_average *average, const emf_work *w)
{
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic z = hci_emf_balanced(average, &w->phases, pass, 1, HCI_EMF_CHANNELS);
        const double phase = atan2(z.cosine, z.sine);
        for (size_t s = 0; s < 3; ++s)
            for (size_t k = 1; k <= average->highest; ++k) {
                hci_average_harmonic *x = hci_average_at(average, pass, s, k);
                *x = hci_emf_turned(*x, -(double)k * phase);
            }
    }
}

/* ---- the balanced part ---- */

/* sin(θ + γ) has its rising zero where θ + γ is 0. */
static void remark_zero(const hci_waveform_task *t, double phase_rad)
{
    hci_note_add(
        &t->result->remark,
        "theta_e is 0 at %.4g rad of phase a's fundamental, not at its rising zero crossing: "
        "%s %.4g rad %s theta_e (%.4g rad %s theta_m), as --angle-offset %.2f does; a back_emf.csv is "
        "written "
        "of that angle, so that its fundamental has the phase 0: what else is read beside it needs it",
        phase_rad, phase_rad > 0.0 ? "add" : "subtract", fabs(phase_rad), phase_rad > 0.0 ? "to" : "from",
        fabs(phase_rad) / t->options->pole_pairs, phase_rad > 0.0 ? "to" : "from",
        phase_rad * 180.0 / HCI_PI);
    t->result->zero_rad = phase_rad;
}

static hci_status take_balanced(const hci_waveform_task *t, const hci_average *average, const emf_work *w)
{
    hci_average part = *average;
    part.channels = 1;
    part.wave = hci_memory_new(average->count * (average->highest + 1), sizeof *part.wave);
    if (part.wave == NULL) return hci_waveform_memory(t);
    for (size_t pass = 0; pass < average->count; ++pass)
        for (size_t k = 1; k <= average->highest; ++k)
            *hci_average_at(&part, pass, 0, k) =
                hci_emf_balanced(average, &w->phases, pass, k, HCI_EMF_CHANNELS);
    const hci_order_estimate fundamental = hci_average_estimate(&part, 0, 1);
    const hci_status status = hci_waveform_take_orders(t, &part, 0, 1.0);
    hci_memory_free(part.wave);
    const double phase = hci_phase_rad(fundamental.mean.sine, fundamental.mean.cosine);
    const double error = fundamental.std_error / hci_emf_length(fundamental.mean);
    if (!status && !w->by_clock && fabs(phase) > fmax(0.01, HCI_EMF_TIMES_ERROR * error))
        remark_zero(t, phase);
    return status;
}

static void remark_currents(const hci_waveform_task *t)
{
    const double rms_A = hci_waveform_current_rms(t->run);
    if (hci_waveform_current_flows(t))
        hci_note_add(&t->result->remark, "currents of %.3g A rms flow: what they drop is in the voltages",
                     rms_A);
}

static hci_status back_emf_of(const hci_waveform_task *t, emf_work *w)
{
    hci_average average = {.highest = 0};
    double sum = 0.0;
    hci_status status = take_samples(t, w);
    if (!status) status = fit_in_sequence(t, w, &average);
    if (!status) {
        for (size_t k = 0; k < w->count; ++k)
            sum += w->speed_rad_per_s[k];
        t->result->speed_rad_per_s = sum / (double)w->count;
        const double inverse = remove_offsets(&average);
        hci_emf_choose_channels(&average, &w->phases);
        if (w->by_clock) {
            align(&average, w);
            hci_note_add(&t->result->remark,
                         "without an angle a speed that ripples within a turn shows as orders beside "
                         "the fundamental");
        }
        status = hci_emf_compare_channels(t, &average, &w->phases, inverse);
    }
    if (!status) status = take_balanced(t, &average, w);
    if (!status) remark_currents(t);
    hci_average_release(&average);
    return status;
}

hci_status hci_waveform_back_emf(const hci_waveform_task *t)
{
    emf_work w = {.count = 0};
    for (size_t k = 0; k < t->options->order_count; ++k)
        if (fabs(t->options->orders[k] - round(t->options->orders[k])) > HCI_ORDER_TOLERANCE)
            return hci_note_set(t->note, HCI_ERROR_ARGUMENT,
                                "order %g: the back-EMF has whole electrical orders only; leave it out, or "
                                "say --order-base mechanical",
                                t->options->orders[k]);
    hci_status status = allocate(t, &w);
    if (!status) status = back_emf_of(t, &w);
    release(&w);
    return status;
}
