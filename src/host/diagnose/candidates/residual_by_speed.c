#include "host/diagnose/candidates/residual_by_speed.h"

#include <math.h>
#include <string.h>

#define BINS_AN_OCTAVE 4.0

static bool tells_mean(const hci_candidates_source *s, size_t run)
{
    const hci_run *r = &s->runs[run];
    return s->use[run] && r->torque_source == HCI_TORQUE_MEASURED && !r->mean_is_unknown;
}

static double fastest(const hci_candidates_source *s)
{
    double most = 0.0;
    for (size_t k = 0; k < s->samples->segment_count; ++k) {
        const hci_segment *x = &s->samples->segment[k];
        for (size_t j = x->first; j < x->first + x->count && tells_mean(s, x->run); ++j)
            most = fmax(most, fabs(s->samples->sample[j].reading.speed_rad_per_s));
    }
    return most;
}

/* Sums of weight, weighted speed and residual. */
static void segment_add(const hci_candidates_source *s, const hci_segment *x, double most,
                        hci_effect_speed_mean sum[HCI_SPEED_MEANS])
{
    for (size_t j = x->first; j < x->first + x->count; ++j) {
        const double speed = s->samples->sample[j].reading.speed_rad_per_s, w = 1.0 / s->variance[j];
        if (speed == 0.0) continue;
        const double bin = floor(BINS_AN_OCTAVE * log2(most / fabs(speed)) + 0.5);
        if (bin >= HCI_SPEED_BINS) continue;
        hci_effect_speed_mean *m = &sum[(size_t)bin + (speed < 0.0 ? HCI_SPEED_BINS : 0)];
        m->weight += w;
        m->speed_rad_per_s += w * speed;
        m->residual_Nm += w * s->residual_Nm[j];
    }
}

size_t hci_residual_by_speed(const hci_candidates_source *s, hci_effect_speed_mean mean[HCI_SPEED_MEANS])
{
    const double most = fastest(s);
    size_t count = 0;
    memset(mean, 0, HCI_SPEED_MEANS * sizeof *mean);
    for (size_t k = 0; k < s->samples->segment_count && most > 0.0; ++k)
        if (tells_mean(s, s->samples->segment[k].run)) segment_add(s, &s->samples->segment[k], most, mean);
    for (size_t k = 0; k < HCI_SPEED_MEANS; ++k) {
        const hci_effect_speed_mean m = mean[k];
        if (m.weight > 0.0)
            mean[count++] =
                (hci_effect_speed_mean){m.speed_rad_per_s / m.weight, m.residual_Nm / m.weight, m.weight};
    }
    return count;
}
