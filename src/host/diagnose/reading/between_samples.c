#include "host/diagnose/reading/between_samples.h"

#include <math.h>

#include "host/recording/rotor_frame.h"

#define PART_RAD   2.0  /* that the finest order may turn by in a part of a step */
#define COARSE_RAD 1.25 /* from sample to sample, beyond which such a cubic will not do */
#define LINE_RAD   0.5  /* up to which a line will do, where they follow each other unevenly */
#define FINE_RAD   1.0  /* from sample to sample, up to which a cubic through them will do */

enum { MOST_PARTS = 200, MOST_PARTS_OF_STEP = 4 };

double hci_finest_order(const hci_machine *machine, const hci_effects *effects)
{
    double finest = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        finest = fmax(finest, machine->cogging[k].order);
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j)
            finest = fmax(finest, effects->effect[k].term[j].order);
    return finest * machine->pole_pairs;
}

static double turned(const hci_sample *from, const hci_sample *to, double finest_order)
{
    return finest_order * fabs(to->theta_m_rad - from->theta_m_rad);
}

bool hci_is_coarse(const hci_binned_sample *sample, size_t count, double finest_order)
{
    for (size_t k = 1; k < count; ++k)
        if (turned(&sample[k - 1].reading, &sample[k].reading, finest_order) > FINE_RAD) return true;
    return false;
}

size_t hci_parts_of_step(double step_rad, double finest_order, bool even)
{
    const double turned_rad = finest_order * fabs(step_rad);
    if (!(turned_rad > COARSE_RAD)) return 1;
    return (size_t)fmin(ceil(turned_rad / (even ? FINE_RAD : LINE_RAD)), MOST_PARTS_OF_STEP);
}

hci_between hci_between_of(const hci_sample *from, const hci_sample *to, int pole_pairs, double finest_order)
{
    const double parts = ceil(turned(from, to, finest_order) / PART_RAD);
    const size_t count = 2 * (size_t)fmin(fmax(parts, 1.0), MOST_PARTS);
    return (hci_between){from,       to,   hci_sample_dq(from, pole_pairs), hci_sample_dq(to, pole_pairs),
                         pole_pairs, count};
}

static double along(double from, double to, double share)
{
    return from + share * (to - from);
}

static hci_sample between_at(const hci_between *x, double share)
{
    const hci_sample *from = x->from, *to = x->to;
    const hci_dq a = x->i_from, b = x->i_to;
    const hci_dq i = {along(a.d, b.d, share), along(a.q, b.q, share), along(a.zero, b.zero, share)};
    hci_sample at = *from;
    at.theta_m_rad = along(from->theta_m_rad, to->theta_m_rad, share);
    at.speed_rad_per_s = along(from->speed_rad_per_s, to->speed_rad_per_s, share);
    at.acceleration_rad_per_s2 = along(from->acceleration_rad_per_s2, to->acceleration_rad_per_s2, share);
    at.temperature_C = along(from->temperature_C, to->temperature_C, share);
    at.elapsed_s = along(from->elapsed_s, to->elapsed_s, share);
    hci_phases_of_dq(i, x->pole_pairs * at.theta_m_rad, at.i_abc);
    return at;
}

hci_sample hci_sample_between(const hci_sample *from, const hci_sample *to, int pole_pairs, double share)
{
    const hci_between x = {from,       to, hci_sample_dq(from, pole_pairs), hci_sample_dq(to, pole_pairs),
                           pole_pairs, 0};
    return between_at(&x, share);
}

hci_sample hci_between_at(const hci_between *x, size_t k)
{
    const double of_part = k % 2 == 0 ? 0.5 - 0.5 / sqrt(3.0) : 0.5 + 0.5 / sqrt(3.0);
    return between_at(x, 2.0 * ((double)(k / 2) + of_part) / (double)x->count);
}
