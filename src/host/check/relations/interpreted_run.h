/* A recording in an interpretation: its speed, currents, voltages and power in SI units, d along the magnets,
 * as they are if the numbers are meant that way. In: the statistics of the recording (data.h). Out: what the
 * relations compare with the machine. The has_… functions say which recordings can be used; they do not
 * depend on the interpretation, so that none can escape from a relation. */
#ifndef HCI_SRC_HOST_CHECK_INTERPRETED_RUN_H
#define HCI_SRC_HOST_CHECK_INTERPRETED_RUN_H

#include "host/check/relations/interpretation.h"

/* Electrical angle per recorded angle; negative where the angle is counted backward. */
double hci_check_scale_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* Mechanical speed in rad/s: by angle and time (NAN where one is missing), by the column (NAN without it),
 * and by the column or else by the angle. */
double hci_check_angle_speed_of(const check_run *r, const check_interpretation *as, const check_model *m);
double hci_check_column_speed_of(const check_run *r, const check_interpretation *as, const check_model *m);
double hci_check_speed_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* The column's mean over the time in which the angle was followed. */
double hci_check_speed_over_time_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* Mean current i_d + j i_q in A; 0 where none was recorded. */
check_vector hci_check_current_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* 3/2 i e* per rad/s, in N·m: its real part is what the magnets make of the current. */
check_vector hci_check_mutual_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* The means of the voltage equation, in V, A and rad/s. */
check_voltage_terms hci_check_voltage_terms_of(const check_run *r, const check_interpretation *as,
                                               const check_model *m);

/* Mean electrical power in W. */
double hci_check_power_of(const check_run *r, const check_interpretation *as, const check_model *m);

/* ---- which recordings can say something, in every interpretation */

bool hci_check_is_unbalanced(double balance);
bool hci_check_has_speed(const check_run *r);
bool hci_check_has_vector_current(const check_data *data, const check_run *r);
bool hci_check_tells_torque(const check_data *data, const check_run *r); /* phase currents beside it */
bool hci_check_has_turning_voltage(const check_run *r);
bool hci_check_has_drop(const check_data *data, const check_run *r);
bool hci_check_has_emf(const check_data *data, const check_run *r, const check_model *m);

/* Whether phases b and c of the currents, or of the voltages, are read the other way round. */
bool hci_check_currents_swapped(const check_interpretation *as);
bool hci_check_voltages_swapped(const check_interpretation *as);

#endif
