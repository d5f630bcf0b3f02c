/* All models with one more effect, or two, and by how much each would lower the score if it were linear. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_CANDIDATE_MODELS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_CANDIDATE_MODELS_H

#include "host/diagnose/search/search.h"

enum { HCI_MOST_CANDIDATE_MODELS = HCI_MOST_TYPES * (HCI_MOST_TYPES + 1) / 2 };

/* One or two types that could come in together. */
typedef struct {
    size_t a, b;  /* as in hci_candidate_type; equal for one */
    double gain;  /* fall of the score */
    bool *in;     /* of each candidate of the list */
    size_t terms; /* of those */
} hci_candidate_model;

typedef struct {
    hci_candidate_model model[HCI_MOST_CANDIDATE_MODELS];
    size_t count;
    hci_candidates list; /* the model and what else the recordings could show */
    bool *flags;
} hci_candidate_models;

/* pairs: of two types too. On failure *models is empty. HCI_ERROR_MEMORY. */
hci_status hci_candidate_models_make(hci_search *search, const hci_candidates *model, bool pairs,
                                     hci_candidate_models *models, hci_note *note);
void hci_candidate_models_release(hci_candidate_models *models);

/* Effects that could take over a part of what one in the model explains, since their terms look the same in
 * all these recordings. same_as: out, for each type (as in hci_candidate_type) that other one, or NULL.
 * HCI_ERROR_MEMORY. */
hci_status hci_candidate_models_same(hci_search *search, const hci_candidates *model,
                                     const hci_effect_type *same_as[HCI_MOST_TYPES], hci_note *note);

/* The model with the candidates of a model, fitted as far as its score may come below a bar. On failure
 * *fitted is empty. HCI_ERROR_MEMORY. */
hci_status hci_candidate_model_fit(hci_search *search, const hci_candidate_models *models,
                                   const hci_candidate_model *model, double bar, hci_fitted_model *fitted,
                                   hci_note *note);

#endif
