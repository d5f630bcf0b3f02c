/* The files of a folder of results: whether they are those that were written with its summary.json, by the
 * checksums in it. */
#ifndef HCI_SRC_HOST_CURRENTS_OWN_FILES_H
#define HCI_SRC_HOST_CURRENTS_OWN_FILES_H

#include "hci/host/base/note.h"

/* One file. summary: the text of summary.json, which may not name it; remedy: what to do, for the note. A
 * file that is not there or cannot be read is for who reads it. HCI_ERROR_INPUT where it is another one,
 * _MEMORY. */
hci_status hci_own_file_check(const char *summary, const char *path, const char *remedy, hci_note *note);

/* The same by the summary.json beside it; all is well where there is none. */
hci_status hci_own_file_check_beside(const char *path, const char *remedy, hci_note *note);

/* All files that the summary.json of a folder names, and those of each folder within that has one.
 * HCI_ERROR_INPUT for the first that is another one or is not there, or where the folder itself has no
 * summary.json with checksums; _MEMORY. */
hci_status hci_own_folder_check(const char *folder, const char *remedy, hci_note *note);

#endif
