/* What is wanted of which machine, and what flows already: the question that every method of solving is
 * asked. */
#ifndef HCI_SRC_HOST_SOLVE_TASK_H
#define HCI_SRC_HOST_SOLVE_TASK_H

#include "hci/host/solve/solve.h"
#include "hci/machine/strategy.h"
#include "host/machine/quadratic_model.h"

/* The torque is T(θ, i) = T_cog + e·i + ½ iᵀL'i + T_x(θ, i), T_x of a higher degree. Methods solve the linear
 * problem gradient·i = target − T_cog + offset: for a machine whose torque is linear the gradient is e and
 * the offset nothing; for others both are those of the torque made linear at some currents (linearise.h). */
typedef struct {
    const hci_machine *machine;      /* e, L', T_cog: all torque up to the second degree in the currents */
    const hci_effects_plant *higher; /* T_x; NULL: none */
    bool has_neutral;                /* a zero sequence may flow */
    const hci_target *target;
    const hci_wave *held; /* a fundamental that flows whatever is solved; NULL: none */
    const hci_wave *gradient;
    size_t gradient_count;
    const hci_harmonic *offset; /* NULL: none */
    size_t offset_count;
    double
        highest_rotor_order; /* |n − σ| of components that are not to be chosen is above it; 0: any may be */
    double rotor_price; /* a square of current of component (n, σ) counts 1 + rotor_price (n − σ)⁸ times */
    double compared_up_to;           /* orders above are left to themselves; 0: all are compared */
    size_t period_turns;             /* electrical turns after which every order named so far repeats */
    hci_strategy strategy;           /* of the pointwise method */
    const double *current_angle_rad; /* that the current keeps in the rotor frame in its place; NULL: none */
    hci_progress *progress;
    void *progress_context;
    hci_stop *stop; /* asked before each system that is solved, and at each angle of the pointwise method */
    void *stop_context;
} hci_task;

/* A task for a machine: the gradient of no current, everything else but the target zero. model and target
 * must outlive it. */
void hci_task_begin(const hci_quadratic_model *model, const hci_target *target, hci_task *task);

/* Fills period_turns for everything in the task, the components of a set (or NULL) and given waves.
 * HCI_ERROR_INPUT when there is no common period. */
hci_status hci_task_find_period(hci_task *task, const hci_component_set *set, const hci_wave *wave,
                                size_t count, hci_note *note);

/* HCI_ERROR_STOPPED where the task is to end without a result. */
hci_status hci_task_goes_on(const hci_task *task, hci_note *note);

/* Whether the torque is linear in the currents: neither L' nor T_x. */
bool hci_task_is_linear(const hci_task *task);

/* Temperature of the magnets; NAN, which is the reference of their effect, where none is given. */
double hci_magnet_temperature_C(const hci_solve_options *options);

#endif
