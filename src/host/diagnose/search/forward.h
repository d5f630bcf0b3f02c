/* One step forward: the effect, or the two at once, that lower the score most come into the model.
 *
 * What each would bring is read off the linearised problem (candidate_models.h); the three most promising are
 * fitted in full, and the best one is taken if the score falls by more than 10. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_FORWARD_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_FORWARD_H

#include "host/diagnose/search/search.h"

/* Takes in the effect, or the two, that lower the score most. added: out, whether there was one.
 * HCI_ERROR_MEMORY. Seconds: O(samples·columns²). */
hci_status hci_search_forward(hci_search *search, hci_fitted_model *model, bool *added, hci_note *note);

/* The same without a series in the currents and without what no effect explains, and with the noise as it is:
 * scores stay comparable. Nothing comes in that does not bring the score below `least`. HCI_ERROR_MEMORY. */
hci_status hci_search_forward_few(hci_search *search, hci_fitted_model *model, double least, bool *added,
                                  hci_note *note);

#endif
