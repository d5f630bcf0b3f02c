/* What one more effect, or two, would be worth on top of a model, as far as the linearised problem tells. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_CANDIDATE_MODELS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_CANDIDATE_MODELS_H

#include "host/diagnose/search/search.h"

enum { HCI_MOST_TRIALS = HCI_MOST_TYPES * (HCI_MOST_TYPES + 1) / 2 };

/* One or two types that could come in together. */
typedef struct {
    size_t a, b; /* as in hci_suspect_type; equal for one */
    double gain; /* fall of the score */
    bool *in;    /* of each suspect of the list */
} hci_trial;

typedef struct {
    hci_trial trial[HCI_MOST_TRIALS];
    size_t count;
    hci_suspects list; /* the model and what else the recordings could show */
    bool *flags;
} hci_trials;

/* pairs: of two types too. On failure *trials is empty. HCI_ERROR_MEMORY. */
hci_status hci_trials_make(hci_search *search, const hci_suspects *model, bool pairs, hci_trials *trials,
                           hci_note *note);
void hci_trials_release(hci_trials *trials);

/* Rooms that could take over a part of what one in the model explains, since their terms look the same in all
 * these recordings. same_as: out, for each type (as in hci_suspect_type) that other one, or NULL.
 * HCI_ERROR_MEMORY. */
hci_status hci_trials_same(hci_search *search, const hci_suspects *model,
                           const hci_effect_type *same_as[HCI_MOST_TYPES], hci_note *note);

/* The model with the suspects of a trial, fitted. On failure *account is empty. HCI_ERROR_MEMORY. */
hci_status hci_trial_fit(hci_search *search, const hci_trials *trials, const hci_trial *trial,
                         hci_account *account, hci_note *note);

#endif
