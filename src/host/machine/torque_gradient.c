/* What a current makes of torque at each order. In: a machine and currents; out: e + L'i or e + ½L'i as
 * waves, which take the place of the back-EMF wherever the torque is not linear in the currents. */
#include "host/machine/torque_gradient.h"

#include <string.h>

#include "host/base/memory.h"

typedef struct {
    const hci_wave *wave;
    size_t count;
} currents;

/* e + share·L'i */
static hci_status emf_and_slope(const hci_machine *machine, currents i, double share, double relative_floor,
                                hci_wave_list *waves, hci_note *note)
{
    const size_t emf_count = machine->back_emf_count;
    size_t n;
    waves->count = 0;
    waves->wave = hci_memory_new(emf_count + hci_slope_waves_capacity(machine, i.count), sizeof *waves->wave);
    if (!waves->wave)
        return hci_note_memory(note, NULL, "the reluctance torque of %zu current components", i.count);
    n = hci_slope_waves(machine, i.wave, i.count, waves->wave);
    for (size_t k = 0; k < n; ++k) {
        waves->wave[k].sine *= share;
        waves->wave[k].cosine *= share;
    }
    memcpy(waves->wave + n, machine->back_emf, emf_count * sizeof *waves->wave);
    waves->count = hci_waves_join(waves->wave, n + emf_count, relative_floor);
    return HCI_OK;
}

hci_status hci_torque_gradient(const hci_machine *machine, const hci_wave *wave, size_t count,
                               double relative_floor, hci_wave_list *waves, hci_note *note)
{
    return emf_and_slope(machine, (currents){wave, count}, 1.0, relative_floor, waves, note);
}

hci_status hci_torque_secant(const hci_machine *machine, const hci_wave *wave, size_t count,
                             double relative_floor, hci_wave_list *waves, hci_note *note)
{
    return emf_and_slope(machine, (currents){wave, count}, 0.5, relative_floor, waves, note);
}

void hci_linear_torque_release(hci_linear_torque *linear)
{
    hci_memory_free(linear->gradient.wave);
    hci_memory_free(linear->offset.harmonic);
    memset(linear, 0, sizeof *linear);
}
