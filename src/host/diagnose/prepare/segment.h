/* A sample of a recording, or the mean of several, and samples that follow each other in time. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_SEGMENT_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_SEGMENT_H

#include "hci/effects/effect.h"

/* A sample, or the mean of those at about the same angle in several turns. */
typedef struct {
    hci_sample reading; /* smoothed, for regressions */
    hci_sample raw;     /* as it was read */
    double torque_Nm;
    double sum_A;        /* i_a + i_b + i_c; NAN where they were not recorded one by one */
    double time_s;       /* ascending within a segment; 0 where there is none */
    double count;        /* samples in it; 0: it tells no torque */
    double scatter_N2m2; /* sum of the squared departures of their torques from the line along the angle
                            through the mean */
    double moment_Nmrad; /* sum of the products of the departures of torque and angle */
    double spread_rad2;  /* variance of their angles */
} hci_binned_sample;

enum { HCI_LONGEST_SEGMENT = 4096 }; /* samples of a segment */

/* Samples that follow each other in time. */
typedef struct {
    size_t run;          /* in the list of runs */
    size_t first, count; /* its samples */
    size_t turns;    /* in the mean, electrical periods where the turn is not known; 0: samples as they are */
    double period_s; /* of one turn, when turns > 0 */
    bool timed;
    bool smooth;   /* the currents are free of noise */
    double joined; /* narrow bins of the turn in a sample, on the average, >= 1; 0 is 1 */
} hci_segment;

/* Means of so many narrow bins have that part of the variance of the noise of one: what is judged by the
 * noise of a sample, and by how many there are, is judged as if they had not been joined. */
static inline double hci_segment_joined(const hci_segment *segment)
{
    return segment->joined > 1.0 ? segment->joined : 1.0;
}

#endif
