/* Other effects in place of one in the model: better ones replace it, equally good ones make it ambiguous. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_RIVALS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_RIVALS_H

#include "host/diagnose/search/search.h"

/* Takes note that these rounds have been at a model. Effects that fit as well as each other take turns
 * otherwise, since each has its own noise to be judged by, and spend the work. */
void hci_search_see(hci_search *search, const hci_candidates *model);

/* Puts one effect in place of another where that fits better, unless these rounds have been at those types.
 * swapped: out. HCI_ERROR_MEMORY. */
hci_status hci_search_swap(hci_search *search, hci_fitted_model *model, bool *swapped, hci_note *note);

/* Marks the effects that could stand in place of one that is in. HCI_ERROR_MEMORY. */
hci_status hci_search_rivals(hci_search *search, const hci_effect_type *type, hci_attribution *attribution,
                             hci_note *note);

/* The model with one effect in place of another, for the values it would have; instead: out, empty where the
 * effect would not lower the score or could not be believed. HCI_ERROR_MEMORY. */
hci_status hci_search_instead(hci_search *search, const hci_fitted_model *model,
                              const hci_effect_type *in_place, const hci_effect_type *type,
                              hci_fitted_model *instead, hci_note *note);

/* Whether the runs in use tell an effect from every other one in its place: none of them fits nearly as well.
 * HCI_ERROR_MEMORY. */
hci_status hci_search_is_told(hci_search *search, const hci_fitted_model *model, const hci_effect_type *type,
                              bool *told, hci_note *note);

/* Whether an angle that is read wrong, in the place of an effect, makes most of what it explains. of_angle:
 * out. HCI_ERROR_MEMORY. */
hci_status hci_search_is_of_angle(hci_search *search, const hci_fitted_model *model,
                                  const hci_effect_type *type, bool *of_angle, hci_note *note);

#endif
