/* Looking up the unit that a cell or the name of a column spells. */
#ifndef HCI_SRC_HOST_BASE_UNIT_LOOKUP_H
#define HCI_SRC_HOST_BASE_UNIT_LOOKUP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *spelling;
    int dimension;
    double factor; /* to the first unit of this dimension */
} hci_unit;

/* Which turn a unit of angle is a part of, as EDeg and deg mech say it. */
typedef enum { HCI_UNIT_TURN_UNSAID, HCI_UNIT_TURN_MECHANICAL, HCI_UNIT_TURN_ELECTRICAL } hci_unit_turn;

/* unit: or NULL. */
hci_unit_turn hci_unit_turn_of(const hci_unit *unit);

/* The unit that `length` bytes of text spell, or NULL. Without regard to case, but for a leading M, which
 * would be mega and is nothing here. Empty text and "-" are the unit 1. */
const hci_unit *hci_unit_find(const char *text, size_t length);

/* The same for the suffix of a column name, where M may be a milli in capitals (TIME_MS). */
const hci_unit *hci_unit_of_suffix(const char *suffix);

bool hci_unit_equal(const hci_unit *a, const hci_unit *b);

/* The unit suffix of a column name, the longest that is a unit ("speed_rad_per_s": rad_per_s, not s), or the
 * unit 1. base_length: out, length of the name before the suffix and its underscore. */
const hci_unit *hci_unit_of_name(const char *name, size_t *base_length);

#endif
