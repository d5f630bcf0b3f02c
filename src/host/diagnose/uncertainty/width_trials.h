/* How widely terms may be expected that nothing tells: widths that are tried on runs left out in turn, and
 * how well each describes them.
 *
 * In: terms and runs. Out: trials with weights. No width is chosen: where the runs do not tell two apart both
 * count, each as likely as it describes them (theory.md, section 14). */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_WIDTH_TRIALS_H
#define HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_WIDTH_TRIALS_H

#include "hci/host/base/note.h"
#include "host/diagnose/uncertainty/allowed_terms.h"
#include "host/diagnose/uncertainty/power_trials.h"
#include "host/numeric/ridge.h"

enum { HCI_MOST_WIDTHS = 24 };

/* One width. */
typedef struct {
    hci_allowed_width width;
    double misfit;            /* −2 log of the likelihood of the runs left out; INFINITY: none */
    double weight;            /* share of all, 0 to 1 */
    hci_left_out_group *left; /* of each group of runs */
} hci_width_trial;

/* Start with {0}. */
typedef struct {
    hci_width_trial trial[HCI_MOST_WIDTHS];
    size_t count, best; /* best: the one with the least misfit */
    double *precision;  /* [terms], of work */
    double **share;     /* [shares]: of each group of runs, what it alone tells has no say */
    size_t shares;
    hci_power_trials powers; /* with the best of them */
} hci_width_trials;

/* trials: out; on failure as far as they came, to be released. HCI_ERROR_MEMORY, HCI_ERROR_STOPPED. O(n³/3)
 * for each width. */
hci_status hci_width_trials_make(const hci_allowed_terms *terms, const hci_condensed *runs,
                                 hci_width_trials *trials, hci_note *note);
void hci_width_trials_release(hci_width_trials *trials);

/* Places in `trial` and in `powers.trial`. */
typedef struct {
    size_t width, power;
} hci_width_place;

/* What the runs say with one of the widths and one of the powers' shares. False when memory is out or there
 * is nothing. */
bool hci_width_trials_ridge(const hci_width_trials *trials, hci_width_place at,
                            const hci_allowed_terms *terms, const hci_condensed *runs, hci_ridge *ridge);

#endif
