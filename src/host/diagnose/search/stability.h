/* Whether the effects that were found stay when runs are left out.
 *
 * In: a fitted model. Out: the model without the effects that do not help to predict a run that was not
 * fitted, and for each effect that stays, with how many of the runs left out in turn it would have been found
 * all the same. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_STABILITY_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_STABILITY_H

#include "host/diagnose/search/attribution.h"
#include "host/diagnose/search/search.h"

/* Takes out, one by one and the worst first, the effects whose presence does not lower the error of runs left
 * out in turn. Fewer than three runs are cut into parts, which stand for runs. HCI_ERROR_MEMORY.
 * O(samples·terms² + effects·runs·terms³). */
hci_status hci_search_keep_predictive(hci_search *search, hci_fitted_model *model, hci_note *note);

/* How badly a model describes runs left out in turn, in units of χ² where it describes them to their noise,
 * and less where it fails: samples × logarithm of the mean square, summed over the runs. HCI_ERROR_MEMORY. */
hci_status hci_search_left_out(hci_search *search, const hci_candidates *model, double *misfit,
                               hci_note *note);

/* What a model says of runs left out in turn: the share of the error that it takes away when they are fitted
 * that it leaves when they are not. Near 0 for what is right, about 1 for what is chosen to fit these runs
 * alone. 0 of fewer than six runs, which may each be the only one to show something. HCI_ERROR_MEMORY. */
hci_status hci_search_unpredicted(hci_search *search, const hci_candidates *model, double *share,
                                  hci_note *note);

/* Sets stays and left_out of the verdicts of effects that are in. HCI_ERROR_MEMORY. */
hci_status hci_search_stability(hci_search *search, hci_attribution *attribution, hci_note *note);

#endif
