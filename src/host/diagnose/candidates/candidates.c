#include "host/diagnose/candidates/candidates.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"

/* ---- types ---- */

const hci_effect_type *hci_candidate_type(size_t k)
{
    const hci_effect_type *type = hci_effect_type_at(k);
    return type || (k > 0 && !hci_effect_type_at(k - 1)) ? type : &hci_empirical_type;
}

size_t hci_candidate_types(void)
{
    size_t k = 0;
    while (hci_candidate_type(k))
        ++k;
    return k;
}

bool hci_candidates_have(const hci_candidates *s, const hci_effect_type *type)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->candidate[k].in && s->candidate[k].type == type) return true;
    return false;
}

bool hci_candidates_have_series(const hci_candidates *s)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->candidate[k].in && s->candidate[k].type->is_series) return true;
    return false;
}

size_t hci_candidates_types_in(const hci_candidates *s)
{
    size_t sum = 0;
    for (size_t r = 0; hci_candidate_type(r); ++r)
        sum += hci_candidates_have(s, hci_candidate_type(r));
    return sum;
}

size_t hci_candidates_terms_in(const hci_candidates *s)
{
    size_t sum = 0;
    for (size_t k = 0; k < s->count; ++k)
        if (s->candidate[k].in) sum += s->candidate[k].count;
    return sum;
}

bool hci_candidates_are_of_whole(const hci_candidates *s, const hci_effect_type *type)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->candidate[k].in && s->candidate[k].type == type && s->candidate[k].coenergy_unit > 0.0)
            return true;
    return false;
}

void hci_candidates_remove_type(hci_candidates *s, const hci_effect_type *type)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->candidate[k].type == type) s->candidate[k].in = false;
}

hci_status hci_candidates_copy(const hci_candidates *from, hci_candidates *to, hci_note *note)
{
    memset(to, 0, sizeof *to);
    hci_candidate *candidate = hci_memory_new(from->count + 1, sizeof *candidate);
    if (!candidate) return hci_note_memory(note, NULL, "the list of effects");
    if (from->count > 0) memcpy(candidate, from->candidate, from->count * sizeof *candidate);
    *to = *from;
    to->candidate = candidate;
    return HCI_OK;
}

double hci_candidate_departure(const hci_candidate *x, size_t k)
{
    const hci_effect_parameter *parameter = &x->type->parameter[x->term[k].parameter];
    return parameter->traits & HCI_PARAMETER_SCALE ? 0.0 : x->term[k].value - x->declared[k];
}

bool hci_candidate_is_unbalanced(const hci_effect_type *type, size_t parameter, double order)
{
    if (!type->propose_coenergy || type->any_phase || parameter >= type->parameter_count) return false;
    const hci_effect_parameter *p = &type->parameter[parameter];
    return p->ordered && !p->whole && fabs(remainder(order, 6.0)) > HCI_ORDER_TOLERANCE;
}

bool hci_candidate_is_gain(const hci_effect_type *type)
{
    return type->sum_by_value && strcmp(type->parameter[0].unit, "1") == 0;
}

/* In N·m, whatever the current and the speed are. */
static bool is_sensor_zero(const hci_effect_parameter *p)
{
    return p->traits == (HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_LINEAR) && strcmp(p->unit, "Nm") == 0;
}

static bool is_of_magnets(const hci_effect_parameter *p)
{
    return (p->traits & HCI_PARAMETER_WITH_LOAD) != 0;
}

/* The first type with a parameter that is one. */
static const hci_effect_type *type_with(bool (*is)(const hci_effect_parameter *), size_t *parameter)
{
    for (size_t t = 0; t < hci_candidate_types(); ++t)
        for (size_t k = 0; k < hci_candidate_type(t)->parameter_count; ++k) {
            *parameter = k;
            if (is(&hci_candidate_type(t)->parameter[k])) return hci_candidate_type(t);
        }
    return NULL;
}

const hci_effect_type *hci_sensor_zero(size_t *parameter)
{
    return type_with(is_sensor_zero, parameter);
}

const hci_effect_type *hci_torque_per_ampere(size_t *parameter)
{
    return type_with(is_of_magnets, parameter);
}

void hci_candidate_shorten(hci_candidate *x)
{
    --x->count;
    x->shortened = true;
}

static bool have_same_terms(const hci_candidate *a, const hci_candidate *b)
{
    if (a->type != b->type || a->count != b->count) return false;
    for (size_t k = 0; k < a->count; ++k)
        if (a->term[k].parameter != b->term[k].parameter ||
            fabs(a->term[k].order - b->term[k].order) > HCI_ORDER_TOLERANCE)
            return false;
    return true;
}

const hci_candidate *hci_candidates_find_in(const hci_candidates *candidates, const hci_candidate *candidate)
{
    for (size_t k = 0; k < candidates->count; ++k)
        if (candidates->candidate[k].in && have_same_terms(&candidates->candidate[k], candidate))
            return &candidates->candidate[k];
    return NULL;
}

hci_status hci_candidates_add(hci_candidates *candidates, const hci_candidate *candidate, hci_note *note)
{
    size_t at = candidates->count;
    hci_candidate *grown = hci_memory_resize(candidates->candidate, candidates->count + 1, sizeof *grown);
    if (!grown) return hci_note_memory(note, NULL, "the list of effects");
    candidates->candidate = grown;
    while (at > 0 && grown[at - 1].type != candidate->type)
        --at;
    if (at == 0) at = candidates->count;
    memmove(grown + at + 1, grown + at, (candidates->count - at) * sizeof *grown);
    grown[at] = *candidate;
    ++candidates->count;
    return HCI_OK;
}

void hci_candidates_release(hci_candidates *candidates)
{
    hci_memory_free(candidates->candidate);
    memset(candidates, 0, sizeof *candidates);
}
