/* The relations of `check`, and what they share. Each function answers HCI_CHECK_NONE where the figures do
 * not have what it needs, whatever the view. */
#ifndef HCI_SRC_HOST_CHECK_RELATIONS_H
#define HCI_SRC_HOST_CHECK_RELATIONS_H

#include "host/check/interpretation.h"

/* Tolerances that are also the measure of what is unknown in one recording. */
enum {
    EMF_TOLERANCE_PERCENT = 5,
    EMF_ANGLE_TOLERANCE_PERCENT = 15,
    RESISTANCE_TOLERANCE_PERCENT = 20,
    POWER_TOLERANCE_PERCENT = 8,
    TORQUE_TOLERANCE_PERCENT = 5,
    COGGING_ANGLE_TOLERANCE_PERCENT = 30
};
#define PERCENT(x) ((x) / 100.0)

/* Resistance (warm copper) and inductance (saturation) are known to a fifth. */
#define DROP_UNKNOWN 0.2

/* What a drive logs as v_d, v_q is what it has asked for: dead times and drops of its switches are not in it.
 */
#define COMMAND_UNKNOWN 0.05

/* A machine without inductances is declared to have L_d = L_q; so much of k_e may p (L_d − L_q) i_d be after
 * all. */
#define SALIENCY_UNKNOWN 0.15

extern const check_value HCI_CHECK_NONE;
check_value hci_check_found(double found);
check_value hci_check_ratio_of(double top, double bottom); /* HCI_CHECK_NONE unless bottom > 0 */
double hci_check_or_zero(double x);                        /* 0 for NAN */

/* Least squares of `top` over `bottom` through the origin, over the recordings. Starts from {0}. */
typedef struct {
    double cross, square, other, unknown;
} check_fit;

/* unknown: what may be missing in `bottom`, in the measure of its usual tolerance: such a recording counts
 * less. */
void hci_check_fit_add(check_fit *x, double top, double bottom, double unknown);
check_value hci_check_fit_value(const check_fit *x);

/* ---- cogging.csv */

double hci_check_cogging_order(const check_figures *f, const check_view *v, const check_model *m, size_t k);
bool hci_check_is_significant(const check_table *t, size_t k);

/* ---- a recording in a view (check_seen.c) */

double hci_check_scale_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_angle_speed_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_column_speed_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_speed_of(const check_run *r, const check_view *v, const check_model *m);
check_vector hci_check_current_of(const check_run *r, const check_view *v, const check_model *m);
check_loop hci_check_loop_of(const check_run *r, const check_view *v, const check_model *m);
double hci_check_power_of(const check_run *r, const check_view *v, const check_model *m);
check_vector hci_check_phase_of_line(check_vector x, const check_view *v);
check_vector hci_check_emf_expected(double speed, const check_model *m);

bool hci_check_turns(double order);
bool hci_check_is_unbalanced(double balance);
bool hci_check_has_speed(const check_run *r);
bool hci_check_has_vector_current(const check_figures *f, const check_run *r);
bool hci_check_has_turning_voltage(const check_run *r);
bool hci_check_has_drop(const check_figures *f, const check_run *r);
bool hci_check_has_emf(const check_figures *f, const check_run *r, const check_model *m);

/* ---- relations */

check_value hci_check_of_emf_order(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_emf_phase(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_emf_phase_range(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_phase_range(const check_figures *f, const check_view *v,
                                             const check_model *m);
check_value hci_check_of_cogging_sixes(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_slots(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_first(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_inductance_difference(const check_figures *f, const check_view *v,
                                               const check_model *m);
check_value hci_check_of_rated_torque(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_rated_voltage(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_flux_size(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_flux_per_current(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_current_order(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_voltage_order(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_angle_speed(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_angle_ratio(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_frequency_speed(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_emf_size(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_emf_angle(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_resistance_size(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_emf_per_frequency(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_power_balance(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_torque_size(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_share(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_size(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_cogging_angle(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_current_sum(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_current_balance(const check_figures *f, const check_view *v, const check_model *m);
check_value hci_check_of_voltage_balance(const check_figures *f, const check_view *v, const check_model *m);

#endif
