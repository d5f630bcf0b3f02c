/* A torque that swings at a frequency of its own beside the turn of the rotor: of a load, a belt, the mains.
 * No effect of a machine or a bench makes it, and means over turns would make orders of it that are not
 * there. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_SWING_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_SWING_H

#include "hci/machine/torque.h"
#include "host/diagnose/prepare/swing_groups.h"

/* What is asked of the torque of a run. */
typedef struct {
    const hci_run *run;
    const hci_run_statistics *statistics;
    const hci_machine *machine; /* what the currents make in it is no swing */
} hci_swing_question;

/* Finds swings in a steady run of a torque sensor, whose currents and speed do not swing with them: each
 * torque less that of one turn before holds nothing that repeats with the turn. swing: out, the largest
 * first; of those that are `known` from other runs also what is no plain line here. Returns how many;
 * SIZE_MAX when memory is out. O(n (log n + harmonics)). */
size_t hci_swings_find(const hci_swing_question *question, const hci_swing_groups *known,
                       hci_swing swing[HCI_MOST_SWINGS]);

/* Their sum at a time. */
double hci_swings_at_Nm(const hci_run_statistics *statistics, double time_s);

#endif
