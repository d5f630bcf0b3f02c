/* The torque made linear in the currents, as lists of waves (theory.md, sections 2 and 7). */
#ifndef HCI_SRC_HOST_MACHINE_TORQUE_GRADIENT_H
#define HCI_SRC_HOST_MACHINE_TORQUE_GRADIENT_H

#include "hci/host/base/note.h"
#include "hci/machine/torque.h"

/* Owned lists; start with {0}, freed with hci_memory_free. */
typedef struct {
    hci_wave *wave;
    size_t count;
} hci_wave_list;

typedef struct {
    hci_harmonic *harmonic;
    size_t count;
} hci_harmonic_list;

/* T(i) ≈ gradient·i − offset near the currents i_k at which it was made linear: gradient = ∂T/∂i in N·m/A and
 * offset = ∂T/∂i·i_k − T(i_k) in N·m. */
typedef struct {
    hci_wave_list gradient;
    hci_harmonic_list offset;
} hci_linear_torque;

void hci_linear_torque_release(hci_linear_torque *linear);

/* ∂T/∂i = e + L'i of the machine at `count` star currents, and e + ½L'i, whose product with i is the mutual
 * and reluctance torque. Waves below relative_floor times the largest are dropped. *waves: out;
 * HCI_ERROR_MEMORY, and then it is empty. O(slopes · count). */
hci_status hci_torque_gradient(const hci_machine *machine, const hci_wave *currents, size_t count,
                               double relative_floor, hci_wave_list *waves, hci_note *note);
hci_status hci_torque_secant(const hci_machine *machine, const hci_wave *currents, size_t count,
                             double relative_floor, hci_wave_list *waves, hci_note *note);

#endif
