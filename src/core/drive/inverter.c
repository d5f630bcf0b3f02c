#include <math.h>

#include "hci/drive/plant.h"

void hci_inverter_switched(double dc_link_V, unsigned legs, double v[2])
{
    /* The plane drops the common part of the leg voltages, which is what a floating star point does. */
    const double abc[3] = {legs & 1u ? dc_link_V : 0.0, legs & 2u ? dc_link_V : 0.0,
                           legs & 4u ? dc_link_V : 0.0};
    hci_plane_from_abc(abc, v);
}

double hci_inverter_average(double dc_link_V, double v[2])
{
    double abc[3];
    hci_plane_to_abc(v, abc);
    const double line_V = fmax(abc[0], fmax(abc[1], abc[2])) - fmin(abc[0], fmin(abc[1], abc[2]));
    if (!(line_V > dc_link_V)) return 1.0;
    const double factor = dc_link_V / line_V;
    v[0] *= factor;
    v[1] *= factor;
    return factor;
}

double hci_inverter_sinusoidal(double dc_link_V, double v[2])
{
    double abc[3];
    hci_plane_to_abc(v, abc);
    const double most_V = fmax(fabs(abc[0]), fmax(fabs(abc[1]), fabs(abc[2])));
    if (!(most_V > 0.5 * dc_link_V)) return 1.0;
    const double factor = 0.5 * dc_link_V / most_V;
    v[0] *= factor;
    v[1] *= factor;
    return factor;
}

double hci_inverter_circle(double dc_link_V, double v[2])
{
    /* An amplitude A of the phases is a vector of √(3/2)·A in the plane. */
    const double size_V = hypot(v[0], v[1]), most_V = dc_link_V / sqrt(2.0);
    if (!(size_V > most_V)) return 1.0;
    const double factor = most_V / size_V;
    v[0] *= factor;
    v[1] *= factor;
    return factor;
}

double hci_inverter_limit(hci_modulation modulation, double dc_link_V, double v[2])
{
    if (modulation == HCI_MODULATION_SINUSOIDAL) return hci_inverter_sinusoidal(dc_link_V, v);
    if (modulation == HCI_MODULATION_CIRCLE) return hci_inverter_circle(dc_link_V, v);
    return hci_inverter_average(dc_link_V, v);
}

/* sat(i/crossing), with the sign of i where nothing is between. */
static double saturated(double i_A, double crossing_A)
{
    if (fabs(i_A) < crossing_A) return i_A / crossing_A;
    return (double)(i_A > 0.0) - (double)(i_A < 0.0);
}

void hci_inverter_dead_time(const hci_dead_time *dead_time, const double i[2], double factor, double v[2])
{
    double abc[3], plane[2];
    if (dead_time->voltage_V == 0.0) return;
    hci_plane_to_abc(i, abc);
    for (int s = 0; s < 3; ++s)
        abc[s] = factor * dead_time->voltage_V * saturated(abc[s], dead_time->crossing_A);
    hci_plane_from_abc(abc, plane);
    v[0] += plane[0];
    v[1] += plane[1];
}
