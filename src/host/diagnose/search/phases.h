/* What recordings do not tell of sensors and phases. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_PHASES_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_PHASES_H

#include "host/diagnose/search/attribution.h"

/* Marks as ambiguous what is in the model and may be of the other kind, and writes down the machine that it
 * would then be, as the `alternative` of a verdict that is in:
 *
 *   - gains of the current sensors and of the phases at once, or back-EMFs of order 1 that differ. The torque
 * e·(1 + m)·i is that of sensors with the gains −m, and where all sensors read the same share of some current
 * besides, the sum of the currents is what it was found to be. So sensors alone, that read each other's
 * current, make it all.
 *   - gains of two sensors that are alike, and of the third another one: the common part is as well a magnet
 *     of another strength.
 *
 * HCI_ERROR_MEMORY. */
hci_status hci_search_phases_mark(hci_attribution *attribution, hci_note *note);

#endif
