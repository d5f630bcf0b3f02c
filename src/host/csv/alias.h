/* Columns as other tools name them. The table in alias.c is all that is known of these tools;
 * docs/files.md lists it. */
#ifndef HCI_SRC_HOST_CSV_ALIAS_H
#define HCI_SRC_HOST_CSV_ALIAS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *name;   /* without its unit; see hci_alias_is_name */
    const char *column; /* what is asked for instead; NULL: may be several things, and is refused */
    const char *unit;   /* of its values where the file says none; NULL: it counts only where the file does */
    const char *tool;   /* where it was seen */
    const char
        *meaning; /* for the user to check: "`name` is read as MEANING"; NULL: it cannot be anything else */
    const char *beside; /* only in a file that has this column too; then before all other readings; or NULL */
} hci_alias;

extern const hci_alias hci_aliases[];
extern const size_t hci_alias_count;

/* Are these `length` bytes the name of the alias? Case, blanks, '_' and '-' do not count, except for an alias
 * of one letter or with `beside`, which stands as it is written. An alias ".x" is any dotted path that ends
 * with x, ".x.y" one that ends with x.y or is that. */
bool hci_alias_is_name(const hci_alias *alias, const char *name, size_t length);

#endif
