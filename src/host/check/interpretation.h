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

/* One way to read one thing. */
typedef struct {
    const char *slip;
    int aspect; /* of choices with the same aspect at most one is taken */
    double prior;
    size_t field; /* offset in check_view: field = field × times + plus */
    double times, plus;
    int where;
    const char *words;
    const char *should_be; /* with %s for the number that should stand there */
    const char *told_by;   /* what would tell this slip from its like */
} check_choice;

extern const check_choice HCI_CHECK_CHOICES[];
extern const size_t HCI_CHECK_CHOICE_COUNT;

/* Whether the files have what a choice is about. */
bool hci_check_choice_applies(const check_choice *choice, const check_figures *f);

double hci_check_choice_prior(const check_choice *choice, const check_figures *f);

check_view hci_check_view_declared(void);
void hci_check_view_take(check_view *view, const check_choice *choice);
check_model hci_check_model_of(const check_figures *f, const check_view *view);

/* Where a choice points to, what stands there and what should. */
void hci_check_choice_locate(const check_choice *choice, const check_figures *f, const check_view *view,
                             hci_check_finding *finding);

/* ---- relations */

typedef enum {
    CHECK_RATIO, /* found/expected, by its logarithm */
    CHECK_LOW,   /* so, below 1 with half as much again: friction, and a cautious sheet */
    CHECK_HIGH,  /* so, below 1 with half the tolerance: copper is warmer than on the sheet, seldom colder */
    CHECK_ANGLE, /* radians, modulo a turn */
    CHECK_SHARE, /* a difference */
    CHECK_MOST   /* at most the expected, by the logarithm of what is above */
} check_kind;

/* NAN: the figures do not have it. spread: the tolerance is this many times the least one. */
typedef struct {
    double found, spread;
} check_value;

typedef struct {
    const char *name, *words;
    check_kind kind;
    double expected, tolerance;
    double cap; /* the most that one relation can say against a reading, in nats */
    check_value (*of)(const check_figures *f, const check_view *view, const check_model *model);
    const char *needs;
    const char *instead; /* relation that says the same where it can be checked; "": none */
} check_relation;

extern const check_relation HCI_CHECK_RELATIONS[];
extern const size_t HCI_CHECK_RELATION_COUNT;

/* Deviation in standard deviations, and what it costs in nats. */
double hci_check_deviation(const check_relation *relation, check_value value);
double hci_check_loss(const check_relation *relation, check_value value);

/* ---- all readings: fills verdict, findings, evidence and gaps. HCI_ERROR_MEMORY. */
hci_status hci_check_weigh(const check_figures *f, hci_check *check, hci_note *note);

#endif
