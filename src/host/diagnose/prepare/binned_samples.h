/* Recordings made small enough for thousands of fits.
 *
 * In: runs as they were read, of any length. Out: samples in segments that follow each other in time. Where
 * the current, the speed and the temperature are steady over three turns or more, a segment is the
 * synchronous average: the mean of all samples in each of 4096 bins of the turn. Elsewhere the samples stay
 * as they are, and of a long run evenly spread parts of them. Each sample carries its readings as they were
 * and smoothed. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H

#include "hci/effects/effect.h"
#include "hci/host/base/note.h"
#include "hci/host/recording/run.h"
#include "host/diagnose/prepare/run_statistics.h"

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
