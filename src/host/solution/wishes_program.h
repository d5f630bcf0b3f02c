/* What the wishes for currents within limits are programs of: the torque's orders and the grids of all that
 * is limited, of as many phases and as much of a turn as tell of the rest. */
#ifndef HCI_SRC_HOST_SOLUTION_WISHES_PROGRAM_H
#define HCI_SRC_HOST_SOLUTION_WISHES_PROGRAM_H

#include "host/limit/program.h"
#include "host/machine/torque_gradient.h"
#include "host/solve/task.h"

/* What is solved, and where it goes. */
typedef struct {
    hci_task *task; /* gradient and offset follow the current where the torque is not linear */
    const hci_machine_data *machine;
    const hci_solve_options *options;
    const hci_bounds *bounds;
    hci_linear_torque *at; /* what they point to; to be released after the task was last used */
    hci_solution *solution;
} hci_limited;

/* Start with {0}, `of` and `set` filled. */
typedef struct {
    const hci_limited *of;
    hci_component_set set;
    hci_harmonic_system system;
    hci_voltage_model voltage;
    hci_wave_list current; /* where voltage and torque are made linear */
    hci_limit_program program;
    hci_limit_rest rest[HCI_STAGE_COPPER + 1]; /* of each stage the last one */
    double *x;                                 /* S and C of each component, A: what was found */
    const double *best; /* the same of the best step, whose peaks stay rows as those of x do; NULL: none */
    size_t rounds;      /* programs solved so far */
    size_t steps;   /* in which the torque was made linear so far, of those before too that it goes on from */
    bool is_ended;  /* for so many of them */
    bool is_coarse; /* the torque is still being made linear: peaks may stay for the next step */
    bool is_far;    /* and so far off that the solver need not be precise */
    bool is_hard;   /* the torque of the last step could not be as wanted */
    bool is_bounded; /* in: the steps are hardly to come to rest; out: whether they did not, and were bounded
                      */
    bool is_kept;    /* the ripple of kept_Nm is there, and less copper is no reason to leave it */
    double kept_Nm;
    hci_limit_optimum cost; /* of the stage that says what limits cost */
} hci_wishes;

/* Fills what does not change from step to step. */
void hci_wishes_program_begin(hci_wishes *wishes);

/* System and grids at the currents of the last step, in place of those before. HCI_ERROR_MEMORY. */
hci_status hci_wishes_program_make(hci_wishes *wishes, hci_note *note);

void hci_wishes_program_release(hci_wishes *wishes);

/* The highest order of a set, at least 1. */
double hci_wishes_top(const hci_component_set *set);

#endif
