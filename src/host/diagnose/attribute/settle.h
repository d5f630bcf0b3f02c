/* What it means for the effects that were found that what is left is noise, or is not. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SETTLE_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SETTLE_H

#include "host/diagnose/search/search.h"

/* Compares what is left with the noise, and finds whether known effects stand beside something larger that is
 * not understood: sets unknown, wanders and unexplained_Nm, and may take effects out. HCI_ERROR_MEMORY. */
hci_status hci_search_settle(hci_search *search, hci_attribution *attribution, hci_note *note);

#endif
