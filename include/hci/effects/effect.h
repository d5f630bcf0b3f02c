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
    double speed_rad_per_s;   /* mechanical */
    double i_abc[3];          /* A */
    double change_A_per_s[3]; /* how fast the currents change in the rotor frame, as phase quantities: 0 for
                               * currents that turn with the rotor. Only delays use it */
    double curvature_A_per_s2[3]; /* the same of that rate; where it is not known, 0 */
    double temperature_C; /* of the magnets; NAN where it is not known, which stands for the reference */
} hci_sample;

/* A torque and its derivatives at a true sample; zeros to begin with. */
typedef struct {
    double torque_Nm;       /* T_x */
    double by_current[3];   /* ∂T/∂i_s, N·m/A */
    double by_change[3];    /* by change_A_per_s, N·m·s/A; of readings only */
    double by_angle;        /* ∂T/∂θ_m at constant phase currents, N·m/rad */
    double inductance_H[3]; /* L_x = ∂²W'/∂i² in the orthonormal αβ plane: αα, αβ, ββ */
} hci_effect_torque;

/* ---- effects ---- */

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
} hci_effect_channel;

/* What is known of an effect. A function that does not concern it is NULL. */
struct hci_effect_type {
    const char *name;                      /* as in effects.csv */
    const char *equation;                  /* in words and letters, for people */
    const char *signature;                 /* how it shows in a residual */
    const hci_effect_parameter *parameter; /* the kinds of numbers that it has */
    size_t parameter_count;                /* entries of parameter */
    bool in_machine;       /* `torque` acts in the air gap, else only between it and the reading */
    bool beyond_quadratic; /* the torque is of higher than second degree in the currents */

    /* Adds what one term contributes to the torque at a true sample. Returns ∂T/∂value, the regressor of a
     * linear parameter. */
    double (*torque)(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum);

    /* In place of `torque` where there may be many terms: adds what all of them contribute. by_value: out,
     * ∂T/∂value of each term, or NULL. */
    void (*torque_of_all)(const hci_effect *effect, const hci_machine *machine, const hci_sample *truth,
                          hci_effect_torque *sum, double *by_value);

    /* What brakes the shaft of a simulated drive: the smooth part at a speed. */
    double (*drag_Nm)(const hci_effect *effect, double speed_rad_per_s);

    /* And the Coulomb part. */
    double (*coulomb_Nm)(const hci_effect *effect);

    /* In place: a true sample to the reading. */
    void (*sense)(const hci_effect *effect, int pole_pairs, hci_sample *x);

    /* In place: a reading to the true sample. */
    void (*undo)(const hci_effect *effect, int pole_pairs, hci_sample *x);

    /* The adjoint of `undo`: turns the derivatives of a torque by what `undo` returned (by_angle, by_current,
     * by_change) into those by what it got. before: what it got. by_value: out, a derivative by each term's
     * value. */
    void (*undo_adjoint)(const hci_effect *effect, int pole_pairs, const hci_sample *before,
                         hci_effect_torque *by, double *by_value);

    /* The sensors of a simulated drive, HCI_SENSE_COUNT channels: gain and offset go into hci_sensor, all
     * else into the channels. */
    void (*simulate)(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels);

    /* The dynamics of the torque sensor along a run, in place: torque_Nm[n], and by_value[n][columns], of
     * which those from own_column on are the effect's terms; NULL: not wanted. */
    void (*filter)(const hci_effect *effect, const double *time_s, size_t n, double *torque_Nm,
                   double *by_value, size_t columns, size_t own_column);
};

/* Type k of the registry; NULL behind the last one. */
const hci_effect_type *hci_effect_type_at(size_t k);

/* The type of an effect by its name in effects.csv; NULL when there is none. */
const hci_effect_type *hci_effect_type_find(const char *name);

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

/* The torque in N·m that a torque sensor without lag reads beside this reading of the others: declared
 * machine, effects in it, friction, offset. by_value: out, may be NULL; the derivative by each term's value,
 * exact, which for a linear effect is its regressor. O(terms + harmonics). */
double hci_effects_predict(const hci_machine *machine, const hci_effects *effects, const hci_sample *reading,
                           double *by_value);

/* The sensor's lag or resonance along a run of n such torques, in place; nothing happens without that effect.
 * time_s: ascending, in steps of any size; a step back starts anew. The sensor starts settled. by_value: n
 * rows of hci_effects_terms doubles, in place as well, or NULL. Trapezoidal rule. */
void hci_effects_filter(const hci_effects *effects, const double *time_s, size_t n, double *torque_Nm,
                        double *by_value);

#ifdef __cplusplus
}
#endif

#endif
