/* Whether what the runs without a current show by themselves can be kept where nothing else is understood. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H
#define HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* Whether it is a torque over the angle, which is asked about. */
bool hci_no_load_is_asked(const hci_effect_type *type);

/* Why not, in a sentence: the ripple of the runs under load rises with it, or it may be a sensor that lags.
 * NULL: nothing speaks against it. Static. */
const char *hci_no_load_denied(const hci_dataset *dataset, const hci_runs *runs, const hci_candidates *model,
                               const hci_diagnosis *diagnosis);

#endif
