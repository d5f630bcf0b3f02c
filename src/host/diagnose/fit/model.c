#include "host/diagnose/fit/model.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

static bool same_term(const hci_effect_term *a, const hci_effect_term *b)
{
    return a->parameter == b->parameter && fabs(a->order - b->order) < HCI_ORDER_TOLERANCE;
}

static const hci_effect *declared_of(const hci_effects *declared, const hci_effect_type *type)
{
    for (size_t k = 0; k < declared->count; ++k)
        if (declared->effect[k].type == type) return &declared->effect[k];
    return NULL;
}

/* The terms of one type while they are collected: places first … end − 1 of the model's list. */
typedef struct {
    hci_model *model;
    const hci_effect_type *type;
    const hci_effect *before; /* what is declared of it, or NULL */
    size_t first, end;
} collection;

/* Adds a term unless the effect has it; then its value is replaced. Returns its place. Candidates are all
 * different, so that only declared terms have to be looked through. */
static size_t term_put(collection *c, const hci_effect_term *term)
{
    size_t at = c->before ? c->first : c->end;
    while (at < c->end && !same_term(&c->model->term[at], term))
        ++at;
    c->model->term[at] = *term;
    if (at == c->end) ++c->end;
    return at;
}

static bool candidates_put(collection *c)
{
    bool any = false;
    for (size_t k = 0; k < c->model->columns; ++k) {
        hci_model_column *column = &c->model->column[k];
        if (column->candidate->type != c->type) continue;
        column->place = term_put(c, &column->candidate->term[column->term]);
        any = true;
    }
    return any;
}

/* The current at which the values of the effect hold, where it has one that is not declared. */
static void reference_put(collection *c, double reference_current_A)
{
    for (size_t k = 0; k < c->type->parameter_count && !c->before; ++k)
        if (c->type->parameter[k].traits & HCI_PARAMETER_REFERENCE_CURRENT)
            c->model->term[c->end++] = (hci_effect_term){k, 0.0, reference_current_A, NAN};
}

/* Returns the end of the type's terms. */
static size_t type_put(hci_model *m, const hci_effect_type *type, const hci_effects *declared,
                       double reference_current_A, size_t first)
{
    collection c = {m, type, declared_of(declared, type), first, first};
    for (size_t k = 0; c.before && k < c.before->count; ++k)
        m->term[c.end++] = c.before->term[k];
    if (candidates_put(&c)) reference_put(&c, reference_current_A);
    if (c.end > first) m->effect[m->list.count++] = (hci_effect){type, m->term + first, c.end - first};
    return c.end;
}

static size_t columns_of(const hci_candidates *candidates, bool all, hci_model_column *column)
{
    size_t count = 0;
    for (size_t k = 0; k < candidates->count; ++k) {
        const hci_candidate *s = &candidates->candidate[k];
        for (size_t j = 0; (all || s->in) && j < s->count; ++j, ++count)
            if (column) column[count] = (hci_model_column){s, j, 0};
    }
    return count;
}

hci_status hci_model_make(const hci_effects *declared, const hci_candidates *candidates, bool all,
                          hci_model *model, hci_note *note)
{
    const size_t types = hci_candidate_types();
    size_t used = 0;
    memset(model, 0, sizeof *model);
    model->columns = columns_of(candidates, all, NULL);
    model->effect = hci_memory_new(types, sizeof *model->effect);
    model->term = hci_memory_new(model->columns + hci_effects_terms(declared) + 1, sizeof *model->term);
    model->column = hci_memory_new(model->columns + 1, sizeof *model->column);
    if (!model->effect || !model->term || !model->column) {
        hci_model_release(model);
        return hci_note_memory(note, NULL, "a model with effects");
    }
    columns_of(candidates, all, model->column);
    for (size_t r = 0; r < types; ++r)
        used = type_put(model, hci_candidate_type(r), declared, candidates->reference_current_A, used);
    model->list.effect = model->effect;
    return HCI_OK;
}

void hci_model_release(hci_model *model)
{
    hci_memory_free(model->effect);
    hci_memory_free(model->term);
    hci_memory_free(model->column);
    memset(model, 0, sizeof *model);
}
