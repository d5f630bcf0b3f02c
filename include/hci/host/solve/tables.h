/* The other small tables: wanted torque, set of harmonics, currents. */
#ifndef HCI_HOST_SOLVE_TABLES_H
#define HCI_HOST_SOLVE_TABLES_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/host/base/note.h"
#include "hci/machine/system.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One wanted torque order. */
typedef struct {
    hci_harmonic torque_Nm; /* order 0: the mean */
    double weight;          /* >= 0; 0: do not care */
} hci_target_order;

/* A wanted torque spectrum; orders that are not listed are wanted zero. Start with {0}. */
typedef struct {
    hci_target_order *order; /* ascending */
    size_t count;            /* entries of order */
} hci_target;

/* The name under which a component was asked for. */
typedef enum {
    HCI_SET_POS,  /* positive sequence */
    HCI_SET_NEG,  /* negative sequence */
    HCI_SET_SYM,  /* the symmetrical system of Vollat et al.: sequence of order mod 3 */
    HCI_SET_ASYM, /* their asymmetrical system: positive sequence */
    HCI_SET_ZERO  /* zero sequence, with a neutral conductor */
} hci_set;

/* The name as in files: pos, neg, sym, asym, zero; a static string. */
const char *hci_set_name(hci_set set);

/* Current components that may be used. Start with {0}. */
typedef struct {
    hci_component *component; /* each once */
    hci_set *set;             /* the name of each */
    size_t count;             /* entries of component and of set */
    hci_note remark;          /* components that the file names twice and that are counted once, or "" */
} hci_component_set;

/* Currents as waves, in A or, read with per_Nm, in A/(N·m). Start with {0}. */
typedef struct {
    hci_wave *wave; /* each component once */
    hci_set *set;   /* the name of each */
    size_t count;   /* entries of wave and of set */
    uint64_t hash;  /* FNV-1a over the values */
} hci_currents;

/* Reads a wanted torque: columns order, amplitude_Nm, phase_rad and optionally weight. At order 0 the
 * amplitude is the signed mean and the phase 0 or π/2. Orders ascending on return. HCI_ERROR_INPUT,
 * HCI_ERROR_MEMORY. */
hci_status hci_target_read(const char *path, hci_target *target, hci_note *note);

/* Frees what a target holds and empties it. */
void hci_target_release(hci_target *target);

/* Reads a set of components: columns order, set. A file with a header alone is an empty set. Orders divisible
 * by three are refused as `sym` unless the machine has a neutral conductor. */
hci_status hci_component_set_read(const char *path, bool has_neutral, hci_component_set *set, hci_note *note);

/* Frees what a set holds and empties it. */
void hci_component_set_release(hci_component_set *set);

/* Reads currents: columns order, set, amplitude_A (or, with per_Nm, amplitude_A_per_Nm), phase_rad.
 * HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_currents_read(const char *path, bool per_Nm, hci_currents *currents, hci_note *note);

/* Frees what currents hold and empties them. */
void hci_currents_release(hci_currents *currents);

#ifdef __cplusplus
}
#endif

#endif
