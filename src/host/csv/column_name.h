/* Names of columns, canonical ones and those of other tools. */
#ifndef HCI_SRC_HOST_CSV_COLUMN_NAME_H
#define HCI_SRC_HOST_CSV_COLUMN_NAME_H

#include <stdbool.h>
#include <stddef.h>

#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"

/* What a column is asked for by: "theta_e_rad" is the base "theta_e" in the unit rad. */
typedef struct {
    const char *base;
    size_t base_length;
    const hci_unit *unit;
} hci_wanted_column;

hci_wanted_column hci_wanted_column_of(const char *name);

/* Is `name` the wanted base, or the name of an alias, followed by a unit or by nothing? unit: out, NULL for
 * nothing. */
bool hci_column_split(const char *name, const hci_wanted_column *want, const hci_unit **unit);
bool hci_column_split_alias(const char *name, const hci_alias *alias, const hci_unit **unit);

/* The unit that the end of a name gives: "_deg", " (deg)", "[deg]", " / deg", ", deg"; NULL: none. */
const hci_unit *hci_column_unit_of_tail(const char *tail);

#endif
