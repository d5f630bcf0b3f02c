/* Which effects the recordings show.
 *
 * In: the dataset. Out: the model with the effects that were found, a verdict on each effect, and what no
 * effect explains. Effects come in one or two at a time while the score
 *
 *     χ² + parameters · ln(samples) + prices of the choice
 *
 * falls by more than 10 (forward), leave when it rises by less (backward), and are replaced where another
 * fits better. Then what is left is compared with the noise (settle), and what could stand in place of what
 * (rivals). */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTE_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_ATTRIBUTE_H

#include "host/diagnose/search/attribution.h"

/* regression->noise: in/out. On failure *attribution is empty. HCI_ERROR_MEMORY. Seconds: some hundred fits.
 */
hci_status hci_attribute(hci_regression *regression, const hci_attribute_options *options,
                         hci_attribution *attribution, hci_note *note);
void hci_attribution_release(hci_attribution *attribution);

#endif
