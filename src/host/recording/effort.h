/* Whether a current works with the motion of a shaft or against it, of a recording without a torque. By
 * itself a motor accelerates where its current is larger, and its current makes up for what friction takes:
 * both hold whatever the inertia, and both turn round with the sign of the current, or of angle and speed
 * together. */
#ifndef HCI_SRC_HOST_RECORDING_EFFORT_H
#define HCI_SRC_HOST_RECORDING_EFFORT_H

#include <stdbool.h>

#include "hci/host/recording/run.h"

/* Of one recording, [count] each, in any unit. */
typedef struct {
    const double *time, *speed, *iq;
    const double *theta_m_rad; /* NULL: where in its mechanical turn the shaft is, is not known */
    size_t count;
} hci_effort_samples;

/* i_q = a·acceleration + c·sign(speed) + a weight, which is told where the shaft turns both ways; where that
 * tells no sign, also + orders 1 and 2 of the mechanical turn, which an arm or a crank makes. */
typedef struct {
    double accelerating; /* a over its standard error; 0: not told */
    double slope;        /* a, in the units of i_q and acceleration */
    double braking;      /* c over its standard error; 0: not told */
    double share;        /* c over the rms of i_q in the windows, without these orders, from -1 to 1 */
    double of_all;       /* c over the rms of i_q in all samples, likewise */
    bool has_both_ways;  /* forward and back: c has no weight in it */
} hci_effort;

/* By least squares over windows; zeros where there are too few samples. O(count). */
hci_effort hci_effort_find(const hci_effort_samples *samples);

/* 1: the current works with the motion, -1: against it, 0: not told. What accelerates goes before what
 * brakes. */
int hci_effort_way(const hci_effort *effort);

/* Whether the sign is told by what accelerates. */
bool hci_effort_accelerates(const hci_effort *effort);

/* Sets current_way and iq_per_acceleration of a run whose i_q the drive has recorded, or whose phase currents
 * lie along i_q, with a remark where it is -1, and counts_pole_pairs. Rows without time are taken as evenly
 * spaced. HCI_ERROR_MEMORY. O(samples). */
hci_status hci_run_effort_set(hci_run *run, hci_note *note);

#endif
