/* The search for effects: where it stands, and the steps that it is made of. Private to the search. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_SEARCH_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_SEARCH_H

#include "host/diagnose/search/attribute.h"

#define HCI_DECISIVE 10.0 /* fall of the score that makes an effect believed: odds of 150 to 1 */
#define HCI_AS_GOOD  0.5  /* scores that differ by less are the same */

typedef struct {
    hci_regression *regression;
    const hci_attribute_options *options;
    double *residual_Nm, *variance; /* of each sample, of the model looked at last */
    int richness;                   /* of saturation */
    const char *doing;
    double share, until; /* of all work: done so far, and when the step at hand is done */
} hci_search;

/* Tells of a step that takes the work from one share of the whole to another. */
void hci_search_begin(hci_search *search, const char *doing, double from, double until);
/* Tells of a part of it: there is no knowing how many follow, so each takes a little of what is left. */
void hci_search_tell(hci_search *search);

/* ---- models ---- */

/* HCI_ERROR_MEMORY, and then `to` is empty. */
hci_status hci_fitted_model_copy(const hci_fitted_model *from, hci_fitted_model *to, hci_note *note);
void hci_fitted_model_replace(hci_fitted_model *old, hci_fitted_model *by); /* `by` is empty then */
void hci_fitted_model_release(hci_fitted_model *fitted);

/* An fitted without a type, fitted again. On failure `without` is empty. HCI_ERROR_MEMORY. */
hci_status hci_search_without(hci_search *search, const hci_fitted_model *fitted, const hci_effect_type *type,
                              hci_fitted_model *without, hci_note *note);

/* ---- residual and noise ---- */

/* Sets residual_Nm. HCI_ERROR_MEMORY. */
hci_status hci_search_residual(hci_search *search, const hci_candidates *candidates, hci_note *note);
/* The same of the readings as they are, and the noise of every segment from it. */
hci_status hci_search_noise(hci_search *search, const hci_candidates *candidates, hci_note *note);
/* Finds the noise anew and fits again: scores from before are no longer comparable. */
hci_status hci_search_renew(hci_search *search, hci_fitted_model *fitted, hci_note *note);

/* Root mean square over the runs in use, N·m. */
double hci_search_residual_rms(const hci_search *search);
double hci_search_noise_rms(const hci_search *search);

/* explained_Nm: out, rms of what the model with an effect describes and the one without does not.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_explained(hci_search *search, const hci_candidates *with, const hci_candidates *without,
                                double *explained_Nm, hci_note *note);

/* Whether that is large enough to matter; an effect that is in may always become more exact. */
hci_status hci_search_noticeable(hci_search *search, const hci_candidates *with,
                                 const hci_candidates *without, bool *noticeable, hci_note *note);

/* ---- steps: each may replace the fitted, and says whether it did. HCI_ERROR_MEMORY ---- */

/* Takes in the effect, or the two, that lower the score most. */
hci_status hci_search_forward(hci_search *search, hci_fitted_model *fitted, bool *added, hci_note *note);
/* Lets go of single orders that are not worth their price. */
hci_status hci_search_prune(hci_search *search, hci_fitted_model *fitted, hci_note *note);
/* Lets go of one effect that is no longer decisive, or too small to matter. */
hci_status hci_search_drop(hci_search *search, hci_fitted_model *fitted, bool *dropped, hci_note *note);
/* Puts one effect in place of another where that fits better. */
hci_status hci_search_swap(hci_search *search, hci_fitted_model *fitted, bool *swapped, hci_note *note);

/* ---- verdicts ---- */

/* Judges what is left, and whether known effects stand beside something larger that is not understood: sets
 * unknown, wanders and unexplained_Nm, and may take effects out. HCI_ERROR_MEMORY. */
hci_status hci_search_settle(hci_search *search, hci_attribution *attribution, hci_note *note);

/* Marks the effects that could stand in place of one that is in. HCI_ERROR_MEMORY. */
hci_status hci_search_rivals(hci_search *search, const hci_effect_type *type, hci_attribution *attribution,
                             hci_note *note);

#endif
