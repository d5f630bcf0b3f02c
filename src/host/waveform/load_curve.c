#include "hci/host/waveform/load_curve.h"

#include <math.h>
#include <stdlib.h>

#include "hci/math/harmonic.h"

#define TO_RAD       (HCI_PI / 180.0)
#define AS_LONG      0.1
#define SAME_RAD     (3.0 * TO_RAD)
#define NEXT_RAD     (20.0 * TO_RAD)
#define FURTHEST_RAD (60.0 * TO_RAD)

static double length_A(const hci_load *x)
{
    return hypot(x->id_A, x->iq_A);
}

/* Of the line through 0. */
static double direction_rad(const hci_load *x)
{
    return atan2(x->iq_A < 0.0 ? x->id_A : -x->id_A, fabs(x->iq_A));
}

static int by_length(const void *a, const void *b)
{
    const double x = length_A(a), y = length_A(b);
    return (x > y) - (x < y);
}

static bool goes_over(const hci_load *x, const hci_load *next)
{
    const bool as_long = length_A(next) < (1.0 + AS_LONG) * length_A(x);
    return fabs(direction_rad(next) - direction_rad(x)) < (as_long ? SAME_RAD : NEXT_RAD) &&
           fabs(direction_rad(next)) <= FURTHEST_RAD;
}

bool hci_loads_are_on_curve(hci_load *load, size_t count)
{
    if (count < 2) return false;
    qsort(load, count, sizeof *load, by_length);
    bool is_curve = fabs(direction_rad(&load[0])) <= FURTHEST_RAD;
    for (size_t k = 1; k < count && is_curve; ++k)
        is_curve = goes_over(&load[k - 1], &load[k]);
    return is_curve;
}

double hci_load_curve_angle_rad(const hci_load *load, size_t count, double torque_Nm)
{
    size_t k = 1;
    while (k + 1 < count && fabs(load[k].torque_Nm) < fabs(torque_Nm))
        ++k;
    const double from = direction_rad(&load[k - 1]), until = direction_rad(&load[k]);
    const double more_Nm = fabs(load[k].torque_Nm) - fabs(load[k - 1].torque_Nm);
    const double share =
        (fabs(torque_Nm) - fabs(load[k - 1].torque_Nm)) / more_Nm; /* NAN of equal torques: 0 */
    return from + fmin(1.0, fmax(0.0, share)) * (until - from);
}
