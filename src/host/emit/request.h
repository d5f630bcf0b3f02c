/* What may be asked of emit. */
#ifndef HCI_SRC_HOST_EMIT_REQUEST_H
#define HCI_SRC_HOST_EMIT_REQUEST_H

#include "hci/host/emit/emit.h"

/* Letters of the longest table name. */
enum { HCI_EMIT_NAME_LENGTH = 48 };

/* Whether the name of a machine may stand in a comment. HCI_OK or HCI_ERROR_ARGUMENT. */
hci_status hci_emit_check_facts(const hci_emit_facts *facts, hci_note *note);

/* HCI_OK, HCI_ERROR_ARGUMENT or _NOT_FINITE. */
hci_status hci_emit_request_check(const hci_emit_request *request, hci_note *note);

#endif
