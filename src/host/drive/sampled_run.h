/* One run of the sampled drive at a constant speed, as short as its figures allow: what a table for
 * hci/loop.h makes of the torque where the voltage does not do for it. */
#ifndef HCI_SRC_HOST_DRIVE_SAMPLED_RUN_H
#define HCI_SRC_HOST_DRIVE_SAMPLED_RUN_H

#include "hci/loop.h"
#include "host/drive/machine_model.h"

enum { HCI_LOOP_MOST_ORDERS = 128 }; /* of a table */

typedef struct {
    const hci_drive_data *drive;    /* fitted */
    const hci_machine_model *plant; /* that is driven, with its effects */
    const hci_machine_model *known; /* by the decoupling */
    const hci_loop_f32 *loop;       /* of one level of torque */
    float *memory;                  /* of the tables: hci_loop_floats with HCI_LOOP_FEEDFORWARD */
} hci_sampled_drive;

/* The torque over whole electrical turns. NAN where the state left the finite numbers. */
typedef struct {
    double mean_Nm, ripple_Nm; /* ripple_Nm: peak to peak, at two to four instants of a sample */
} hci_sampled_torque;

/* With voltage feedforward. speed_rad_per_s: electrical, signed, not 0. O(samples until the start is
 * forgotten). */
hci_sampled_torque hci_sampled_run(const hci_sampled_drive *drive, double speed_rad_per_s);

#endif
