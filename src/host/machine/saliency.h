/* L_d and L_q that differ in machine.csv, where nothing gives the torque that goes with that. */
#ifndef HCI_SRC_HOST_MACHINE_SALIENCY_H
#define HCI_SRC_HOST_MACHINE_SALIENCY_H

#include <stdbool.h>

#include "hci/host/base/note.h"
#include "hci/host/base/output.h"

/* Of a folder without inductance.csv: adds to the remark that currents are solved without the reluctance
 * torque 3/2 p (L_d - L_q) i_d i_q, and how to have it, where the two differ by more than 1 % and effects.csv
 * has no effect that makes it. NAN: not given. */
void hci_saliency_remark(const char *folder, double inductance_d_H, double inductance_q_H, hci_note *remark);

/* Whether they differ so much. */
bool hci_is_salient(double inductance_d_H, double inductance_q_H);

/* The rows of inductance.csv of a winding with L_d and L_q, whose star point is not connected: what flows
 * into that is not known, and its inductance is written as 0. */
void hci_saliency_write_rows(hci_output *out, double inductance_d_H, double inductance_q_H);

#endif
