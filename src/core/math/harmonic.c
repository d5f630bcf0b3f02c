#include "hci/math/harmonic.h"

#include <math.h>
#include <stdbool.h>

#include "core/math/phases.h"
#include "core/math/sort.h"
#include "core/math/turning.h"

double hci_amplitude(double sine, double cosine)
{
    return hypot(sine, cosine);
}

double hci_phase_rad(double sine, double cosine)
{
    const double phase = atan2(cosine, sine);
    return phase > -HCI_PI ? phase : HCI_PI;
}

hci_harmonic hci_harmonic_polar(double order, double amplitude, double phase_rad)
{
    const hci_harmonic mean = {0.0, 0.0, amplitude};
    const hci_harmonic h = {order, amplitude * cos(phase_rad), amplitude * sin(phase_rad)};
    return order < HCI_ORDER_TOLERANCE ? mean : h;
}

hci_wave hci_wave_polar(double order, int sequence, double amplitude, double phase_rad)
{
    const hci_wave w = {order, sequence, amplitude * cos(phase_rad), amplitude * sin(phase_rad)};
    return w;
}

int hci_sequence_of_order(double order)
{
    const int remainder = (int)fmod(floor(order + 0.5), 3.0);
    return remainder == 2 ? -1 : remainder;
}

double hci_harmonics_at(const hci_harmonic *terms, size_t count, double theta_rad)
{
    hci_turning at = HCI_TURNING;
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        hci_turning_to(&at, terms[k].order, theta_rad);
        sum += terms[k].sine * at.s + terms[k].cosine * at.c;
    }
    return sum;
}

/* x = S sin nθ + C cos nθ, and a quarter of a period ahead y = S cos nθ − C sin nθ, of each sequence. */
void hci_waves_at(const hci_wave *waves, size_t count, double theta_rad, double abc[3])
{
    hci_turning at = HCI_TURNING;
    double x[3] = {0.0, 0.0, 0.0}, y[3] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < count; ++k) {
        const hci_wave *w = &waves[k];
        hci_turning_to(&at, w->order, theta_rad);
        x[w->sequence + 1] += w->sine * at.s + w->cosine * at.c;
        y[w->sequence + 1] += w->sine * at.c - w->cosine * at.s;
    }
    abc[0] = abc[1] = abc[2] = 0.0;
    for (int sequence = -1; sequence <= 1; ++sequence)
        hci_phases_add(x[sequence + 1], y[sequence + 1], sequence, abc);
}

static bool comes_after(const hci_wave *a, const hci_wave *b)
{
    if (fabs(a->order - b->order) >= HCI_ORDER_TOLERANCE) return a->order > b->order;
    return a->sequence > b->sequence;
}

static bool wave_comes_after(const void *items, size_t a, size_t b)
{
    const hci_wave *waves = items;
    return comes_after(&waves[a], &waves[b]);
}

static void swap_waves(void *items, size_t a, size_t b)
{
    hci_wave *waves = items;
    const hci_wave kept = waves[a];
    waves[a] = waves[b];
    waves[b] = kept;
}

static double largest_amplitude(const hci_wave *waves, size_t count)
{
    double largest = 0.0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, hypot(waves[k].sine, waves[k].cosine));
    return largest;
}

size_t hci_waves_join(hci_wave *waves, size_t count, double relative_floor)
{
    static const hci_sorting BY_ORDER = {wave_comes_after, swap_waves};
    size_t joined = 0, kept = 0;
    hci_sort(waves, count, &BY_ORDER);
    for (size_t k = 0; k < count; ++k) {
        if (joined > 0 && !comes_after(&waves[k], &waves[joined - 1])) {
            waves[joined - 1].sine += waves[k].sine;
            waves[joined - 1].cosine += waves[k].cosine;
        } else {
            waves[joined++] = waves[k];
        }
    }
    const double floor_value = relative_floor * largest_amplitude(waves, joined);
    for (size_t k = 0; k < joined; ++k)
        if (hypot(waves[k].sine, waves[k].cosine) > floor_value) waves[kept++] = waves[k];
    return kept;
}

/* At order 0, (−1, S, C) is the same constant current as (+1, −S, C). */
static hci_wave canonical(hci_wave wave)
{
    if (wave.order < HCI_ORDER_TOLERANCE && wave.sequence == -1) {
        wave.sequence = 1;
        wave.sine = -wave.sine;
    }
    return wave;
}

static bool same_component(hci_wave a, hci_wave b)
{
    return a.sequence == b.sequence && fabs(a.order - b.order) < HCI_ORDER_TOLERANCE;
}

/* Σ_s x_s² averages to (3/2)A², except a constant zero-sequence current, which is C in every phase: 3 C². */
static double mean_square_of(hci_wave sum)
{
    if (sum.sequence == 0 && sum.order < HCI_ORDER_TOLERANCE) return 3.0 * sum.cosine * sum.cosine;
    return 1.5 * (sum.sine * sum.sine + sum.cosine * sum.cosine);
}

double hci_waves_mean_square(const hci_wave *waves, size_t count)
{
    double total = 0.0;
    for (size_t k = 0; k < count; ++k) {
        hci_wave sum = canonical(waves[k]);
        bool counted = false;
        for (size_t j = 0; j < count && !counted; ++j) {
            const hci_wave other = canonical(waves[j]);
            if (j == k || !same_component(sum, other)) continue;
            counted = j < k;
            sum.sine += other.sine;
            sum.cosine += other.cosine;
        }
        if (!counted) total += mean_square_of(sum);
    }
    return total;
}
