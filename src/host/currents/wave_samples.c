#include "host/currents/wave_samples.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/fft.h"

/* Eight neighbours at a distance h are off by (h·order)⁸/8!·(1/2·3/2·5/2·7/2)² of an order's amplitude at
 * most: by 1e-11 of the highest one. */
enum { PER_PERIOD = 64, NEIGHBOURS = 8, BEFORE = 3, LEAST_WAVES = 48, MOST_SAMPLES = 1 << 20 };

static double highest_order(const hci_wave *waves, size_t count)
{
    double highest = 1.0;
    for (size_t k = 0; k < count; ++k)
        highest = fmax(highest, waves[k].order);
    return highest;
}

/* A wave in one phase: S sin φ + C cos φ is the real part of (C − iS) e^(iφ), a phase later by σ2πs/3. */
static void wave_add(const hci_wave *w, size_t bin, int phase, double *re, double *im)
{
    const double lag_rad = w->sequence * phase * 2.0 * HCI_PI / 3.0, s = sin(lag_rad), c = cos(lag_rad);
    re[bin] += w->cosine * c - w->sine * s;
    im[bin] -= w->sine * c + w->cosine * s;
}

/* One phase. room: [2 count]. */
static void phase_fill(const hci_wave *waves, size_t waves_count, size_t turns, int phase, size_t count,
                       double *room, double *value)
{
    memset(room, 0, 2 * count * sizeof *room);
    for (size_t k = 0; k < waves_count; ++k)
        wave_add(&waves[k], (size_t)(waves[k].order * (double)turns + 0.5), phase, room, room + count);
    hci_fft(room, room + count, count, 1);
    memcpy(value, room, count * sizeof *value);
}

bool hci_wave_samples_make(const hci_wave *waves, size_t count, size_t turns, hci_wave_samples *samples)
{
    const double least = PER_PERIOD * highest_order(waves, count) * (double)turns;
    *samples = (hci_wave_samples){NULL, 0};
    if (count < LEAST_WAVES || least > MOST_SAMPLES) return true;
    const size_t n = hci_fft_size(least);
    double *value = hci_memory_new(3 * n, sizeof *value), *room = hci_memory_new(2 * n, sizeof *room);
    for (int phase = 0; value && room && phase < 3; ++phase)
        phase_fill(waves, count, turns, phase, n, room, value + (size_t)phase * n);
    if (value && room)
        *samples = (hci_wave_samples){value, n};
    else
        hci_memory_free(value);
    hci_memory_free(room);
    return samples->count > 0;
}

/* Lagrange's: weight j is Π (x − m)/(j − m) over the other places m, the first of which is −BEFORE. */
static void weights_fill(double x, double weight[NEIGHBOURS])
{
    static const double UNDER[NEIGHBOURS] = {-5040.0, 720.0, -240.0, 144.0, -144.0, 240.0, -720.0, 5040.0};
    double ahead = 1.0, behind = 1.0;
    for (int j = 0; j < NEIGHBOURS; ++j) {
        weight[j] = ahead / UNDER[j];
        ahead *= x - (double)(j - BEFORE);
    }
    for (int j = NEIGHBOURS - 1; j >= 0; --j) {
        weight[j] *= behind;
        behind *= x - (double)(j - BEFORE);
    }
}

void hci_wave_samples_at(const hci_wave_samples *samples, double share, double abc[3])
{
    const size_t n = samples->count;
    const double place = share * (double)n, whole = floor(place);
    double weight[NEIGHBOURS];
    weights_fill(place - whole, weight);
    abc[0] = abc[1] = abc[2] = 0.0;
    for (size_t j = 0; j < NEIGHBOURS; ++j) {
        const size_t at = ((size_t)whole + n + j - BEFORE) % n;
        for (size_t s = 0; s < 3; ++s)
            abc[s] += weight[j] * samples->value[s * n + at];
    }
}

void hci_wave_samples_release(hci_wave_samples *samples)
{
    hci_memory_free(samples->value);
    *samples = (hci_wave_samples){NULL, 0};
}
