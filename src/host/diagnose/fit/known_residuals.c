#include "host/diagnose/fit/known_residuals.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/reading/predicted_reading.h"

static void residual_release(hci_known_residual *x)
{
    hci_memory_free(x->effect);
    hci_memory_free(x->term);
    hci_memory_free(x->use);
    hci_memory_free(x->residual_Nm);
    memset(x, 0, sizeof *x);
}

static bool is_same_effect(const hci_effect *a, const hci_effect *b)
{
    if (a->type != b->type || a->count != b->count) return false;
    for (size_t k = 0; k < a->count; ++k)
        if (a->term[k].parameter != b->term[k].parameter || a->term[k].order != b->term[k].order ||
            a->term[k].value != b->term[k].value)
            return false;
    return true;
}

static bool is_same(const hci_known_residual *x, const hci_regression *e, const hci_effects *effects)
{
    if (!x->residual_Nm || x->effects != effects->count || x->raw != e->raw || x->free_means != e->free_means)
        return false;
    for (size_t k = 0; k < effects->count; ++k)
        if (!is_same_effect(&x->effect[k], &effects->effect[k])) return false;
    return memcmp(x->use, e->use, e->samples->run_count * sizeof *x->use) == 0;
}

static void model_copy(hci_known_residual *x, const hci_effects *effects)
{
    hci_effect_term *to = x->term;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *from = &effects->effect[k];
        if (from->count > 0) memcpy(to, from->term, from->count * sizeof *to);
        x->effect[k] = (hci_effect){from->type, to, from->count};
        to += from->count;
    }
    x->effects = effects->count;
}

/* Where memory is out nothing is kept. */
static void keep(hci_known_residual *x, const hci_regression *e, const hci_effects *effects,
                 const double *residual_Nm, double work)
{
    const size_t runs = e->samples->run_count, samples = e->samples->count;
    residual_release(x);
    x->effect = hci_memory_new(effects->count + 1, sizeof *x->effect);
    x->term = hci_memory_new(hci_effects_terms(effects) + 1, sizeof *x->term);
    x->use = hci_memory_new(runs + 1, sizeof *x->use);
    x->residual_Nm = hci_memory_new(samples + 1, sizeof *x->residual_Nm);
    if (!x->effect || !x->term || !x->use || !x->residual_Nm) {
        residual_release(x);
        return;
    }
    model_copy(x, effects);
    memcpy(x->use, e->use, runs * sizeof *x->use);
    memcpy(x->residual_Nm, residual_Nm, samples * sizeof *x->residual_Nm);
    x->raw = e->raw;
    x->free_means = e->free_means;
    x->work = work;
}

hci_status hci_known_residuals_find(hci_known_residuals *known, const hci_regression *e,
                                    const hci_effects *effects, double *residual_Nm, hci_note *note)
{
    hci_known_residual *oldest = &known->model[0];
    for (size_t k = 0; k < HCI_KNOWN_RESIDUALS; ++k) {
        hci_known_residual *x = &known->model[k];
        if (x->asked < oldest->asked) oldest = x;
        if (!is_same(x, e, effects)) continue;
        memcpy(residual_Nm, x->residual_Nm, e->samples->count * sizeof *residual_Nm);
        hci_regression_count_products(e, x->work);
        x->asked = ++known->asked;
        return HCI_OK;
    }
    const double before = e->work ? *e->work : 0.0;
    const hci_status status = hci_regression_residual(e, effects, residual_Nm, note);
    if (status) return status;
    keep(oldest, e, effects, residual_Nm, e->work ? *e->work - before : 0.0);
    oldest->asked = ++known->asked;
    return HCI_OK;
}

void hci_known_residuals_release(hci_known_residuals *known)
{
    for (size_t k = 0; k < HCI_KNOWN_RESIDUALS; ++k)
        residual_release(&known->model[k]);
    memset(known, 0, sizeof *known);
}
