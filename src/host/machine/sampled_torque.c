/* Torque above the second degree. In: effects and star currents as waves; out: the torque's harmonics, or its
 * gradient as waves and its offset as harmonics. The current is brought to samples over the period by one
 * transform, the effects are evaluated at each, and transforms bring the results back. */
#include "host/machine/sampled_torque.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/machine/quadratic_model.h"
#include "host/numeric/fft.h"

#define LEAST_PER_TURN 1024.0

/* Samples over the path; pairs of rows are real and imaginary part of one transform. */
typedef struct {
    double *alpha, *beta;                   /* current in A */
    double *gradient_alpha, *gradient_beta; /* ∂T/∂i in N·m/A */
    double *torque, *offset;                /* T and ∂T/∂i·i − T in N·m */
    size_t count, turns;
} samples;

/* A polynomial of the current has many times its orders, but they fall off as fast as the current's own. */
static double samples_per_turn(const hci_torque_path *p)
{
    double top = 0.0;
    for (size_t k = 0; k < p->count; ++k)
        top = fmax(top, p->wave[k].order);
    top = fmax(8.0 * top, 4.0 * hci_effects_top_order(p->higher->effects));
    return fmax(LEAST_PER_TURN, top);
}

static hci_status samples_new(const hci_torque_path *p, samples *s, hci_note *note)
{
    s->turns = p->turns;
    s->count = hci_fft_size(samples_per_turn(p) * (double)p->turns);
    s->alpha = hci_memory_new(6 * s->count, sizeof *s->alpha);
    if (!s->alpha) return hci_note_memory(note, NULL, "%zu samples of the torque", s->count);
    s->beta = s->alpha + s->count;
    s->gradient_alpha = s->beta + s->count;
    s->gradient_beta = s->gradient_alpha + s->count;
    s->torque = s->gradient_beta + s->count;
    s->offset = s->torque + s->count;
    return HCI_OK;
}

/* α + jβ of a wave is (C − jS) e^(jnθ) for positive and (C + jS) e^(−jnθ) for negative sequence. */
static void fill_current(const hci_torque_path *p, const samples *s)
{
    for (size_t k = 0; k < p->count; ++k) {
        const hci_wave *w = &p->wave[k];
        const size_t n = (size_t)floor(w->order * (double)s->turns + 0.5);
        const size_t at = w->sequence > 0 || n == 0 ? n : s->count - n;
        if (w->sequence == 0) continue;
        s->alpha[at] += w->cosine;
        s->beta[at] -= w->sequence * w->sine;
    }
    hci_fft(s->alpha, s->beta, s->count, 1);
}

/* T and ∂T/∂i at sample k; in the plane ∂T/∂i·i = (3/2)(g_α i_α + g_β i_β). */
static void evaluate_at(const hci_effects_plant *higher, const samples *s, size_t k)
{
    const hci_alpha_beta i = {s->alpha[k], s->beta[k], 0.0};
    const double period_m_rad = 2.0 * HCI_PI * (double)s->turns / higher->machine->pole_pairs;
    hci_sample x = {0};
    x.theta_m_rad = period_m_rad * (double)k / (double)s->count;
    x.temperature_C = higher->temperature_C;
    hci_clarke_inverse(i, x.i_abc);
    const hci_effect_torque t = hci_effects_torque(higher->machine, higher->effects, &x, NULL);
    const hci_alpha_beta gradient = hci_clarke(t.by_current);
    s->gradient_alpha[k] = gradient.alpha;
    s->gradient_beta[k] = gradient.beta;
    s->torque[k] = t.torque_Nm;
    s->offset[k] = 1.5 * (gradient.alpha * i.alpha + gradient.beta * i.beta) - t.torque_Nm;
}

/* In: the path; out: its samples, torque and offset transformed already. s->alpha is to be freed in any case.
 */
static hci_status sample(const hci_torque_path *p, samples *s, hci_note *note)
{
    const hci_status status = samples_new(p, s, note);
    if (status) return status;
    fill_current(p, s);
    for (size_t k = 0; k < s->count; ++k)
        evaluate_at(p->higher, s, k);
    hci_fft(s->torque, s->offset, s->count, -1);
    return HCI_OK;
}

typedef enum { TORQUE, OFFSET } row;

/* One of the two real signals, without what is rounding. */
static hci_status harmonics(const samples *s, row which, hci_harmonic_list *out, hci_note *note)
{
    const hci_fft_pair pair = {s->torque, s->offset, s->count, s->turns};
    double largest = 0.0;
    out->count = 0;
    out->harmonic = hci_memory_new(s->count / 2, sizeof *out->harmonic);
    if (!out->harmonic) return hci_note_memory(note, NULL, "the torque's orders");
    for (size_t k = 0; k < s->count / 2; ++k) {
        hci_harmonic *h = &out->harmonic[k], unused;
        hci_fft_bin(&pair, k, which == TORQUE ? h : &unused, which == TORQUE ? &unused : h);
        largest = fmax(largest, hci_amplitude(h->sine, h->cosine));
    }
    for (size_t k = 0; k < s->count / 2; ++k) {
        const hci_harmonic h = out->harmonic[k];
        if (hci_amplitude(h.sine, h.cosine) > HCI_FFT_FLOOR * largest) out->harmonic[out->count++] = h;
    }
    return HCI_OK;
}

hci_status hci_sampled_torque(const hci_torque_path *path, hci_harmonic_list *torque, hci_note *note)
{
    samples s = {0};
    hci_status status = sample(path, &s, note);
    memset(torque, 0, sizeof *torque);
    if (!status) status = harmonics(&s, TORQUE, torque, note);
    hci_memory_free(s.alpha);
    return status;
}

/* Both sequences of each order of the gradient, as in fill_current. */
static hci_status gradient_waves(const samples *s, hci_wave_list *out, hci_note *note)
{
    const double scale = 1.0 / (double)s->count, *a = s->gradient_alpha, *b = s->gradient_beta;
    size_t n = 0;
    out->wave = hci_memory_new(s->count, sizeof *out->wave);
    if (!out->wave) return hci_note_memory(note, NULL, "the torque's slopes");
    hci_fft(s->gradient_alpha, s->gradient_beta, s->count, -1);
    for (size_t k = 0; k < s->count / 2; ++k) {
        const double order = (double)k / (double)s->turns;
        const size_t mirror = s->count - k;
        if (k > 0) out->wave[n++] = (hci_wave){order, -1, scale * b[mirror], scale * a[mirror]};
        out->wave[n++] = (hci_wave){order, 1, -scale * b[k], scale * a[k]};
    }
    out->count = hci_waves_join(out->wave, n, HCI_FFT_FLOOR);
    return HCI_OK;
}

hci_status hci_sampled_torque_linearise(const hci_torque_path *path, hci_linear_torque *linear,
                                        hci_note *note)
{
    samples s = {0};
    hci_status status = sample(path, &s, note);
    memset(linear, 0, sizeof *linear);
    if (!status) status = harmonics(&s, OFFSET, &linear->offset, note);
    if (!status) status = gradient_waves(&s, &linear->gradient, note);
    hci_memory_free(s.alpha);
    if (status) hci_linear_torque_release(linear);
    return status;
}
