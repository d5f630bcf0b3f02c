#include "host/diagnose/fit/cancelling.h"

#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/model.h"

#define LEFT 0.0625 /* of the squares of what terms make, that is left of their sum where they cancel */

static bool is_asked(const hci_candidates *candidates, const hci_effect_type *type)
{
    return type->in_machine && !type->is_series && hci_candidates_have(candidates, type) &&
           !hci_candidates_are_of_whole(candidates, type);
}

/* By how much a linear term is away from its declared value; 0 of another one, and of one of another type. */
static double departure_of(const hci_model_column *c, const hci_effect_type *type)
{
    const hci_candidate *x = c->candidate;
    const unsigned traits = x->type->parameter[x->term[c->term].parameter].traits;
    return x->type == type && (traits & HCI_PARAMETER_LINEAR) ? hci_candidate_departure(x, c->term) : 0.0;
}

static bool cancels(const hci_model *m, const hci_normal_equations *normal, const hci_effect_type *type)
{
    double together = 0.0, apart = 0.0;
    for (size_t i = 0; i < m->columns; ++i) {
        const double a = departure_of(&m->column[i], type);
        if (a == 0.0) continue;
        apart += a * a * normal->gram[i * normal->n + i];
        for (size_t j = 0; j < m->columns; ++j)
            together += a * departure_of(&m->column[j], type) * normal->gram[i * normal->n + j];
    }
    return together < LEFT * apart;
}

hci_status hci_cancelling_find(const hci_regression *e, const hci_candidates *candidates,
                               const hci_effect_type **type, hci_note *note)
{
    hci_model model;
    hci_normal_equations normal;
    *type = NULL;
    hci_status status = hci_regression_normal(e, candidates, false, &normal, note);
    if (status) return status;
    status = hci_model_make(e->declared, candidates, false, &model, note);
    for (size_t r = 0; r < hci_candidate_types() && !status && !*type; ++r)
        if (is_asked(candidates, hci_candidate_type(r)) && cancels(&model, &normal, hci_candidate_type(r)))
            *type = hci_candidate_type(r);
    if (!status) hci_model_release(&model);
    hci_normal_equations_release(&normal);
    return status;
}
