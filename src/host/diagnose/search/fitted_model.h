/* A model that has been fitted: candidates with their values, and how well they describe the recordings. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_FITTED_MODEL_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_FITTED_MODEL_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/fit/fit.h"

/* Start with {0}. */
typedef struct {
    hci_candidates candidates; /* those that are in have values and standard errors */
    hci_fit fit;
} hci_fitted_model;

/* HCI_ERROR_MEMORY, and then `to` is empty. */
hci_status hci_fitted_model_copy(const hci_fitted_model *from, hci_fitted_model *to, hci_note *note);
void hci_fitted_model_replace(hci_fitted_model *old, hci_fitted_model *by); /* `by` is empty then */
void hci_fitted_model_release(hci_fitted_model *model);

#endif
