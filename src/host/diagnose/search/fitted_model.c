#include "host/diagnose/search/fitted_model.h"

#include <string.h>

hci_status hci_fitted_model_copy(const hci_fitted_model *from, hci_fitted_model *to, hci_note *note)
{
    to->fit = from->fit;
    return hci_candidates_copy(&from->candidates, &to->candidates, note);
}

void hci_fitted_model_replace(hci_fitted_model *old, hci_fitted_model *by)
{
    hci_fitted_model_release(old);
    *old = *by;
    memset(by, 0, sizeof *by);
}

void hci_fitted_model_release(hci_fitted_model *model)
{
    hci_candidates_release(&model->candidates);
    memset(model, 0, sizeof *model);
}
