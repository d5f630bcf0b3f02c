#include "host/numeric/angle_bins.h"

#include <math.h>

size_t hci_repeat_at(const hci_repeat *r, double turns)
{
    return (size_t)((turns - floor(turns)) * (double)r->ranges) % r->ranges;
}

void hci_repeat_add(hci_repeat *r, double turns, double value)
{
    const size_t at = hci_repeat_at(r, turns);
    r->sum[at] += value;
    r->square[at] += value * value;
    r->count[at] += 1.0;
}

double hci_repeat_mean(const hci_repeat *r, size_t range)
{
    return r->sum[range] / fmax(1.0, r->count[range]);
}

double hci_repeat_rms(const hci_repeat *r, double least_freedom)
{
    double total = 0.0, freedom = 0.0;
    for (size_t c = 0; c < r->ranges; ++c) {
        if (r->count[c] < 2.0) continue;
        total += r->square[c] - r->sum[c] * r->sum[c] / r->count[c];
        freedom += r->count[c] - 1.0;
    }
    return freedom > least_freedom ? sqrt(fmax(total, 0.0) / freedom) : (double)NAN;
}
