/* inductance.csv: phase inductances, or their slopes, over one electrical turn. */
#ifndef HCI_SRC_HOST_MACHINE_INDUCTANCE_H
#define HCI_SRC_HOST_MACHINE_INDUCTANCE_H

#include "hci/host/base/note.h"
#include "hci/machine/torque.h"

/* The harmonics of a table. inductance: L(θ), NULL when the file holds slopes only. Both are the caller's to
 * free. */
typedef struct {
    hci_inductance *inductance;
    size_t inductance_count;
    hci_inductance_slope *slope;
    size_t slope_count;
} hci_inductance_table;

/* Columns theta_e_rad and La_H, Lb_H, Lc_H, Mab_H, Mbc_H, Mca_H, or dLa_H_per_rad … dMca_H_per_rad (per
 * mechanical radian). Angles in equal steps over one electrical turn, with or without the end point. */
hci_status hci_inductance_read(const char *path, int pole_pairs, hci_inductance_table *table, hci_note *note);

#endif
