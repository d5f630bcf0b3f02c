/* From what a search has found to the verdict: what runs held out, those without a current and voltages say
 * of it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CONCLUDE_H
#define HCI_SRC_HOST_DIAGNOSE_CONCLUDE_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* a: effects that do not stand leave its model. d: empty but for resolution_Nm. HCI_ERROR_MEMORY. A few fits,
 * and what hci_diagnosis_fill costs each time that something leaves. */
hci_status hci_conclude(hci_dataset *b, const hci_machine_data *machine, const hci_runs *runs,
                        hci_attribution *a, hci_diagnosis *d, hci_note *note);

#endif
