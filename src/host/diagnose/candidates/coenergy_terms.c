#include "host/diagnose/candidates/coenergy_terms.h"

#include <math.h>
#include <string.h>

typedef struct {
    hci_candidates *all;
    const hci_effect_type *type; /* of what is added */
    hci_note *note;
    hci_status status;
} builder;

/* The candidate that has a term already; NULL: none. */
static hci_candidate *owner_of(const builder *b, const hci_effect_term *term)
{
    for (size_t k = 0; k < b->all->count; ++k) {
        hci_candidate *x = &b->all->candidate[k];
        for (size_t j = 0; x->type == b->type && j < x->count; ++j)
            if (x->term[j].parameter == term->parameter &&
                fabs(x->term[j].order - term->order) <= HCI_ORDER_TOLERANCE)
                return x;
    }
    return NULL;
}

/* For hci_effect_proposals: context is a builder. */
static void add(void *context, const hci_effect_candidate *x)
{
    builder *b = context;
    const hci_effect_term term = {x->parameter, x->order, 0.0, NAN};
    hci_candidate *owner = owner_of(b, &term);
    if (owner) {
        owner->coenergy_unit = x->expected;
        owner->power = x->power;
    } else if (!b->status) {
        const hci_candidate added = {.type = b->type,
                                     .term = {term},
                                     .count = 1,
                                     .coenergy_unit = x->expected,
                                     .power = x->power,
                                     .in = true};
        b->status = hci_candidates_add(b->all, &added, b->note);
    }
}

/* Those that are in. */
static hci_status keep(const hci_candidates *known, hci_candidates *all, hci_note *note)
{
    hci_status status = HCI_OK;
    memset(all, 0, sizeof *all);
    all->reference_current_A = known->reference_current_A;
    for (size_t k = 0; k < known->count && !status; ++k)
        if (known->candidate[k].in) status = hci_candidates_add(all, &known->candidate[k], note);
    return status;
}

hci_status hci_coenergy_terms(const hci_candidates *known, const hci_effect_coenergy_series *series,
                              hci_candidates *all, hci_note *note)
{
    builder b = {all, NULL, note, keep(known, all, note)};
    const hci_effect_proposals to = {add, &b};
    for (size_t r = 0; (b.type = hci_effect_type_at(r)) != NULL; ++r)
        if (b.type->propose_coenergy) b.type->propose_coenergy(series, &to);
    if (b.status) hci_candidates_release(all);
    return b.status;
}
