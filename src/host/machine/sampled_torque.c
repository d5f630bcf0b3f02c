#include "host/machine/sampled_torque.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/machine/quadratic_model.h"
#include "host/numeric/fft.h"

#define LEAST_PER_TURN 1024.0

/* Complex rows, α + jβ of the current, then of ∂T/∂i, and torque + j·offset. */
typedef struct {
    double *x, *y; /* current */
    double *a, *b; /* ∂T/∂i */
    double *torque, *offset;
    size_t count, turns;
} grid;

static hci_status grid_new(grid *g, const hci_effects_plant *beyond, size_t turns, const hci_wave *wave,
                           size_t count, hci_note *note)
{
    double top = 0.0;
    for (size_t k = 0; k < count; ++k)
        top = fmax(top, wave[k].order);
    /* a polynomial of the current has many times its orders, but they fall off as fast as the current's own
     */
    top = fmax(8.0 * top, 4.0 * hci_effects_top_order(beyond->effects));
    g->turns = turns;
    g->count = hci_fft_size(fmax(LEAST_PER_TURN, top) * (double)turns);
    g->x = hci_memory_new(6 * g->count, sizeof *g->x);
    if (!g->x)
        return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for %zu samples of the torque", g->count);
    g->y = g->x + g->count;
    g->a = g->y + g->count;
    g->b = g->a + g->count;
    g->torque = g->b + g->count;
    g->offset = g->torque + g->count;
    return HCI_OK;
}

/* α + jβ of a wave is (C − jS) e^(jnθ) for positive and (C + jS) e^(−jnθ) for negative sequence. */
static void fill_current(const grid *g, const hci_wave *wave, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const size_t n = (size_t)floor(wave[k].order * (double)g->turns + 0.5);
        const size_t at = wave[k].sequence > 0 || n == 0 ? n : g->count - n;
        if (wave[k].sequence == 0) continue;
        g->x[at] += wave[k].cosine;
        g->y[at] -= wave[k].sequence * wave[k].sine;
    }
    hci_fft(g->x, g->y, g->count, 1);
}

static void evaluate(const grid *g, const hci_effects_plant *beyond)
{
    const double turn_m_rad = 2.0 * HCI_PI * (double)g->turns / beyond->machine->pole_pairs;
    for (size_t k = 0; k < g->count; ++k) {
        const hci_alpha_beta i = {g->x[k], g->y[k], 0.0};
        hci_sample s = {0};
        s.theta_m_rad = turn_m_rad * (double)k / (double)g->count;
        s.temperature_C = beyond->temperature_C;
        hci_clarke_inverse(i, s.i_abc);
        const hci_effect_torque t = hci_effects_torque(beyond->machine, beyond->effects, &s, NULL);
        const hci_alpha_beta gain = hci_clarke(t.by_current);
        g->a[k] = gain.alpha;
        g->b[k] = gain.beta;
        g->torque[k] = t.torque_Nm;
        g->offset[k] = 1.5 * (gain.alpha * i.alpha + gain.beta * i.beta) - t.torque_Nm;
    }
    hci_fft(g->torque, g->offset, g->count, -1);
}

static hci_status sample(const hci_effects_plant *beyond, size_t turns, const hci_wave *wave, size_t count,
                         grid *g, hci_note *note)
{
    const hci_status status = grid_new(g, beyond, turns, wave, count, note);
    if (status) return status;
    fill_current(g, wave, count);
    evaluate(g, beyond);
    return HCI_OK;
}

/* The first or the second of the two real signals, without what is rounding. */
static hci_status harmonics(const grid *g, bool second, hci_harmonic **out, size_t *count, hci_note *note)
{
    double largest = 0.0;
    *count = 0;
    *out = hci_memory_new(g->count / 2, sizeof **out);
    if (!*out) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the torque's orders");
    for (size_t k = 0; k < g->count / 2; ++k) {
        hci_harmonic unused;
        hci_fft_bin(g->torque, g->offset, g->count, k, g->turns, second ? &unused : &(*out)[k],
                    second ? &(*out)[k] : &unused);
        largest = fmax(largest, hypot((*out)[k].sine, (*out)[k].cosine));
    }
    for (size_t k = 0; k < g->count / 2; ++k)
        if (hypot((*out)[k].sine, (*out)[k].cosine) > HCI_FFT_FLOOR * largest) (*out)[(*count)++] = (*out)[k];
    return HCI_OK;
}

hci_status hci_sampled_torque(const hci_effects_plant *beyond, size_t turns, const hci_wave *wave,
                              size_t count, hci_harmonic **torque, size_t *torque_count, hci_note *note)
{
    grid g = {0};
    hci_status status = sample(beyond, turns, wave, count, &g, note);
    *torque = NULL;
    *torque_count = 0;
    if (!status) status = harmonics(&g, false, torque, torque_count, note);
    hci_memory_free(g.x);
    return status;
}

/* Both sequences of each order, as in fill_current. */
static hci_status waves(const grid *g, hci_sampled_linear *linear, hci_note *note)
{
    const double scale = 1.0 / (double)g->count;
    size_t n = 0;
    linear->gain = hci_memory_new(g->count, sizeof *linear->gain);
    if (!linear->gain) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the torque's slopes");
    hci_fft(g->a, g->b, g->count, -1);
    for (size_t k = 0; k < g->count / 2; ++k) {
        const double order = (double)k / (double)g->turns;
        const size_t mirror = g->count - k;
        linear->gain[n++] = (hci_wave){order, 1, -scale * g->b[k], scale * g->a[k]};
        if (k > 0) linear->gain[n++] = (hci_wave){order, -1, scale * g->b[mirror], scale * g->a[mirror]};
    }
    linear->gain_count = hci_waves_join(linear->gain, n, HCI_FFT_FLOOR);
    return HCI_OK;
}

hci_status hci_sampled_torque_linearise(const hci_effects_plant *beyond, size_t turns, const hci_wave *wave,
                                        size_t count, hci_sampled_linear *linear, hci_note *note)
{
    grid g = {0};
    hci_status status = sample(beyond, turns, wave, count, &g, note);
    memset(linear, 0, sizeof *linear);
    if (!status) status = harmonics(&g, true, &linear->offset, &linear->offset_count, note);
    if (!status) status = waves(&g, linear, note);
    hci_memory_free(g.x);
    if (status) hci_sampled_linear_release(linear);
    return status;
}

void hci_sampled_linear_release(hci_sampled_linear *linear)
{
    hci_memory_free(linear->gain);
    hci_memory_free(linear->offset);
    memset(linear, 0, sizeof *linear);
}
