/* The constraints that act at the currents of Newton's method, made linear, and how they bend. */
#ifndef HCI_SRC_HOST_LIMIT_NEWTON_COLUMNS_H
#define HCI_SRC_HOST_LIMIT_NEWTON_COLUMNS_H

#include "host/limit/newton_state.h"

/* Of each constraint and its multiplier, whose product an interior point has made small, the larger one
 * stays: the multipliers of the others become 0. */
void hci_newton_drop_slack(hci_newton *w);

/* The peaks to where they are at these currents; then fills the columns and H with how they bend, and its
 * factor. f: out, ∇f without the limits. HCI_ERROR_MEMORY, without a note. */
hci_status hci_newton_linearise(hci_newton *w, double *f);

#endif
