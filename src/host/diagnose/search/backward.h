/* Steps backward: what the model no longer needs leaves it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_BACKWARD_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_BACKWARD_H

#include "host/diagnose/search/search.h"

/* Lets go of single orders whose part of χ² is less than their price, while a fit without them is as good.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_prune(hci_search *search, hci_fitted_model *model, hci_note *note);

/* Lets go of one effect that is no longer decisive, or too small to matter. dropped: out. HCI_ERROR_MEMORY.
 */
hci_status hci_search_drop(hci_search *search, hci_fitted_model *model, bool *dropped, hci_note *note);

/* Lets go, one after the other, of effects that do not pay their price once standard errors count what the
 * noise has in common over many samples: a wander that looks like an order for a while. HCI_ERROR_MEMORY. */
hci_status hci_search_drop_unsure(hci_search *search, hci_fitted_model *model, hci_note *note);

/* By how much the order of a type that is surest pays more than its price, by the standard errors that it
 * has; INFINITY where these do not tell. */
double hci_search_sureness(const hci_candidates *model, const hci_effect_type *type, double rows);

#endif
