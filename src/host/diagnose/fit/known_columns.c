#include "host/diagnose/fit/known_columns.h"

#include <stdint.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/reading/shorter_list.h"

#define SPARE 1.5 /* times the columns at first: candidates change from round to round */

/* ---- terms ---- */

static unsigned traits_of(const hci_effect_type *type, const hci_effect_term *term)
{
    return type->parameter[term->parameter].traits;
}

/* Whether derivatives by other terms depend on the value. */
static bool is_of_stand(const hci_effect_type *type, const hci_effect_term *term)
{
    const bool acts = type->undo || type->read_torque || (traits_of(type, term) & HCI_PARAMETER_ALONG_TIME);
    return acts && term->value != 0.0;
}

static double reference_of(const hci_effect *effect)
{
    for (size_t k = 0; k < effect->count; ++k)
        if (traits_of(effect->type, &effect->term[k]) & HCI_PARAMETER_REFERENCE_CURRENT)
            return effect->term[k].value;
    return 0.0;
}

/* ---- tables ---- */

static void table_release(hci_known_table *t)
{
    hci_memory_free(t->stand);
    hci_memory_free(t->use);
    hci_memory_free(t->column);
    hci_memory_free(t->value);
    memset(t, 0, sizeof *t);
}

void hci_known_columns_release(hci_known_columns *known)
{
    for (size_t k = 0; k < HCI_KNOWN_TABLES; ++k)
        table_release(&known->table[k]);
    memset(known, 0, sizeof *known);
}

/* The values of the test stand in a list. stand: out, [terms], or NULL. Returns how many. */
static size_t stand_of(const hci_effects *list, hci_stand_value *stand)
{
    size_t count = 0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; j < list->effect[k].count; ++j) {
            const hci_effect *effect = &list->effect[k];
            if (!is_of_stand(effect->type, &effect->term[j])) continue;
            if (stand) stand[count] = (hci_stand_value){effect->type, effect->term[j]};
            ++count;
        }
    return count;
}

static bool is_same_value(const hci_stand_value *a, const hci_stand_value *b)
{
    return a->type == b->type && a->term.parameter == b->term.parameter && a->term.order == b->term.order &&
           a->term.value == b->term.value;
}

static bool is_same_state(const hci_known_table *t, const hci_regression *e, const hci_stand_value *stand,
                          size_t count)
{
    if (!t->value || t->stand_count != count) return false;
    for (size_t k = 0; k < count; ++k)
        if (!is_same_value(&t->stand[k], &stand[k])) return false;
    return memcmp(t->use, e->use, e->samples->run_count * sizeof *t->use) == 0;
}

/* Takes the values of the test stand over. False when memory is out, or so many numbers would be too many,
 * and then the table is empty. */
static bool table_start(hci_known_table *t, const hci_regression *e, hci_stand_value *stand, size_t count,
                        size_t columns)
{
    const size_t capacity = (size_t)(SPARE * (double)columns), runs = e->samples->run_count;
    table_release(t);
    t->stand = stand;
    t->stand_count = count;
    t->capacity = capacity;
    if (capacity > 0 && e->samples->count < HCI_KNOWN_NUMBERS / capacity) {
        t->use = hci_memory_new(runs + 1, sizeof *t->use);
        t->column = hci_memory_new(capacity, sizeof *t->column);
        t->value = hci_memory_new((e->samples->count + 1) * capacity, sizeof *t->value);
    }
    if (t->use && t->column && t->value) {
        memcpy(t->use, e->use, runs * sizeof *t->use);
        return true;
    }
    table_release(t);
    return false;
}

/* The table of the present state; NULL where there is none. */
static hci_known_table *table_find(const hci_regression *e, const hci_model *model)
{
    hci_known_columns *known = e->columns;
    const size_t count = stand_of(&model->list, NULL);
    hci_stand_value *stand = hci_memory_new(count + 1, sizeof *stand);
    hci_known_table *oldest = &known->table[0];
    if (!stand) return NULL;
    stand_of(&model->list, stand);
    for (size_t k = 0; k < HCI_KNOWN_TABLES; ++k) {
        hci_known_table *t = &known->table[k];
        if (t->asked < oldest->asked) oldest = t;
        if (!is_same_state(t, e, stand, count)) continue;
        hci_memory_free(stand);
        t->asked = ++known->asked;
        return t;
    }
    if (!table_start(oldest, e, stand, count, model->columns)) return NULL;
    oldest->asked = ++known->asked;
    return oldest;
}

/* ---- columns ---- */

/* last: the one that was found last; the next one is near. Returns its slot; SIZE_MAX where it is not known.
 */
static size_t slot_find(const hci_known_table *t, const hci_known_column *x, size_t *last)
{
    for (size_t k = 0; k < t->count; ++k) {
        const size_t at = (*last + k) % t->count;
        const hci_known_column *y = &t->column[at];
        if (y->type != x->type || y->parameter != x->parameter || y->order != x->order ||
            y->reference_current_A != x->reference_current_A)
            continue;
        *last = at + 1;
        return at;
    }
    return SIZE_MAX;
}

static const hci_effect *effect_of(const hci_model *model, const hci_effect_type *type)
{
    for (size_t k = 0; k < model->list.count; ++k)
        if (model->list.effect[k].type == type) return &model->list.effect[k];
    return NULL;
}

static void sources_add(hci_column_plan *p, const hci_column_source *x, bool known)
{
    if (known)
        p->known[p->known_count++] = *x;
    else
        p->predicted[p->predicted_count++] = *x;
}

/* Tells the columns that are known from those that are not, which get a place to be kept in. False where
 * there are not enough places. */
static bool columns_divide(hci_column_plan *p, const hci_model *model)
{
    hci_known_table *t = p->table;
    size_t last = 0, next = t ? t->count : 0;
    p->known_count = p->predicted_count = 0;
    for (size_t c = 0; c < model->columns; ++c) {
        const hci_model_column *m = &model->column[c];
        const hci_effect *effect = effect_of(model, m->candidate->type);
        const hci_effect_term *term = &model->term[m->place];
        hci_column_source x = {c, m->place, SIZE_MAX};
        const hci_known_column wanted = {effect->type, term->parameter, term->order, reference_of(effect)};
        const bool may = t && hci_effect_is_linear(effect);
        if (may) x.slot = slot_find(t, &wanted, &last);
        const bool known = x.slot != SIZE_MAX;
        if (may && !known && next == t->capacity) return false;
        if (may && !known) t->column[x.slot = next++] = wanted;
        sources_add(p, &x, known);
    }
    p->filled = next;
    return true;
}

/* ---- what is to be predicted ---- */

/* left: out, of each term of the model, whether it is neither to be predicted nor differentiated by. */
static void left_out_find(const hci_column_plan *p, const hci_model *model, bool *left)
{
    for (size_t k = 0; k < p->known_count; ++k) {
        const size_t place = model->column[p->known[k].column].place;
        left[place] = model->term[place].value == 0.0;
    }
}

static void list_shorten(hci_column_plan *p, const hci_model *model, const bool *left, size_t *place)
{
    p->list = hci_effects_shorten(&model->list, left, p->effect, p->term, place);
    for (size_t k = 0; k < p->predicted_count; ++k)
        p->predicted[k].place = place[p->predicted[k].place];
}

static bool plan_reserve(hci_column_plan *p, const hci_model *model, size_t terms)
{
    p->effect = hci_memory_new(model->list.count + 1, sizeof *p->effect);
    p->term = hci_memory_new(terms + 1, sizeof *p->term);
    p->predicted = hci_memory_new(2 * model->columns + 1, sizeof *p->predicted);
    p->known = p->predicted ? p->predicted + model->columns : NULL;
    p->constant_by_value = hci_memory_new(model->columns + 1, sizeof *p->constant_by_value);
    return p->effect && p->term && p->predicted && p->constant_by_value;
}

static bool list_make(hci_column_plan *p, const hci_model *model, size_t terms)
{
    bool *left = hci_memory_new(terms + 1, sizeof *left);
    size_t *place = hci_memory_new(terms + 1, sizeof *place);
    const bool made = left && place;
    if (made) {
        left_out_find(p, model, left);
        list_shorten(p, model, left, place);
    }
    hci_memory_free(left);
    hci_memory_free(place);
    return made;
}

/* What is not known is known next time: a table without places for that begins anew. */
static void sources_find(hci_column_plan *p, const hci_regression *e, const hci_model *model)
{
    if (columns_divide(p, model)) return;
    table_release(p->table);
    p->table = table_find(e, model);
    if (columns_divide(p, model)) return;
    p->table = NULL;
    columns_divide(p, model);
}

bool hci_column_plan_make(const hci_regression *e, const hci_model *model, bool keeps, hci_column_plan *p)
{
    const size_t terms = hci_effects_terms(&model->list);
    memset(p, 0, sizeof *p);
    p->table =
        keeps && e->columns && !e->raw ? table_find(e, model) : NULL; /* a table is of smoothed readings */
    bool made = plan_reserve(p, model, terms);
    if (made) sources_find(p, e, model);
    made = made && list_make(p, model, terms);
    if (!made) hci_column_plan_release(p);
    return made;
}

void hci_column_plan_release(hci_column_plan *p)
{
    hci_memory_free(p->effect);
    hci_memory_free(p->term);
    hci_memory_free(p->predicted);
    hci_memory_free(p->constant_by_value);
    memset(p, 0, sizeof *p);
}

void hci_column_plan_keep(const hci_column_plan *p)
{
    if (p->table) p->table->count = p->filled;
}

/* Of one sample. kept: its row of the table. */
static void row_fill(const hci_column_plan *p, double scale, const double *by_value, double *kept, double *x)
{
    for (size_t k = 0; k < p->predicted_count; ++k) {
        const hci_column_source *s = &p->predicted[k];
        x[s->column] = by_value[s->place];
        if (s->slot != SIZE_MAX) kept[s->slot] = by_value[s->place] / scale;
    }
    for (size_t k = 0; k < p->known_count; ++k)
        x[p->known[k].column] = scale * kept[p->known[k].slot];
}

void hci_column_plan_constants(const hci_column_plan *p, const hci_regression *e,
                               const hci_predicted_reading *predicted)
{
    const hci_known_table *t = p->table;
    if (predicted->current_Nm)
        row_fill(p, 1.0, predicted->constant_by_value, t ? t->value + e->samples->count * t->capacity : NULL,
                 p->constant_by_value);
}

void hci_column_plan_fill(const hci_column_plan *p, const hci_regression *e, const hci_segment *s,
                          const hci_predicted_reading *predicted, double *x)
{
    const size_t terms = predicted->terms, columns = p->predicted_count + p->known_count;
    const hci_known_table *t = p->table;
    const double scale = hci_run_reads_current(&e->runs[s->run]) ? predicted->holding_scale : 1.0;
    const double constant = predicted->constant_Nm_per_A, share = constant != 0.0 ? 1.0 / constant : 0.0;
    for (size_t j = 0; j < s->count; ++j) {
        row_fill(p, scale, predicted->by_value + j * terms,
                 t ? t->value + (s->first + j) * t->capacity : NULL, x + j * columns);
        for (size_t c = 0; predicted->current_Nm && c < columns; ++c)
            x[j * columns + c] -= predicted->current_Nm[j] * share * p->constant_by_value[c];
    }
}
