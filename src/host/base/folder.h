/* Folders that are made for output, and taken away again where nothing came of it. */
#ifndef HCI_SRC_HOST_BASE_FOLDER_H
#define HCI_SRC_HOST_BASE_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

/* Makes a folder with its parents. folder: written to on the way, and as it was on return. existing: out, the
 * length of the part of the path that was there before. False where it cannot be made: nothing is left of it
 * then, and errno says why. */
bool hci_folder_make(char *folder, size_t *existing);

/* Removes what was made of it, as far as it is empty. Safe in the handler of a signal. */
void hci_folder_remove(char *folder, size_t existing);

/* Removes a folder with all that is in it; links in it are removed, not followed. False, with errno, where
 * something stays; true where there is none. */
bool hci_folder_delete(const char *folder);

#endif
