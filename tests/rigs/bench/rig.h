/* A bench that exists on paper only: a machine, what its owner does not know of it, and recordings.
 *
 * The equations are those of docs/effects.md, written down a second time and on purpose without a line of the
 * library. Everything is a function of time, so that a delayed reading is exact. Angles are mechanical unless
 * the name says θ_e; phase s lags phase a by s thirds of an electrical turn. */
#ifndef RIG_H
#define RIG_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define RIG_PI 3.14159265358979323846

enum { RIG_WAVES = 8, RIG_RUNS = 16, RIG_RIPPLES = 4 };

/* ---- chance ---- */

typedef struct {
    uint64_t state;
} rig_random;

rig_random rig_random_of(const char *text, uint64_t seed);
double rig_uniform(rig_random *r, double from, double to);
double rig_log_uniform(rig_random *r, double from, double to);
double rig_normal(rig_random *r);
int rig_pick(rig_random *r, int from, int to); /* both included */
bool rig_chance(rig_random *r, double share);
/* In 0 … 1 and always the same for the same three numbers. */
double rig_hash(uint64_t seed, int64_t a, int64_t b);

/* ---- what is declared ---- */

/* S sin nθ + C cos nθ */
typedef struct {
    double order, sine, cosine;
} rig_wave;

typedef struct {
    int pole_pairs;
    double rated_current_A, rated_torque_Nm, rated_speed_rad_per_s;
    rig_wave emf[RIG_WAVES]; /* of phase a, N·m/A */
    int emf_count;
    rig_wave cogging[RIG_WAVES];
    int cogging_count;
    bool salient;
    double ld_H, lq_H, l0_H, ld6_H, lq6_H; /* L_d = ld + ld6 cos 6θ */
    double emf_frequency_Hz;               /* 0: the table is in N·m/A */
} rig_machine;

rig_machine rig_machine_draw(int most_pole_pairs, rig_random *r);
/* e·i + ½ iᵀL'i + T_cog */
double rig_torque_declared(const rig_machine *m, double theta_m_rad, const double i_A[3]);
/* L_aa, L_bb, L_cc, M_ab, M_bc, M_ca */
void rig_inductances(const rig_machine *m, double theta_e_rad, double out_H[6]);
void rig_dq_of(double theta_e_rad, const double i_A[3], double *id_A, double *iq_A);
void rig_abc_of(double theta_e_rad, double id_A, double iq_A, double i_A[3]);
double rig_waves_at(const rig_wave *w, int count, double theta_rad);

/* ---- what is hidden ---- */

typedef enum {
    RIG_COGGING,
    RIG_BACK_EMF,
    RIG_PHASE_IMBALANCE,
    RIG_RELUCTANCE,
    RIG_SATURATION,
    RIG_MAGNET_TEMPERATURE,
    RIG_CURRENT_OFFSET,
    RIG_CURRENT_GAIN,
    RIG_POSITION_OFFSET,
    RIG_POSITION_ECCENTRICITY,
    RIG_CHANNEL_DELAY,
    RIG_FRICTION,
    RIG_TORQUE_SENSOR,
    RIG_MECHANICAL_ORDER,
    RIG_EFFECTS,
    RIG_NOTHING = RIG_EFFECTS
} rig_effect;

/* Effects that docs/effects.md does not have. */
typedef enum {
    RIG_KNOWN,
    RIG_SQRT_CURRENT,
    RIG_LOOSE_PART,
    RIG_DRIFT,
    RIG_BELT,
    RIG_HYSTERESIS,
    RIG_SPEED_ORDER,
    RIG_TANH_CURRENT,
    RIG_STICK,
    RIG_BURST,
    RIG_INVENTIONS
} rig_invention;

extern const char *const RIG_EFFECT_NAME[RIG_EFFECTS];
extern const char *const RIG_INVENTION_NAME[RIG_INVENTIONS];

/* Numbers only, and zero throughout: nothing. Units of docs/effects.md. */
typedef struct {
    rig_wave cogging[2];
    rig_wave emf[1];
    double imbalance[3];
    double dd_cosine_0, qq_cosine_6;
    double d1q2_cosine_0, d0q3_sine_6, d3q0_cosine_0; /* at the rated current */
    double emf_per_kelvin;                            /* from 20 °C */
    double current_offset_A[3], current_gain[3];
    double position_offset_rad; /* electrical */
    rig_wave eccentricity[2];   /* mechanical orders */
    double current_delay_s, angle_delay_s;
    double coulomb, viscous, quadratic;
    double time_constant_s, natural_frequency_Hz, damping, torque_offset_Nm;
    rig_wave turn[1], turn_iq[1]; /* mechanical orders */
} rig_hidden;

/* One of the inventions; order, phase and scale as it uses them. */
typedef struct {
    rig_invention kind;
    double amplitude_Nm, order, phase_rad, scale;
} rig_invented;

/* ---- the bench ---- */

typedef struct {
    bool holdout;
    double theta_m_rad, omega_rad_per_s; /* at t = 0, and its mean */
    double ripple[RIG_RIPPLES], ripple_phase[RIG_RIPPLES];
    int ripple_order[RIG_RIPPLES]; /* of the speed */
    double id_A, iq_A;
    double i5_A, phase5_rad, i7_A, phase7_rad; /* injected */
    double warmth;                             /* 0 … 1 */
    double temperature_C, warming_C_per_s;
    bool has_temperature;
    double duration_s, step_s;
    int samples;
    uint64_t seed;
} rig_run;

typedef struct {
    bool electrical, wrapped, degrees, dq, speed, rpm, semicolon;
} rig_form;

typedef struct {
    rig_machine machine;
    rig_hidden hidden;
    rig_invented invented;
    rig_effect effect[2];
    int effect_count;
    rig_run run[RIG_RUNS];
    int run_count;
    double torque_noise_Nm, coloured_share, correlation_samples, current_noise_A;
    int counts_per_turn;
    rig_form form;
    uint64_t seed;
} rig_case;

/* The truth at an instant. */
typedef struct {
    double theta_m_rad, omega_rad_per_s, i_A[3], temperature_C;
} rig_instant;

rig_instant rig_run_at(const rig_case *c, const rig_run *run, double t_s);
/* Everything that reaches the torque sensor but inventions, and the inventions. */
double rig_torque_true(const rig_case *c, const rig_instant *x);
double rig_torque_invented(const rig_case *c, const rig_run *run, double t_s, const rig_instant *x);
/* What encoder and current sensors show without noise and rounding. */
double rig_angle_shown(const rig_case *c, const rig_run *run, double t_s);
void rig_currents_shown(const rig_case *c, const rig_run *run, double t_s, double i_A[3]);

/* Instruments and runs for the machine and the effects of a case. */
bool rig_case_has(const rig_case *c, rig_effect effect);
void rig_bench_draw(rig_case *c, rig_random *r);

/* The torque sensor along time. */
typedef struct {
    double lag_Nm, resonator_Nm, rate_Nm_per_s;
} rig_sensor;

bool rig_sensor_is_ideal(const rig_hidden *h);
/* One Runge-Kutta step with the input at its beginning, middle and end. */
void rig_sensor_step(const rig_hidden *h, const double input_Nm[3], double step_s, rig_sensor *s);
int rig_sensor_steps(const rig_hidden *h, double span_s, double input_rad_per_s);
/* Brings the sensor from one time of the run to another. */
void rig_sensor_follow(const rig_case *c, const rig_run *run, double from_s, double to_s, rig_sensor *s);
double rig_sensor_settling_s(const rig_hidden *h);
rig_sensor rig_sensor_settled(const rig_case *c, const rig_run *run, double t_s);

/* One sample as it is written, and what of its torque no model can know. */
typedef struct {
    double time_s, theta_m_rad, omega_rad_per_s, i_A[3], torque_Nm, temperature_C, noise_Nm;
} rig_reading;

/* Up to run->samples readings. Returns how many. */
int rig_run_read(const rig_case *c, const rig_run *run, rig_reading *out);

/* ---- a case ---- */

/* "none", "two", the name of an effect, or of an invention. False: no such kind. */
bool rig_case_draw(const char *kind, uint64_t seed, rig_case *c);
/* Over the runs to be fitted: what the hidden effects add to the residual of the declared machine, and the
 * noise of the declared machine. */
double rig_hidden_rms(const rig_case *c);
double rig_noise_rms(const rig_case *c);

typedef struct {
    const char *effect;
    char parameter[48];
    double value;
    const char *unit;
} rig_truth;

enum { RIG_TRUTHS = 16 };
int rig_truths(const rig_case *c, rig_truth out[RIG_TRUTHS]);

/* Writes machine/, runs/, runs.csv and truth.csv. False, and a word on standard error: could not. */
bool rig_case_write(const rig_case *c, const char *folder);

#endif
