/* Which models these rounds have been at: effects that fit as well as each other take turns otherwise, since
 * each has its own noise to be judged by, and spend the work. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SEEN_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SEEN_H

#include "host/diagnose/search/search.h"

/* Takes note of the types of a model; nothing where there have been too many. */
void hci_seen_add(hci_search *search, const hci_candidates *model);

/* Whether one had the types of this model and one more; more NULL: those of this model. */
bool hci_seen_has(const hci_search *search, const hci_candidates *model, const hci_effect_type *more);

#endif
