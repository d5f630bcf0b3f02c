/* A ZIP archive of files as they are, without compression: each entry is stored, with its CRC-32, and all are
 * dated 1 January 1980, so that the same files make the same bytes. */
#ifndef HCI_SRC_HOST_FMU_ZIP_H
#define HCI_SRC_HOST_FMU_ZIP_H

#include <stddef.h>
#include <stdint.h>

#include "hci/host/base/output.h"

/* One file of the archive; the text and the bytes are the caller's. */
typedef struct {
    const char *path; /* with / between folders */
    const void *bytes;
    size_t size;
} hci_zip_entry;

/* Appends the archive to the current file of a set. HCI_ERROR_ARGUMENT for more than 65535 entries or 4 GB,
 * which this form does not hold. */
hci_status hci_zip_write(hci_output *output, const hci_zip_entry *entries, size_t count, hci_note *note);

#endif
