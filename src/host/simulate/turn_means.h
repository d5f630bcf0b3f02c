/* Torque and current vector of a simulated drive over one electrical turn: mean and extremes of all turns, in
 * equal steps of the angle. */
#ifndef HCI_SRC_HOST_SIMULATE_TURN_MEANS_H
#define HCI_SRC_HOST_SIMULATE_TURN_MEANS_H

#include <stddef.h>

#include "hci/machine/frames.h"
#include "host/numeric/range.h"

enum { HCI_TURN_STEPS = 360 };

/* Sums over the samples of each step. */
typedef struct {
    size_t samples[HCI_TURN_STEPS];
    double torque_Nm[HCI_TURN_STEPS];
    hci_dq current_A[HCI_TURN_STEPS];
    hci_range torque_range_Nm[HCI_TURN_STEPS];
} hci_turn_means;

void hci_turn_means_begin(hci_turn_means *turn);

/* theta_e_rad: of any size and sign; a sample whose angle is not finite is left out. */
void hci_turn_means_add(hci_turn_means *turn, double theta_e_rad, double torque_Nm, hci_dq current_A);

/* Of one step, or of `many` steps from there on together. samples 0: there is nothing. */
typedef struct {
    size_t samples;
    double torque_Nm;
    hci_dq current_A;
    hci_range torque_range_Nm;
} hci_turn_mean;

hci_turn_mean hci_turn_mean_of(const hci_turn_means *turn, size_t step, size_t many);

#endif
