/* Currents that keep their angle in the rotor frame: i_d = −I sin β, i_q = I cos β with a length I that may
 * be of either sign. Of a machine of which nothing else was recorded, that is all that its torque is known
 * of: which of its terms makes a ripple does not matter along the one direction. */
#ifndef HCI_SRC_HOST_SOLVE_KEPT_ANGLE_H
#define HCI_SRC_HOST_SOLVE_KEPT_ANGLE_H

#include "hci/machine/strategy.h"

/* u: out, the unit vector of the orthonormal plane along the direction at an electrical angle. angle_rad: β.
 */
void hci_kept_angle_direction(double theta_rad, double angle_rad, double u[2]);

/* What of the back-EMF e of three phases, in N·m/A and without a mean, lies along the direction at an
 * electrical angle, in its place. angle_rad: β. Returns its square. */
double hci_kept_angle_project(double theta_rad, double angle_rad, double e[3]);

/* The current along the direction that makes a torque, where the torque goes one way with it all the way from
 * no current. x: in, of the orthonormal plane, that of a neighbouring angle or 0; out, where the answer is
 * no: as long as it was. HCI_NOT_REACHED: none was found. */
hci_status hci_kept_angle_current(const hci_smooth_torque *torque, double theta_rad, double angle_rad,
                                  double wanted_Nm, double x[2]);

#endif
