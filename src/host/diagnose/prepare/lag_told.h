/* Whether recordings tell how slow a torque sensor is. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_LAG_TOLD_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_LAG_TOLD_H

#include "hci/machine/torque.h"
#include "host/diagnose/prepare/run_statistics.h"

/* A sensor that is slow makes each order smaller and turns it, at one speed by the same factor in all runs:
 * orders that are not known take any such factor in, and a lag pays there for nothing but the noise of the
 * currents, which it takes out of the modelled torque. What tells it is a run at another speed or in the
 * other direction, one whose current varies by a part of the largest, of which the torque is known, or a
 * ripple that the machine declares. Of runs [count] with use, whose torque was measured; where there is none,
 * false. O(runs). */
bool hci_lag_is_told(const hci_machine *machine, const hci_run *runs, const hci_run_statistics *statistics,
                     const bool *use, size_t count);

#endif
