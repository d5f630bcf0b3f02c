/* The clock of a recording: stamps that were rounded, repeated, begin again, or do not belong to the angle
 * beside them. */
#ifndef HCI_SRC_HOST_RECORDING_CLOCK_H
#define HCI_SRC_HOST_RECORDING_CLOCK_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"

/* Stamps of n samples. */
typedef struct {
    double *time_s;    /* changed in place */
    const size_t *row; /* of each sample in the file, ascending; NULL: they follow each other */
    size_t n;
} hci_stamps;

/* Makes stamps ascend, and says in the remark how:
 *   a step back by a whole day, or by the range of a counter, goes on as if there were none;
 *   another step back begins a piece of its own, behind a gap as long as the record;
 *   stamps that are a uniform clock rounded to whole steps become that clock;
 *   other stamps that repeat, or are a little earlier than the one before, are spread evenly to the next.
 * False: they say nothing (all equal, descending, or a step back for every 20 samples). O(n). */
bool hci_clock_mend(hci_stamps stamps, hci_note *remark);

/* Longer steps of stamps that ascend, s, are gaps, as between tests of one file: over a gap nothing tells how
 * far the shaft went. O(n). */
double hci_clock_gap_s(const double *time_s, size_t n);

/* Whether stamps come early and late by turns, by a tenth of the time between samples or more, as where a bus
 * or a whole number of milliseconds makes them: what varies from sample to sample is then not told by them.
 * Before they are mended. O(n). */
bool hci_clock_is_rough(hci_stamps stamps);

typedef enum {
    HCI_CLOCK_AGREES,  /* the angle is a smooth function of the stamps, or rough in any case */
    HCI_CLOCK_JITTERS, /* it is one of the rows, and not of the stamps */
    HCI_CLOCK_FOREIGN  /* angle and stamp were not taken at the same instant */
} hci_clock_kind;

/* Holds the stamps against an unwrapped mechanical angle. What is less than 0.01 rad of the electrical angle,
 * or two steps of the encoder, does not count; a foreign clock is 0.02 rad of the mechanical angle off and
 * four steps. work: n. O(n log n). */
hci_clock_kind hci_clock_judge(hci_stamps stamps, const double *theta_m_rad, int pole_pairs, double *work);

/* Stamps that jitter: a uniform clock where they are one rounded, else means of 41 neighbours. work: n. */
void hci_clock_smooth(hci_stamps stamps, double *work, hci_note *remark);

/* Whether all columns of a table are of one clock: HCI_ERROR_INPUT where a second column of time runs
 * otherwise than the first by more than a twentieth of the record and what it may be held for, and columns
 * that are known stand to the right of both: those of one row are then of different instants.
 * HCI_ERROR_MEMORY. Columns that are left out (`none`) do not count. O(rows). */
hci_status hci_clocks_agree(hci_csv *csv, hci_note *note);

/* Puts the rows of a file that was sorted by its angle back in the order of its time, and says so: where the
 * angle never goes back, and half of the steps of time are more than twenty times the mean one, to and fro.
 * HCI_ERROR_MEMORY. O(n log n). */
hci_status hci_rows_by_time(hci_csv *csv, hci_note *note);

#endif
