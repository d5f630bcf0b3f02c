#include "host/diagnose/candidates/candidates.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the list of effects");
}

/* ---- types ---- */

const hci_effect_type *hci_suspect_type(size_t k)
{
    const hci_effect_type *type = hci_effect_type_at(k);
    return type || (k > 0 && !hci_effect_type_at(k - 1)) ? type : &hci_unknown_type;
}

size_t hci_suspect_types(void)
{
    size_t k = 0;
    while (hci_suspect_type(k))
        ++k;
    return k;
}

bool hci_suspects_have(const hci_suspects *s, const hci_effect_type *type)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].in && s->suspect[k].type == type) return true;
    return false;
}

size_t hci_suspects_types_in(const hci_suspects *s)
{
    size_t sum = 0;
    for (size_t r = 0; hci_suspect_type(r); ++r)
        sum += hci_suspects_have(s, hci_suspect_type(r));
    return sum;
}

size_t hci_suspects_terms_in(const hci_suspects *s)
{
    size_t sum = 0;
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].in) sum += s->suspect[k].count;
    return sum;
}

void hci_suspects_leave(hci_suspects *s, const hci_effect_type *type)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].type == type) s->suspect[k].in = false;
}

hci_status hci_suspects_copy(const hci_suspects *from, hci_suspects *to, hci_note *note)
{
    memset(to, 0, sizeof *to);
    hci_suspect *suspect = hci_memory_new(from->count + 1, sizeof *suspect);
    if (!suspect) return no_memory(note);
    if (from->count > 0) memcpy(suspect, from->suspect, from->count * sizeof *suspect);
    *to = *from;
    to->suspect = suspect;
    return HCI_OK;
}

bool hci_suspect_same(const hci_suspect *a, const hci_suspect *b)
{
    if (a->type != b->type || a->count != b->count) return false;
    for (size_t k = 0; k < a->count; ++k)
        if (a->term[k].parameter != b->term[k].parameter ||
            fabs(a->term[k].order - b->term[k].order) > HCI_ORDER_TOLERANCE)
            return false;
    return true;
}

hci_status hci_suspects_add(hci_suspects *suspects, const hci_suspect *suspect, hci_note *note)
{
    size_t at = suspects->count;
    hci_suspect *grown = hci_memory_resize(suspects->suspect, suspects->count + 1, sizeof *grown);
    if (!grown) return no_memory(note);
    suspects->suspect = grown;
    while (at > 0 && grown[at - 1].type != suspect->type)
        --at;
    if (at == 0) at = suspects->count;
    memmove(grown + at + 1, grown + at, (suspects->count - at) * sizeof *grown);
    grown[at] = *suspect;
    ++suspects->count;
    return HCI_OK;
}

void hci_suspects_release(hci_suspects *suspects)
{
    hci_memory_free(suspects->suspect);
    memset(suspects, 0, sizeof *suspects);
}
