/* Whether all that a run shows repeats with the turn of the shaft, but for white noise: then a mean over its
 * turns loses nothing. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_REPEATS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_REPEATS_H

#include "host/diagnose/prepare/turns.h"

/* Of the torque less its swings and of i_d and i_q, each less that at the same angle one turn before, in
 * `count` turns that are alike and follow each other: no line in the spectrum, none at 0 either, and
 * neighbours that have next to nothing in common. repeats: out, not where angles stand still. False when
 * memory is out. O(n log n). */
bool hci_repeats_find(const hci_run *run, const hci_run_statistics *statistics, int pole_pairs,
                      const hci_turn *turns, size_t count, bool *repeats);

#endif
