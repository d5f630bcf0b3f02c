/* Currents as waves: currents.csv. */
#ifndef HCI_HOST_CURRENTS_CURRENTS_H
#define HCI_HOST_CURRENTS_CURRENTS_H

#include <stdint.h>

#include "hci/host/currents/component_set.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Currents as waves, in A or, read with per_Nm, in A/(N·m). Start with {0}. */
typedef struct {
    hci_wave *wave; /* each component once */
    hci_set *set;   /* the name of each */
    size_t count;   /* entries of wave and of set */
    uint64_t hash;  /* FNV-1a over the values */
} hci_currents;

/* Reads currents: columns order, set, amplitude_A (or, with per_Nm, amplitude_A_per_Nm), phase_rad.
 * HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_currents_read(const char *path, bool per_Nm, hci_currents *currents, hci_note *note);

/* Frees what currents hold and empties them. */
void hci_currents_release(hci_currents *currents);

#ifdef __cplusplus
}
#endif

#endif
