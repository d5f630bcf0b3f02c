#include "host/diagnose/reading/shorter_list.h"

static unsigned traits_of(const hci_effect *effect, size_t k)
{
    return effect->type->parameter[effect->term[k].parameter].traits;
}

bool hci_effect_is_linear(const hci_effect *effect)
{
    const unsigned any = HCI_PARAMETER_LINEAR | HCI_PARAMETER_REFERENCE_CURRENT;
    if (effect->type->undo || effect->type->read_torque) return false;
    for (size_t k = 0; k < effect->count; ++k)
        if (!(traits_of(effect, k) & any)) return false;
    return true;
}

/* One effect; none but its reference current is none. Returns the end of its terms. */
static size_t effect_shorten(const hci_effect *from, const bool *left, hci_effects *to, hci_effect *effect,
                             hci_effect_term *term, size_t first, size_t *place)
{
    size_t end = first, values = 0;
    for (size_t k = 0; k < from->count; ++k) {
        if (left[k]) continue;
        values += !(traits_of(from, k) & HCI_PARAMETER_REFERENCE_CURRENT);
        if (place) place[k] = end;
        term[end++] = from->term[k];
    }
    if (values == 0) return first;
    effect[to->count++] = (hci_effect){from->type, term + first, end - first};
    return end;
}

hci_effects hci_effects_shorten(const hci_effects *from, const bool *left, hci_effect *effect,
                                hci_effect_term *term, size_t *place)
{
    hci_effects to = {effect, 0};
    size_t at = 0, end = 0;
    for (size_t k = 0; k < from->count; at += from->effect[k++].count)
        end = effect_shorten(&from->effect[k], left + at, &to, effect, term, end, place ? place + at : NULL);
    return to;
}

hci_effects hci_effects_present(const hci_effects *from, hci_effect *effect, hci_effect_term *term,
                                bool *work)
{
    size_t at = 0;
    for (size_t k = 0; k < from->count; ++k) {
        const bool linear = hci_effect_is_linear(&from->effect[k]);
        for (size_t j = 0; j < from->effect[k].count; ++j)
            work[at++] = linear && from->effect[k].term[j].value == 0.0;
    }
    return hci_effects_shorten(from, work, effect, term, NULL);
}
