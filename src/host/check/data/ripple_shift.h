/* The ripple of a torque, or of the current that balances it, belongs to the machine: two recordings whose
 * angles have one zero show it at the same places of the turn. In: two recordings. Out: by how much the angle
 * of the second is counted from another place. */
#ifndef HCI_SRC_HOST_CHECK_RIPPLE_SHIFT_H
#define HCI_SRC_HOST_CHECK_RIPPLE_SHIFT_H

#include "host/check/data/data.h"

typedef struct {
    double at_zero,
        at_best;      /* correlation of both ripples as they stand, and at the shift; 0: none is seen */
    double shift_rad; /* of the mechanical angle; of several that are as good the smallest */
    bool is_unique;   /* there is one */
} check_ripple_shift;

/* Of the orders of a mechanical turn that stand out of the noise, but for multiples of `leave` (0: all).
 * Recordings without ripple, of less than a turn, or with an electrical angle, show none. O(samples), the
 * first time. */
check_ripple_shift hci_check_ripple_shift(check_run *a, check_run *b, int leave);

#endif
