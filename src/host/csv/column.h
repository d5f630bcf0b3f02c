/* Which column of a table holds a quantity that is asked for by its canonical name. */
#ifndef HCI_SRC_HOST_CSV_COLUMN_H
#define HCI_SRC_HOST_CSV_COLUMN_H

#include <stdbool.h>

#include "hci/host/csv/csv.h"
#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"

typedef enum {
    HCI_COLUMN_NONE,        /* no column goes by this name */
    HCI_COLUMN_ONE,         /* one does, in a unit of the quantity */
    HCI_COLUMN_TWICE,       /* several do */
    HCI_COLUMN_OTHER_UNIT,  /* one does, in a unit of another quantity */
    HCI_COLUMN_GIVEN_UNIT,  /* the user names one in a unit of another quantity */
    HCI_COLUMN_CONFLICT,    /* its name and the row of units say different units */
    HCI_COLUMN_UNKNOWN_UNIT /* the row of units says one that is not known */
} hci_column_kind;

typedef struct {
    hci_column_kind kind;
    size_t column;
    double factor;            /* from the file's unit to the unit asked for */
    const hci_alias *alias;   /* by which it was found; NULL: by its own name */
    bool has_unit;            /* the file says a unit */
    bool is_rms;              /* of a sine, by a word of the header: the factor has √2 for it */
    const char *overruled_by; /* the name by which the user says another unit than the file; NULL: none is */
} hci_column_match;

/* The unit at the end of a header under any name, such as "AI3 (mV)", or in the row of units; NULL: none. */
const hci_unit *hci_column_unit(const hci_csv *csv, size_t column);

/* By the canonical name with its unit, or by a name of another tool where none has the canonical one. */
hci_column_match hci_column_find(const hci_csv *csv, const char *name);

/* Why a column that was found, or none, cannot be used: any kind but HCI_COLUMN_ONE. HCI_ERROR_INPUT. */
hci_status hci_column_error(const hci_csv *csv, const char *name, const hci_column_match *found,
                            hci_note *note);

/* Whether the header has columns of all these names: a reader that goes by rows misses none of them in a
 * table without rows. HCI_ERROR_INPUT for the first that is not there. */
hci_status hci_columns_check(const hci_csv *csv, const char *const *names, size_t count, hci_note *note);

#endif
