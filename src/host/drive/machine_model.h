/* What a machine is to a drive: its tables over the angle, resistance and mean inductances. */
#ifndef HCI_SRC_HOST_DRIVE_MACHINE_MODEL_H
#define HCI_SRC_HOST_DRIVE_MACHINE_MODEL_H

#include "hci/drive/plant.h"
#include "hci/effects/effect.h"
#include "hci/host/drive/drive.h"
#include "host/drive/loop_model.h"

/* Start with {0}. */
typedef struct {
    hci_plant_table table; /* of rows */
    double *rows;
    hci_machine machine; /* what the table was made of; the arrays are those of the machine that was read */
    hci_plant_inductance inductance;
    double resistance_ohm, inductance_H[2]; /* L_d, L_q: means over a turn, seen from the rotor */
    const hci_effects *effects; /* what it has beyond the tables; NULL: nothing, or it is not asked for */
} hci_machine_model;

/* All that the tables say. To be released. HCI_ERROR_INPUT where resistance or inductance are missing,
 * HCI_ERROR_MEMORY. */
hci_status hci_machine_model_make(const hci_machine_data *machine, hci_machine_model *model, hci_note *note);

/* The same with all that its effects say, as it is driven: L_d and L_q that differ leave their reluctance
 * torque to effects that have one. effects: NULL, or to outlive the model. */
hci_status hci_machine_model_make_whole(const hci_machine_data *machine, const hci_effects *effects,
                                        hci_machine_model *model, hci_note *note);

/* A machine with constant L_d and L_q and the fundamental of the back-EMF, as `decoupling,constant` knows it.
 */
hci_status hci_machine_model_make_constant(const hci_machine_data *machine, hci_machine_model *model,
                                           hci_note *note);

void hci_machine_model_release(hci_machine_model *model);

/* The loop of a fitted drive at an electrical speed. */
hci_loop_model hci_drive_loop(const hci_drive_data *drive, const hci_machine_model *machine,
                              double speed_rad_per_s);

#endif
