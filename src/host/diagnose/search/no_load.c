#include "host/diagnose/search/no_load.h"

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/rounds.h"
#include "host/diagnose/search/settle.h"
#include "host/diagnose/search/stability.h"

#define LITTLE 0.01 /* of the largest current, that is none */

/* ---- which runs ---- */

static double largest_A(const hci_regression *e)
{
    double most = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && e->samples->statistics[r].current_A > most)
            most = e->samples->statistics[r].current_A;
    return most;
}

/* Runs in use, of a sensor of torque, whose current is none. Returns how many. */
static size_t runs_find(const hci_regression *e, bool *use)
{
    const double least_A = LITTLE * largest_A(e);
    size_t count = 0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        use[r] = e->use[r] && e->runs[r].torque_source == HCI_TORQUE_MEASURED &&
                 e->samples->statistics[r].current_A < least_A;
        count += use[r];
    }
    return count;
}

/* ---- their effects ---- */

/* Known effects that leave nothing but noise, and that each of the runs tells by itself. found: out. */
static hci_status effects_find(hci_search *s, hci_fitted_model *model, bool *found, hci_note *note)
{
    hci_status status = hci_search_rounds(s, model, note);
    *found = false;
    if (!status) status = hci_search_keep_predictive(s, model, note);
    if (!status) status = hci_search_drop_unsure(s, model, note);
    if (!status) status = hci_search_is_noise(s, &model->candidates, found, note);
    *found = *found && !hci_candidates_have(&model->candidates, &hci_empirical_type);
    return status;
}

static hci_status of_runs(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    bool found = false;
    s->no_current = true;
    hci_status status = effects_find(s, model, &found, note);
    s->no_current = false;
    if (!status && found) return hci_fitted_model_copy(model, &s->no_load, note);
    hci_fitted_model_release(model);
    return status;
}

hci_status hci_search_no_load(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_regression *e = s->regression;
    const bool *all = e->use;
    bool *use = hci_memory_new(e->samples->run_count + 1, sizeof *use);
    if (!use) return hci_note_memory(note, NULL, "runs without a current");
    hci_status status = HCI_OK;
    if (runs_find(e, use) > 0) {
        e->use = use;
        status = of_runs(s, model, note);
        e->use = all;
    }
    hci_memory_free(use);
    return status;
}
