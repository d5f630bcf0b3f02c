/* machine.csv: its values in canonical units, and where each stands. */
#ifndef HCI_SRC_HOST_MACHINE_MACHINE_VALUES_H
#define HCI_SRC_HOST_MACHINE_MACHINE_VALUES_H

#include "hci/host/csv/csv.h"
#include "hci/host/machine/machine.h"

enum {
#define HCI_COUNT_ONE(field, name, unit) +1
    HCI_MACHINE_VALUE_COUNT = 0 HCI_MACHINE_VALUES(HCI_COUNT_ONE)
#undef HCI_COUNT_ONE
};

/* In the order of HCI_MACHINE_VALUES. */
typedef struct {
    hci_csv *csv;                          /* the file */
    double value[HCI_MACHINE_VALUE_COUNT]; /* NAN: not given */
    size_t row[HCI_MACHINE_VALUE_COUNT];   /* data row of a value that is given */
    bool has_neutral;
    hci_note remark; /* names that are not known */
} hci_machine_values;

/* Reads machine.csv. *values is to be released even after a failure. HCI_ERROR_INPUT, also without
 * `pole_pairs` or where they are no whole number from 1 to 1000; HCI_ERROR_MEMORY. */
hci_status hci_machine_values_read(const char *path, hci_machine_values *values, hci_note *note);
void hci_machine_values_release(hci_machine_values *values);

#endif
