#include "host/diagnose/fit/current_sums.h"

#include <math.h>

#include "host/diagnose/candidates/candidates.h"

#define ZEROS_DRIFT 0.05 /* of a sensor's zero, from one run to another */

double hci_current_sum_of(const hci_binned_sample *sample, const hci_sample *truth, double scale)
{
    double left_A = sample->sum_A;
    for (int phase = 0; phase < 3; ++phase)
        left_A += scale * truth->i_abc[phase] - sample->reading.i_abc[phase];
    return left_A;
}

double hci_current_sum_scale(const hci_effects *effects)
{
    double scale = 1.0;
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count && hci_candidate_is_gain(effects->effect[k].type);
             ++j)
            scale += effects->effect[k].term[j].value / 3.0;
    return scale;
}

double hci_current_sums_rms(const hci_regression *e, const hci_effects *effects)
{
    const double scale = hci_current_sum_scale(effects);
    double square = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        const double deviation_A = e->sum_deviation_A[s->run];
        if (!(deviation_A > 0.0)) continue;
        for (size_t k = s->first; k < s->first + s->count; ++k) {
            const hci_binned_sample *sample = &e->samples->sample[k];
            const hci_sample truth =
                hci_effects_undo_currents(effects, e->machine->pole_pairs, &sample->reading);
            const double left = hci_current_sum_of(sample, &truth, scale) / deviation_A;
            square += sample->count * left * left;
            count += sample->count;
        }
    }
    return count > 0.0 ? sqrt(square / count) : 0.0;
}

hci_current_zeros hci_current_zeros_left(const hci_regression *e, const hci_effects *effects,
                                         const hci_segment *s)
{
    const hci_run_statistics *x = &e->samples->statistics[s->run];
    const hci_sample *reading = &e->samples->sample[s->first].reading;
    const double length_A = hypot(hypot(x->standing_A[0], x->standing_A[1]), x->standing_A[2]);
    hci_current_zeros left = {.deviation_A = ZEROS_DRIFT * length_A};
    if (!x->zeros_read || !(length_A > 0.0) || hci_segment_next(e->samples, s->run, NULL) != s) return left;
    left.truth = hci_effects_undo_currents(effects, e->machine->pole_pairs, reading);
    for (size_t phase = 0; phase < 3; ++phase)
        if (reading->computed_phase != (int)phase + 1) left.phase[left.count++] = phase;
    return left;
}

double hci_current_zeros_rms(const hci_regression *e, const hci_effects *effects)
{
    double square = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        const hci_current_zeros left = hci_current_zeros_left(e, effects, s);
        for (size_t k = 0; k < left.count; ++k, count += 1.0)
            square += pow(left.truth.i_abc[left.phase[k]] / left.deviation_A, 2.0);
    }
    return count > 0.0 ? sqrt(square / count) : 0.0;
}
