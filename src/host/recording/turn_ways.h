/* A shaft that control turns slowly, order by order of its turn: how it accelerates, by its angle over time,
 * and its i_q, apart for each direction. */
#ifndef HCI_SRC_HOST_RECORDING_TURN_WAYS_H
#define HCI_SRC_HOST_RECORDING_TURN_WAYS_H

#include "hci/host/recording/run.h"

/* S sin kφ + C cos kφ of a quantity, and the standard error of each. */
typedef struct {
    double sine, cosine, std_error;
    bool stands_out; /* of the noise */
} hci_way_wave;

/* Order k of the turn. */
typedef struct {
    hci_way_wave time_s;             /* by which the angle is reached later than at a steady speed */
    hci_way_wave iq_A;               /* torque current */
    double alpha_sine, alpha_cosine; /* mechanical acceleration, rad/s², where time or current stands out */
} hci_way_order;

/* All turns in one direction. */
typedef struct {
    double speed_rad_per_s; /* mean, mechanical, signed */
    hci_way_order *order;   /* [highest + 1] */
    size_t *seen, count;    /* [count], ascending: orders of which time or current stands out */
    bool any;               /* there are such turns */
} hci_way;

/* Start with {0}. */
typedef struct {
    double scale;          /* the turn is scale × the mechanical one: 1, or the pole pairs */
    size_t highest;        /* order of the turn */
    double resolution_rad; /* of movements that come back in each turn */
    hci_way way[2];        /* forward, backward */
} hci_turn_ways;

/* Of a run with an angle, a clock and currents. *found: whether it goes round a turn in a direction, at
 * speeds of that direction that differ by less than a tenth from part to part, and nowhere goes back or ten
 * times as fast as on the average, as a shaft that sticks does; where not, *ways is empty. The turn is the
 * mechanical one where the angle knows it, else the electrical one. What is near a reversal, half an
 * electrical turn, is left out. HCI_ERROR_MEMORY. O(samples·orders + turns·orders²). */
hci_status hci_turn_ways_find(const hci_run *run, int pole_pairs, hci_turn_ways *ways, bool *found);
void hci_turn_ways_release(hci_turn_ways *ways);

/* The acceleration at an angle, of the orders that stand out: α = −t″/t′³ of the time over the angle. */
double hci_way_acceleration(const hci_turn_ways *ways, const hci_way *way, double theta_m_rad);

#endif
