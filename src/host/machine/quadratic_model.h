/* A machine with its effects, sorted by how the torque depends on the current.
 *
 * What is of second degree or less is written into the machine itself, T = e·i + ½iᵀL'i + T_cog with e, L'
 * and T_cog of their own; whatever the effect, three values and slopes at each angle say all of it. What is
 * of a higher degree stays an effect. What does not act in the machine is left out. */
#ifndef HCI_SRC_HOST_MACHINE_QUADRATIC_MODEL_H
#define HCI_SRC_HOST_MACHINE_QUADRATIC_MODEL_H

#include "hci/effects/effect.h"
#include "hci/host/base/note.h"

typedef struct {
    hci_machine machine;      /* up to the second degree */
    hci_effects_plant higher; /* above it; effects NULL when there is nothing */
    hci_effects lower_list, higher_list;
    hci_effect *effect;          /* of both lists */
    hci_wave *back_emf;          /* owned, of `machine`; NULL where it is as declared */
    hci_harmonic *cogging;       /* the same */
    hci_inductance_slope *slope; /* the same */
    size_t left_out;             /* effects that do not act in the machine */
} hci_quadratic_model;

/* effects: or NULL. temperature_C: of the magnets, NAN for the reference. The declared machine and the
 * effects must outlive *model, which is to be released in any case. HCI_ERROR_INPUT when orders have no
 * common period, HCI_ERROR_MEMORY. */
hci_status hci_quadratic_model_make(const hci_machine *declared, const hci_effects *effects,
                                    double temperature_C, hci_quadratic_model *model, hci_note *note);
void hci_quadratic_model_release(hci_quadratic_model *model);

/* Whether all orders of these effects repeat after so many electrical turns. */
bool hci_effects_repeat(const hci_effects *effects, int pole_pairs, size_t turns);

/* The highest order that a term names, 0 when none does. */
double hci_effects_top_order(const hci_effects *effects);

#endif
