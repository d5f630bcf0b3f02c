/* One process at a time writes into a folder. */
#ifndef HCI_SRC_HOST_BASE_FOLDER_LOCK_H
#define HCI_SRC_HOST_BASE_FOLDER_LOCK_H

#include <stdbool.h>

/* A folder that this process has locked, maybe more than once. */
typedef struct hci_folder_lock hci_folder_lock;

/* Locks an existing folder, and waits for another process that has it for up to wait_ms. NULL where that
 * keeps it (errno is EWOULDBLOCK) or memory is out (ENOMEM). A file system without locks locks nothing. The
 * lock ends with the process at the latest. is_alone: out, whether it is certain that nobody else writes
 * there, this process included. */
hci_folder_lock *hci_folder_lock_take(const char *folder, int wait_ms, bool *is_alone);

/* lock may be NULL. */
void hci_folder_lock_release(hci_folder_lock *lock);

#endif
