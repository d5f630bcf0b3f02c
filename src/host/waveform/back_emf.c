/* Back-EMF: three voltages over speed, how the channels compare, and their balanced part. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/clock.h"
#include "host/waveform/task.h"

/* A channel with another scale than the other two, where these agree. */
#define SCALE_ODD    1.25
#define SCALE_AGREES 1.1

/* What a channel may be off before it is said. */
#define RATIO_TELLS     0.02
#define OFFSET_TELLS    0.02
#define PHASE_TELLS_rad 0.02
#define TIMES_ERROR     5.0

/* Samples below this share of the highest speed are mostly offset and noise. */
#define SLOW_SHARE 0.1

enum { INVERSE = 3, CHANNELS = 4 }; /* va, vb, vc, and 1/ω, which an offset follows */

typedef struct {
    size_t count;
    double *angle_rad, *speed_rad_per_s; /* electrical; mechanical */
    double *voltage_V;                   /* [count][3] */
    double *value;                       /* [count][CHANNELS] */
    bool by_clock;                       /* no angle was recorded */
    int sequence;                        /* −1: the phases follow each other as a-c-b */
    bool counts[3];                      /* channels of the balanced part */
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
    w->value = hci_memory_new(n, CHANNELS * sizeof(double));
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
    const hci_average_samples samples = {w->angle_rad, w->value, w->count, CHANNELS};
    for (size_t k = 0; k < w->count; ++k) {
        for (size_t s = 0; s < 3; ++s)
            w->value[CHANNELS * k + s] = w->voltage_V[3 * k + s] / w->speed_rad_per_s[k];
        w->value[CHANNELS * k + INVERSE] = 1.0 / w->speed_rad_per_s[k];
    }
    const hci_status status = hci_waveform_average(t, &samples, 1.0, average);
    if (status == HCI_ERROR_MEMORY) return hci_waveform_memory(t);
    if (status == HCI_ERROR_SINGULAR)
        return hci_waveform_refuse(t, "angles that do not go round an electrical turn",
                                   "samples all around, without large gaps",
                                   "record more of the turn, faster, or ask for lower orders");
    return status;
}

/* ---- waves as complex numbers S + jC = A exp(jγ) ---- */

static hci_average_harmonic turned(hci_average_harmonic w, double angle_rad)
{
    const double c = cos(angle_rad), s = sin(angle_rad);
    return (hci_average_harmonic){w.sine * c - w.cosine * s, w.sine * s + w.cosine * c};
}

static double length_of(hci_average_harmonic w)
{
    return hypot(w.sine, w.cosine);
}

/* a/b */
static hci_average_harmonic quotient(hci_average_harmonic a, hci_average_harmonic b)
{
    const double square = b.sine * b.sine + b.cosine * b.cosine;
    return (hci_average_harmonic){(a.sine * b.sine + a.cosine * b.cosine) / square,
                                  (a.cosine * b.sine - a.sine * b.cosine) / square};
}

/* Turns order k of phase s onto that of phase a, of which it is the third-of-a-period copy. */
static hci_average_harmonic onto_a(hci_average_harmonic w, size_t order, int sequence, size_t phase)
{
    return turned(w, (double)order * sequence * (double)phase * 2.0 * HCI_PI / 3.0);
}

/* Mean over the channels that count, or over these but one. */
static hci_average_harmonic balanced(const hci_average *average, const emf_work *w, size_t pass, size_t order,
                                     size_t except)
{
    hci_average_harmonic sum = {0.0, 0.0};
    double count = 0.0;
    for (size_t s = 0; s < 3; ++s) {
        if (!w->counts[s] || s == except) continue;
        const hci_average_harmonic z =
            onto_a(*hci_average_at(average, pass, s, order), order, w->sequence, s);
        sum.sine += z.sine;
        sum.cosine += z.cosine;
        count += 1.0;
    }
    return (hci_average_harmonic){sum.sine / count, sum.cosine / count};
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
                const hci_average_harmonic a = onto_a(*z, 1, sequence, s);
                const double length = length_of(a);
                sum.sine += length > 0.0 ? a.sine / length : 0.0;
                sum.cosine += length > 0.0 ? a.cosine / length : 0.0;
            }
            difference += sequence * length_of(sum);
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
    w->sequence = 1;
    if (status != HCI_OK || sequence_of(average) >= 0.0) return status;
    if (!w->by_clock) {
        w->sequence = -1;
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
    const double inverse = hci_average_estimate(average, INVERSE, 0).mean.cosine;
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic *speed = hci_average_at(average, pass, INVERSE, 0);
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

/* rms over the passes of a channel's fundamental. */
static double size_of(const hci_average *average, size_t channel)
{
    double square = 0.0;
    for (size_t pass = 0; pass < average->count; ++pass) {
        const double length = length_of(*hci_average_at(average, pass, channel, 1));
        square += length * length / (double)average->count;
    }
    return sqrt(square);
}

static bool within(double a, double b, double ratio)
{
    return a <= ratio * b && b <= ratio * a;
}

/* Leaves out the one whose scale is not that of the other two. */
static void choose_channels(const hci_average *average, emf_work *w)
{
    double size[3];
    for (size_t s = 0; s < 3; ++s)
        size[s] = size_of(average, s);
    for (size_t s = 0; s < 3; ++s) {
        const double first = size[(s + 1) % 3], second = size[(s + 2) % 3];
        w->counts[s] =
            !within(first, second, SCALE_AGREES) || within(size[s], 0.5 * (first + second), SCALE_ODD);
    }
}

/* Without an angle each turn's zero is its own: the rising zero crossing of phase a's fundamental. */
static void align(const hci_average *average, const emf_work *w)
{
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic z = balanced(average, w, pass, 1, CHANNELS);
        const double phase = atan2(z.cosine, z.sine);
        for (size_t s = 0; s < 3; ++s)
            for (size_t k = 1; k <= average->highest; ++k) {
                hci_average_harmonic *x = hci_average_at(average, pass, s, k);
                *x = turned(*x, -(double)k * phase);
            }
    }
}

/* ---- channels against each other ---- */

/* Each pass's ratio of a channel's fundamental to that of the others, as the only wave of `out`. */
static void set_ratios(const hci_average *average, const emf_work *w, size_t channel, hci_average *out)
{
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic z =
            onto_a(*hci_average_at(average, pass, channel, 1), 1, w->sequence, channel);
        *hci_average_at(out, pass, 0, 1) = quotient(z, balanced(average, w, pass, 1, channel));
    }
}

/* The error of a ratio where there are too few turns to see it vary. */
static double ratio_error(const hci_average *average, const emf_work *w, size_t channel)
{
    double square = 0.0, own = 0.0, others = 0.0;
    for (size_t s = 0; s < 3; ++s) {
        const hci_order_estimate e = hci_average_estimate(average, s, 1);
        const double share = e.std_error / length_of(e.mean);
        if (s == channel) own = share * share;
        if (s == channel || !w->counts[s]) continue;
        square += share * share;
        others += 1.0;
    }
    return sqrt(own + square / (others * others));
}

static void compare_channel(const hci_average *average, const emf_work *w, size_t s, double inverse,
                            hci_average *ratios, hci_waveform_channel *c)
{
    static const char *const NAME[3] = {"va", "vb", "vc"};
    const hci_order_estimate offset = hci_average_estimate(average, s, 0);
    set_ratios(average, w, s, ratios);
    const hci_order_estimate ratio = hci_average_estimate(ratios, 0, 1);
    c->name = NAME[s];
    c->left_out = !w->counts[s];
    c->offset_V = offset.mean.cosine / inverse;
    c->offset_error_V = fabs(offset.std_error / inverse);
    c->ratio = length_of(ratio.mean);
    c->phase_error_rad = atan2(ratio.mean.cosine, ratio.mean.sine);
    c->phase_error =
        hci_average_has_repeats(average) ? ratio.std_error / c->ratio : ratio_error(average, w, s);
    c->ratio_error = c->phase_error * c->ratio;
}

static const char *guess_of(double ratio)
{
    const double up = fmax(ratio, 1.0 / ratio);
    if (within(up, 10.0, 1.15)) return ": a x10 probe?";
    if (within(up, 100.0, 1.15)) return ": a x100 probe?";
    if (within(up, sqrt(3.0), 1.05)) return ": line and phase voltages mixed?";
    return "";
}

static void remark_channel(const hci_waveform_task *t, const hci_waveform_channel *c, double amplitude_V)
{
    if (c->left_out)
        hci_note_add(&t->result->remark,
                     "channel %s reads %.3g times the others%s; it is left out of the amplitudes", c->name,
                     c->ratio, guess_of(c->ratio));
    else if (fabs(c->ratio - 1.0) > fmax(RATIO_TELLS, TIMES_ERROR * c->ratio_error))
        hci_note_add(&t->result->remark, "channel %s reads %.4g times the others%s", c->name, c->ratio,
                     guess_of(c->ratio));
    if (fabs(c->offset_V) >
        fmax(OFFSET_TELLS * amplitude_V * (c->left_out ? c->ratio : 1.0), TIMES_ERROR * c->offset_error_V))
        hci_note_add(&t->result->remark, "channel %s has an offset of %.3g V", c->name, c->offset_V);
    if (fabs(c->phase_error_rad) > fmax(PHASE_TELLS_rad, TIMES_ERROR * c->phase_error))
        hci_note_add(&t->result->remark, "channel %s is %.3g rad off its third of a turn", c->name,
                     c->phase_error_rad);
}

static hci_status compare_channels(const hci_waveform_task *t, const hci_average *average, const emf_work *w,
                                   double inverse)
{
    hci_average ratios = *average;
    double size = 0.0, counted = 0.0;
    ratios.channels = 1;
    ratios.highest = 1;
    ratios.wave = hci_memory_new(average->count, 2 * sizeof *ratios.wave);
    if (ratios.wave == NULL) return hci_waveform_memory(t);
    for (size_t s = 0; s < 3; ++s) {
        compare_channel(average, w, s, inverse, &ratios, &t->result->channel[s]);
        if (w->counts[s]) size += size_of(average, s);
        counted += w->counts[s];
    }
    for (size_t s = 0; s < 3; ++s)
        remark_channel(t, &t->result->channel[s], size / counted / fabs(inverse));
    hci_memory_free(ratios.wave);
    return HCI_OK;
}

/* ---- the balanced part ---- */

/* sin(θ + γ) has its rising zero where θ + γ is 0. */
static void remark_zero(const hci_waveform_task *t, double phase_rad)
{
    hci_note_add(&t->result->remark,
                 "theta_e is 0 at %.4g rad of phase a's fundamental, not at its rising zero crossing: "
                 "%s %.4g rad %s theta_e (%.4g rad %s theta_m)",
                 phase_rad, phase_rad > 0.0 ? "add" : "subtract", fabs(phase_rad),
                 phase_rad > 0.0 ? "to" : "from", fabs(phase_rad) / t->options->pole_pairs,
                 phase_rad > 0.0 ? "to" : "from");
}

static hci_status take_balanced(const hci_waveform_task *t, const hci_average *average, const emf_work *w)
{
    hci_average part = *average;
    part.channels = 1;
    part.wave = hci_memory_new(average->count * (average->highest + 1), sizeof *part.wave);
    if (part.wave == NULL) return hci_waveform_memory(t);
    for (size_t pass = 0; pass < average->count; ++pass)
        for (size_t k = 1; k <= average->highest; ++k)
            *hci_average_at(&part, pass, 0, k) = balanced(average, w, pass, k, CHANNELS);
    const hci_order_estimate fundamental = hci_average_estimate(&part, 0, 1);
    const hci_status status = hci_waveform_take_orders(t, &part, 0, 1.0);
    hci_memory_free(part.wave);
    const double phase = hci_phase_rad(fundamental.mean.sine, fundamental.mean.cosine);
    const double error = fundamental.std_error / length_of(fundamental.mean);
    if (status == HCI_OK && !w->by_clock && fabs(phase) > fmax(0.01, TIMES_ERROR * error))
        remark_zero(t, phase);
    return status;
}

static void remark_currents(const hci_waveform_task *t)
{
    const double rms_A = hci_waveform_current_rms(t->run);
    if (rms_A > 0.0)
        hci_note_add(&t->result->remark, "currents of %.3g A rms flow: what they drop is in the voltages",
                     rms_A);
}

static hci_status back_emf_of(const hci_waveform_task *t, emf_work *w)
{
    hci_average average = {.highest = 0};
    double sum = 0.0;
    hci_status status = take_samples(t, w);
    if (status == HCI_OK) status = fit_in_sequence(t, w, &average);
    if (status == HCI_OK) {
        for (size_t k = 0; k < w->count; ++k)
            sum += w->speed_rad_per_s[k];
        t->result->speed_rad_per_s = sum / (double)w->count;
        const double inverse = remove_offsets(&average);
        choose_channels(&average, w);
        if (w->by_clock) {
            align(&average, w);
            hci_note_add(&t->result->remark,
                         "without an angle a speed that ripples within a turn shows as orders beside "
                         "the fundamental");
        }
        status = compare_channels(t, &average, w, inverse);
    }
    if (status == HCI_OK) status = take_balanced(t, &average, w);
    if (status == HCI_OK) remark_currents(t);
    hci_average_release(&average);
    return status;
}

hci_status hci_waveform_back_emf(const hci_waveform_task *t)
{
    emf_work w = {.count = 0};
    for (size_t k = 0; k < t->options->order_count; ++k)
        if (fabs(t->options->orders[k] - round(t->options->orders[k])) > HCI_ORDER_TOLERANCE)
            return hci_note_set(t->note, HCI_ERROR_ARGUMENT,
                                "order %g: the back-EMF has whole electrical orders only",
                                t->options->orders[k]);
    hci_status status = allocate(t, &w);
    if (status == HCI_OK) status = back_emf_of(t, &w);
    release(&w);
    return status;
}
