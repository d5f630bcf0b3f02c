/* Whether a saliency explains what a zero of the angle would. In: the statistics of the recordings, in an
 * interpretation. Out: whether their torques ask for another zero also beside a reluctance torque that is
 * free, and both as saturation leaves them. */
#ifndef HCI_SRC_HOST_CHECK_ZERO_SALIENCY_H
#define HCI_SRC_HOST_CHECK_ZERO_SALIENCY_H

#include "host/check/interpreted_run.h"

/* Whether the recordings have voltages whose back-EMF tells the zero, or torques that at the angle as it is
 * no saliency explains nearly as well as the zero at zero_rad does. O(recordings). */
bool hci_check_zero_is_told(const check_data *data, const check_interpretation *as, double zero_rad);

#endif
