/* Which fitted models nobody would believe, however well they describe the recordings.
 *
 * In: a machine with the effects of a model. Out: whether it keeps a torque per ampere, whether its sensors
 * are as good as sensors are, and whether what brakes does not drive. Recordings that were meant otherwise
 * (another sign, unit or motor) are described best by a machine that hardly makes torque, and an effect that
 * is missing in the catalogue by sensors with large errors. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_BELIEF_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_BELIEF_H

#include "host/diagnose/search/search.h"

/* Fits a model. One that cannot be believed gets the score INFINITY, so that nothing is worse; the best of
 * those is kept in search->disbelieved. HCI_ERROR_MEMORY. */
hci_status hci_search_fit(hci_search *search, hci_fitted_model *model, hci_note *note);
/* The same as far as its score may come below a bar; where it will not, it stays above it. */
hci_status hci_search_fit_below(hci_search *search, hci_fitted_model *model, double bar, hci_note *note);

/* What a model leaves of the declared torque per ampere, as a share; 1 where none is declared.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_constant_share(const hci_search *search, const hci_candidates *candidates,
                                     double *share, hci_note *note);

/* Takes the types out of a model that was fitted without that, one by one, whose values cannot be believed or
 * which take the torque per ampere away; with the noise found anew. HCI_ERROR_MEMORY. */
hci_status hci_search_keep_believed(hci_search *search, hci_fitted_model *model, hci_note *note);

/* The same of what brakes and would drive, and of a mean torque of the iron that keeps its sign with the
 * load, whatever the search went through on its way: the best of such models is kept in search->disbelieved.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_keep_brakes(hci_search *search, hci_fitted_model *model, hci_note *note);

/* How well the best model that is not believed describes the recordings, beside the one that is. */
typedef enum {
    HCI_YIELD_NOTHING, /* worse, or there is none */
    HCI_YIELD_RIVAL,   /* nearly as well or better */
    HCI_YIELD_BETTER   /* decisively better */
} hci_yield;

/* Where the model that is not believed is better, something unknown is behind both, and only what both have
 * in common stays. HCI_ERROR_MEMORY. */
hci_status hci_search_yield(hci_search *search, hci_fitted_model *model, hci_yield *yield, hci_note *note);

#endif
