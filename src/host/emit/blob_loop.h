/* Orders for a drive as the bytes that hci/loop_blob.h reads. */
#ifndef HCI_SRC_HOST_EMIT_BLOB_LOOP_H
#define HCI_SRC_HOST_EMIT_BLOB_LOOP_H

#include "hci/host/base/output.h"
#include "hci/host/emit/emit_loop.h"
#include "hci/loop.h"

/* Appends them to the current file of a set. */
void hci_emit_loop_blob(const hci_loop_f32 *loop, const hci_emit_loop_request *request, hci_output *out);

#endif
