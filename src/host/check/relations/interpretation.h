/* An interpretation: one combination of assumptions on how the numbers of the files are meant (peak or rms,
 * poles or pole pairs, from which axis the angle counts, ...), and the machine that the tables are with it.
 * In: the numbers as they stand (data.h). Out: k_e, R, L and so on in SI units, so that the relations are
 * written once, without regard to conventions. */
#ifndef HCI_SRC_HOST_CHECK_INTERPRETATION_H
#define HCI_SRC_HOST_CHECK_INTERPRETATION_H

#include "host/check/data/data.h"

/* What the numbers of back_emf.csv can be. */
enum {
    CHECK_EMF_DECLARED,
    CHECK_EMF_RMS,
    CHECK_EMF_LINE,
    CHECK_EMF_LINE_RMS,
    CHECK_EMF_TAKEN_FOR_RMS, /* a peak, or a value of a phase, that was converted as another one */
    CHECK_EMF_TAKEN_FOR_LINE,
    CHECK_EMF_TAKEN_FOR_LINE_RMS,
    CHECK_EMF_VOLT_PER_KRPM,
    CHECK_EMF_VOLT_PER_KRPM_LINE,
    CHECK_EMF_VOLT_PER_KRPM_LINE_RMS,
    CHECK_EMF_KV,
    CHECK_EMF_VOLT_PER_HZ,
    CHECK_EMF_FLUX_LINKAGE,
    CHECK_EMF_TAKEN_PER_KRPM, /* of V·s/rad */
    CHECK_EMF_TAKEN_PER_KRPM_LINE,
    CHECK_EMF_TAKEN_PER_KRPM_LINE_RMS
};

/* Which two phases stand in each other's columns. */
enum { CHECK_SWAPPED_BC = 1, CHECK_SWAPPED_AB, CHECK_SWAPPED_CA };

/* Factors are 1 and flags 0 where the files are as they are declared. All fields are doubles, so that a
 * convention error is one field, a factor and a summand (convention_errors.h). */
typedef struct {
    double pole_pairs;                                     /* factor */
    double pole_pairs_counted;                             /* 1: as the recordings count them */
    double emf_kind;                                       /* CHECK_EMF_… */
    double emf_sign;                                       /* factor */
    double emf_mechanical, cogging_mechanical;             /* 1: orders per mechanical turn */
    double phase_unit, emf_phase_unit, cogging_phase_unit; /* rad per what stands in the column */
    double zero_rad;                                       /* θ = angle of the tables + this */
    double rated_current, resistance;                      /* factors */
    double slope_electrical;                               /* 1: dL per electrical radian */
    double theta_m_is_electrical, theta_e_is_mechanical;   /* 1: so */
    double theta_geared; /* 1: the angle is of a shaft that turns faster or slower, as the recordings count */
    double theta_unit;   /* rad per what stands in the column */
    double direction;    /* −1: the angle is counted backward */
    double run_zero_rad; /* θ = angle of the recording + this */
    double run_zero_free; /* 1: that is what the recordings say themselves (run_zero.h) */
    double swapped;       /* CHECK_SWAPPED_…: phases of the recordings; 0: none */
    double currents_swapped, voltages_swapped; /* those of the currents, of the voltages alone */
    double current, voltage;                   /* factors */
    double dq;                                 /* factor of i_d, i_q and of v_d, v_q */
    double voltage_is_line;                    /* 1: va, vb, vc hold v_ab, v_bc, v_ca */
    double torque, speed;                      /* factors */
    double speed_electrical;                   /* 1: so */
    double speed_mechanical;                   /* 1: so, of a column of an electrical speed */
    double speed_unsigned;                     /* 1: so; its sign is that of the angle */
    double time;                               /* factor */
} check_interpretation;

/* The machine that the tables are in an interpretation. NAN: not known. */
typedef struct {
    double pole_pairs;
    double emf_Nm_per_A, emf_phase_rad; /* k_e and γ of the fundamental, θ as in theory.md */
    double resistance_ohm, inductance_d_H, inductance_q_H;
    double reluctance_Nm_per_A2; /* torque = this × i_d × i_q: 3/2 p (L_d − L_q) */
    double rated_current_A;
} check_model;

/* Nothing is meant otherwise than it is declared. */
check_interpretation hci_check_as_declared(void);

check_model hci_check_model_of(const check_data *data, const check_interpretation *as);

/* The back-EMF at a mechanical speed as d + jq: jω_m k_e e^{jγ}, in V. */
check_vector hci_check_emf_expected(double speed_rad_per_s, const check_model *m);

/* ---- cogging.csv */

/* The electrical order of row k. */
double hci_check_cogging_order(const check_data *data, const check_interpretation *as, const check_model *m,
                               size_t k);

/* Whether row k is large enough to say where the table has its orders. */
bool hci_check_is_significant(const check_table *t, size_t k);

#endif
