/* Effects put on a simulated drive: the memory for them, and in words why they do not fit. */
#include "hci/host/machine/effects.h"
#include "host/base/memory.h"

static hci_status say(const hci_effects_refusal *refusal, hci_note *note)
{
    switch (refusal->reason) {
    case HCI_EFFECTS_DRIVING:
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "%s: Coulomb friction is %g N·m in sum, expected 0 or more; a simulated shaft cannot be "
            "driven by its bearings",
            refusal->type ? refusal->type->name : "machine", refusal->value);
    case HCI_EFFECTS_DELAY:
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: found %g s, expected 0 or more and less than %d steps of the simulation; "
                            "delay the other channels instead of one by less than 0",
                            refusal->type->name, refusal->value, HCI_EFFECTS_MOST_STEPS);
    case HCI_EFFECTS_TOO_MANY_LINKS:
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "more than %d effects act on one sensor; join those of one kind",
                            HCI_EFFECT_LINKS);
    default:
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "effects belong on a drive that has a step and no effects yet");
    }
}

hci_status hci_effects_attach(const hci_effects_plant *plant, const hci_plant_state *state, hci_drive *drive,
                              hci_sensor *sensors, hci_effects_attachment **attachment, hci_note *note)
{
    hci_effects_refusal refusal;
    hci_effects_attachment *a = hci_memory_new(1, sizeof *a);
    *attachment = NULL;
    if (!a) return hci_note_memory(note, NULL, "the effects of the machine");
    if (hci_effects_put(plant, state, drive, sensors, a, &refusal) != HCI_OK) {
        hci_memory_free(a);
        return say(&refusal, note);
    }
    *attachment = a;
    return HCI_OK;
}

void hci_effects_detach(hci_effects_attachment *attachment)
{
    hci_memory_free(attachment);
}
