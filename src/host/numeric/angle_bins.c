#include "host/numeric/angle_bins.h"

#include <math.h>

size_t hci_angle_bins_at(const hci_angle_bins *b, double turns)
{
    return (size_t)((turns - floor(turns)) * (double)b->bins) % b->bins;
}

void hci_angle_bins_add(hci_angle_bins *b, double turns, double value)
{
    const size_t at = hci_angle_bins_at(b, turns);
    b->sum[at] += value;
    b->square[at] += value * value;
    b->count[at] += 1.0;
}

double hci_angle_bins_mean(const hci_angle_bins *b, size_t bin)
{
    return b->sum[bin] / fmax(1.0, b->count[bin]);
}

double hci_angle_bins_rms(const hci_angle_bins *b, double least_freedom)
{
    double total = 0.0, freedom = 0.0;
    for (size_t c = 0; c < b->bins; ++c) {
        if (b->count[c] < 2.0) continue;
        total += b->square[c] - b->sum[c] * b->sum[c] / b->count[c];
        freedom += b->count[c] - 1.0;
    }
    return freedom > least_freedom ? sqrt(fmax(total, 0.0) / freedom) : (double)NAN;
}
