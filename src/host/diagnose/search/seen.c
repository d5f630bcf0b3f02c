#include "host/diagnose/search/seen.h"

static uint32_t types_of(const hci_candidates *model, const hci_effect_type *more)
{
    uint32_t types = 0;
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        if (hci_candidates_have(model, hci_candidate_type(r)) || hci_candidate_type(r) == more)
            types |= (uint32_t)1 << r;
    return types;
}

void hci_seen_add(hci_search *s, const hci_candidates *model)
{
    if (s->seen_count < HCI_MOST_SEEN && !hci_seen_has(s, model, NULL))
        s->seen[s->seen_count++] = types_of(model, NULL);
}

bool hci_seen_has(const hci_search *s, const hci_candidates *model, const hci_effect_type *more)
{
    for (size_t k = 0; k < s->seen_count; ++k)
        if (s->seen[k] == types_of(model, more)) return true;
    return false;
}
