/* Tables of the columns name, value, unit, as machine.csv, effects.csv and scenarios are: the number of a row
 * in the unit that the program works in. */
#ifndef HCI_SRC_HOST_CSV_NAME_VALUES_H
#define HCI_SRC_HOST_CSV_NAME_VALUES_H

#include "hci/host/csv/csv.h"

/* One name that a table may hold, and where its number goes. */
typedef struct {
    const char *name;
    const char *unit; /* that the number is wanted in; see hci_value_factor */
    double *value;    /* NAN as long as the table has not given it */
} hci_named_value;

/* What the number in the column `value` of this row is to be multiplied by to be in the unit `wanted`. The
 * column `unit` may be missing; nothing, 1 and - in it stand for the wanted unit, which itself need not be
 * one that other tables know ("count"). HCI_ERROR_INPUT for a unit that does not convert. */
hci_status hci_value_factor(const hci_csv *csv, size_t row, const char *wanted, double *factor,
                            hci_note *note);

/* The number of this row in the unit that is wanted. HCI_ERROR_INPUT: not a finite number, or a unit that
 * does not convert. */
hci_status hci_value_read(const hci_csv *csv, size_t row, const char *wanted, double *value, hci_note *note);

/* The same with its range, in the unit that is wanted; `count` as that unit stands for a whole number.
 * remedy: what to do about another one. HCI_ERROR_INPUT. */
typedef struct {
    double low, high;
    const char *remedy;
} hci_value_range;

hci_status hci_value_read_within(const hci_csv *csv, size_t row, const hci_named_value *wanted,
                                 const hci_value_range *range, hci_note *note);

/* The place of the column `value` among words that end with NULL, whatever its case. HCI_ERROR_INPUT. */
hci_status hci_value_read_choice(const hci_csv *csv, size_t row, const char *const *choices,
                                 const char *remedy, int *value, hci_note *note);

/* The error of a name that is none of `names` (ends with NULL), with the nearest where there is one.
 * where: the page that lists them all. HCI_ERROR_INPUT. */
hci_status hci_unknown_name(const hci_csv *csv, size_t row, const char *name, const char *const *names,
                            const char *where, hci_note *note);

/* Which of `count` names the column `name` holds in this row: *at, or `count` for none of them.
 * HCI_ERROR_INPUT where the name was there before, that is, where its value is not NAN any more. The value is
 * not read yet. */
hci_status hci_named_value_find(const hci_csv *csv, size_t row, const hci_named_value *list, size_t count,
                                size_t *at, hci_note *note);

#endif
