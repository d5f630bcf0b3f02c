/* The wanted torque: target.csv. */
#ifndef HCI_HOST_CURRENTS_TARGET_H
#define HCI_HOST_CURRENTS_TARGET_H

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"
#include "hci/math/harmonic.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One wanted torque order. */
typedef struct {
    hci_harmonic torque_Nm; /* order 0: the mean */
    double weight;          /* >= 0; 0: do not care */
} hci_target_order;

/* A wanted torque spectrum; orders that are not listed are wanted zero. Start with {0}. */
typedef struct {
    hci_target_order *order; /* ascending */
    size_t count;            /* entries of order */
} hci_target;

/* Reads a wanted torque: columns order, amplitude_Nm, phase_rad and optionally weight. At order 0 the
 * amplitude is the signed mean and the phase 0 or π/2. Orders ascending on return. HCI_ERROR_INPUT,
 * HCI_ERROR_MEMORY. */
hci_status hci_target_read(const char *path, hci_target *target, hci_note *note);

/* The same where the column `order` counts what base says; pole_pairs divides mechanical orders, also those
 * of a column `mechanical_order`. */
hci_status hci_target_read_orders(const char *path, hci_order_base base, int pole_pairs, hci_target *target,
                                  hci_note *remark, hci_note *note);

/* Frees what a target holds and empties it. */
void hci_target_release(hci_target *target);

/* The entry of an order; torque 0 and weight 1 when it is not listed. O(count). */
hci_target_order hci_target_at(const hci_target *target, double order);

/* The wanted mean torque in N·m, order 0; 0 when it is not listed. */
double hci_target_mean_Nm(const hci_target *target);

#ifdef __cplusplus
}
#endif

#endif
