/* What the search has found, as findings of a diagnosis: parameters in words, most important first. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FINDINGS_H
#define HCI_SRC_HOST_DIAGNOSE_FINDINGS_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* Fills finding, most important first, and the verdict. rms_before_Nm of the diagnosis is there already. */
void hci_findings_fill(const hci_attribution *attribution, hci_diagnosis *diagnosis);

/* Puts what no effect explains first, in place of what the search says of it. words: behind its rms. */
void hci_finding_unknown_put(hci_diagnosis *diagnosis, double unexplained_Nm, const char *words);

/* Its fall of the BIC; NAN where it is not known: the search looks no further at an effect of which no part
 * by itself lets the criterion fall. */
double hci_finding_delta_bic(const hci_finding *finding);

/* Fills unexplained and wanders: what the search describes without knowing it. */
void hci_unexplained_fill(const hci_dataset *dataset, const hci_attribution *attribution,
                          hci_diagnosis *diagnosis);

#endif
