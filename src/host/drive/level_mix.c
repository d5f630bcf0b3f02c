#include "host/drive/level_mix.h"

#include "host/base/memory.h"

hci_status hci_level_mix_make(const hci_loop_f32 *loop, const hci_loop_level *levels, double torque_Nm,
                              hci_level_mix *mix, hci_note *note)
{
    const hci_loop_mix share = hci_loop_mix_of(loop, (float)torque_Nm);
    size_t count = 0;
    for (uint32_t l = 0; l < share.count; ++l)
        count += levels[share.first + l].count;
    mix->waves = hci_memory_new(count, sizeof *mix->waves);
    mix->level = (hci_loop_level){torque_Nm, mix->waves, 0};
    if (!mix->waves) return hci_note_memory(note, NULL, "%zu waves", count);
    for (uint32_t l = 0; l < share.count; ++l)
        for (size_t k = 0; k < levels[share.first + l].count; ++k) {
            hci_wave *w = &mix->waves[mix->level.count++];
            *w = levels[share.first + l].waves[k];
            w->sine *= (double)share.weight[l];
            w->cosine *= (double)share.weight[l];
        }
    return HCI_OK;
}

void hci_level_mix_release(hci_level_mix *mix)
{
    hci_memory_free(mix->waves);
    *mix = (hci_level_mix){{0.0, NULL, 0}, NULL};
}
