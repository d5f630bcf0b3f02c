/* Torques that a drive has estimated from its own current behind a filter: as those that are k_t·i_q in every
 * row (computed_torque.h) they say nothing of the machine. */
#ifndef HCI_SRC_HOST_RECORDING_ESTIMATED_TORQUE_H
#define HCI_SRC_HOST_RECORDING_ESTIMATED_TORQUE_H

#include "hci/host/recording/run.h"

/* How a torque over time follows i_q behind a first-order low pass. */
typedef struct {
    double constant_Nm_per_A; /* of i_q */
    double time_constant_s;   /* of the low pass */
    bool within_rounding;     /* nothing is left but the rounding of both */
    bool is_of_noise; /* without a current it follows the noise of the current sensors: no shaft does */
    bool tells;       /* whether the run could show either */
} hci_torque_estimate;

/* Of a run with a measured torque, time, angle and currents; others do not tell. torque_constant: of the
 * machine, N·m/A; 0: not known. HCI_ERROR_MEMORY. O(samples). */
hci_status hci_torque_estimate_of(const hci_run *run, double torque_constant, hci_torque_estimate *estimate,
                                  hci_note *note);

/* Frees the torques of a list that are such estimates, where more than half of the runs that tell show it:
 * then of all runs, since one column of one drive made them; else of those that show it. What is left is read
 * as runs without a torque are. HCI_ERROR_MEMORY. */
hci_status hci_estimated_torques_leave(hci_run *runs, size_t count, const hci_run_options *options,
                                       hci_note *note);

#endif
