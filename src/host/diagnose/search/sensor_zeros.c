#include "host/diagnose/search/sensor_zeros.h"

#include <math.h>

#include "host/diagnose/fit/current_sums.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/forward.h"

#define CONTRADICTED 2.0 /* times what zeros differ by from one run to another */

enum { PHASES = 3 };

/* Whether all torques are of a sensor. Where a shaft is held the currents are what is measured, zeros and
 * all. */
static bool are_of_sensors(const hci_regression *e)
{
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && e->runs[r].torque_source != HCI_TORQUE_MEASURED) return false;
    return true;
}

/* The type that shows in the sum of the currents whatever flows; NULL: there is none. */
static const hci_effect_type *type_of_zeros(void)
{
    size_t k = 0;
    const hci_effect_type *type;
    while ((type = hci_effect_type_at(k)) != NULL && (!type->sum_by_value || hci_candidate_is_gain(type)))
        ++k;
    return type;
}

/* A torque once an electrical turn, of a series that any phase may have and that needs no current. */
static bool is_once_a_turn(const hci_candidate *x)
{
    return x->in && x->type->any_phase && x->count > 0 && fabs(x->term[0].order - 1.0) < HCI_ORDER_TOLERANCE;
}

/* Takes such torques out. Returns whether there were any. */
static bool once_a_turn_leaves(hci_candidates *model)
{
    bool any = false;
    for (size_t k = 0; k < model->count; ++k) {
        if (!is_once_a_turn(&model->candidate[k])) continue;
        model->candidate[k].in = false;
        any = true;
    }
    return any;
}

/* Puts in the zeros of the phases that are not in. */
static hci_status zeros_enter(hci_candidates *model, const hci_effect_type *type, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t s = 0; s < PHASES && !status; ++s) {
        hci_candidate x = {.type = type, .count = 1, .price = 2.0 * log(PHASES), .in = true};
        x.term[0] = (hci_effect_term){s, 0.0, 0.0, NAN};
        if (!hci_candidates_find_in(model, &x)) status = hci_candidates_add(model, &x, note);
    }
    return status;
}

/* What zeros of all phases explain more than those of some and the torque do, they explain by no more terms:
 * the third of a star is free, and dropped if it says nothing. */
static bool is_as_good(const hci_fitted_model *zeros, const hci_fitted_model *model)
{
    return zeros->fit.score < model->fit.score + log(fmax(2.0, model->fit.rows)) + HCI_DECISIVE;
}

hci_status hci_search_sensor_zeros(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    const hci_effect_type *type = type_of_zeros();
    hci_fitted_model zeros = {0};
    *changed = false;
    if (!type || s->no_current || !are_of_sensors(s->regression)) return HCI_OK;
    hci_status status = hci_fitted_model_copy(model, &zeros, note);
    if (!status && once_a_turn_leaves(&zeros.candidates)) {
        status = zeros_enter(&zeros.candidates, type, note);
        if (!status) status = hci_search_fit(s, &zeros, note);
        *changed = !status && is_as_good(&zeros, model);
    }
    if (*changed) {
        hci_fitted_model_replace(model, &zeros);
        status = hci_search_renew(s, model, note);
    }
    hci_fitted_model_release(&zeros);
    return status;
}

/* ---- where they were read without a current ---- */

/* Whether offsets leave more of the zeros that were read than these differ by. */
static hci_status is_contradicted(const hci_search *s, const hci_candidates *model, bool *contradicted,
                                  hci_note *note)
{
    hci_model written;
    *contradicted = false;
    const hci_status status = hci_model_make(s->regression->declared, model, false, &written, note);
    if (status) return status;
    *contradicted = hci_current_zeros_rms(s->regression, &written.list) > CONTRADICTED;
    hci_model_release(&written);
    return HCI_OK;
}

/* What a model leaves of the zeros that were read, on the average of the runs in use; 0: of no sensor. */
static hci_status left_find(const hci_search *s, const hci_candidates *model, double left_A[PHASES],
                            hci_note *note)
{
    hci_model written;
    double runs[PHASES] = {0.0};
    for (size_t k = 0; k < PHASES; ++k)
        left_A[k] = 0.0;
    const hci_status status = hci_model_make(s->regression->declared, model, false, &written, note);
    if (status) return status;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        const hci_current_zeros zeros = hci_current_zeros_left(s->regression, &written.list, x);
        for (size_t k = 0; k < zeros.count; ++k) {
            left_A[zeros.phase[k]] += zeros.truth.i_abc[zeros.phase[k]];
            runs[zeros.phase[k]] += 1.0;
        }
    }
    hci_model_release(&written);
    for (size_t k = 0; k < PHASES; ++k)
        left_A[k] /= fmax(1.0, runs[k]);
    return HCI_OK;
}

/* Offsets as they were read. */
static hci_status as_read_set(const hci_search *s, hci_candidates *model, const hci_effect_type *type,
                              hci_note *note)
{
    double left_A[PHASES];
    const hci_status status = left_find(s, model, left_A, note);
    for (size_t k = 0; k < model->count && !status; ++k) {
        hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; j < x->count && x->in && x->type == type; ++j)
            x->term[j].value += left_A[x->term[j].parameter];
    }
    return status;
}

hci_status hci_search_beside_zeros(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    const hci_effect_type *type = type_of_zeros();
    hci_fitted_model read = {0};
    bool contradicted = false;
    *changed = false;
    if (!type || s->no_current || !hci_candidates_have(&model->candidates, type)) return HCI_OK;
    hci_status status = is_contradicted(s, &model->candidates, &contradicted, note);
    if (status || !contradicted) return status;
    status = hci_fitted_model_copy(model, &read, note);
    if (!status) status = zeros_enter(&read.candidates, type, note);
    if (!status) status = as_read_set(s, &read.candidates, type, note);
    if (!status) status = hci_search_forward(s, &read, changed, note);
    if (*changed) hci_fitted_model_replace(model, &read);
    hci_fitted_model_release(&read);
    return status;
}
