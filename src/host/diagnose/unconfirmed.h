/* What a search that has ended at the limit of its work took in, and that nothing has confirmed.
 *
 * Such a search has not been at others that may describe the same. An effect is confirmed all the same where
 * it is found with other runs left out, has been compared with all that could stand in its place, and what is
 * not understood is small beside it, in the runs that were fitted and in those held out; and none, where one
 * that could stand in the place of another is better than that. */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCONFIRMED_H
#define HCI_SRC_HOST_DIAGNOSE_UNCONFIRMED_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/search/attribution.h"

/* Whether an effect that is in the model is not confirmed; not of one that the runs without a current show by
 * themselves. */
bool hci_is_unconfirmed(const hci_attribution *attribution, const hci_diagnosis *diagnosis,
                        const hci_verdict *verdict);

#endif
