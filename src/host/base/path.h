/* Paths of files that are there. */
#ifndef HCI_SRC_HOST_BASE_PATH_H
#define HCI_SRC_HOST_BASE_PATH_H

#include <stdbool.h>

#include "hci/host/base/note.h"

/* Whether both name one file. */
bool hci_path_is_same(const char *a, const char *b);

/* How a file is found from a folder: "../runs/a.csv". relative: out, to be freed with hci_memory_free.
 * HCI_ERROR_INPUT where one of both is not there, HCI_ERROR_MEMORY. */
hci_status hci_path_relative(const char *file, const char *folder, char **relative, hci_note *note);

#endif
