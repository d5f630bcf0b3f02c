/* Whether all that a run shows repeats with the turn of the shaft, but for white noise: then a mean over its
 * turns loses nothing. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_REPEATS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_REPEATS_H

#include "host/diagnose/prepare/turns.h"

/* Samples of a run in turns that are alike and follow each other, and in how many bins of the turn there
 * would be means of them. */
typedef struct {
    const hci_run *run; /* with time, angle, currents and torque */
    const hci_run_statistics *statistics;
    int pole_pairs;
    size_t first, count; /* samples */
    size_t bins;         /* of a turn, >= 1; fewer than samples */
} hci_repeats_question;

/* Of the torque less its swings and of i_d and i_q, each less the line through the means of the bins: no line
 * in the spectrum, and neighbours that have next to nothing in common. repeats: out. False when memory is
 * out. O(n log n). */
bool hci_repeats_find(const hci_repeats_question *question, bool *repeats);

/* Whether the torque goes along with what of i_q does not repeat: by more than half of Nm_per_A, and by four
 * standard errors. That current flowed then, as of a supply that ripples; what a sensor's noise shows, the
 * torque does not. follows: out. False when memory is out. O(samples). */
bool hci_repeats_follows(const hci_repeats_question *question, double Nm_per_A, bool *follows);

/* Whether the noise of the torque is four times as strong between orders 1 and 5 of the turn as from 20 to
 * 40. A mean over the turns has a number for each order alone, and cannot tell such noise from what repeats.
 * Less than 80 samples a turn do not tell. slow: out. False when memory is out. O(n log n). */
bool hci_repeats_slow_noise(const hci_repeats_question *question, bool *slow);

#endif
