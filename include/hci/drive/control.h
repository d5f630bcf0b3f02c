/* Control of the simulated drive: a speed loop, torque to currents, current control; and the closed loop of
 * all.
 *
 *     speed ─▶ PI ─▶ torque ─▶ strategy, current waves or code ─▶ limits
 *         ─▶ hysteresis, PI or ideal ─▶ inverter
 *
 * Everything runs once a step of the plant; slower samples are every n-th. For an interrupt: hci/foc.h. */
#ifndef HCI_DRIVE_CONTROL_H
#define HCI_DRIVE_CONTROL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hci/drive/plant.h"
#include "hci/drive/sensor.h"
#include "hci/machine/strategy.h"
#include "hci/math/harmonic.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- parts ---- */

/* Proportional-integral controller y = k_p ε + k_i ∫ε dt, |y| <= limit, integral by the forward rectangle.
 * While the output is limited the integral is drawn towards the limit with the time constant k_p/k_i
 * (back-calculation); with k_p = 0 it stays at the limit. */
typedef struct {
    double proportional;   /* k_p, unit of y by unit of ε */
    double integral_per_s; /* k_i, the same per second */
} hci_pi;

/* One sample of the controller. integral: in/out, in the unit of y. sample_s: > 0. Returns y. */
double hci_pi_step(const hci_pi *pi, double *integral, double error, double limit, double sample_s);

/* Two-level hysteresis control, each phase for itself: a leg goes to the negative rail when its current is
 * more than half the band above the reference, to the positive rail when as much below, and otherwise stays,
 * at least `hold_steps` steps. With a floating star point a phase depends on all three legs, so the error can
 * reach twice half the band, that is the whole band, plus what it moves in hold_steps. */
typedef struct {
    double band_A;       /* full width */
    unsigned hold_steps; /* between two switchings of a leg; 0 and 1 are no restriction */
} hci_hysteresis;

/* What a hysteresis control keeps from step to step. */
typedef struct {
    unsigned legs;       /* bit s set: leg s at the positive rail */
    unsigned held[3];    /* steps for which leg s must still rest */
    uint64_t switchings; /* of all legs */
} hci_hysteresis_state;

/* The shortest hold with which a leg never exceeds a switching frequency (one period: on and off), that is
 * half a period in whole steps, rounded up. frequency_Hz: INFINITY for none. */
unsigned hci_hysteresis_hold(double frequency_Hz, double step_s);

/* One step. Returns the legs. */
unsigned hci_hysteresis_step(const hci_hysteresis *hysteresis, hci_hysteresis_state *state,
                             const double reference_A[3], const double measured_A[3]);

/* PI control of i_d and i_q in the rotor frame of the electrical angle, average voltages within the hexagon.
 * Gains in V/A and V/(A·s) are the same in amplitude-invariant and orthonormal axes. The voltage is turned
 * ahead by the rotor's way from the sample to the middle of its use. */
typedef struct {
    hci_pi pi[2];   /* of d and q, V/A and V/(A·s) */
    double filter;  /* share of a new reading in the low-pass of i_d and i_q before the PI; 0, 1: none */
    bool decoupled; /* adds ω (e + L'i) and the rotation of L i, from the table */
    /* Steps from a sample to the use of its voltage, at most those of a sample: all of them where a PWM unit
     * is loaded once a period. */
    unsigned delay_steps;
    hci_modulation modulation; /* which voltages there are */
    hci_dead_time dead_time;   /* what it adds against the inverter's, by the measured current; 0: nothing */
} hci_current_pi;

/* What a PI current control keeps from sample to sample. */
typedef struct {
    double integral[2]; /* d, q, V */
    double filtered[2]; /* d, q, A; where there is a filter */
    double v[2];        /* in use, αβ */
    double pending[2];  /* from the last sample */
    unsigned wait;      /* steps until that is used; 0: it is */
    uint64_t limited;   /* samples whose voltage the inverter could not give */
} hci_current_pi_state;

/* ---- the controller ---- */

/* How currents follow their references. */
typedef enum {
    HCI_CURRENT_IDEAL,      /* they are their references */
    HCI_CURRENT_HYSTERESIS, /* each phase for itself, switched voltages */
    HCI_CURRENT_PI          /* in the rotor frame, average voltages */
} hci_current_loop;

/* Their words in files: X(loop, word). */
#define HCI_CURRENT_LOOP_NAMES(X)                                                                            \
    X(HCI_CURRENT_IDEAL, "ideal")                                                                            \
    X(HCI_CURRENT_HYSTERESIS, "hysteresis")                                                                  \
    X(HCI_CURRENT_PI, "pi")

/* What a controller reads. */
typedef struct {
    double i_abc[3];        /* phase currents, A */
    double theta_m_rad;     /* mechanical angle */
    double speed_rad_per_s; /* mechanical speed */
} hci_measurement;

/* What somebody else's code asks for at a sample, in the rotor frame of the measured angle,
 * amplitude-invariant. */
typedef struct {
    double i_A[2]; /* reference current, d and q */
    double v_V[2]; /* added to the voltage of a PI loop: d, q */
} hci_reference_dq;

/* Code that gives the references, such as a table that runs on a target. Called once a sample. */
typedef struct {
    /* context: of this struct. torque_Nm: commanded. reference: out. */
    void (*at)(void *context, const hci_measurement *measured, double torque_Nm, hci_reference_dq *reference);
    void *context; /* first argument of at */
} hci_reference_code;

/* Where reference currents come from, from a time on: code; or a strategy; or, when there are waves,
 * T·per_Nm(θ) + fixed(θ). */
typedef struct {
    double from_s;                  /* time from which on it holds */
    hci_strategy strategy;          /* used when there are no waves */
    const hci_wave *per_Nm;         /* A/(N·m); NULL with count 0 */
    size_t per_Nm_count;            /* entries of per_Nm */
    const hci_wave *fixed;          /* A; NULL with count 0 */
    size_t fixed_count;             /* entries of fixed */
    const hci_reference_code *code; /* NULL: none */
} hci_current_source;

/* The controller of a drive. */
typedef struct {
    const hci_plant_table *table; /* the machine as the controller models it */
    double step_s;                /* of the plant */
    double dc_link_V;             /* voltage of the dc link, > 0; not used by the ideal loop */

    bool speed_controlled; /* the set point is a speed in rad/s, otherwise a torque in N·m */
    hci_pi speed;          /* N·m·s/rad and N·m/rad */
    unsigned speed_every;  /* steps between its samples; 0 is 1 */
    /* |torque command|, > 0; INFINITY for none. The speed loop winds up against current limits, which it does
     * not see: keep this at or below sqrt(3/2)·iq_limit. */
    double torque_limit_Nm;

    const hci_current_source *sources; /* ascending in from_s; the first holds from the start */
    size_t source_count;               /* >= 1 */
    unsigned current_every; /* steps between samples of the references, and of PI current control; 0 is 1 */

    /* Limits > 0, INFINITY for none. |i_dx| and |i_qx| of a strategy's current are in the frame dq_x of
     * frames.h, as the second paper's 8 A each, where 1 N·m of mutual torque takes sqrt(2/3) of i_qx whatever
     * the machine; waves are not limited by them. The peak limit holds for all: the length of the current, as
     * the peak of the sine that is as long. */
    double id_limit;     /* of a strategy's |i_dx| */
    double iq_limit;     /* of a strategy's |i_qx| */
    double peak_limit_A; /* of any reference, as the peak of a sine */

    hci_current_loop loop;     /* which of the three */
    hci_hysteresis hysteresis; /* of the hysteresis loop */
    hci_current_pi current;    /* of the PI loop */
} hci_control;

/* All zeros is a controller before its first step. */
typedef struct {
    uint64_t step;                     /* steps done */
    unsigned speed_wait, current_wait; /* steps to the next sample */
    size_t source;                     /* the one in use */
    double speed_integral_Nm;          /* of the speed loop */
    double torque_Nm;                  /* command */
    double answer[2];                  /* the strategy's current before limits, αβ */
    bool has_answer;                   /* whether answer is one */
    uint64_t unreached;                /* samples at which the strategy had no current for the torque */
    uint64_t limited;                  /* samples at which a current limit was active */
    hci_hysteresis_state hysteresis;   /* of the hysteresis loop */
    hci_current_pi_state current;      /* of the PI loop */
    double reference[2];               /* A, αβ */
    double feed[2];                    /* V, αβ of the measured angle: what code adds to the PI loop */
    double v[2];                       /* V, αβ; not used by the ideal loop */
} hci_control_state;

/* One step: state->v (state->reference with the ideal loop) is what the plant gets until the next one.
 * O(1) with a strategy, O(waves) at the samples with waves; may run in an interrupt. */
void hci_control_step(const hci_control *control, hci_control_state *state, const hci_measurement *measured,
                      double set_point);

/* ---- the closed loop ---- */

/* Machine, controller and sensors in a closed loop. */
typedef struct {
    hci_plant plant;           /* machine and shaft */
    hci_dead_time dead_time;   /* of the inverter, with the PI loop; zeros: none */
    hci_control control;       /* and what drives them */
    const hci_sensor *sensors; /* HCI_SENSE_COUNT of them, or NULL: all ideal */
} hci_drive;

/* The state of a drive. */
typedef struct {
    hci_plant_state plant;                     /* of machine and shaft */
    hci_control_state control;                 /* of the controller */
    hci_sensor_state sensors[HCI_SENSE_COUNT]; /* started by the caller, when there are sensors */
    hci_measurement measured;                  /* at the start of the last step */
    double v[2];                               /* V, αβ, at the machine in the last step */
    double torque_Nm;                          /* true torque there */
    double torque_measured_Nm;                 /* and its reading */
} hci_drive_state;

/* state->measured: what the sensors read of the plant now, the first part of a step. For who controls the
 * plant by other means; each call is one step of the sensors. */
void hci_drive_measure(const hci_drive *drive, hci_drive_state *state);

/* Measure, control, and move the plant on by control.step_s. The state's plant is then one step ahead of its
 * measurements. */
void hci_drive_step(const hci_drive *drive, hci_drive_state *state, double set_point, double load_Nm);

#ifdef __cplusplus
}
#endif

#endif
