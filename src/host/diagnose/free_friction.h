/* Friction of shafts without a torque sensor that run at constant speed: what their current makes on average.
 *
 * Nothing in such runs tells the torque per ampere, so that it is held at the declared value: what varies is
 * searched with the means left free, and the friction of these means stands beside it. Those with too few
 * samples in an electrical period tell nothing else beside recordings that do. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FREE_FRICTION_H
#define HCI_SRC_HOST_DIAGNOSE_FREE_FRICTION_H

#include "hci/host/diagnose/diagnose.h"
#include "host/recording/drag_law.h"

/* Start with {0}. */
typedef struct {
    hci_drag *drag;                  /* [runs]; NULL: not looked for */
    bool *is_apart;                  /* [runs]: tells its mean alone */
    hci_runs rest;                   /* the runs that are not apart; belong to `runs`, but for the arrays */
    hci_drag_law law;                /* beyond what is declared; 0 terms: none */
    hci_effects_data effects;        /* the declared ones with it; empty where there is none */
    double declared[HCI_DRAG_TERMS]; /* the law that is declared */
} hci_free_friction;

/* Whether no run to be fitted tells the torque per ampere: holding tests, and free shafts that hardly
 * accelerate. */
bool hci_constant_is_held(const hci_runs *runs);

/* Of the runs to be fitted, where none has a measured torque; first hci_free_shafts_find of all runs.
 * HCI_ERROR_INPUT for a run without an angle, _MEMORY; release it also then. */
hci_status hci_free_friction_find(const hci_machine_data *machine, const hci_effects *declared,
                                  const hci_runs *runs, hci_free_friction *friction, hci_note *note);

/* Makes it a finding of a diagnosis that began with its effects and the rest of the runs, and adds the errors
 * of the others and the mean errors of these runs. HCI_ERROR_MEMORY. */
hci_status hci_free_friction_tell(const hci_free_friction *friction, const hci_runs *runs,
                                  hci_diagnosis *diagnosis, hci_note *note);

void hci_free_friction_release(hci_free_friction *friction);

#endif
