/* A recording that has not been made: one turn of a steady run, as a model says that it would read. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_TRIAL_RUN_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_TRIAL_RUN_H

#include "host/diagnose/next/operating_points.h"

/* A dataset of one run. It must not be moved. Start with {0}. */
typedef struct {
    hci_binned_sample *sample;
    double *residual_Nm; /* of each sample */
    hci_segment segment;
    hci_run_statistics statistics;
    hci_run run;
    hci_binned_samples samples;
    hci_noise noise;
    double sum_deviation_A;
    bool use;
    hci_regression regression;
} hci_trial_run;

/* For machine and declared effects of a regression. HCI_ERROR_MEMORY. */
hci_status hci_trial_run_make(const hci_regression *regression, const hci_playable *playable,
                              hci_trial_run *trial, hci_note *note);
void hci_trial_run_release(hci_trial_run *trial);

/* Samples of the turn. O(1). */
size_t hci_trial_run_samples(int pole_pairs);

/* The readings at an operating point when `truth` is all that acts: the torque, and in a holding test the
 * current that leaves none. HCI_ERROR_MEMORY. O(samples·terms). */
hci_status hci_trial_run_play(hci_trial_run *trial, const hci_playable *playable,
                              const hci_operating_point *point, const hci_effects *truth, hci_note *note);

#endif
