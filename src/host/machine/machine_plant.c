#include "host/machine/machine_plant.h"

#include <math.h>

#include "hci/machine/torque.h"

hci_status hci_machine_plant_make(const char *folder, const hci_machine_data *machine,
                                  hci_machine_plant *plant, hci_note *note)
{
    const hci_status status = hci_effects_read_machine(folder, &plant->effects, note);
    plant->torque_constant_Nm_per_A = hci_machine_torque_constant(machine);
    if (status) return status;
    return hci_quadratic_model_make(&machine->model, &plant->effects.list, (double)NAN, &plant->model, note);
}

void hci_machine_plant_release(hci_machine_plant *plant)
{
    hci_quadratic_model_release(&plant->model);
    hci_effects_release(&plant->effects);
}

void hci_machine_plant_phases(double theta_rad, const double dq[2], double abc[3])
{
    for (int s = 0; s < 3; ++s) {
        const double x = theta_rad - 2.0 * HCI_PI * s / 3.0;
        abc[s] = dq[1] * sin(x) - dq[0] * cos(x);
    }
}

static hci_effect_torque higher_at(const hci_machine_plant *plant, double theta_rad, const double abc[3])
{
    const hci_effects_plant *higher = &plant->model.higher;
    const hci_sample truth = {.theta_m_rad = theta_rad / hci_machine_plant_pole_pairs(plant),
                              .i_abc = {abc[0], abc[1], abc[2]},
                              .temperature_C = higher->temperature_C};
    return hci_effects_torque(higher->machine, higher->effects, &truth, NULL);
}

double hci_machine_plant_torque_at(const hci_machine_plant *plant, double theta_rad, const double abc[3],
                                   double slope[3])
{
    double torque_Nm = hci_torque_at(&plant->model.machine, theta_rad, abc);
    if (slope) hci_torque_gradient_at(&plant->model.machine, theta_rad, abc, slope);
    if (!plant->model.higher.effects) return torque_Nm;
    const hci_effect_torque more = higher_at(plant, theta_rad, abc);
    for (int s = 0; slope && s < 3; ++s)
        slope[s] += more.by_current[s];
    return torque_Nm + more.torque_Nm;
}
