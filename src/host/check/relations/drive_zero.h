/* What the direction of the currents says of the electrical zero. In: recordings of phase currents, angle and
 * torque. A drive of a machine without saliency keeps its i_d at 0, so that in all of them the current lies
 * along q, and where it does not the zero of the recorded angle is another one. The torque says which way q
 * points, and by the cosine within how much that is so. */
#ifndef HCI_SRC_HOST_CHECK_DRIVE_ZERO_H
#define HCI_SRC_HOST_CHECK_DRIVE_ZERO_H

#include "host/check/relations/interpreted_run.h"

/* rad; drives find their own zero as well as that. */
#define CHECK_DRIVE_ZERO_TOLERANCE 0.06

typedef struct {
    bool is_told;     /* the currents lie along one direction, and no declared saliency turns them */
    double zero_rad;  /* to be added to the angle of the recordings so that they lie along q */
    double reach_rad; /* within which the torques confirm it */
} check_drive_zero;

/* as->run_zero_rad does not count. O(recordings). */
check_drive_zero hci_check_drive_zero(const check_data *data, const check_interpretation *as,
                                      const check_model *m);

#endif
