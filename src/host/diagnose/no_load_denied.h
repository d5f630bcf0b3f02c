/* Whether what the runs without a current show by themselves can be kept where nothing else is understood. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H
#define HCI_SRC_HOST_DIAGNOSE_NO_LOAD_DENIED_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* Whether it is a torque over the angle, which is asked about. */
bool hci_no_load_is_asked(const hci_effect_type *type);

/* Whether most of it has orders that the machine does not declare, or far larger ones: a sensor that lags,
 * averages or has play changes a torque that is there, and adds no order of the turn. */
bool hci_no_load_is_new(const hci_machine *machine, const hci_candidates *model);

/* Whether the ripple that is left of the runs under load is larger with it than that of the declared machine.
 */
bool hci_no_load_rises(const hci_dataset *dataset, const hci_runs *runs, const hci_diagnosis *diagnosis);

/* Why not, in a sentence: the ripple of the runs under load rises with it, or it may be a sensor that lags.
 * NULL: nothing speaks against it. Static. */
const char *hci_no_load_denied(const hci_dataset *dataset, const hci_runs *runs, const hci_candidates *model,
                               const hci_diagnosis *diagnosis);

#endif
