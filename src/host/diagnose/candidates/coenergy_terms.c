#include "host/diagnose/candidates/coenergy_terms.h"

#include <math.h>
#include <string.h>

#define UNLIKE 0.1 /* of what is usual at an order, from which on it was found: less is noise */

typedef struct {
    hci_candidates *all;
    const hci_effect_type *type; /* of what is added */
    const bool *place;           /* [HCI_COENERGY_ORDERS]: of which orders; NULL: of all */
    bool unlike;                 /* what a rotor that looks alike both ways round does not have */
    hci_note *note;
    hci_status status;
} builder;

size_t hci_coenergy_place(double order)
{
    const double place = floor((order + 1.0) / 6.0);
    return place < HCI_COENERGY_ORDERS ? (size_t)place : HCI_COENERGY_ORDERS - 1;
}

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
    if (b->place && !b->place[hci_coenergy_place(x->order)]) return;
    if (owner) {
        owner->coenergy_unit = x->expected;
        owner->power = x->power;
    } else if (!b->status) {
        const hci_candidate added = {.type = b->type,
                                     .term = {term},
                                     .count = 1,
                                     .coenergy_unit = x->expected,
                                     .power = x->power,
                                     .unlike = b->unlike,
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

static void propose(builder *b, const hci_effect_coenergy_series *series)
{
    const hci_effect_proposals to = {add, b};
    for (size_t r = 0; (b->type = hci_effect_type_at(r)) != NULL; ++r)
        if (b->type->propose_coenergy) b->type->propose_coenergy(series, &to);
}

hci_status hci_coenergy_terms(const hci_candidates *known, const hci_effect_coenergy_series *series,
                              hci_candidates *all, hci_note *note)
{
    builder b = {all, NULL, NULL, false, note, keep(known, all, note)};
    propose(&b, series);
    if (b.status) hci_candidates_release(all);
    return b.status;
}

/* ---- what was found ---- */

typedef struct {
    const hci_candidates *known;
    const hci_effect_type *type;
    double *size, *squares;
} meter;

/* For hci_effect_proposals: context is a meter. */
static void measure(void *context, const hci_effect_candidate *x)
{
    const meter *m = context;
    if (x->power == 0) return;
    const size_t place = hci_coenergy_place(x->order);
    double size = 0.0;
    for (size_t k = 0; k < m->known->count; ++k) {
        const hci_candidate *c = &m->known->candidate[k];
        for (size_t j = 0; c->in && c->type == m->type && j < c->count; ++j)
            if (c->term[j].parameter == x->parameter &&
                fabs(c->term[j].order - x->order) <= HCI_ORDER_TOLERANCE)
                size = fmax(size, fabs(hci_candidate_departure(c, j)) / x->expected);
    }
    m->size[place] = fmax(m->size[place], size);
    if (x->power > 1) m->squares[place] = fmax(m->squares[place], size);
}

void hci_coenergy_sizes_of(const hci_candidates *known, const hci_effect_coenergy_series *series,
                           hci_coenergy_sizes *sizes)
{
    hci_effect_coenergy_series to_measure = *series;
    memset(sizes, 0, sizeof *sizes);
    for (int unlike = 0; unlike < 2; ++unlike) {
        meter m = {known, NULL, unlike ? sizes->unlike : sizes->usual,
                   unlike ? sizes->unlike_squares : sizes->usual_squares};
        const hci_effect_proposals to = {measure, &m};
        to_measure.unlike = unlike == 1;
        for (size_t r = 0; (m.type = hci_effect_type_at(r)) != NULL; ++r)
            if (m.type->propose_coenergy) m.type->propose_coenergy(&to_measure, &to);
    }
}

hci_status hci_coenergy_terms_unlike(const hci_coenergy_sizes *sizes,
                                     const hci_effect_coenergy_series *series, hci_candidates *all,
                                     hci_note *note)
{
    bool place[HCI_COENERGY_ORDERS];
    builder b = {all, NULL, place, true, note, HCI_OK};
    hci_effect_coenergy_series unlike = *series;
    unlike.unlike = true;
    for (size_t k = 0; k < HCI_COENERGY_ORDERS; ++k)
        place[k] = sizes->unlike[k] > UNLIKE * sizes->usual[k];
    propose(&b, &unlike);
    if (b.status) hci_candidates_release(all);
    return b.status;
}
