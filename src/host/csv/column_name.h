/* Names of columns, canonical ones and those of other tools. */
#ifndef HCI_SRC_HOST_CSV_COLUMN_NAME_H
#define HCI_SRC_HOST_CSV_COLUMN_NAME_H

#include <stdbool.h>
#include <stddef.h>

#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"
#include "host/csv/channel_name.h"

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

/* A quantity along d or q, of which "Id (Peak)" and "Iq rms [A]" say the amplitude of its sines: of a phase
 * neither is what flows at an instant. */
bool hci_column_is_along_axis(const hci_wanted_column *want);

/* A header without such a word: "Id", "Iq [A]"; false: it has none. factor: out, from what the word says to
 * the peak. */
bool hci_column_without_amplitude(const char *header, char plain[HCI_CHANNEL_SIZE], double *factor);

/* The unit that the end of a name gives: "_deg", " (deg)", "[deg]", " / deg", ", deg"; NULL: none. */
const hci_unit *hci_column_unit_of_tail(const char *tail);

#endif
