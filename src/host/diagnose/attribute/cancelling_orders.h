/* Orders of an effect that nearly cancel each other in what was recorded: one of two is enough. */
#ifndef HCI_SRC_HOST_DIAGNOSE_ATTRIBUTE_CANCELLING_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_ATTRIBUTE_CANCELLING_ORDERS_H

#include "host/diagnose/search/search.h"

/* model: in and out, a fitted one. HCI_ERROR_MEMORY, _STOPPED. A fit for each order that may leave. */
hci_status hci_cancelling_orders_leave(hci_search *search, hci_fitted_model *model, hci_note *note);

#endif
