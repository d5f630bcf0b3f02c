/* Whether what the runs without a current show by themselves can be kept where nothing else is understood. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H
#define HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* Whether it is a torque over the angle, which is asked about. */
bool hci_no_load_is_asked(const hci_effect_type *type);

/* Whether it has mostly orders that the machine does not declare, which no sensor makes of others, and either
 * shows at different speeds, where no frequency is one order, or beside so large a ripple under load that
 * this says nothing of it. */
bool hci_no_load_is_shown(const hci_dataset *dataset, const hci_runs *runs, const hci_candidates *model,
                          const hci_diagnosis *diagnosis);

/* Whether the ripple that is left of the runs under load is larger with it than that of the declared machine.
 */
bool hci_no_load_rises(const hci_dataset *dataset, const hci_runs *runs, const hci_diagnosis *diagnosis);

/* Why not, in a sentence: the ripple of the runs under load rises with it, or it may be a sensor that lags.
 * NULL: nothing speaks against it. Static. */
const char *hci_no_load_denied(const hci_dataset *dataset, const hci_runs *runs, const hci_candidates *model,
                               const hci_diagnosis *diagnosis);

#endif
