/* The rows of a program of limits and wishes, by where they come from. Each function adds those that the
 * stage asks for. */
#ifndef HCI_SRC_HOST_LIMIT_ROWS_H
#define HCI_SRC_HOST_LIMIT_ROWS_H

#include "host/limit/build.h"

/* Phase currents and line voltages at angles; the torque there; cones of the voltage vector there
 * (current_rows.c). */
void hci_limit_add_angles(hci_limit_build *build);
void hci_limit_add_torque_angles(hci_limit_build *build);
void hci_limit_add_vectors(hci_limit_build *build);

/* Orders of the torque (torque_rows.c): the mean and the swing, linear; cones of the orders above 0;
 * equations of orders that are as wanted. */
void hci_limit_add_mean(hci_limit_build *build);
void hci_limit_add_swing(hci_limit_build *build);
void hci_limit_add_torque_cones(hci_limit_build *build);
void hci_limit_add_orders(hci_limit_build *build);

/* Sizes of the currents (current_rows.c): cones of each phase's rms current, of the copper and of the
 * distance from the last answer; equations of phases that are open. */
void hci_limit_add_rms(hci_limit_build *build);
void hci_limit_add_copper(hci_limit_build *build);
void hci_limit_add_trust(hci_limit_build *build);
void hci_limit_add_open(hci_limit_build *build);

/* hci_component_copper, and a millionth where that is 0, so that the program has one answer. */
double hci_limit_copper_of(hci_component component, int part);

#endif
