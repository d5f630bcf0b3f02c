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

#endif
