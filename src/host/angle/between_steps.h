/* An angle that was read in the steps of an encoder, as it goes on between them. */
#ifndef HCI_SRC_HOST_ANGLE_BETWEEN_STEPS_H
#define HCI_SRC_HOST_ANGLE_BETWEEN_STEPS_H

#include <stddef.h>

/* Takes in place of each reading a parabola in time through the middles of the eight steps on either side, or
 * where hardly more than one sample falls on a step through as many readings, so that the mean over a step
 * stays that of the readings; where that is further from a reading than three quarters of a step, as where
 * the shaft turns round, the reading stays. angle_rad: [n], unwrapped; time_s: [n], ascending. Returns the
 * step in rad; 0 where nothing is changed: the angle is not read in steps, in steps of more than a degree, of
 * which two are passed from sample to sample or more than fifty samples fall on each (a shaft that rests
 * there), or the parabolas do not follow it. -1: memory is out. O(n). */
double hci_angle_between_steps(double *angle_rad, const double *time_s, size_t n);

#endif
