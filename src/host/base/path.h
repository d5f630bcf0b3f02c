/* Paths of files that are there, and of those that cannot be read. */
#ifndef HCI_SRC_HOST_BASE_PATH_H
#define HCI_SRC_HOST_BASE_PATH_H

#include <stdbool.h>
#include <sys/stat.h>

#include "hci/host/base/note.h"

/* Whether both name one file. */
bool hci_path_is_same(const char *a, const char *b);

/* How a file is found from a folder: "../runs/a.csv". relative: out, to be freed with hci_memory_free.
 * HCI_ERROR_INPUT where one of both is not there, HCI_ERROR_MEMORY. */
hci_status hci_path_relative(const char *file, const char *folder, char **relative, hci_note *note);

/* ---- files that are there and cannot be read ----
 * A function may go on as if there were none, and its result is then another one. As of memory that was
 * short (memory.h), who writes a result asks before. */

/* Keeps that PATH could not be read, by errno of the call that failed; not where errno says that there is
 * nothing. */
void hci_unread_keep(const char *path);

/* Whether there is something at a path, and what; what cannot be looked at is kept. */
bool hci_unread_stat(const char *path, struct stat *info);

/* HCI_ERROR_INPUT with a note of the first one since the last call, which is forgotten then. Not safe for
 * threads. */
hci_status hci_unread_check(hci_note *note);

#endif
