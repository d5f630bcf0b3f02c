/* The currents that a table of levels makes at one torque. */
#ifndef HCI_SRC_HOST_DRIVE_LEVEL_MIX_H
#define HCI_SRC_HOST_DRIVE_LEVEL_MIX_H

#include "hci/host/drive/drive.h"
#include "hci/loop.h"

typedef struct {
    hci_loop_level level; /* its waves are those below; orders may be there more than once */
    hci_wave *waves;
} hci_level_mix;

/* As hci_loop_at mixes them. loop: made of the levels. mix: out, to be given to hci_level_mix_release.
 * HCI_ERROR_MEMORY. */
hci_status hci_level_mix_make(const hci_loop_f32 *loop, const hci_loop_level *levels, double torque_Nm,
                              hci_level_mix *mix, hci_note *note);
void hci_level_mix_release(hci_level_mix *mix);

#endif
