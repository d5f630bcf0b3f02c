/* Torque of higher than second degree in the current, sampled along a current. */
#ifndef HCI_SRC_HOST_MACHINE_SAMPLED_TORQUE_H
#define HCI_SRC_HOST_MACHINE_SAMPLED_TORQUE_H

#include "hci/effects/effect.h"
#include "hci/host/base/note.h"

/* The torque of star currents over `turns` electrical turns, which must be a period of all: the orders at
 * which there is any. *torque: out, to be freed with hci_memory_free. */
hci_status hci_sampled_torque(const hci_effects_plant *beyond, size_t turns, const hci_wave *wave,
                              size_t count, hci_harmonic **torque, size_t *torque_count, hci_note *note);

/* The same made linear: ∂T/∂i as waves, and the torque ∂T/∂i·i − T that it has too much at these currents. */
typedef struct {
    hci_wave *gain;
    size_t gain_count;
    hci_harmonic *offset;
    size_t offset_count;
} hci_sampled_linear;

hci_status hci_sampled_torque_linearise(const hci_effects_plant *beyond, size_t turns, const hci_wave *wave,
                                        size_t count, hci_sampled_linear *linear, hci_note *note);
void hci_sampled_linear_release(hci_sampled_linear *linear);

#endif
