/* Angles that were recorded within a turn, made to go on. */
#ifndef HCI_SRC_HOST_ANGLE_UNWRAP_H
#define HCI_SRC_HOST_ANGLE_UNWRAP_H

#include <stddef.h>

typedef enum {
    HCI_ANGLE_WHOLE,     /* was not wrapped: it is beyond a turn and does not jump back */
    HCI_ANGLE_WITHIN,    /* stays within a turn and never jumps */
    HCI_ANGLE_UNWRAPPED, /* jumped by turns, which were taken out */
    HCI_ANGLE_SCATTERED, /* neighbouring samples are no neighbours in angle; left as it was */
    HCI_ANGLE_UNCLEAR    /* a third of a turn or more from sample to sample; left as it was */
} hci_angle_path;

typedef struct {
    hci_angle_path path;
    size_t turns;     /* the jumps were by so many turns */
    size_t predicted; /* steps whose whole turns come from the speed */
} hci_unwrapping;

/* Unwraps angle_rad[n] in place. time_s: ascending, or NULL: samples without order in time may be scattered.
 * Across a gap in time the angle goes on as fast as before it.
 * rate_rad_per_s: a speed of this angle, or NULL. A rate of 0 throughout says nothing but that each sample
 * stands for itself. */
hci_unwrapping hci_unwrap(double *angle_rad, size_t n, const double *time_s, const double *rate_rad_per_s);

#endif
