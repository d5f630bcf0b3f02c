/* A model that has been fitted: candidates with their values, and how well they describe the recordings. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_FITTED_MODEL_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_FITTED_MODEL_H

#include <string.h>

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/fit.h"

/* Start with {0}. */
typedef struct {
    hci_candidates candidates; /* those that are in have values and standard errors */
    hci_fit fit;
} hci_fitted_model;

/* HCI_ERROR_MEMORY, and then `to` is empty. */
static inline hci_status hci_fitted_model_copy(const hci_fitted_model *from, hci_fitted_model *to,
                                               hci_note *note)
{
    to->fit = from->fit;
    return hci_candidates_copy(&from->candidates, &to->candidates, note);
}

static inline void hci_fitted_model_release(hci_fitted_model *model)
{
    hci_candidates_release(&model->candidates);
    memset(model, 0, sizeof *model);
}

/* `by` is empty then. */
static inline void hci_fitted_model_replace(hci_fitted_model *old, hci_fitted_model *by)
{
    hci_fitted_model_release(old);
    *old = *by;
    memset(by, 0, sizeof *by);
}

#endif
