/* The checksum of a file as the POSIX command `cksum` prints it. */
#ifndef HCI_SRC_HOST_BASE_CHECKSUM_H
#define HCI_SRC_HOST_BASE_CHECKSUM_H

#include <stdbool.h>

enum { HCI_CHECKSUM_SIZE = 32 };

/* text: out, the checksum and the size in bytes, with a blank between them. False where the file cannot be
 * read. */
bool hci_checksum_file(const char *path, char text[HCI_CHECKSUM_SIZE]);

#endif
