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
