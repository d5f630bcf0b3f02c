/* What a model is asked between two samples of a recording.
 *
 * In: two samples of a shaft that turns, and the finest order of the torque. Out: so many samples between
 * them, by the rule of Gauss of two points in each part of the step, that their mean is that of the torque:
 * an order that turns by two radians in a part is off by 0.5 % of it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_BETWEEN_SAMPLES_H
#define HCI_SRC_HOST_DIAGNOSE_READING_BETWEEN_SAMPLES_H

#include "host/diagnose/reading/regression.h"

/* The finest order of the torque of a model, in periods of a mechanical turn. O(terms + harmonics). */
double hci_finest_order(const hci_machine *machine, const hci_effects *effects);

/* Whether between two samples of a segment such an order turns by more than a radian. O(samples). */
bool hci_is_coarse(const hci_binned_sample *sample, size_t count, double finest_order);

/* In how many equal parts a step from sample to sample is to be taken, so that such an order turns by about a
 * radian in a part, or where samples do not follow each other evenly by half of one; 1 where it turns by
 * hardly more than a radian in the step, at most four. */
size_t hci_parts_of_step(double step_rad, double finest_order, bool even);

/* At a share of the way between two samples: angle, speed and currents in the rotor frame along straight
 * lines. */
hci_sample hci_sample_between(const hci_sample *from, const hci_sample *to, int pole_pairs, double share);

/* A step from one sample to the next. */
typedef struct {
    const hci_sample *from, *to;
    hci_dq i_from, i_to; /* their currents in the rotor frame */
    int pole_pairs;
    size_t count; /* of samples between the two, that make the mean from one to the other; at least 2 */
} hci_between;

hci_between hci_between_of(const hci_sample *from, const hci_sample *to, int pole_pairs, double finest_order);

/* Sample k of the count: angle, speed and currents in the rotor frame along straight lines. */
hci_sample hci_between_at(const hci_between *between, size_t k);

#endif
