/* What recordings leave open about a machine that was fitted to them.
 *
 * In: the fitted model. Out: machines that the recordings allow as well (theory.md, section 14). They may
 * differ from the fitted one in its own terms, and in terms that it does not have: those of the co-energy to
 * higher powers of the currents and higher orders, each expected to be as small as iron has it. How wide that
 * expectation is and how large the errors are, is told by runs that are left out in turn. */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_UNCERTAINTY_H
#define HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_UNCERTAINTY_H

#include "hci/host/machine/uncertainty.h"
#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

enum { HCI_MOST_ALTERNATIVES = 8 };

/* Other machines that explain the recordings as well, by other effects: each is the terms that are in. */
typedef struct {
    const hci_candidates *machine[HCI_MOST_ALTERNATIVES];
    size_t count;          /* 0: none */
    double constant_share; /* standard deviation of the torque per ampere, as a share of it, where the means
                            * of the recordings do not tell it; 0: they do */
} hci_alternatives;

/* fitted: the terms of the model that are in, with their values; regression: with the noise that the model
 * leaves. Of n alternatives each makes one in n + 1 of the machines. uncertainty: out; empty where fewer than
 * three runs, or parts of runs that are long enough, tell something. HCI_ERROR_MEMORY, HCI_ERROR_STOPPED by
 * regression->watch, and then it is empty too. O(terms³/3 + runs·samples·terms²). */
hci_status hci_uncertainty_find(hci_regression *regression, const hci_candidates *fitted,
                                const hci_alternatives *alternatives, hci_uncertainty *uncertainty,
                                hci_note *note);

#endif
