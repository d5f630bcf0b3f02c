/* Effects in place of one that is better and not borne out.
 *
 * One step takes the effect that explains most at once, and a sensor so slow that it shows no ripple explains
 * all ripple that a machine has too much of, whichever effects those are. Where runs left out, or its own
 * errors, then speak against it, it leaves, and what it stood for has never been looked for. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_WITHOUT_DENIED_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_WITHOUT_DENIED_H

#include "host/diagnose/search/search.h"

/* Where effects that explain most of what a model does would not stay in it, looks for others without them,
 * and takes those where they explain nearly as much and stay. HCI_ERROR_MEMORY. */
hci_status hci_search_without_denied(hci_search *search, hci_fitted_model *model, hci_note *note);

#endif
