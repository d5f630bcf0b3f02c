/* A delay that waves over the angle have in common, at whatever speeds they were read.
 *
 * In: of each recording its speed, what loads it, and the waves of a quantity over the angle. Order n of one
 * that is read late by τ is turned by −nωτ. Out: the τ for which the waves, turned back, are the same in all
 * recordings but for a part in proportion to the load, whatever they are. */
#ifndef HCI_SRC_HOST_RECORDING_LIST_COMMON_DELAY_H
#define HCI_SRC_HOST_RECORDING_LIST_COMMON_DELAY_H

#include <stdbool.h>
#include <stddef.h>

enum { HCI_DELAY_ORDERS = 240 };

/* S sin nφ + C cos nφ. */
typedef struct {
    double sine, cosine;
} hci_delay_wave;

/* A recording. */
typedef struct {
    double speed_rad_per_s, load;              /* signed; load in any unit */
    double std_error;                          /* of each coordinate of a wave */
    hci_delay_wave wave[HCI_DELAY_ORDERS + 1]; /* by the order; 0 is not looked at */
} hci_delay_record;

typedef struct {
    double delay_s;    /* positive: read late */
    double turned_rad; /* by which the delay turns the waves, rms over what they are, at the fastest */
    double before, left,
        other;      /* χ² of what is not the same: without it, with it, and with the next best one */
    double freedom; /* degrees of freedom of these */
} hci_common_delay;

/* The best delay of up to most_s either way, of up to some ten thousand. `other` is the best that is not next
 * to it. False where there is nothing to compare: fewer recordings than unknowns, all at one speed, or no
 * wave above five standard errors. O(delays · orders · recordings). */
bool hci_common_delay_find(const hci_delay_record *record, size_t count, double most_s,
                           hci_common_delay *delay);

#endif
