/* What the runs without a current show by themselves.
 *
 * In: an empty model, and recordings of which some have no current to speak of. Out: the effects of those
 * alone, from which the search goes on. Whatever is wrong under load takes nothing away from them, and they
 * stay where the rest is not understood. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_NO_LOAD_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_NO_LOAD_H

#include "host/diagnose/search/search.h"

/* The model stays empty where no runs are without a current, or all are, or where no known effects leave
 * nothing but noise of them. Sets search->no_load. HCI_ERROR_MEMORY. */
hci_status hci_search_no_load(hci_search *search, hci_fitted_model *model, hci_note *note);

#endif
