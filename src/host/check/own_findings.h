/* Slips that recordings prove by themselves, beside any reading of the tables: a channel of the currents that
 * is not as the two others, an angle that has not one zero in all recordings, and a torque that is noise. In:
 * the data and the best interpretation. Out: findings. */
#ifndef HCI_SRC_HOST_CHECK_OWN_FINDINGS_H
#define HCI_SRC_HOST_CHECK_OWN_FINDINGS_H

#include "hci/host/check/check.h"
#include "host/check/posterior.h"

/* Adds them before all others: no other finding is told as well. */
void hci_check_own_findings(const check_posterior *p, hci_check *check);

#endif
