/* How much smaller terms are that grow as higher powers of the currents than what was found at an order:
 * shares that are tried on runs left out in turn.
 *
 * In: terms and runs, and the width of all else. Out: shares with weights. Runs at several currents show how
 * what was found grows, and so that there is little that grows faster; where they show nothing all shares
 * weigh alike (theory.md, section 14). */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_POWER_TRIALS_H
#define HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_POWER_TRIALS_H

#include "hci/host/base/note.h"
#include "host/diagnose/uncertainty/allowed_terms.h"
#include "host/numeric/ridge.h"

enum { HCI_MOST_POWERS = 4 };

typedef struct {
    double beyond; /* as that of hci_allowed_width */
    double misfit; /* −2 log of the density of the runs left out */
    double weight; /* share of all, 0 to 1 */
} hci_power_trial;

typedef struct {
    hci_power_trial trial[HCI_MOST_POWERS];
    size_t count;
} hci_power_trials;

/* What they are tried with. */
typedef struct {
    const hci_allowed_terms *terms;
    const hci_condensed *runs;
    hci_allowed_width width; /* with its twins; 0: none, and then nothing is tried */
    double *precision;       /* [terms], of work */
} hci_power_trials_of;

/* HCI_ERROR_MEMORY, HCI_ERROR_STOPPED. O(n³/3 + n² Σ rank) for each share. */
hci_status hci_power_trials_make(const hci_power_trials_of *of, hci_power_trials *trials, hci_note *note);

#endif
