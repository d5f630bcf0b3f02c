/* An encoder with so few counts that a table read at them is another one. */
#ifndef HCI_SRC_HOST_DRIVE_COARSE_ANGLE_H
#define HCI_SRC_HOST_DRIVE_COARSE_ANGLE_H

#include <stdbool.h>

#include "hci/effects/effect.h"
#include "hci/loop.h"

/* Whether there are fewer counts in an electrical turn than twice the highest order of the table: orders then
 * act as others, and on the mean. counts: in a mechanical turn; 0: the angle is not counted. */
bool hci_angle_is_coarse(double counts, int pole_pairs, double highest_order);

/* The mean torque in N·m of the currents of a table that is read in the middle of each count and held, in
 * axes at that angle, as where the speed is low; at a torque that is asked for. NAN where memory is out.
 * O(angles · harmonics). */
double hci_coarse_mean_Nm(const hci_loop_f32 *loop, const hci_machine *machine, const hci_effects *effects,
                          double counts, double torque_Nm);

#endif
