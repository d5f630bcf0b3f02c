#include "host/waveform/emf_phases.h"

#include <math.h>

#include "hci/math/harmonic.h"

hci_average_harmonic hci_emf_turned(hci_average_harmonic w, double angle_rad)
{
    const double c = cos(angle_rad), s = sin(angle_rad);
    return (hci_average_harmonic){w.sine * c - w.cosine * s, w.sine * s + w.cosine * c};
}

double hci_emf_length(hci_average_harmonic w)
{
    return hypot(w.sine, w.cosine);
}

/* Turns order k of phase s onto that of phase a, of which it is the third-of-a-period copy. */
hci_average_harmonic hci_emf_onto_a(hci_average_harmonic w, size_t order, int sequence, size_t phase)
{
    return hci_emf_turned(w, (double)order * sequence * (double)phase * 2.0 * HCI_PI / 3.0);
}

/* Mean over the channels that count, or over these but one. */
hci_average_harmonic hci_emf_balanced(const hci_average *average, const hci_emf_phases *phases, size_t pass,
                                      size_t order, size_t except)
{
    hci_average_harmonic sum = {0.0, 0.0};
    double count = 0.0;
    for (size_t s = 0; s < 3; ++s) {
        if (!phases->counts[s] || s == except) continue;
        const hci_average_harmonic z =
            hci_emf_onto_a(*hci_average_at(average, pass, s, order), order, phases->sequence, s);
        sum.sine += z.sine;
        sum.cosine += z.cosine;
        count += 1.0;
    }
    return (hci_average_harmonic){sum.sine / count, sum.cosine / count};
}

/* rms over the passes of a channel's fundamental. */
double hci_emf_size(const hci_average *average, size_t channel)
{
    double square = 0.0;
    for (size_t pass = 0; pass < average->count; ++pass) {
        const double length = hci_emf_length(*hci_average_at(average, pass, channel, 1));
        square += length * length / (double)average->count;
    }
    return sqrt(square);
}
