/* What every reader of a machine folder needs of it: that it is there, and its files. */
#ifndef HCI_SRC_HOST_MACHINE_FOLDER_H
#define HCI_SRC_HOST_MACHINE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/machine/machine.h"

/* The names of the files of a machine. */
enum { HCI_MACHINE_FILES = 5 };
extern const char *const hci_machine_files[HCI_MACHINE_FILES];

/* "folder/file"; HCI_ERROR_INPUT with a note where it does not fit. */
hci_status hci_machine_path(char *path, size_t size, const char *folder, const char *file, hci_note *note);

/* Whether the file is there, or there is something in its place that cannot be looked at. */
bool hci_machine_has(const char *path);

/* Its identity: the name of the folder it was read from, and a digest of what makes its torque; none where
 * effects.csv cannot be read. */
void hci_machine_identify(const char *folder, hci_machine_data *machine);

/* HCI_ERROR_INPUT with a note where there is no such folder, or it has not the files of a machine. */
hci_status hci_machine_check_folder(const char *folder, hci_note *note);

#endif
