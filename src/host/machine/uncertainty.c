#include "hci/host/machine/uncertainty.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

hci_status hci_uncertainty_reserve(hci_uncertainty *u, size_t runs, size_t machines, hci_note *note)
{
    const size_t terms = hci_effects_terms(&u->effects.list);
    u->run = hci_memory_new(runs, sizeof *u->run);
    u->departure = hci_memory_new(terms * machines, sizeof *u->departure);
    if (!u->run || !u->departure) return hci_note_memory(note, NULL, "what recordings leave open");
    u->runs = runs;
    u->machines = machines;
    return HCI_OK;
}

void hci_uncertainty_release(hci_uncertainty *u)
{
    for (size_t k = 0; k < u->runs; ++k)
        hci_memory_free(u->run[k].file);
    hci_effects_release(&u->effects);
    hci_memory_free(u->departure);
    hci_memory_free(u->run);
    memset(u, 0, sizeof *u);
}

/* ---- whether it belongs to a machine ---- */

static const hci_effect_term *term_in(const hci_effects *effects, const hci_effect_type *type,
                                      const hci_effect_term *term)
{
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; effects->effect[k].type == type && j < effects->effect[k].count; ++j) {
            const hci_effect_term *x = &effects->effect[k].term[j];
            if (x->parameter == term->parameter && fabs(x->order - term->order) <= HCI_ORDER_TOLERANCE)
                return x;
        }
    return NULL;
}

/* Whether all values of one list are in the other; a reference current alone is no effect. */
static bool holds_all(const hci_effects *all, const hci_effects *part)
{
    for (size_t k = 0; k < part->count; ++k)
        for (size_t j = 0; j < part->effect[k].count; ++j) {
            const hci_effect *effect = &part->effect[k];
            const hci_effect_term *term = &effect->term[j], *same = term_in(all, effect->type, term);
            const double standard = effect->type->parameter[term->parameter].standard;
            const bool refers =
                (effect->type->parameter[term->parameter].traits & HCI_PARAMETER_REFERENCE_CURRENT) != 0;
            if (same ? same->value != term->value : term->value != standard && !refers) return false;
        }
    return true;
}

bool hci_uncertainty_is_of(const hci_uncertainty *u, const hci_effects *effects)
{
    return holds_all(effects, &u->effects.list) && holds_all(&u->effects.list, effects);
}

/* No recording had a torque that would have to be explained: of voltages alone. */
static bool is_of_no_torque(const hci_machine_origin *origin)
{
    return strcmp(origin->verdict, "unknown") == 0 && !isfinite(origin->unexplained_Nm);
}

bool hci_machine_origin_is_doubtful(const hci_machine_origin *origin)
{
    if (is_of_no_torque(origin)) return false;
    if (origin->search[0] && strcmp(origin->search, "complete") != 0) return true;
    return !(origin->left_means_Nm > 0.0) &&
           (strcmp(origin->verdict, "partly explained") == 0 || strcmp(origin->verdict, "unknown") == 0);
}

/* ---- what was measured ---- */

static void widen(hci_measured_range *range, hci_measured_range by)
{
    range->least = fmin(range->least, by.least);
    range->most = fmax(range->most, by.most);
}

hci_measured_run hci_uncertainty_measured(const hci_uncertainty *u)
{
    const hci_measured_range none = {NAN, NAN};
    hci_measured_run all = {NULL, none, none, none, NAN};
    for (size_t k = 0; k < u->runs; ++k) {
        widen(&all.id_A, u->run[k].id_A);
        widen(&all.iq_A, u->run[k].iq_A);
        widen(&all.speed_rad_per_s, u->run[k].speed_rad_per_s);
    }
    return all;
}
