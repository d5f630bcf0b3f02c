/* How good the true torque of currents within limits is, by the wishes in their order. */
#ifndef HCI_SRC_HOST_SOLVE_MERIT_H
#define HCI_SRC_HOST_SOLVE_MERIT_H

#include "host/machine/torque_gradient.h"
#include "host/solve/task.h"

typedef struct {
    double mean_error_Nm, ripple_Nm, copper_A2;
    double overshoot_Nm; /* what limits are exceeded by, as a torque: counts as the mean error does */
} hci_limit_merit;

/* *merit: out. HCI_ERROR_MEMORY. */
hci_status hci_limit_merit_evaluate(const hci_task *task, hci_minimise minimise, const hci_wave_list *current,
                                    hci_limit_merit *merit, hci_note *note);

/* Whether a is better than b: the mean first, then the ripple, then the copper. Differences below the
 * rounding of a torque of scale_Nm do not count. */
bool hci_limit_merit_less(const hci_limit_merit *a, const hci_limit_merit *b, double scale_Nm);

#endif
