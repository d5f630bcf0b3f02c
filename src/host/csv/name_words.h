/* Names of columns that are made of plain words, as people write them in the language of their bench: "Mech.
 * Winkel", "Courant phase 1", "Par medido". The table of words in name_words.c is all that is known of them;
 * docs/files.md lists it. */
#ifndef HCI_SRC_HOST_CSV_NAME_WORDS_H
#define HCI_SRC_HOST_CSV_NAME_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"

/* What such a name says, with its unit behind it: an alias whose name is "" and whose column is NULL for an
 * angle that may be mechanical or electrical; NULL: a word is not known, or the words do not say one
 * quantity. of_row: the unit that the row of units says, or NULL. unit: out, the unit in the name, NULL:
 * none. O(length · words). */
const hci_alias *hci_name_words(const char *name, const hci_unit *of_row, const hci_unit **unit);

/* What a column that is not read may be. */
typedef enum { HCI_LIKE_TORQUE, HCI_LIKE_CURRENT, HCI_LIKE_SPEED, HCI_LIKE_POSITION } hci_name_like;

/* Whether a name may be that of a measured one: by a word or its unit; no current of a supply. */
bool hci_name_words_like(hci_name_like what, const char *name, const hci_unit *of_row);

/* Whether a word of it says d, as `Id_meas` does. */
bool hci_name_words_along_d(const char *name);

/* Whether an alias is one of words that leave nothing to be checked where the file says the unit. */
bool hci_name_words_are_clear(const hci_alias *said);

/* Words of one kind, divided by blanks, in lower case and without accents; NULL beyond the last kind. kind:
 * out, what they say. */
const char *hci_name_words_known(size_t k, const char **kind);

/* Is a name one of those that a recording has, here or elsewhere? And without those in plain words. */
bool hci_column_is_known(const char *name);
bool hci_column_has_known_name(const char *name);

#endif
