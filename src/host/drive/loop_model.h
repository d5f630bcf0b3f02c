/* The sampled current loop in the rotor frame, linear: what it makes of a reference and of a disturbance at
 * one frequency, and whether it is stable.
 *
 *     i = G(jν) i* − Y(jν) v        v: voltage that disturbs, such as the back-EMF
 *
 * Each is a complex 2 × 2 of d and q, since L_d and L_q may differ and the held voltage turns with the
 * stator. docs/theory.md, section 16. */
#ifndef HCI_SRC_HOST_DRIVE_LOOP_MODEL_H
#define HCI_SRC_HOST_DRIVE_LOOP_MODEL_H

#include <complex.h>
#include <stdbool.h>

typedef struct {
    double resistance_ohm, inductance_H[2]; /* L_d, L_q */
    double kp_ohm[2], ki_ohm_per_s[2];      /* of d and q */
    double filter; /* share of a new reading in the low-pass of the measured i_d and i_q; 0, 1: none */
    double sample_s, delay_s; /* from a sample to the beginning of its voltage's use, at most a sample */
    double speed_rad_per_s;   /* ω, electrical */
    bool decoupled;           /* ω L_q i_q and ω L_d i_d are added by the measured current */
} hci_loop_model;

typedef struct {
    double complex m[2][2]; /* rows: d, q of what comes out */
} hci_matrix2;

/* The same with all gains times a factor. */
hci_loop_model hci_loop_with_gains(hci_loop_model model, double factor);

/* What the low-pass makes of a current at ν. */
double complex hci_loop_filter_at(const hci_loop_model *model, double nu_rad_per_s);

/* Both at the frequency ν != 0 in the rotor frame, signed, |ν| below half the sampling. */
typedef struct {
    hci_matrix2 reference;   /* G */
    hci_matrix2 sampled;     /* the same of what the samples read */
    hci_matrix2 disturbance; /* Y, A/V */
} hci_loop_answer;

hci_loop_answer hci_loop_answer_at(const hci_loop_model *model, double nu_rad_per_s);

/* At standstill, of d or q: what the samples read of the current that a voltage makes, over the part of it at
 * that frequency, P_s/(P H). */
double complex hci_loop_sampling_at(const hci_loop_model *model, int axis, double nu_rad_per_s);

/* Largest magnitude of the closed loop's poles in z: below 1 it is stable. To 1e-4. */
double hci_loop_largest_pole(const hci_loop_model *model);

/* Time constant of the slowest of them, s: what is forgotten by 1/e in. INFINITY where it is not stable. */
double hci_loop_slowest_s(const hci_loop_model *model);

#endif
