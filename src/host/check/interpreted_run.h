/* A recording in a view. */
#ifndef HCI_SRC_HOST_CHECK_INTERPRETED_RUN_H
#define HCI_SRC_HOST_CHECK_INTERPRETED_RUN_H

#include "host/check/interpretation.h"

double hci_check_scale_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_angle_speed_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_column_speed_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_speed_of(const check_run *r, const check_view *v, const check_model *m);
check_vector hci_check_current_of(const check_run *r, const check_view *v, const check_model *m);
check_loop hci_check_loop_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_power_of(const check_run *r, const check_view *v, const check_model *m);
check_vector hci_check_phase_of_line(check_vector x, const check_view *v);

bool hci_check_turns(double order);
bool hci_check_is_unbalanced(double balance);
bool hci_check_has_speed(const check_run *r);
bool hci_check_has_vector_current(const check_figures *f, const check_run *r);
bool hci_check_has_turning_voltage(const check_run *r);
bool hci_check_has_drop(const check_figures *f, const check_run *r);
bool hci_check_has_emf(const check_figures *f, const check_run *r, const check_model *m);

#endif
