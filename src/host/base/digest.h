/* A digest of bytes (FNV-1a, 64 bits), to tell whether files are the same. */
#ifndef HCI_SRC_HOST_BASE_DIGEST_H
#define HCI_SRC_HOST_BASE_DIGEST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HCI_DIGEST_START 14695981039346656037u

/* Goes on from `sum`, HCI_DIGEST_START at first. */
uint64_t hci_digest_next(uint64_t sum, const char *bytes, size_t count);

/* The same of all bytes of a file; false where it cannot be read, which path.h keeps. */
bool hci_digest_file(const char *path, uint64_t *sum);

#endif
