/* A machine as hci_data.c holds it. */
#ifndef HCI_SRC_FMU_MACHINE_DATA_H
#define HCI_SRC_FMU_MACHINE_DATA_H

#include "hci/effects/effect.h"

typedef struct {
    hci_machine machine; /* declared */
    hci_plant_inductance inductance;
    hci_effects effects;
    size_t points; /* of its table over the angle */
    bool imposed;  /* currents are imposed, not voltages */
} hci_fmu_machine_data;

extern const hci_fmu_machine_data hci_fmu_machine;

#endif
