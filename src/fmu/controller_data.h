/* A controller as hci_data.c holds it. */
#ifndef HCI_SRC_FMU_CONTROLLER_DATA_H
#define HCI_SRC_FMU_CONTROLLER_DATA_H

#include <stdbool.h>

#include "hci/drive/plant.h"
#include "hci/loop.h"

typedef struct {
    hci_machine known; /* the machine as the decoupling knows it */
    hci_plant_inductance inductance;
    size_t points;            /* of its table over the angle */
    const hci_loop_f32 *loop; /* as `emit --drive` writes it */
    double step_s;            /* in which delays are counted */
    unsigned every;           /* steps of a sample */
    unsigned delay_steps;     /* from a sample to the use of its voltage */
    bool decoupled;
    hci_modulation modulation;
} hci_fmu_controller_data;

extern const hci_fmu_controller_data hci_fmu_controller;

#endif
