/* The least squared error of a torque that is not linear in the currents, by damped steps. */
#ifndef HCI_SRC_HOST_SOLVE_DAMPED_H
#define HCI_SRC_HOST_SOLVE_DAMPED_H

#include "host/machine/torque_gradient.h"
#include "host/solve/task.h"

/* Components whose torque is to come near to the target. */
typedef struct {
    hci_task *task;
    hci_linear_torque *at; /* what the task's gradient and offset point to; to be released after the task */
    const hci_component_set *set;
    double enough_Nm;  /* largest error of an order with which the target is reached, and it ends */
    double *x;         /* S and C of each component in A; in: where to begin, out: the nearest */
    double square_Nm2; /* out: squared error of the torque, weighted */
    double change;     /* out: of the last step, as a share of the currents */
    size_t steps;      /* out: times that the torque was made linear */
    bool is_at_rest;   /* out: the target is reached, or no step lowers the error any more */
} hci_damped;

enum { HCI_DAMPED_MOST = 256 }; /* components; its matrix is dense */

/* Never goes away from the target: the error at x is at most what it was. A minimum in the neighbourhood of
 * where it began; of several currents with the same error not the one of least copper. The task is left
 * linear at x. HCI_ERROR_MEMORY, _STOPPED. */
hci_status hci_damped_descend(hci_damped *d, hci_note *note);

/* Star waves of a set at coordinates x (2·count), and in front what is held (or NULL), into *waves, whose
 * memory is replaced. HCI_ERROR_MEMORY. */
hci_status hci_set_waves(const hci_component_set *set, const double *x, const hci_wave *held,
                         hci_wave_list *waves, hci_note *note);

#endif
