#include "host/machine/torque_gradient.h"

#include <string.h>

#include "host/base/memory.h"

hci_status hci_torque_gradient(const hci_machine *machine, const hci_wave *currents, size_t count,
                               double share, double relative_floor, hci_wave **waves, size_t *wave_count,
                               hci_note *note)
{
    const size_t emf_count = machine->back_emf_count;
    size_t n;
    *wave_count = 0;
    *waves = hci_memory_new(emf_count + hci_slope_waves_capacity(machine, count), sizeof **waves);
    if (!*waves)
        return hci_note_set(note, HCI_ERROR_MEMORY,
                            "out of memory for the reluctance torque of %zu current components", count);
    n = hci_slope_waves(machine, currents, count, *waves);
    for (size_t k = 0; k < n; ++k) {
        (*waves)[k].sine *= share;
        (*waves)[k].cosine *= share;
    }
    memcpy(*waves + n, machine->back_emf, emf_count * sizeof **waves);
    *wave_count = hci_waves_join(*waves, n + emf_count, relative_floor);
    return HCI_OK;
}
