/* effects.csv of a machine folder, and effects on a simulated drive. */
#ifndef HCI_HOST_MACHINE_EFFECTS_H
#define HCI_HOST_MACHINE_EFFECTS_H

#include "hci/drive/control.h"
#include "hci/effects/attach.h"
#include "hci/host/base/note.h"
#include "hci/host/base/output.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Effects with their values. Start with {0}, which is no effect. */
typedef struct {
    hci_effects list;      /* points into the arrays below */
    hci_effect *effect;    /* list.count of them */
    hci_effect_term *term; /* of all effects, hci_effects_terms(&list) of them */
} hci_effects_data;

/* Reads a file with the columns effect, parameter, value, unit, std_error. Rows may stand in any order; on
 * return effects are in the order of the registry, and the terms of each by parameter and order. A unit of 1,
 * - or nothing stands for the parameter's own. Effect or parameter unknown, not of its unit, or named twice:
 * HCI_ERROR_INPUT. HCI_ERROR_MEMORY. On failure *effects is empty. */
hci_status hci_effects_read(const char *path, hci_effects_data *effects, hci_note *note);

/* The same from effects.csv of a machine folder; none there: no effect. */
hci_status hci_effects_read_machine(const char *folder, hci_effects_data *effects, hci_note *note);

/* Frees what effects hold and empties them. */
void hci_effects_release(hci_effects_data *effects);

/* Writes effects.csv as the next file of a set, in the order given; what hci_effects_read makes of it is
 * written with the same bytes. HCI_ERROR_OUTPUT, _MEMORY; discard the set then. */
hci_status hci_effects_write(hci_output *output, const hci_effects *effects, hci_note *note);

/* hci_effects_put, with memory for the attachment and words for a refusal. *attachment: out, to be given to
 * hci_effects_detach; NULL on failure. HCI_ERROR_ARGUMENT for a delay below 0 or of a million steps, or
 * Coulomb friction below 0 in sum; HCI_ERROR_MEMORY. The drive is then untouched. */
hci_status hci_effects_attach(const hci_effects_plant *plant, const hci_plant_state *state, hci_drive *drive,
                              hci_sensor *sensors, hci_effects_attachment **attachment, hci_note *note);

/* Frees an attachment; the drive must not be used any more. NULL is fine. */
void hci_effects_detach(hci_effects_attachment *attachment);

#ifdef __cplusplus
}
#endif

#endif
