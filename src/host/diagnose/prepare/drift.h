/* A torque that creeps along a run, much slower than a turn: of a sensor whose zero drifts, of oil that gets
 * warm. A mean over turns would make noise of it that no turn repeats. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_DRIFT_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_DRIFT_H

#include "host/diagnose/prepare/run_statistics.h"

/* Finds it in a steady run of a torque sensor, one way, whose current, speed and temperature do not creep
 * with it: each torque less that of one turn before holds nothing that repeats with the turn. Nm_per_A: of
 * i_q. What was not found has a degree of 0. O(samples). */
hci_drift hci_drift_find(const hci_run *run, const hci_run_statistics *statistics, int pole_pairs,
                         double Nm_per_A);

/* Straight lines of one rate, and no other drift, are the effect torque_drift in runs of many turns
 * (hci_turns_creep), and none there. */
void hci_drifts_leave_to_effect(hci_run_statistics *statistics, size_t runs);

/* At a time; 0 on average over the run. */
double hci_drift_at_Nm(const hci_drift *drift, double time_s);

/* From its least to its largest in the run. */
double hci_drift_peak_to_peak_Nm(const hci_drift *drift);

#endif
