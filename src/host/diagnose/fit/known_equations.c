#include "host/diagnose/fit/known_equations.h"

#include <stdint.h>
#include <string.h>

#include "host/base/memory.h"

/* ---- what makes a model ---- */

static const hci_effect_parameter *parameter_of(const hci_known_term *x)
{
    return &x->type->parameter[x->parameter];
}

/* Whether the torque is linear in a value and no other regressor depends on it but those of the test stand.
 */
static bool is_linear(const hci_known_term *x)
{
    const unsigned traits = parameter_of(x)->traits;
    return (traits & HCI_PARAMETER_LINEAR) && !(traits & HCI_PARAMETER_ALONG_TIME) && !x->type->undo &&
           !x->type->read_torque;
}

static bool is_term(const hci_known_term *x, const hci_effect_type *type, const hci_effect_term *term)
{
    return x->type == type && x->parameter == term->parameter && x->order == term->order;
}

/* last: the one that was found last; models have their terms in much the same order, so that the next one is
 * near. */
static const hci_known_term *term_find(const hci_known_model *of, const hci_effect_type *type,
                                       const hci_effect_term *term, size_t *last)
{
    for (size_t k = 0; k < of->terms; ++k) {
        const size_t at = (*last + k) % of->terms;
        if (!is_term(&of->term[at], type, term)) continue;
        *last = at;
        return &of->term[at];
    }
    return NULL;
}

/* Whether a model without a term is the same as one with this value of it. */
static bool is_nothing(const hci_effect_type *type, size_t parameter, double value)
{
    const hci_effect_parameter *x = &type->parameter[parameter];
    return value == 0.0 || value == x->standard ||
           (x->traits & (HCI_PARAMETER_REFERENCE_CURRENT | HCI_PARAMETER_SCALE));
}

static bool is_same_noise(const hci_known_model *x, const hci_regression *e)
{
    const hci_binned_samples *samples = e->samples;
    return x->noise && memcmp(x->noise, e->noise, samples->segment_count * sizeof *x->noise) == 0 &&
           memcmp(x->use, e->use, samples->run_count * sizeof *x->use) == 0;
}

/* ---- what has changed ---- */

/* A model that is asked for, beside one that is known. */
typedef struct {
    const hci_known_model *from;
    double *change; /* of the value of each column of `from` */
    size_t *column; /* of `from`, for each column of the model */
    bool *met;      /* terms of `from` that the model has */
    bool changed;   /* any value */
} comparison;

static bool comparison_make(comparison *c, const hci_known_model *from, size_t columns)
{
    *c = (comparison){.from = from,
                      .change = hci_memory_new(from->normal.n + 1, sizeof *c->change),
                      .column = hci_memory_new(columns + 1, sizeof *c->column),
                      .met = hci_memory_new(from->terms + 1, sizeof *c->met)};
    return c->change && c->column && c->met;
}

static void comparison_release(comparison *c)
{
    hci_memory_free(c->change);
    hci_memory_free(c->column);
    hci_memory_free(c->met);
}

/* Takes note of the value that a term has now. False where it is not known what that makes of the rows. */
static bool value_compare(comparison *c, const hci_known_term *x, double value)
{
    if (x->value == value) return true;
    if (!is_linear(x) || x->column == SIZE_MAX || !x->shown) return false;
    c->change[x->column] = value - x->value;
    c->changed = true;
    return true;
}

/* Terms of the model: each is known, or is nothing. */
static bool model_compare(comparison *c, const hci_model *model)
{
    size_t last = 0;
    for (size_t k = 0; k < model->list.count; ++k) {
        const hci_effect *effect = &model->list.effect[k];
        for (size_t j = 0; j < effect->count; ++j) {
            const hci_effect_term *term = &effect->term[j];
            const hci_known_term *x = term_find(c->from, effect->type, term, &last);
            if (!x && !is_nothing(effect->type, term->parameter, term->value)) return false;
            if (x && !value_compare(c, x, term->value)) return false;
            if (x) c->met[x - c->from->term] = true;
        }
    }
    return true;
}

/* Terms that the model does not have: each is nothing, or falls to 0. */
static bool rest_compare(comparison *c)
{
    for (size_t k = 0; k < c->from->terms; ++k) {
        const hci_known_term *x = &c->from->term[k];
        if (c->met[k] || is_nothing(x->type, x->parameter, x->value)) continue;
        if (!value_compare(c, x, 0.0)) return false;
    }
    return true;
}

/* Columns of the model: each is known, and linear where any value has changed. */
static bool columns_find(comparison *c, const hci_model *model)
{
    size_t last = 0;
    for (size_t k = 0; k < model->columns; ++k) {
        const hci_model_column *column = &model->column[k];
        const hci_known_term *x =
            term_find(c->from, column->candidate->type, &column->candidate->term[column->term], &last);
        if (!x || x->column == SIZE_MAX || (c->changed && !is_linear(x))) return false;
        c->column[k] = x->column;
    }
    return true;
}

/* ---- the equations ---- */

/* Row i of G times the change. */
static double product(const comparison *c, size_t i)
{
    const hci_normal_equations *from = &c->from->normal;
    double sum = 0.0;
    for (size_t j = 0; j < from->n; ++j)
        if (c->change[j] != 0.0) sum += from->gram[i * from->n + j] * c->change[j];
    return sum;
}

static void equations_take(const comparison *c, hci_normal_equations *normal)
{
    const hci_normal_equations *from = &c->from->normal;
    normal->rows += from->rows;
    normal->square += from->square;
    for (size_t i = 0; i < from->n; ++i)
        if (c->change[i] != 0.0) normal->square += c->change[i] * (product(c, i) - 2.0 * from->moment[i]);
    for (size_t i = 0; i < normal->n; ++i) {
        const size_t row = c->column[i];
        normal->moment[i] += from->moment[row] - product(c, row);
        for (size_t j = 0; j < normal->n; ++j)
            normal->gram[i * normal->n + j] += from->gram[row * from->n + c->column[j]];
    }
}

static bool model_find(const hci_known_model *from, const hci_model *model, hci_normal_equations *normal)
{
    comparison c;
    const bool known = comparison_make(&c, from, model->columns) && model_compare(&c, model) &&
                       rest_compare(&c) && columns_find(&c, model);
    if (known) equations_take(&c, normal);
    comparison_release(&c);
    return known;
}

bool hci_known_equations_find(hci_known_equations *known, const hci_regression *e, const hci_model *model,
                              hci_normal_equations *normal)
{
    for (size_t k = 0; known && k < HCI_KNOWN_EQUATIONS; ++k) {
        hci_known_model *x = &known->model[k];
        if (x->normal.n < model->columns || !is_same_noise(x, e) || !model_find(x, model, normal)) continue;
        x->asked = ++known->asked;
        return true;
    }
    return false;
}

/* ---- keeping ---- */

static void model_release(hci_known_model *x)
{
    hci_normal_equations_release(&x->normal);
    hci_memory_free(x->term);
    hci_memory_free(x->noise);
    hci_memory_free(x->use);
    memset(x, 0, sizeof *x);
}

static bool model_reserve(hci_known_model *x, const hci_regression *e, const hci_model *model)
{
    x->term = hci_memory_new(hci_effects_terms(&model->list) + 1, sizeof *x->term);
    x->noise = hci_memory_new(e->samples->segment_count + 1, sizeof *x->noise);
    x->use = hci_memory_new(e->samples->run_count + 1, sizeof *x->use);
    return x->term && x->noise && x->use && hci_normal_equations_start(&x->normal, model->columns);
}

static void terms_copy(hci_known_model *x, const hci_model *model, const bool *shown)
{
    for (size_t k = 0; k < model->list.count; ++k)
        for (size_t j = 0; j < model->list.effect[k].count; ++j) {
            const hci_effect_term *term = &model->list.effect[k].term[j];
            x->term[x->terms++] = (hci_known_term){
                model->list.effect[k].type, term->parameter, term->order, term->value, SIZE_MAX, false};
        }
    for (size_t c = 0; c < model->columns; ++c) {
        x->term[model->column[c].place].column = c;
        x->term[model->column[c].place].shown = shown[c];
    }
}

bool hci_known_equations_keep(hci_known_equations *known, const hci_regression *e, const hci_model *model,
                              const bool *shown, const hci_normal_equations *normal)
{
    const size_t n = normal->n;
    hci_known_model *x = known ? known->model : NULL;
    for (size_t k = 1; x && k < HCI_KNOWN_EQUATIONS; ++k)
        if (known->model[k].asked < x->asked) x = &known->model[k];
    if (!x) return true;
    model_release(x);
    if (!model_reserve(x, e, model)) {
        model_release(x);
        return false;
    }
    terms_copy(x, model, shown);
    memcpy(x->noise, e->noise, e->samples->segment_count * sizeof *x->noise);
    memcpy(x->use, e->use, e->samples->run_count * sizeof *x->use);
    memcpy(x->normal.gram, normal->gram, n * n * sizeof *normal->gram);
    memcpy(x->normal.moment, normal->moment, n * sizeof *normal->moment);
    x->normal.square = normal->square;
    x->normal.rows = normal->rows;
    x->asked = ++known->asked;
    return true;
}

void hci_known_equations_release(hci_known_equations *known)
{
    for (size_t k = 0; k < HCI_KNOWN_EQUATIONS; ++k)
        model_release(&known->model[k]);
    memset(known, 0, sizeof *known);
}
