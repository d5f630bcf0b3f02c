/* The torque of a machine with its effects, for phase currents at an angle. */
#ifndef HCI_SRC_HOST_MACHINE_MACHINE_PLANT_H
#define HCI_SRC_HOST_MACHINE_MACHINE_PLANT_H

#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "host/machine/quadratic_model.h"

/* Start with {0}. `model` points into the rest, so that it is not to be moved. */
typedef struct {
    hci_effects_data effects;
    hci_quadratic_model model;       /* torque up to the second degree of the currents, and above it */
    double torque_constant_Nm_per_A; /* of the machine as it is declared */
} hci_machine_plant;

/* folder: its effects.csv is read; machine: as read from there. It is to be released even after a failure.
 * HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_machine_plant_make(const char *folder, const hci_machine_data *machine,
                                  hci_machine_plant *plant, hci_note *note);
void hci_machine_plant_release(hci_machine_plant *plant);

static inline int hci_machine_plant_pole_pairs(const hci_machine_plant *plant)
{
    return plant->model.machine.pole_pairs;
}

/* Phase currents of i_d and i_q. */
void hci_machine_plant_phases(double theta_rad, const double dq[2], double abc[3]);

/* The torque of the machine in N·m at an electrical angle; slope (may be NULL): its derivatives by the phase
 * currents. */
double hci_machine_plant_torque_at(const hci_machine_plant *plant, double theta_rad, const double abc[3],
                                   double slope[3]);

#endif
