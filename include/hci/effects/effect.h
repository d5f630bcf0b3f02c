/* Physical effects that a machine or a test bench has beyond the declared machine.
 *
 * Each type of effect is one file with its parameters and pure functions, all of them exact, that simulating,
 * predicting and diagnosing share.
 *
 *   on the machine   an additional torque T_x(θ_m, i, ω, ϑ), with ∂T_x/∂i, ∂T_x/∂θ_m and ∂T_x/∂(parameter)
 *   on the bench     what the sensors read for a true state, the inverse, and its derivatives
 *
 * Effects on the machine add to the declared machine and do not act on each other. Those of a magnetic
 * circuit come from a co-energy W'(θ_m, i):
 *
 *     T_x = ∂W'/∂θ_m      ∂ψ_x/∂θ_m = ∂²W'/∂i∂θ_m = ∂T_x/∂i      L_x = ∂²W'/∂i²
 *
 * so the motional voltage ω ∂T_x/∂i and the inductance L_x belong to the torque, and the plant conserves
 * energy.
 *
 * An order in a parameter's name is electrical; one that is within the tolerance of k/p is k/p. */
#ifndef HCI_EFFECTS_EFFECT_H
#define HCI_EFFECTS_EFFECT_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/drive/plant.h"
#include "hci/drive/sensor.h"
#include "hci/machine/torque.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- samples ---- */

/* One instant, true or as it is read. */
typedef struct {
    double theta_m_rad; /* mechanical, of any size; θ = p·θ_m. Only an unwrapped electrical angle divided
                         * by p will do where there are orders k/p */
    double speed_rad_per_s;         /* mechanical */
    double acceleration_rad_per_s2; /* mechanical; 0 where it is not known */
    double i_abc[3];                /* A */
    double change_A_per_s[3]; /* how fast the currents change in the rotor frame, as phase quantities: 0 for
                               * currents that turn with the rotor. Only delays use it */
    double curvature_A_per_s2[3]; /* the same of that rate; where it is not known, 0 */
    double swing_rad_per_s; /* how fast the currents swing in the rotor frame: a delay of a radian of it or
                             * more goes on along that oscillation; 0: along a parabola */
    double temperature_C;   /* of the magnets; NAN where it is not known, which stands for the reference */
    double elapsed_s;       /* since the start of the recording; 0 where there is no time */
    int computed_phase; /* 1, 2, 3: no sensor reads this phase's current, it is minus the sum of the other two
                         * as they are read; 0: each has its own, or it is not known */
    bool switched_off;  /* no current flows, and no sensor read one: zeros of the sensors are in no reading */
} hci_sample;

/* A torque and its derivatives at a true sample; zeros to begin with. */
typedef struct {
    double torque_Nm;       /* T_x */
    double by_current[3];   /* ∂T/∂i_s, N·m/A */
    double by_change[3];    /* by change_A_per_s, N·m·s/A; of readings only */
    double by_curvature[3]; /* by curvature_A_per_s2, N·m·s²/A; of readings only */
    double by_angle;        /* ∂T/∂θ_m at constant phase currents, N·m/rad */
    double inductance_H[3]; /* L_x = ∂²W'/∂i² in the orthonormal αβ plane: αα, αβ, ββ */
} hci_effect_torque;

/* ---- effects ---- */

/* What is particular about a parameter; any of them together. */
enum {
    HCI_PARAMETER_LINEAR = 1,       /* torques are linear in it: its regressor does not depend on its value */
    HCI_PARAMETER_WITH_CURRENT = 2, /* acts with the current: not to be seen in a holding test, where the
                                     * current answers to the torque */
    HCI_PARAMETER_WITH_SPEED = 4,   /* acts with the speed: not to be seen in a holding test either */
    HCI_PARAMETER_OF_TRANSDUCER = 8,      /* of a torque sensor: to be seen in a measured torque only */
    HCI_PARAMETER_ALONG_TIME = 16,        /* makes `filter` act unless it is 0 */
    HCI_PARAMETER_LAG = 32,               /* a time constant of `filter`: at 0 its regressor is −dT/dt */
    HCI_PARAMETER_REFERENCE_CURRENT = 64, /* the current at which the other values hold: not fitted, a
                                           * diagnosis sets it to the largest that was measured */
    HCI_PARAMETER_SCALE =
        128, /* how far the other values of the effect reach; says nothing while those are 0 */
    HCI_PARAMETER_WITH_LOAD = 256 /* makes a ripple in proportion to the current: to be seen in a holding test
                                   * against a steady load, but for order 1, the torque per ampere itself */
};

/* One kind of number that an effect has. */
typedef struct {
    const char *name;    /* in effects.csv; with `ordered`, what stands before "_ORDER" */
    const char *unit;    /* in which values are kept */
    const char *meaning; /* a few words */
    double standard;     /* the value when it is not given */
    double least;        /* smallest value that it may have */
    bool ordered;        /* once for each order, otherwise once */
    bool whole;          /* orders are whole numbers */
    double least_order;  /* smallest order that it may have */
    unsigned traits;     /* of those above */
} hci_effect_parameter;

/* A value of one parameter. */
typedef struct {
    size_t parameter; /* in the type's list */
    double order;     /* of an ordered parameter, else 0 */
    double value;     /* in the parameter's unit */
    double std_error; /* NAN where it is not known */
} hci_effect_term;

/* What is known of an effect, below. */
typedef struct hci_effect_type hci_effect_type;

/* One effect of one machine: its type and the values of its parameters. The terms belong to the caller. */
typedef struct {
    const hci_effect_type *type; /* what is known of it */
    const hci_effect_term *term; /* its values, in any order */
    size_t count;                /* entries of term */
} hci_effect;

/* All effects of a machine, in any order. */
typedef struct {
    const hci_effect *effect; /* may be NULL with count 0 */
    size_t count;             /* entries of effect */
} hci_effects;

/* What a drive does to its readings in answer to a value, each the inverse of what its sensor does. */
typedef enum {
    HCI_CORRECT_NOTHING,
    HCI_CORRECT_CURRENT_ZERO,  /* less the value, of the phase that the parameter counts */
    HCI_CORRECT_CURRENT_GAIN,  /* over 1 + value */
    HCI_CORRECT_ANGLE_ZERO,    /* electrical, less the value */
    HCI_CORRECT_ANGLE_SINE,    /* electrical, less value × sin(order · θ) */
    HCI_CORRECT_ANGLE_COSINE,  /* and × cos(order · θ) */
    HCI_CORRECT_TURN_SINE,     /* mechanical, less value × sin(order · θ_m) */
    HCI_CORRECT_TURN_COSINE,   /* and × cos(order · θ_m) */
    HCI_CORRECT_ANGLE_LOAD,    /* electrical, less value × i_q */
    HCI_CORRECT_ANGLE_DELAY,   /* more speed × value; a value below 0 is nothing that a sensor does */
    HCI_CORRECT_CURRENT_DELAY, /* the angle of the value before for the currents */
    HCI_CORRECT_CURRENT_FILTER /* the same of a low pass */
} hci_effect_correction;

/* ---- types ---- */

/* One link in the chain from the true value of a channel to hci_sensor: called once a step, with eight
 * doubles of its own that are 0 at the start. */
typedef struct {
    /* From the value so far to the next. */
    double (*modify)(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad);
    const hci_effect *effect; /* first argument of modify */
    double memory[8];         /* its own */
} hci_effect_link;

/* Most links of a channel. */
enum { HCI_EFFECT_LINKS = 8 };

/* What effects put between a true quantity and its sensor. */
typedef struct {
    hci_effect_link link[HCI_EFFECT_LINKS]; /* in the order in which they act */
    size_t count;                           /* links in use */
    double delay_s;                         /* of the reading */
    const hci_effect_type *delayed_by;      /* whose delay it is, or NULL */
} hci_effect_channel;

/* ---- what a diagnosis has to know ---- */

/* What a model leaves on the average at about one speed, with its direction. */
typedef struct {
    double speed_rad_per_s, residual_Nm; /* means */
    double weight;                       /* one over the variance of the residual, 1/(N²·m²) */
} hci_effect_speed_mean;

/* What recordings are like as a whole, for an effect to say which of its terms could be found in them. */
typedef struct {
    const hci_machine *machine; /* declared */
    bool timed;                 /* a run has time and speed */
    bool moving;                /* the shaft turned */
    bool loaded_both_ways; /* under load in one run forward, in one backward, at alike loads or two each */
    bool one_sided;        /* all loads have an i_q of one sign, of which none tells what of the mean torque
                            * keeps its sign with the load */
    bool has_temperature;  /* of the magnets, which changes */
    bool has_turn;         /* the angle tells where in the mechanical turn the rotor was */
    bool has_neutral;      /* the phases may carry the same current all at once */
    bool creeps;           /* in a run the mean torque of a turn rises or falls from turn to turn */
    double duration_s;     /* of the longest run with time */
    size_t speeds;         /* how many different ones, at most 3 */
    double torque_Nm;      /* largest rms of a run */
    double acceleration_rad_per_s2; /* largest rms of a run with a torque sensor */
    double current_A;               /* largest rms length of a run's current vector */
    double along_d_A;               /* largest mean i_d of a run, either way */
    double flows_d_A;               /* largest rms i_d of a run */
    double standing_current_A;      /* largest mean of a phase current over many electrical turns */
    double reference_current_A;     /* for HCI_PARAMETER_REFERENCE_CURRENT */
    int richness;             /* of series in the currents: 0 low orders, 1 all orders, 2 high powers too */
    const double *slot_order; /* electrical orders of the residual that stand out, whole ones: slots and
                               * poles; the strongest first */
    size_t slot_orders;       /* entries of slot_order */
    const double *turn_order; /* and those that repeat with the mechanical turn only */
    size_t turn_orders;       /* entries of turn_order */
    const double *load_order; /* fractional ones of slots and poles that stand out with the current */
    size_t load_orders;       /* entries of load_order */
    double orders;            /* how many orders they were chosen from */
    const double *flux_order; /* fractions at which cogging and torque with the currents vary alike over the
                               * turn, as the declared ones do with the flux; the strongest first */
    size_t flux_orders;       /* entries of flux_order */
    const double
        *angle_order;    /* electrical orders at which the angle may be read wrong, the strongest first */
    size_t angle_orders; /* entries of angle_order */
    bool poles_differ;   /* orders 3, 9, 15 … stand out with the current: north and south poles differ */
    bool one_gain;       /* torque with the currents and cogging are off by the same factor */
    const hci_effect_speed_mean *of_speed; /* measured torques by the speed, each direction by itself */
    size_t of_speeds;                      /* entries of of_speed */
} hci_effect_survey;

/* Terms that a diagnosis takes into a model together or not at all. */
typedef struct {
    size_t parameter, count; /* the first one in the type's list, and how many that follow each other */
    double order;            /* of ordered parameters, else 0 */
    double alternatives;     /* from how many like it this one is chosen, >= 1: what is usual in a machine has
                              * few; a choice must lower χ² by 2 ln(alternatives) more */
    double expected;         /* standard deviation of the values of machines and benches that somebody has
                              * looked at, in the parameters' unit; 0: any */
    int power;               /* of the currents in the co-energy, where the candidate is a term of that */
    const double *start;     /* count values for a fit to begin with; NULL: those that are declared */
} hci_effect_candidate;

/* Takes one candidate. */
typedef void hci_effect_candidate_taker(void *context, const hci_effect_candidate *candidate);

/* How far the series of the co-energy goes,
 *
 *     W'(θ, i_d, i_q) = Σ c cos nθ (i_d/I_0)^a (i_q/I_0)^b (b even) + Σ c sin nθ … (b odd)    n = 0, 6, 12, …
 *
 * of a rotor that looks alike both ways round; sines and cosines change places in what another rotor has
 * besides. Power a + b = 0 is cogging torque, 1 back-EMF, 2 reluctance, 3 and more saturation; the torque is
 * p ∂W'/∂θ at constant phase currents, so mean and ripple are one. */
typedef struct {
    int pole_pairs;             /* p */
    int power, order;           /* highest, of the currents and of the electrical angle */
    double reference_current_A; /* I_0 */
    bool unlike;    /* what a rotor that looks alike both ways round does not have, and only that */
    int mean_power; /* highest of the currents in what is the same at every angle, where that is above `power`
                     */
} hci_effect_coenergy_series;

/* Takes candidates. */
typedef struct {
    hci_effect_candidate_taker *add; /* called once for each candidate */
    void *context;                   /* its first argument */
} hci_effect_proposals;

enum {
    HCI_EFFECT_SENSORS = 8 /* that `filter_many` takes at once */
};

/* A run whose torque is modelled. */
typedef struct {
    const double *time_s; /* ascending; a step back starts anew */
    size_t count;         /* samples */
    double *torque_Nm;    /* [count], in/out */
    double *by_value;     /* [count][columns], in/out: derivatives by the values of all effects; or NULL */
    size_t columns;       /* of by_value */
    size_t own_column;    /* the first one of the effect's terms */
} hci_effect_run;

/* What a run must have for an effect to act in a model. */
enum {
    HCI_EFFECT_NEEDS_TIME = 1,         /* time_s */
    HCI_EFFECT_NEEDS_SPEED = 2,        /* speed_rad_per_s, given or from time and angle */
    HCI_EFFECT_NEEDS_TEMPERATURE = 4,  /* temperature_C */
    HCI_EFFECT_NEEDS_TURN = 8,         /* an angle that tells where in the mechanical turn the rotor was */
    HCI_EFFECT_NEEDS_RATE = 16,        /* how fast the currents change: change_A_per_s */
    HCI_EFFECT_NEEDS_ACCELERATION = 32 /* acceleration_rad_per_s2, from time and speed */
};

/* What is known of an effect: all of it, so that a new one is one file and one line in the registry. A member
 * that does not concern it is 0 or NULL. */
struct hci_effect_type {
    const char *name;                        /* as in effects.csv */
    const char *title;                       /* as in a sentence, without an article where it needs none */
    const char *equation;                    /* in words and letters, for people */
    const hci_effect_correction *correction; /* of each parameter; NULL: no sensor of a drive */
    const char *signature;                   /* how it shows in a residual */
    const hci_effect_parameter *parameter;   /* the kinds of numbers that it has */
    size_t parameter_count;                  /* entries of parameter */
    unsigned needs;                          /* of HCI_EFFECT_NEEDS_TIME … */
    const char *without;   /* what a prediction says where a run lacks what the effect needs */
    const char *told_by;   /* a run with this tells it from what looks the same; NULL: any other run */
    bool in_machine;       /* `torque` acts in the air gap, else only between it and the reading */
    bool beyond_quadratic; /* the torque is of higher than second degree in the currents */
    bool is_series; /* of many terms, each of which explains little by itself: a diagnosis looks at more
                     * of them (richness) as more is left, and takes all of order 0 in at once */
    bool is_small;  /* a defect of a sensor or of one phase: three times what is expected of it would have
                     * been noticed, and looks like an effect that nobody knows */
    const hci_effect_type *when_equal; /* of three values, one a phase: what equal ones look like; or NULL */
    const hci_effect_type *seen_as;    /* what recordings show of it where it is small, and what it is called
                                        * unless it explains decisively more; or NULL */
    bool in_series;          /* a series in the currents has it in it: not looked for beside one, nor
                              * held against one */
    bool is_angle_zero;      /* turns the zero of the angle */
    bool turns_angle;        /* turns the angle of a recording: a map of mean torques has none */
    bool any_phase;          /* a torque of any order and phase without current: a turned angle is one, too */
    const size_t *resonance; /* two parameters, natural frequency in Hz and damping ratio, that a diagnosis
                              * looks for on a grid, since no small step from nothing finds them */
    const size_t *lag;       /* one parameter, a time constant in s, that a diagnosis looks for on a grid too:
                              * a long one is far from what small steps from nothing promise */
    const size_t *late; /* one parameter, the delay in s of the torque's channel, that a diagnosis looks for
                         * on a grid too: over a slow bus it is many radians of what the torque shows */

    /* Names the terms that such recordings could show. */
    void (*propose)(const hci_effect_survey *survey, const hci_effect_proposals *to);

    /* Names the terms in which motors of one make differ, that are fitted to each of them alike. slots: of
     * the stator; NAN: not known. */
    void (*propose_alike)(const hci_machine *machine, double slots, const hci_effect_proposals *to);

    /* Names its terms of the co-energy, each expected as if the coefficients of power 2 and order 0 had a
     * standard deviation of 1 N·m; those of higher powers and orders are smaller, since iron is smooth. */
    void (*propose_coenergy)(const hci_effect_coenergy_series *series, const hci_effect_proposals *to);

    /* Adds what one term contributes to the torque at a true sample. Returns ∂T/∂value, the regressor of a
     * linear parameter. */
    double (*torque)(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum);

    /* In place of `torque` where there may be many terms: adds what all of them contribute. by_value: out,
     * ∂T/∂value of each term, or NULL. */
    void (*torque_of_all)(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value);

    /* What brakes the shaft of a simulated drive: the smooth part in a state. */
    double (*drag_Nm)(const hci_effect *effect, const hci_plant_state *state);

    /* And the Coulomb part. */
    double (*coulomb_Nm)(const hci_effect *effect);

    /* In place: a true sample to the reading. */
    void (*sense)(const hci_effect *effect, int pole_pairs, hci_sample *x);

    /* In place: a reading to the true sample. */
    void (*undo)(const hci_effect *effect, int pole_pairs, hci_sample *x);

    /* Both leave the currents as they are. */
    bool keeps_currents;

    /* The adjoint of `undo`: turns the derivatives of a torque by what `undo` returned (by_angle, by_current,
     * by_change) into those by what it got. before, after: what it got and returned. by_value: out, a
     * derivative by each term's value. */
    void (*undo_adjoint)(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         const hci_sample *after, hci_effect_torque *by, double *by_value);

    /* The derivative of the sum of the three currents that are read by the term's value; the sum of the true
     * ones is 0 in a star. */
    double (*sum_by_value)(const hci_effect_term *term, const hci_sample *truth);

    /* The sensors of a simulated drive, HCI_SENSE_COUNT channels: gain and offset go into hci_sensor, all
     * else into the channels. */
    void (*simulate)(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels);

    /* A link in the torque's channel of a simulated drive, where that is all: as hci_effect_link.modify. */
    double (*modify_torque)(const hci_effect *effect, const hci_plant_state *plant, double step_s,
                            double *memory, double value, double theta_m_rad);

    /* In place: the torque that reaches a sensor to what that makes of it at once, before its zero. by_value:
     * in/out, derivatives by the values of all effects, so many columns; or NULL. own_column: the first one
     * of the effect's terms. */
    void (*read_torque)(const hci_effect *effect, double *torque_Nm, double *by_value, size_t columns,
                        size_t own_column);

    /* What happens to the reading of the torque along a run, in place. */
    void (*filter)(const hci_effect *effect, const hci_effect_run *run);

    /* What each of several such effects, 1 to HCI_EFFECT_SENSORS of them, makes of the torque of a run, which
     * stays as it is; each has either a resonance or a lag, all have the same. reading_Nm: out, of each
     * sample HCI_EFFECT_SENSORS readings, `count` of them of use. */
    void (*filter_many)(const hci_effect *effects, size_t count, const hci_effect_run *run,
                        double *reading_Nm);
};

/* Type k of the registry; NULL behind the last one. */
const hci_effect_type *hci_effect_type_at(size_t k);

/* The type of an effect by its name in effects.csv; NULL when there is none. */
const hci_effect_type *hci_effect_type_find(const char *name);

/* What all effects together need of a run, HCI_EFFECT_NEEDS_TIME … */
unsigned hci_effects_needs(const hci_effects *effects);

/* The value of a parameter that is not ordered, or its standard. */
double hci_effect_value(const hci_effect *effect, size_t parameter);

/* Terms of all effects: the length of by_value below, whose order is that of the effects and their terms. */
size_t hci_effects_terms(const hci_effects *effects);

/* ---- machine ---- */

/* What the effects in the machine add at a true sample; the declared machine is not in it. by_value: out, may
 * be NULL; ∂T/∂value of each term, 0 for effects elsewhere. O(terms + harmonics); may run in an interrupt. */
hci_effect_torque hci_effects_torque(const hci_machine *machine, const hci_effects *effects,
                                     const hci_sample *truth, double *by_value);

/* The context of hci_effects_apply. */
typedef struct {
    const hci_machine *machine; /* declared */
    const hci_effects *effects; /* what it has beyond that */
    double temperature_C;       /* of the magnets; NAN: the reference */
} hci_effects_plant;

/* For hci_plant_effect: context is an hci_effects_plant. Adds torque, motional voltage, inductance and drag
 * of the effects in the machine; the Coulomb part is not in it. */
void hci_effects_apply(const void *context, const hci_plant_state *state, hci_plant_point *point);

/* The Coulomb part of the effects in N·m, which belongs into hci_plant.coulomb_Nm, where it neither chatters
 * nor creeps. */
double hci_effects_coulomb_Nm(const hci_effects *effects);

/* ---- bench ---- */

/* What is read while the torque of `truth` is read. Speed and rotor-frame rate of change are taken as
 * constant over a delay. */
hci_sample hci_effects_sense(const hci_effects *effects, int pole_pairs, const hci_sample *truth);

/* The inverse: the true sample behind a reading. */
hci_sample hci_effects_undo(const hci_effects *effects, int pole_pairs, const hci_sample *reading);

/* Of the currents alone: the angle stays as it was read where that changes no current. */
hci_sample hci_effects_undo_currents(const hci_effects *effects, int pole_pairs, const hci_sample *reading);

/* The torque in N·m that a torque sensor without lag reads beside this reading of the others: declared
 * machine, effects in it, friction, offset. by_value: out, may be NULL; the derivative by each term's value,
 * exact, which for a linear effect is its regressor. O(terms + harmonics). */
double hci_effects_predict(const hci_machine *machine, const hci_effects *effects, const hci_sample *reading,
                           double *by_value);

/* The same, for a reading that is predicted many times. known: in/out, of the declared machine at the true
 * angle that was met last; before the first time its theta_rad is NAN. */
double hci_effects_predict_again(const hci_machine *machine, const hci_effects *effects,
                                 const hci_sample *reading, hci_torque_parts *known, double *by_value);

/* The sensor's lag or resonance along a run of n such torques, in place; nothing happens without that effect.
 * time_s: ascending, in steps of any size; a step back starts anew. The sensor starts settled. by_value: n
 * rows of hci_effects_terms doubles, in place as well, or NULL. Trapezoidal rule. */
void hci_effects_filter(const hci_effects *effects, const double *time_s, size_t n, double *torque_Nm,
                        double *by_value);

#ifdef __cplusplus
}
#endif

#endif
