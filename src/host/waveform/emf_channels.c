/* How the voltage channels compare: which of them count, and how each differs from the others in offset,
 * scale and phase. */
#include <math.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/waveform/emf_phases.h"

/* A channel with another scale than the other two, where these agree. */
#define SCALE_ODD    1.25
#define SCALE_AGREES 1.1

/* What a channel may be off before it is said. */
#define RATIO_TELLS     0.02
#define OFFSET_TELLS    0.02
#define PHASE_TELLS_rad 0.02

static bool within(double a, double b, double ratio)
{
    return a <= ratio * b && b <= ratio * a;
}

/* Leaves out the one whose scale is not that of the other two. */
void hci_emf_choose_channels(const hci_average *average, hci_emf_phases *phases)
{
    double size[3];
    for (size_t s = 0; s < 3; ++s)
        size[s] = hci_emf_size(average, s);
    for (size_t s = 0; s < 3; ++s) {
        const double first = size[(s + 1) % 3], second = size[(s + 2) % 3];
        phases->counts[s] =
            !within(first, second, SCALE_AGREES) || within(size[s], 0.5 * (first + second), SCALE_ODD);
    }
}

/* a/b */
static hci_average_harmonic quotient(hci_average_harmonic a, hci_average_harmonic b)
{
    const double square = b.sine * b.sine + b.cosine * b.cosine;
    return (hci_average_harmonic){(a.sine * b.sine + a.cosine * b.cosine) / square,
                                  (a.cosine * b.sine - a.sine * b.cosine) / square};
}

/* Each pass's ratio of a channel's fundamental to that of the others, as the only wave of `out`. */
static void set_ratios(const hci_average *average, const hci_emf_phases *phases, size_t channel,
                       hci_average *out)
{
    for (size_t pass = 0; pass < average->count; ++pass) {
        const hci_average_harmonic z =
            hci_emf_onto_a(*hci_average_at(average, pass, channel, 1), 1, phases->sequence, channel);
        *hci_average_at(out, pass, 0, 1) = quotient(z, hci_emf_balanced(average, phases, pass, 1, channel));
    }
}

/* The error of a ratio where there are too few turns to see it vary. */
static double ratio_error(const hci_average *average, const hci_emf_phases *phases, size_t channel)
{
    double square = 0.0, own = 0.0, others = 0.0;
    for (size_t s = 0; s < 3; ++s) {
        const hci_order_estimate e = hci_average_estimate(average, s, 1);
        const double share = e.std_error / hci_emf_length(e.mean);
        if (s == channel) own = share * share;
        if (s == channel || !phases->counts[s]) continue;
        square += share * share;
        others += 1.0;
    }
    return sqrt(own + square / (others * others));
}

static void compare_channel(const hci_average *average, const hci_emf_phases *phases, size_t s,
                            double inverse, hci_average *ratios, hci_waveform_channel *c)
{
    static const char *const NAME[3] = {"va", "vb", "vc"};
    const hci_order_estimate offset = hci_average_estimate(average, s, 0);
    set_ratios(average, phases, s, ratios);
    const hci_order_estimate ratio = hci_average_estimate(ratios, 0, 1);
    c->name = NAME[s];
    c->left_out = !phases->counts[s];
    c->offset_V = offset.mean.cosine / inverse;
    c->offset_error_V = fabs(offset.std_error / inverse);
    c->ratio = hci_emf_length(ratio.mean);
    c->phase_error_rad = atan2(ratio.mean.cosine, ratio.mean.sine);
    c->phase_error =
        hci_average_has_repeats(average) ? ratio.std_error / c->ratio : ratio_error(average, phases, s);
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
    else if (fabs(c->ratio - 1.0) > fmax(RATIO_TELLS, HCI_EMF_TIMES_ERROR * c->ratio_error))
        hci_note_add(&t->result->remark, "channel %s reads %.4g times the others%s", c->name, c->ratio,
                     guess_of(c->ratio));
    if (fabs(c->offset_V) > fmax(OFFSET_TELLS * amplitude_V * (c->left_out ? c->ratio : 1.0),
                                 HCI_EMF_TIMES_ERROR * c->offset_error_V))
        hci_note_add(&t->result->remark, "channel %s has an offset of %.3g V", c->name, c->offset_V);
    if (fabs(c->phase_error_rad) > fmax(PHASE_TELLS_rad, HCI_EMF_TIMES_ERROR * c->phase_error))
        hci_note_add(&t->result->remark, "channel %s is %.3g rad off its third of a turn", c->name,
                     c->phase_error_rad);
}

hci_status hci_emf_compare_channels(const hci_waveform_task *t, const hci_average *average,
                                    const hci_emf_phases *phases, double inverse)
{
    hci_average ratios = *average;
    double size = 0.0, counted = 0.0;
    ratios.channels = 1;
    ratios.highest = 1;
    ratios.wave = hci_memory_new(average->count, 2 * sizeof *ratios.wave);
    if (ratios.wave == NULL) return hci_waveform_memory(t);
    for (size_t s = 0; s < 3; ++s) {
        compare_channel(average, phases, s, inverse, &ratios, &t->result->channel[s]);
        if (phases->counts[s]) size += hci_emf_size(average, s);
        counted += phases->counts[s];
    }
    for (size_t s = 0; s < 3; ++s)
        remark_channel(t, &t->result->channel[s], size / counted / fabs(inverse));
    hci_memory_free(ratios.wave);
    return HCI_OK;
}
