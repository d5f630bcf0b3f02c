/* A reading of the files: one choice for each thing that can be read in several ways, and what it makes of
 * the figures. */
#ifndef HCI_SRC_HOST_CHECK_INTERPRETATION_H
#define HCI_SRC_HOST_CHECK_INTERPRETATION_H

#include "host/check/figures.h"

/* What the numbers of back_emf.csv can be. */
enum {
    EMF_DECLARED,
    EMF_RMS,
    EMF_LINE,
    EMF_LINE_RMS,
    EMF_VOLT_PER_KRPM,
    EMF_VOLT_PER_KRPM_LINE,
    EMF_VOLT_PER_KRPM_LINE_RMS,
    EMF_KV,
    EMF_VOLT_PER_HZ,
    EMF_FLUX_LINKAGE
};

/* How to read the figures. All fields are doubles, so that a choice is one field, a factor and a summand. */
typedef struct {
    double pole_pairs;
    double emf_kind; /* EMF_… */
    double emf_sign;
    double emf_mechanical, cogging_mechanical;             /* 1: orders per mechanical turn */
    double phase_unit, emf_phase_unit, cogging_phase_unit; /* rad per what stands in the column */
    double zero_rad;                                       /* θ = angle of the tables + this */
    double rated_current, resistance;                      /* factors */
    double slope_electrical;                               /* 1: dL per electrical radian */
    double theta_m_is_electrical, theta_e_is_mechanical;
    double theta_unit, direction; /* direction −1: the angle is counted backward */
    double run_zero_rad;          /* θ = angle of the recording + this */
    double swapped;               /* 1: phases b and c of the recordings */
    double current, voltage;
    double dq; /* factor of i_d, i_q and of v_d, v_q */
    double voltage_is_line;
    double torque;
    double speed, speed_electrical;
    double time;
} check_view;

/* The machine that a reading makes of the tables. NAN: not known. */
typedef struct {
    double pole_pairs;
    double emf, emf_phase_rad; /* k_e in N·m/A and γ of the fundamental, θ as in theory.md */
    double resistance_ohm, inductance_d_H, inductance_q_H;
    double reluctance_Nm_per_A2; /* torque = this × i_d × i_q: 3/2 p (L_d − L_q) */
    double rated_current_A;
} check_model;

check_view hci_check_view_declared(void);
check_model hci_check_model_of(const check_figures *f, const check_view *view);

check_vector hci_check_emf_expected(double speed, const check_model *m);

/* ---- cogging.csv */

double hci_check_cogging_order(const check_figures *f, const check_view *v, const check_model *m, size_t k);
bool hci_check_is_significant(const check_table *t, size_t k);

#endif
