/* The other small tables: wanted torque, set of harmonics, currents. */
#ifndef HCI_HOST_TABLES_H
#define HCI_HOST_TABLES_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/host/note.h"
#include "hci/system.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One wanted torque order. Weight 0: do not care. */
typedef struct {
    hci_harmonic torque_Nm;
    double weight;
} hci_target_order;

typedef struct {
    hci_target_order *order;
    size_t count;
} hci_target;

/* The name under which a component was asked for. */
typedef enum { HCI_SET_POS, HCI_SET_NEG, HCI_SET_SYM, HCI_SET_ASYM, HCI_SET_ZERO } hci_set;

const char *hci_set_name(hci_set set);

typedef struct {
    hci_component *component;
    hci_set *set;
    size_t count;
    hci_note remark; /* components that the file names twice and that are counted once, or "" */
} hci_component_set;

typedef struct {
    hci_wave *wave;
    hci_set *set;
    size_t count;
    uint64_t hash; /* FNV-1a over the values */
} hci_currents;

/* target: columns order, amplitude_Nm, phase_rad and optionally weight. At order 0 the amplitude is the
 * signed mean and the phase 0 or π/2. Orders ascending on return. HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_target_read(const char *path, hci_target *target, hci_note *note);
void hci_target_release(hci_target *target);

/* harmonic set: columns order, set. A file with a header alone is an empty set. Orders divisible by three are
 * refused as `sym` unless the machine has a neutral conductor. */
hci_status hci_component_set_read(const char *path, bool has_neutral, hci_component_set *set, hci_note *note);
void hci_component_set_release(hci_component_set *set);

/* currents: columns order, set, amplitude_A (or, with per_Nm, amplitude_A_per_Nm), phase_rad. */
hci_status hci_currents_read(const char *path, bool per_Nm, hci_currents *currents, hci_note *note);
void hci_currents_release(hci_currents *currents);

#ifdef __cplusplus
}
#endif

#endif
