/* What every reader of a machine folder needs of it: its files, and the cells that mean the same to all. */
#ifndef HCI_SRC_HOST_MACHINE_FOLDER_H
#define HCI_SRC_HOST_MACHINE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/csv/csv.h"

/* "folder/file"; HCI_ERROR_INPUT with a note where it does not fit. */
hci_status hci_machine_path(char *path, size_t size, const char *folder, const char *file, hci_note *note);

/* Whether the file is there, or there is something in its place that cannot be looked at. */
bool hci_machine_has(const char *path);

/* The row `connection` of machine.csv. has_neutral: out. HCI_ERROR_INPUT with a note for other words. */
hci_status hci_machine_connection(const hci_csv *csv, size_t row, bool *has_neutral, hci_note *note);

#endif
