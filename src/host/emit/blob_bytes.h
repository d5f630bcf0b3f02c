/* Bytes of a blob, low ones first, and their CRC-32. */
#ifndef HCI_SRC_HOST_EMIT_BLOB_BYTES_H
#define HCI_SRC_HOST_EMIT_BLOB_BYTES_H

#include <stdint.h>

#include "hci/host/base/output.h"
#include "hci/host/emit/emit_facts.h"

/* What is written: the end of what there is so far, and its CRC. Start the CRC with 0xFFFFFFFF. */
typedef struct {
    hci_output *out;
    uint32_t crc;
    size_t count; /* bytes so far */
} hci_blob_sink;

/* One to four bytes, a float, zeros up to a multiple of four, a machine's name, and the CRC of all that. */
void hci_blob_put(hci_blob_sink *sink, uint32_t value, int bytes);
void hci_blob_put_float(hci_blob_sink *sink, float value);
void hci_blob_fill(hci_blob_sink *sink);
void hci_blob_put_name(hci_blob_sink *sink, const char *name);
void hci_blob_put_crc(hci_blob_sink *sink);

/* The first 24 bytes. kind: an hci_blob_kind; bytes: of the whole. */
void hci_blob_put_start(hci_blob_sink *sink, int kind, size_t bytes, uint64_t input_hash, size_t pole_pairs);

#endif
