/* A column of torques that a drive has computed from its own current: it says of the current what is known of
 * it already, and of the machine nothing. */
#ifndef HCI_SRC_HOST_RECORDING_COMPUTED_TORQUE_H
#define HCI_SRC_HOST_RECORDING_COMPUTED_TORQUE_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/recording/run.h"

/* Whether n torques are one constant times i_q of the same sample, but for the rounding of both (twice their
 * steps, or 1e-6 of the largest torque), while i_q varies by more than a hundredth of its largest value and
 * more than that rounding. A torque that was measured has noise and cogging. constant: out, N·m/A. Fewer than
 * 16 samples say nothing. O(n). */
bool hci_torque_is_of_current(const double *torque_Nm, const double *iq_A, size_t n, double *constant);

/* Whether the torque of a run is one number other than 0 in every row while i_q varies by more than a
 * thousandth, both over the angle: what somebody has typed, or a sensor that stands still. A measured torque
 * has noise. Fewer than 16 samples say nothing. O(samples). */
bool hci_torque_is_typed(const hci_run *run);

/* Frees the torques of a list that are one number other than 0 in every row, as in another run where it was
 * typed (above), or whose mean i_q is another one by a tenth of the largest: no machine makes the same torque
 * of two currents, and the current of a steady run varies too little to tell by itself. O(runs x samples +
 * runs²). */
void hci_torques_typed_leave(hci_run *runs, size_t count);

/* Says of runs whose torque is one number that it is the end of a sensor, where another current has the same
 * number, or the other sign of it. O(samples x runs of such a torque). */
void hci_torques_at_one_end_tell(hci_run *runs, size_t count);

/* A torque that a drive has estimated from its own current, behind a filter or not, says nothing of the
 * machine either. How such a torque follows i_q behind a first-order low pass, or none: */
typedef struct {
    double constant_Nm_per_A; /* of i_q */
    double time_constant_s;   /* of the low pass; 0: none, i_q of the same sample */
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
