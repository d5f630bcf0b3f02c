/* The parts of what recordings prove by themselves, each with its finding. */
#ifndef HCI_SRC_HOST_CHECK_OWN_PARTS_H
#define HCI_SRC_HOST_CHECK_OWN_PARTS_H

#include "hci/host/check/check.h"
#include "host/check/posterior.h"

/* The last part of a path. */
const char *hci_check_name_of(const char *path);

/* Before all others; the last one gives way where there are too many. */
void hci_check_put_first(hci_check *check, const hci_check_finding *finding);

/* One that is proved: file, line, column and cell of the place. */
hci_check_finding hci_check_finding_at(const char *slip, const check_place *place, const char *told_by);

/* One channel of the currents is not as the two others. */
void hci_check_add_channel(const check_data *data, hci_check *check);
/* The angle has not one zero in all recordings. */
void hci_check_add_moved(const check_posterior *p, hci_check *check);
/* The currents of some recordings turn the other way. */
void hci_check_add_sequence(const check_data *data, hci_check *check);
/* The angle of some recordings is in another unit. */
void hci_check_add_scale(const check_data *data, hci_check *check);
/* Some recordings make another torque for each ampere. */
void hci_check_add_constant(const check_data *data, hci_check *check);
/* Angle and torque are each in the other's column. */
void hci_check_add_exchanged(const check_data *data, hci_check *check);
/* i_d and i_q are each in the other's column. */
void hci_check_add_exchanged_currents(const check_data *data, hci_check *check);
/* Currents that are said to be of phases stand while the rotor turns. */
void hci_check_add_standing_currents(const check_data *data, hci_check *check);
/* The torque is noise. */
void hci_check_add_dead_torque(const check_data *data, hci_check *check);

#endif
