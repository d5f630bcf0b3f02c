/* Recordings made small: what is left of a long one is the mean over its turns, angle by angle. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H

#include "hci/effects/effect.h"
#include "hci/host/base/note.h"
#include "hci/host/recording/run.h"

/* A sample, or the mean of those at about the same angle in several turns. */
typedef struct {
    hci_sample reading; /* smoothed, for regressions */
    hci_sample raw;     /* as it was read */
    double torque_Nm;
    double sum_A;        /* i_a + i_b + i_c; NAN where they were not recorded one by one */
    double time_s;       /* ascending within a segment; 0 where there is none */
    double count;        /* samples in it */
    double scatter_N2m2; /* sum of the squared departures of their torques from the mean */
} hci_binned_sample;

enum { HCI_LONGEST_SEGMENT = 4096 }; /* samples of a segment */

/* Samples that follow each other in time. */
typedef struct {
    size_t run;          /* in the list of runs */
    size_t first, count; /* its samples */
    size_t turns;    /* in the mean, electrical periods where the turn is not known; 0: samples as they are */
    double period_s; /* of one turn, when turns > 0 */
    bool timed;
    bool smooth; /* the currents are free of noise */
} hci_segment;

/* What a run says of itself before any model. */
typedef struct {
    double mean_torque_Nm, rms_torque_Nm;
    double mean_speed_rad_per_s, current_A; /* root mean square of the current vector's length */
    double mean_id_A, mean_iq_A;
    double repeat_Nm; /* rms departure of a sample from the mean over the turns at its angle; NAN: one turn */
    double angle_step_rad; /* smallest step of the mechanical angle: the encoder's resolution or finer */
    double turns;          /* of the mechanical angle, from the least to the largest */
    double temperature_C;  /* mean; NAN */
} hci_run_statistics;

/* Start with {0}. */
typedef struct {
    hci_binned_sample *sample;
    size_t count;
    hci_segment *segment;
    size_t segment_count;
    hci_run_statistics *statistics; /* one for each run */
    size_t run_count;
} hci_binned_samples;

/* Runs without a torque give no samples. HCI_ERROR_MEMORY. O(samples). */
hci_status hci_binned_samples_make(const hci_machine *machine, const hci_run *runs, size_t run_count,
                                   hci_binned_samples *samples, hci_note *note);
void hci_binned_samples_release(hci_binned_samples *samples);

/* Samples of the longest segment, at least 1. */
size_t hci_segment_longest(const hci_binned_samples *samples);

/* The segment of a run that follows `after` (NULL: the first one); NULL behind the last. */
const hci_segment *hci_segment_next(const hci_binned_samples *samples, size_t run, const hci_segment *after);

#endif
