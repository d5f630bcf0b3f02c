#include "host/diagnose/fit/load_range.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/diagnose/fit/run_parts.h"

enum { DIRECTIONS = 32 }; /* of the plane of currents: a corner is missed by 1 - cos(π/32), half a percent */

#define LOAD    0.1 /* of the largest current, that a load has */
#define ALIKE   (5.0 * HCI_PI / 180.0)
#define OUTSIDE 0.1 /* of the largest current */
#define EVEN    0.9 /* of the current, that its mean is where there is one load all along */

static double current_A(const hci_run_statistics *x)
{
    return hypot(x->mean_id_A, x->mean_iq_A);
}

/* Whether the mean of a run stands for its currents. */
static bool has_place(const hci_run_statistics *x)
{
    return !x->is_direct && current_A(x) >= EVEN * x->current_A;
}

/* How far a run lies along a direction. */
static double along_A(const hci_run_statistics *x, double direction_rad)
{
    return x->mean_id_A * cos(direction_rad) + x->mean_iq_A * sin(direction_rad);
}

/* By how much one run lies further along a direction than all others in use, and no current, at which every
 * power of the currents is known. */
static double further_A(const hci_regression *e, size_t run, double direction_rad)
{
    const hci_run_statistics *x = e->samples->statistics;
    double furthest_A = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && r != run) furthest_A = fmax(furthest_A, along_A(&x[r], direction_rad));
    return along_A(&x[run], direction_rad) - furthest_A;
}

bool hci_run_is_beyond(const hci_regression *e, size_t run)
{
    const hci_run_statistics *x = e->samples->statistics;
    double most_A = 0.0, further = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (!e->use[r]) continue;
        if (!has_place(&x[r])) return false;
        most_A = fmax(most_A, current_A(&x[r]));
    }
    for (int k = 0; k < DIRECTIONS; ++k)
        further = fmax(further, further_A(e, run, 2.0 * HCI_PI * k / DIRECTIONS));
    return further > OUTSIDE * most_A;
}

double hci_load_lead_rad(const hci_regression *e)
{
    const hci_run_statistics *x = e->samples->statistics;
    double most_A = 0.0, lead_rad = NAN;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r]) most_A = fmax(most_A, x[r].current_A);
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (!e->use[r] || !(x[r].current_A > LOAD * most_A)) continue;
        const double own_rad = atan2(-x[r].mean_id_A, x[r].mean_iq_A);
        if (!has_place(&x[r]) || fabs(remainder(own_rad - lead_rad, 2.0 * HCI_PI)) > ALIKE)
            return (double)NAN;
        if (isnan(lead_rad)) lead_rad = own_rad;
    }
    return lead_rad;
}

size_t hci_asked_count(bool *beyond, size_t count)
{
    size_t asked = 0;
    for (size_t k = 0; k < count; ++k)
        asked += !beyond[k];
    if (asked >= HCI_LEAST_GROUPS) return asked;
    memset(beyond, 0, count * sizeof *beyond);
    return count;
}
