/* Means of recordings that nothing explains, or that runs left out deny: what the ripple tells stays. */
#ifndef HCI_SRC_HOST_DIAGNOSE_ATTRIBUTE_SETTLE_MEANS_H
#define HCI_SRC_HOST_DIAGNOSE_ATTRIBUTE_SETTLE_MEANS_H

#include "host/diagnose/search/search.h"

/* Each: HCI_ERROR_MEMORY, _STOPPED; some fits. */

/* Goes back from a whole co-energy to single terms where its means keep their sign with the load, as no
 * iron's do, and those of the single terms turn it. model: in and out. */
hci_status hci_settle_mirror(hci_search *search, hci_fitted_model *model, hci_note *note);

/* Takes out what explains the means of the runs and not those of runs left out, and sets means_open and
 * means_alone. unpredicted: out, effects are there and something else is missing. */
hci_status hci_settle_means(hci_search *search, hci_attribution *attribution, bool *unpredicted,
                            hci_note *note);

/* Iron that saturates leaves where a mean of each run that is another one describes the recordings better. */
hci_status hci_settle_saturation(hci_search *search, hci_attribution *attribution, hci_note *note);

/* What describes the ripple comes back where settling took it out for the sake of means. before: the model
 * that was settled; what is left in it is of no use. */
hci_status hci_settle_ripple(hci_search *search, hci_attribution *attribution, hci_fitted_model *before,
                             hci_note *note);

#endif
