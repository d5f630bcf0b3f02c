/* One step of Newton's method. */
#ifndef HCI_SRC_HOST_LIMIT_NEWTON_STEP_H
#define HCI_SRC_HOST_LIMIT_NEWTON_STEP_H

#include "host/limit/newton_state.h"

/* x, the multipliers and `moved` to those of the constraints made linear; has_failed where these have none,
 * or where it was not near enough. HCI_ERROR_MEMORY, without a note. */
hci_status hci_newton_step(hci_newton *w);

#endif
