/* What the header of a table says of its machine. In: a machine and its folder; out: name, pole pairs, rated
 * speed, and how its magnets depend on the temperature. */
#include "hci/host/emit/emit_facts.h"

#include <string.h>

#include "hci/host/machine/effects.h"

/* The parameter of an effect with that unit, 0 where it has none. */
static double value_with_unit(const hci_effect *effect, const char *unit)
{
    for (size_t k = 0; k < effect->type->parameter_count; ++k)
        if (strcmp(effect->type->parameter[k].unit, unit) == 0) return hci_effect_value(effect, k);
    return 0.0;
}

static void take_magnets(const hci_effects *effects, hci_emit_facts *facts)
{
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *effect = &effects->effect[k];
        if ((effect->type->needs & HCI_EFFECT_NEEDS_TEMPERATURE) == 0 || !effect->type->in_machine) continue;
        facts->emf_per_kelvin = value_with_unit(effect, "1/K");
        facts->magnets_C = value_with_unit(effect, "C");
    }
}

hci_status hci_emit_facts_read(const char *folder, const hci_machine_data *machine, hci_emit_facts *facts,
                               hci_note *note)
{
    hci_effects_data effects;
    const hci_status status = hci_effects_read_machine(folder, &effects, note);
    if (status) return status;
    memcpy(facts->machine, machine->identity.name, sizeof facts->machine);
    facts->pole_pairs = (size_t)machine->pole_pairs;
    facts->rated_speed_rad_per_s =
        machine->rated_speed_rad_per_s > 0.0 ? machine->rated_speed_rad_per_s : 0.0; /* NAN: not given */
    take_magnets(&effects.list, facts);
    hci_corrections_words(&effects.list, facts->corrections, sizeof facts->corrections);
    hci_corrections_take(&effects.list, &facts->correction_values);
    hci_effects_release(&effects);
    return HCI_OK;
}
