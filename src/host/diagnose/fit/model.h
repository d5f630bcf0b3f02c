/* A model written out: the declared effects of a machine with the candidates on top.
 *
 * In: declared effects and candidates. Out: one list of effects that predicts torques, and for each column of
 * the normal equations the place of its term in that list. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_MODEL_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_MODEL_H

#include "host/diagnose/candidates/candidates.h"

/* A column of the normal equations: one term of a candidate. */
typedef struct {
    const hci_candidate *candidate;
    size_t term;  /* of the candidate's */
    size_t place; /* among all terms of the list, which is where its derivative stands */
} hci_model_column;

/* Start with {0}. Release with hci_model_release. */
typedef struct {
    hci_effects list;
    hci_effect *effect;
    hci_effect_term *term;
    hci_model_column *column; /* in the order of the candidates and their terms */
    size_t columns;
} hci_model;

/* declared: the effects that the machine has; a candidate replaces the value of a declared term. all: with
 * all candidates, else with those that are in. candidates: kept as long as the model. HCI_ERROR_MEMORY, and
 * then *model is empty. O(terms). */
hci_status hci_model_make(const hci_effects *declared, const hci_candidates *candidates, bool all,
                          hci_model *model, hci_note *note);
void hci_model_release(hci_model *model);

#endif
