/* The zero of a torque sensor, friction, or a saliency.
 *
 * Each adds one torque to the mean of a recording: the first with one sign always, the second against the
 * motion, the third with i_d i_q. Where each direction was recorded at one load alone, such as a load forward
 * and an idle turn back, one stands for another, and what the current makes is more or less by twice of it.
 * In: what was found. Out: each in the place of another as a rival, with the values that all else has then.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_STANDING_TORQUE_H
#define HCI_SRC_HOST_DIAGNOSE_STANDING_TORQUE_H

#include "host/diagnose/reading/regression.h"
#include "host/diagnose/search/attribution.h"

/* Marks those that are not in and fit as well. HCI_ERROR_MEMORY. A fit for each. */
hci_status hci_standing_torque_judge(const hci_regression *regression, hci_attribution *a, hci_note *note);

#endif
