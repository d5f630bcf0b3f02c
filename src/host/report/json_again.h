/* What new recordings say of the last diagnosis, in summary.json. */
#ifndef HCI_SRC_HOST_REPORT_JSON_AGAIN_H
#define HCI_SRC_HOST_REPORT_JSON_AGAIN_H

#include "hci/host/diagnose/again.h"
#include "host/base/json.h"

/* The object `again`. */
void hci_again_put(hci_json *json, const hci_again *again);

#endif
