/* What is to outlive a power failure. */
#ifndef HCI_SRC_HOST_BASE_SYNC_H
#define HCI_SRC_HOST_BASE_SYNC_H

#include <stdbool.h>
#include <stdio.h>

/* Brings what was written to a stream, or the names in a folder, to the disk. False, with errno, where the
 * disk refuses; a file system that has no such thing agrees. */
bool hci_sync_stream(FILE *stream);
bool hci_sync_folder(const char *folder);

#endif
