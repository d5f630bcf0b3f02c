/* A run cut into turns of the shaft, and which of them are alike enough to be averaged.
 *
 * In: angles and currents of a run. Out: turns one after the other, each with its mean i_d, i_q, speed and
 * temperature. Where the mechanical turn is not known, a turn is an electrical period. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_TURNS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_TURNS_H

#include "host/diagnose/prepare/run_statistics.h"

enum { HCI_TURN_PARTS = 8 };

/* The current in a part of a turn. */
typedef struct {
    double d, q;  /* A */
    double count; /* samples */
} hci_turn_part;

/* Samples of one turn, and their means. */
typedef struct {
    size_t first, count;
    double d, q;                        /* A */
    hci_turn_part part[HCI_TURN_PARTS]; /* evenly, from the zero of the angle on */
    double noise_A2;                    /* mean square of their noise, from neighbouring samples */
    double speed;                       /* rad/s; 0: not recorded */
    double least_speed, most_speed;
    double temperature; /* °C; 0: not recorded */
    double torque;      /* N·m; 0: not recorded */
    bool whole;         /* not cut off by the end of the run or by turning back */
    bool ends_run;      /* it would be whole, but that the run ends with it */
} hci_turn;

/* The mechanical angle after which everything repeats. */
double hci_turn_rad(const hci_run *run, int pole_pairs);

/* 1 where the angle rises between two samples, −1 where it falls. */
double hci_turn_direction(const hci_run *run, size_t from, size_t to);

/* All turns of a run, each ended by the next or by the shaft turning back. turns: out, to be freed whatever
 * is returned. False when memory is out. O(samples). */
bool hci_turns_find(const hci_run *run, int pole_pairs, hci_turn **turns, size_t *count);

/* Whether two turns may go into one mean: whole, the same way round, and current, speed and temperature
 * differ by less than 2 % of the run's, or currents by chance, and 1 K. Those of a free shaft must be even in
 * themselves, since a mean is spread evenly over the time of a turn and accelerations are of time. */
bool hci_turns_alike(const hci_run *run, const hci_run_statistics *statistics, const hci_turn *a,
                     const hci_turn *b);

/* Whether within turns that are alike the current is often another one, part by part, than in the first: by
 * 2 % of the run's and more than chance in one of four, as where it follows a load that does not turn with
 * the shaft. A mean of few turns has lost that. O(count). */
bool hci_turns_swing(const hci_run *run, const hci_run_statistics *statistics, const hci_turn *turns,
                     size_t count);

/* Whether the mean torque of turns that are alike rises or falls from the first to the last: by a line that
 * is six of its standard errors steep, and by a fifth of how much single samples scatter. Less than six turns
 * do not tell. O(count). */
bool hci_turns_creep(const hci_run_statistics *statistics, const hci_turn *turns, size_t count);

#endif
