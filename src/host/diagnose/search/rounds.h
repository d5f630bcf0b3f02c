/* The rounds of the search: one effect more, those out that it makes superfluous, one in place of another.
 *
 * In: an empty model. Out: the model that the score asks for. Where something that no effect explains is in
 * it, known effects are looked for once more without that, and are taken where they leave nothing but
 * noise. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_ROUNDS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_ROUNDS_H

#include "host/diagnose/search/search.h"

#define HCI_ROUNDS_SHARE 0.7 /* of the whole work */

/* HCI_ERROR_MEMORY. */
hci_status hci_search_rounds(hci_search *search, hci_fitted_model *model, hci_note *note);

/* Where effects of sensors that explain most of what a model does would not stay in it, looks for others
 * without them, and takes those where they explain nearly as much and stay. One step takes the effect that
 * explains most at once, and a sensor so slow that it shows no ripple explains all ripple that a machine has
 * too much of, whichever effects those are. Where runs left out, or its own errors, then speak against it, it
 * leaves, and what it stood for has never been looked for. HCI_ERROR_MEMORY. */
hci_status hci_search_without_denied(hci_search *search, hci_fitted_model *model, hci_note *note);

#endif
