/* Which current components may be used: harmonics.csv. */
#ifndef HCI_HOST_CURRENTS_COMPONENT_SET_H
#define HCI_HOST_CURRENTS_COMPONENT_SET_H

#include <stdbool.h>

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"
#include "hci/machine/system.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* Reads a set of components: columns order, set. A file with a header alone is an empty set. Orders divisible
 * by three are refused as `sym` unless the machine has a neutral conductor. */
hci_status hci_component_set_read(const char *path, bool has_neutral, hci_component_set *set, hci_note *note);

/* What a table of components is read for. */
typedef struct {
    bool has_neutral;          /* of the machine */
    int pole_pairs;            /* that divide mechanical orders; 0: not known */
    hci_order_base order_base; /* of the column `order` */
} hci_set_tables;

/* The same for orders of either base. */
hci_status hci_component_set_read_orders(const char *path, const hci_set_tables *of, hci_component_set *set,
                                         hci_note *note);

/* Frees what a set holds and empties it. */
void hci_component_set_release(hci_component_set *set);

#ifdef __cplusplus
}
#endif

#endif
