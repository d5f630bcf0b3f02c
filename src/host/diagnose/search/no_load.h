/* What the runs without a current show by themselves.
 *
 * In: an empty model, and recordings of which some have no current to speak of. Out: the effects of those
 * alone, from which the search goes on. Whatever is wrong under load takes nothing away from them, and they
 * stay where the rest is not understood. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_NO_LOAD_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_NO_LOAD_H

#include "host/diagnose/search/search.h"

/* use: out, [runs], which they are. The model stays empty where none is without a current, or where no known
 * effects leave nothing but noise of them. Sets no_load of the attribution too. HCI_ERROR_MEMORY. */
hci_status hci_search_no_load(hci_search *search, bool *use, hci_attribution *attribution, hci_note *note);

/* Whether the other runs show the torque of the declared machine with the opposite sign. HCI_ERROR_MEMORY. */
hci_status hci_search_opposite(hci_search *search, bool *opposite, hci_note *note);

/* Where something is not known: what they show stays; where that looks like a slip, their means alone. Sets
 * no_load_alone where nothing else does, and then the model is theirs. HCI_ERROR_MEMORY. */
hci_status hci_search_no_load_stays(hci_search *search, hci_attribution *attribution, hci_note *note);

#endif
