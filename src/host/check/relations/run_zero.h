/* Where the electrical zero of the recorded angle is. In: the statistics of the recordings, in an
 * interpretation. Out: the angle to be added to that of the recordings, by the phase of the back-EMF in their
 * voltages, or where there are none by the torque of phase currents at several angles of the current, or
 * where these lie at one angle by the drive that wants them along q (drive_zero.h). */
#ifndef HCI_SRC_HOST_CHECK_RUN_ZERO_H
#define HCI_SRC_HOST_CHECK_RUN_ZERO_H

#include "host/check/relations/interpreted_run.h"

typedef struct {
    bool is_known; /* the recordings have what tells it, in whatever interpretation */
    double zero_rad, std_error_rad;
    bool is_of_drive; /* of currents along one direction, which is q where the drive keeps its i_d at 0 */
} check_run_zero;

/* as->run_zero_rad does not count. O(recordings). */
check_run_zero hci_check_run_zero(const check_data *data, const check_interpretation *as);

/* Whether the recordings have voltages whose back-EMF tells the zero, or torques that at the angle as it is
 * no saliency, saturating or not, explains nearly as well as the zero at zero_rad does. O(recordings). */
bool hci_check_zero_is_told(const check_data *data, const check_interpretation *as, double zero_rad);

/* Standard error in rad of a zero, with what a saliency beside it leaves open; of one by the drive, within
 * what the torques confirm it. O(recordings). */
double hci_check_zero_error(const check_data *data, const check_interpretation *as, check_run_zero zero);

/* What it costs an interpretation, in nats, that the currents lie beside q in it, where their direction alone
 * tells the zero; else 0. O(recordings). */
double hci_check_beside_q_loss(const check_data *data, const check_interpretation *as);

/* Takes it, where as->run_zero_free says so. */
void hci_check_take_run_zero(const check_data *data, check_interpretation *as);

#endif
