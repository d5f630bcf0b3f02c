/* Torque of a higher than the second degree in the current, such as saturation makes, sampled along a current
 * over the period: it has no closed form in waves. */
#ifndef HCI_SRC_HOST_MACHINE_SAMPLED_TORQUE_H
#define HCI_SRC_HOST_MACHINE_SAMPLED_TORQUE_H

#include "hci/effects/effect.h"
#include "host/machine/torque_gradient.h"

/* Where it is sampled: effects of a machine, and star currents that repeat after so many electrical turns. */
typedef struct {
    const hci_effects_plant *higher;
    size_t turns;
    const hci_wave *wave;
    size_t count;
} hci_torque_path;

/* The orders at which there is any torque. *torque: out; HCI_ERROR_MEMORY, and then it is empty. O(n log n)
 * in the samples, at least 1024 a turn. */
hci_status hci_sampled_torque(const hci_torque_path *path, hci_harmonic_list *torque, hci_note *note);

/* The same made linear at the currents. *linear: out, to be released; HCI_ERROR_MEMORY, and then it is empty.
 */
hci_status hci_sampled_torque_linearise(const hci_torque_path *path, hci_linear_torque *linear,
                                        hci_note *note);

#endif
