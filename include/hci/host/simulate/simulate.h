/* The simulated drive: a machine and a scenario in, its steady spectrum and figures out, and every step to
 * whoever wants to watch. */
#ifndef HCI_HOST_SIMULATE_SIMULATE_H
#define HCI_HOST_SIMULATE_SIMULATE_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/drive/control.h"
#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the scenario ---- */

/* Numbers of a scenario: X(field, name in the file, unit, lowest, highest, default, what it is). Unit `count`
 * is a whole number. Not given: NAN, and the default takes its place in hci_simulate. */
#define HCI_SCENARIO_VALUES(X)                                                                               \
    X(duration_s, "duration", "s", 1e-9, 1e6, "", "simulated time; must be given")                           \
    X(step_s, "step", "s", 1e-9, 1.0,                                                                        \
      "hysteresis 1 us; pi current_sample_time/10; ideal period/2048 at a prescribed speed, else 10 us",     \
      "fixed step")                                                                                          \
    X(settle_s, "settle", "s", 0.0, 1e6,                                                                     \
      "halfway from the last change to the end; 0 for ideal currents at a prescribed speed",                 \
      "what is before it is not evaluated")                                                                  \
    X(prescribed_speed_rad_per_s, "prescribed_speed", "rad_per_s", -1e5, 1e5, "",                            \
      "the shaft turns so, whatever the torque")                                                             \
    X(speed_reference_rad_per_s, "speed_reference", "rad_per_s", -1e5, 1e5, "", "set point of a speed loop") \
    X(torque_reference_Nm, "torque_reference", "Nm", -1e9, 1e9, "", "set point without a speed loop")        \
    X(load_torque_Nm, "load_torque", "Nm", -1e9, 1e9, "0", "on the shaft, against positive rotation")        \
    X(load_torque_2_Nm, "load_torque_2", "Nm", -1e9, 1e9, "", "another load")                                \
    X(load_torque_2_from_s, "load_torque_2_from", "s", 0.0, 1e6, "", "from this time on")                    \
    X(initial_speed_rad_per_s, "initial_speed", "rad_per_s", -1e5, 1e5, "0", "at the start")                 \
    X(initial_angle_rad, "initial_angle", "rad", -1e6, 1e6, "0", "electrical, at the start")                 \
    X(inertia_kgm2, "inertia", "kgm2", 1e-12, 1e9, "machine.csv", "of the rotor and what turns with it")     \
    X(viscous_friction_Nms_per_rad, "viscous_friction", "Nms_per_rad", 0.0, 1e9, "machine.csv, or 0",        \
      "torque by speed")                                                                                     \
    X(coulomb_friction_Nm, "coulomb_friction", "Nm", 0.0, 1e9, "machine.csv, or 0", "moving and at rest")    \
    X(strategy_2_from_s, "strategy_2_from", "s", 0.0, 1e6, "", "from this time on strategy_2 holds")         \
    X(speed_kp_Nms_per_rad, "speed_kp", "Nms_per_rad", 0.0, 1e9, "30/s x inertia", "of the speed loop")      \
    X(speed_ki_Nm_per_rad, "speed_ki", "Nm/rad", 0.0, 1e9, "7.5/s x speed_kp", "of the speed loop")          \
    X(speed_sample_time_s, "speed_sample_time", "s", 1e-9, 1.0, "100 us", "of the speed loop")               \
    X(torque_limit_Nm, "torque_limit", "Nm", 1e-9, 1e9, "twice rated_torque, or none", "of the speed loop")  \
    X(id_limit_A, "id_limit", "A", 1e-9, 1e9, "none", "of a strategy's |i_d| in the frame dq_x")             \
    X(iq_limit_A, "iq_limit", "A", 1e-9, 1e9, "none", "of a strategy's |i_q| in the frame dq_x")             \
    X(current_limit_A, "current_limit", "A", 1e-9, 1e9, "none",                                              \
      "of any reference: peak of the sine as long")                                                          \
    X(current_sample_time_s, "current_sample_time", "s", 1e-9, 1.0, "step; 100 us for pi",                   \
      "of references and the pi loop")                                                                       \
    X(hysteresis_band_A, "hysteresis_band", "A", 1e-9, 1e6, "2 % of rated_current", "full width")            \
    X(switching_frequency_max_Hz, "switching_frequency_max", "Hz", 1e-3, 1e9, "20 kHz",                      \
      "of a leg under hysteresis")                                                                           \
    X(dc_link_voltage_V, "dc_link_voltage", "V", 1e-9, 1e7, "machine.csv", "of the inverter")                \
    X(current_kp_ohm, "current_kp", "ohm", 0.0, 1e9, "0.2 L/current_sample_time", "of the pi loop, V/A")     \
    X(current_ki_V_per_As, "current_ki", "V/(A*s)", 0.0, 1e12, "0.2 R/current_sample_time",                  \
      "of the pi loop")                                                                                      \
    X(current_kp_q_ohm, "current_kp_q", "ohm", 0.0, 1e9, "current_kp", "of q in the pi loop")                \
    X(current_ki_q_V_per_As, "current_ki_q", "V/(A*s)", 0.0, 1e12, "current_ki", "the same")                 \
    X(current_filter_s, "current_filter_time", "s", 0.0, 0.1, "0: none",                                     \
      "time constant of the low-pass that the pi loop sees i_d and i_q through")                             \
    X(pwm_delay, "pwm_delay", "count", 0.0, 1.0, "1", "1: the pi loop's voltage is used one sample later")   \
    X(decoupling, "decoupling", "count", 0.0, 1.0, "1",                                                      \
      "1: the pi loop adds the motional voltages with all their harmonics")                                  \
    X(computing_delay_s, "computing_delay", "s", 0.0, 1.0, "current_sample_time where pwm_delay is 1",       \
      "from a sample to the use of the pi loop's voltage")                                                   \
    X(dead_time_s, "dead_time", "s", 0.0, 0.01, "0", "of a leg in each sample of the pi loop")               \
    X(dead_time_crossing_A, "dead_time_crossing", "A", 0.0, 1e6, "0",                                        \
      "current below which dead time acts in part")                                                          \
    X(dead_time_compensation, "dead_time_compensation", "count", 0.0, 1.0, "0",                              \
      "1: the pi loop adds what the dead time takes")                                                        \
    X(current_noise_A, "current_noise", "A", 0.0, 1e6, "0", "standard deviation")                            \
    X(current_offset_a_A, "current_offset_a", "A", -1e6, 1e6, "0", "reads so much more; also _b, _c")        \
    X(current_offset_b_A, "current_offset_b", "A", -1e6, 1e6, "0", "")                                       \
    X(current_offset_c_A, "current_offset_c", "A", -1e6, 1e6, "0", "")                                       \
    X(current_gain_a, "current_gain_a", "1", -1.0, 10.0, "0",                                                \
      "relative error: 0.01 reads 1 % more; also _b, _c")                                                    \
    X(current_gain_b, "current_gain_b", "1", -1.0, 10.0, "0", "")                                            \
    X(current_gain_c, "current_gain_c", "1", -1.0, 10.0, "0", "")                                            \
    X(current_quantum_A, "current_quantum", "A", 0.0, 1e6, "0", "step of the reading")                       \
    X(current_delay_s, "current_delay", "s", 0.0, 1.0, "0", "age of the reading")                            \
    X(encoder_counts, "encoder_counts", "count", 0.0, 1e12, "0: not quantised",                              \
      "of the angle, in a mechanical turn")                                                                  \
    X(angle_offset_rad, "angle_offset", "rad", -10.0, 10.0, "0", "electrical, reads so much more")           \
    X(angle_noise_rad, "angle_noise", "rad", 0.0, 10.0, "0", "electrical, standard deviation")               \
    X(angle_delay_s, "angle_delay", "s", 0.0, 1.0, "0", "age of the reading")                                \
    X(speed_noise_rad_per_s, "speed_noise", "rad_per_s", 0.0, 1e5, "0", "standard deviation")                \
    X(speed_delay_s, "speed_delay", "s", 0.0, 1.0, "0", "age of the reading")                                \
    X(torque_noise_Nm, "torque_noise", "Nm", 0.0, 1e9, "0", "standard deviation, of the logged torque")      \
    X(torque_delay_s, "torque_delay", "s", 0.0, 1.0, "0", "age of the logged torque")                        \
    X(magnet_temperature_C, "magnet_temperature", "C", -273.15, 1000.0, "reference of effects.csv",          \
      "of the magnets")                                                                                      \
    X(seed, "seed", "count", 0.0, 9007199254740992.0, "1", "of all noise")                                   \
    X(highest_order, "highest_order", "count", 1.0, 1000.0, "60", "electrical, of the spectrum")             \
    X(trajectory_every, "trajectory_every", "count", 1.0, 1e9, "up to 20 000 rows",                          \
      "steps to a row of trajectory.csv")

/* Words of a scenario: X(name, the list of what it may be, default, what it is). */
#define HCI_SCENARIO_WORDS(X)                                                                                \
    X("current_control", HCI_CURRENT_LOOP_NAMES, "ideal", "how currents follow their references")            \
    X("strategy", HCI_STRATEGY_NAMES, "mtpa", "torque to currents")                                          \
    X("strategy_2", HCI_STRATEGY_NAMES, "none", "from strategy_2_from on")                                   \
    X("currents", HCI_SCENARIO_PATHS, "none",                                                                \
      "currents.csv, or the folder that `solve` wrote; relative to this file")
/* What `currents` may be: any path. */
#define HCI_SCENARIO_PATHS(X) X(0, "path")

/* Bytes of a path. */
enum { HCI_SCENARIO_PATH_SIZE = 4096 };

/* What the drive is to do. Start with hci_scenario_init. */
typedef struct {
#define HCI_SCENARIO_FIELD(field, name, unit, low, high, fallback, what) double field;
    HCI_SCENARIO_VALUES(HCI_SCENARIO_FIELD)
#undef HCI_SCENARIO_FIELD
    hci_current_loop current_control;      /* how currents follow their references */
    hci_strategy strategy, strategy_2;     /* strategy_2 is used with strategy_2_from_s */
    char currents[HCI_SCENARIO_PATH_SIZE]; /* "" for none */
    char path[HCI_SCENARIO_PATH_SIZE];     /* of the scenario, for messages; "" for none */
} hci_scenario;

/* Nothing given: every number NAN, ideal current control, strategy mtpa, no path. */
void hci_scenario_init(hci_scenario *scenario);

/* Reads name,value,unit; a unit of 1, - or nothing is the canonical one. A name that is not known, or twice,
 * and a value outside its range is HCI_ERROR_INPUT; HCI_ERROR_MEMORY. *scenario is then undefined. */
hci_status hci_scenario_read(const char *path, hci_scenario *scenario, hci_note *note);

/* ---- the simulation ---- */

/* A quantity over the evaluated time, in its unit. */
typedef struct {
    double mean;  /* over time */
    double rms;   /* root of the mean square */
    double most;  /* largest value */
    double least; /* smallest value */
} hci_statistics;

/* Energies over the evaluated time, J. What is not known (ideal current sources have no voltage) is NAN.
 * electrical = copper + stored + mechanical + residual. */
typedef struct {
    double electrical;              /* ∫v·i, into the machine */
    double copper;                  /* lost in the winding */
    double stored;                  /* ½iᵀLi, and the energy of the cogging torque; NAN with effects */
    double mechanical;              /* ∫Tω */
    double load, friction, kinetic; /* mechanical = load + friction + kinetic, but for the integration error;
                                       a prescribed speed has none of them: NAN */
    double residual;                /* error of integration */
} hci_energies;

/* What a simulated drive has done. Means are over time, from from_s to to_s: whole periods of the angle, or
 * all of the time where not one was turned. */
typedef struct {
    double step_s;                             /* fixed step */
    double from_s, to_s;                       /* what was evaluated */
    size_t periods;                            /* whole ones that were evaluated */
    size_t period_turns;                       /* electrical turns in one */
    hci_statistics torque_Nm, speed_rad_per_s; /* of the machine; mechanical */
    hci_statistics current_A;                  /* length of the current vector, amplitude-invariant */
    hci_statistics current_dqx_A;              /* sqrt(i_dx² + i_qx²) */
    double peak_phase_A;                       /* largest |phase current| */
    double T_ripple_percent, F_ripple_percent; /* 100 (T_max − T_min)/T_mean, 100 rms(T − T_mean)/T_mean; NAN
                                                * when T_mean is 0, or less than 1 % of T_max − T_min */
    double copper_W;                           /* NAN without a resistance */
    double plain_amplitude_A; /* sine in phase with the back-EMF's fundamental that would make the mean torque
                                 with it; 0 without one */
    double loss_to_plain;     /* copper loss over that of the sine; NAN when there is none */
    hci_torque_evaluation plain; /* what that sine does where it flows as it should, magnets at the reference
                            temperature; without orders where there is none to compare with */
    bool imposed;                /* currents of a file flow, not those of a strategy */
    double switching_frequency_Hz; /* mean of the legs, NAN without switching */
    size_t without_current;        /* samples at which the strategy had no current */
    size_t limited;                /* samples at which a current limit held */
    size_t voltage_limited;        /* samples at which a pi loop asked for more voltage than there is */
    size_t samples;                /* of the reference currents */
    size_t without_current_from_start, limited_from_start; /* the same from the start on */
    hci_energies energy_J;                                 /* where it went */
    bool energy_balances;                                  /* within 1 %, or not known */
    hci_harmonic *spectrum_Nm; /* order 0 first; NULL with count 0 where not one period was turned */
    size_t spectrum_count;     /* entries of spectrum_Nm */
    hci_note remark;           /* what a reader should know, or "" */
} hci_simulation;

/* ---- watching it ---- */

/* What an observer is told before the first step: of what the steps consist, and how many there are. */
typedef struct {
    double step_s;        /* between two steps */
    size_t steps;         /* that the time has; one more is shown, for the values at its end */
    size_t steps_per_row; /* as the scenario's trajectory_every, or its default */
    double settle_s;      /* what is before it is not evaluated */
    double temperature_C; /* of the magnets; NAN where the scenario does not give it */
    int pole_pairs;       /* of the machine */
    bool has_voltage;     /* false: currents are imposed, and there is no voltage */
    bool has_command;     /* a torque is asked for, by the scenario or by the speed loop */
    bool has_sensors;     /* what is measured is not what is */
} hci_simulation_plan;

/* Events since the start of the run. */
typedef struct {
    uint64_t switchings;      /* of all legs of the inverter */
    uint64_t without_current; /* samples at which the strategy had no current for the torque */
    uint64_t limited;         /* samples at which a current limit held */
    uint64_t voltage_limited; /* samples at which a pi loop asked for more voltage than there is */
} hci_simulation_counts;

/* What holds at the start of a step. */
typedef struct {
    double time_s;                /* from the start of the run */
    double theta_e_rad;           /* electrical, not wrapped */
    double speed_rad_per_s;       /* mechanical */
    double i_A[2], v_V[2];        /* αβ, orthonormal; the voltage holds until the next step */
    double torque_Nm, load_Nm;    /* of the machine, and on the shaft against positive rotation */
    hci_plant_point point;        /* the machine at this angle and current, effects included */
    hci_simulation_counts counts; /* until now */
    const hci_drive_state
        *state; /* after the step, for what was measured and commanded in it; until return */
} hci_simulation_step;

/* Sees every step of a simulation as it is made. */
typedef struct {
    hci_status (*begin)(
        void *context, const hci_simulation_plan *plan,
        hci_note *note); /* before the first step; an error ends the simulation. May be NULL */
    void (*step)(void *context, const hci_simulation_step *step); /* once a step, in the order of time */
    void *context;                                                /* first argument of both */
} hci_simulation_observer;

/* ---- running it ---- */

/* A control that is not of the scenario: code that gives the references of the loop. */
typedef struct {
    hci_reference_code code;      /* in place of strategy and currents */
    const hci_plant_table *known; /* the machine as the decoupling knows it; NULL: as it is declared */
    hci_modulation modulation;    /* which voltages there are */
} hci_simulate_loop;

/* What a simulation is given besides machine and scenario. */
typedef struct {
    const hci_effects *effects;    /* of the machine, on plant and sensors, not known to the controller; NULL
                                      only where it has no effects.csv */
    const hci_simulate_loop *loop; /* in place of strategy and currents; NULL: the scenario's */
    const hci_simulation_observer *observer; /* may be NULL */
    hci_progress *progress;                  /* may be NULL */
    void *progress_context;                  /* first argument of progress */
    hci_stop *stop;                          /* may be NULL; then HCI_ERROR_STOPPED, and nothing is kept */
    void *stop_context;                      /* first argument of stop */
} hci_simulate_options;

/* Runs the scenario and writes nothing (hci_simulate_to_folder of hci/host/report/write.h does). HCI_OK, and
 * *simulation is to be given to hci_simulation_release; or an error with a note, and then it is empty:
 * HCI_ERROR_INPUT for what contradicts itself or is missing in machine or scenario, HCI_ERROR_NUMERIC when
 * the state left the finite numbers, HCI_ERROR_MEMORY, HCI_ERROR_STOPPED, or what the observer's begin
 * returned. Same input, same result to the bit on one libm. */
hci_status hci_simulate(const hci_machine_data *machine, const hci_scenario *scenario,
                        const hci_simulate_options *options, hci_simulation *simulation, hci_note *note);

/* Frees what a simulation holds and empties it. */
void hci_simulation_release(hci_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
