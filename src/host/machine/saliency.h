/* L_d and L_q of a machine folder: what goes with two that differ, and how far their difference is known. */
#ifndef HCI_SRC_HOST_MACHINE_SALIENCY_H
#define HCI_SRC_HOST_MACHINE_SALIENCY_H

#include <stdbool.h>

#include "hci/host/base/note.h"
#include "hci/host/base/output.h"
#include "hci/host/machine/machine.h"

/* Of a machine folder without inductance.csv, where a file gives L_d and L_q: adds to the remark that
 * currents are solved without the reluctance torque 3/2 p (L_d - L_q) i_d i_q, and how to have it, where the
 * two differ by more than 1 % and effects.csv has no effect that makes it. NAN: not given. */
void hci_saliency_remark(const char *file, const char *folder, double inductance_d_H, double inductance_q_H,
                         hci_note *remark);

/* Whether they differ so much. */
bool hci_is_salient(double inductance_d_H, double inductance_q_H);

/* How far L_d - L_q of a rotor is usually from what a machine declares of it, as a standard deviation: of
 * `inductance_H`, or of a flux over the current that the machine is made for. One of the two is 0. */
typedef struct {
    double inductance_H; /* where L_d and L_q are declared */
    double flux_Wb;      /* where they are not */
} hci_saliency_width;

/* O(samples of an electrical turn). */
hci_saliency_width hci_saliency_width_of(const hci_machine_data *machine);

/* The rows of inductance.csv of a winding with L_d and L_q, whose star point is not connected: what flows
 * into that is not known, and its inductance is written as 0. */
void hci_saliency_write_rows(hci_output *out, double inductance_d_H, double inductance_q_H);

#endif
