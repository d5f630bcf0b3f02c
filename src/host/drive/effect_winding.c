#include "host/drive/effect_winding.h"

#include <math.h>

#include "hci/machine/frames.h"

void hci_effects_add_flux_slope(const hci_machine *machine, const hci_effects *effects, double temperature_C,
                                double theta_rad, const hci_plane_current *i, double slope_Vs[2],
                                double inductance_H[3])
{
    hci_sample truth = {.theta_m_rad = theta_rad / machine->pole_pairs, .temperature_C = temperature_C};
    double force[2];
    inductance_H[0] = inductance_H[1] = inductance_H[2] = 0.0;
    if (!effects || effects->count == 0) return;
    hci_plane_to_abc(i->x, truth.i_abc);
    const hci_effect_torque t = hci_effects_torque(machine, effects, &truth, NULL);
    const double *l = t.inductance_H, p = machine->pole_pairs;
    hci_plane_from_abc(t.by_current, force);
    slope_Vs[0] += force[0] + p * (l[0] * i->slope[0] + l[1] * i->slope[1]);
    slope_Vs[1] += force[1] + p * (l[1] * i->slope[0] + l[2] * i->slope[1]);
    for (int k = 0; k < 3; ++k)
        inductance_H[k] = l[k];
}

void hci_effects_mean_inductance(const hci_machine *machine, const hci_effects *effects, double *d_H,
                                 double *q_H)
{
    enum { ANGLES = 360 };
    *d_H = *q_H = 0.0;
    for (int k = 0; k < ANGLES && effects; ++k) {
        const hci_sample at = {.theta_m_rad = 2.0 * HCI_PI * k / (ANGLES * machine->pole_pairs)};
        const hci_effect_torque x = hci_effects_torque(machine, effects, &at, NULL);
        const double c = cos(2.0 * HCI_PI * k / ANGLES), s = sin(2.0 * HCI_PI * k / ANGLES);
        const double *l = x.inductance_H;
        *d_H += (c * c * l[0] + 2.0 * c * s * l[1] + s * s * l[2]) / ANGLES;
        *q_H += (s * s * l[0] - 2.0 * c * s * l[1] + c * c * l[2]) / ANGLES;
    }
}

static const double SAME = 1e-9; /* of L_q */

double hci_effects_take_saliency(const hci_machine *machine, const hci_effects *effects, double *d_H,
                                 double *q_H)
{
    double more_d_H, more_q_H;
    if (fabs(*d_H - *q_H) <= SAME * *q_H) return 0.0;
    hci_effects_mean_inductance(machine, effects, &more_d_H, &more_q_H);
    if (fabs(more_d_H - more_q_H) <= SAME * *q_H) return 0.0;
    *d_H = *q_H = 0.5 * (*d_H + *q_H - more_d_H - more_q_H);
    return more_d_H - more_q_H;
}
