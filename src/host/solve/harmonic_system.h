/* The harmonic balance U x = h of one task and one list of components. */
#ifndef HCI_SRC_HOST_SOLVE_HARMONIC_SYSTEM_H
#define HCI_SRC_HOST_SOLVE_HARMONIC_SYSTEM_H

#include "hci/host/solve/solve.h"
#include "hci/machine/strategy.h"
#include "host/machine/quadratic_model.h"
#include "host/numeric/sparse.h"

/* What is wanted of which machine, and what flows already.
 *
 * machine holds all torque up to the second degree in the currents, beyond what is above it. gain is ∂T/∂i:
 * the back-EMF, and where the torque is not linear e + L'i and more, at the currents where it is linearised.
 * offset is what linearising adds to the wanted torque: the reluctance torque there. */
typedef struct {
    const hci_machine *machine;
    const hci_effects_plant *beyond; /* or NULL */
    bool has_neutral;
    const hci_target *target;
    const hci_wave *held; /* or NULL */
    const hci_wave *gain;
    size_t gain_count;
    const hci_harmonic *offset; /* or NULL */
    size_t offset_count;
    double compared_up_to; /* orders above are left to themselves; 0: all are compared */
    size_t period_turns;   /* electrical turns after which every order named so far repeats */
    hci_strategy strategy; /* of the pointwise method */
    hci_progress *progress;
    void *progress_context;
} hci_task;

/* U, h and what their rows mean. Right-hand sides are two columns: what 1 N·m of mean torque adds, and the
 * rest (wanted ripple less cogging less the torque of what is held), so that h = mean torque × first +
 * second. Rows of U and h carry the weights of their orders; orders of weight 0 are left out. */
typedef struct {
    double *order; /* compared orders, ascending */
    size_t order_count, rows, unknowns;
    double *row_weight;
    double *h;    /* rows × 2 */
    hci_sparse u; /* rows × unknowns; owned */
} hci_harmonic_system;

/* A set with the coordinates of both right-hand sides. */
typedef struct {
    hci_component_set set;
    double *x; /* 2·count × 2 */
} hci_answer;

void hci_answer_release(hci_answer *answer);

/* A task for a machine: all but the target zero, the gain of no current. */
void hci_task_begin(const hci_quadratic_model *corrected, const hci_target *target, hci_task *task);

/* Of the magnets; NAN, which is the reference, where none is given. */
double hci_temperature_C(const hci_solve_options *options);

/* Fills period_turns for everything in the task, the components of a set (or NULL) and given waves.
 * HCI_ERROR_INPUT when there is no common period. */
hci_status hci_task_find_period(hci_task *task, const hci_component_set *set, const hci_wave *wave,
                                size_t count, hci_note *note);

/* Whether the torque is linear in the currents. */
bool hci_task_is_linear(const hci_task *task);

hci_status hci_harmonic_system_make(const hci_task *task, const hci_component *component, size_t count,
                                    hci_compare compare, hci_harmonic_system *balance, hci_note *note);
void hci_harmonic_system_release(hci_harmonic_system *balance);

/* Choice of components, without a limit to their number: the lowest top order whose exact solution costs
 * at most 1 % more copper than the pointwise limit. x: out, the solution (unknowns × 2), the caller's to
 * free. */
hci_status hci_choose_all(const hci_task *task, double tolerance_Nm, double limit_mean_square_A2,
                          hci_component_set *set, double **x, hci_note *note);

/* The best set of at most `most` components: least worst order with at most loss_A2 of mean square current.
 * only: the candidates, or NULL for all that there are. */
hci_status hci_choose_few(const hci_task *task, const hci_component_set *only, size_t most,
                          double tolerance_Nm, double loss_A2, hci_component_set *set, double **x,
                          hci_note *note);

/* The linear problem at task->gain: the given set, `only` when there is none and it is not NULL, or a chosen
 * one. Fills size, rank, condition and method of *solution; *answer is to be released in any case. */
hci_status hci_linear_answer(const hci_task *task, const hci_solve_options *options,
                             const hci_component_set *only, hci_answer *answer, hci_solution *solution,
                             hci_note *note);

/* The same for a machine whose torque is not linear, by Newton's method: task->gain and task->offset follow
 * the current; what they point to is in *room, to be released by hci_newton_release after the task was last
 * used. */
typedef struct {
    hci_wave *gain;
    hci_harmonic *offset;
} hci_linearisation;

hci_status hci_newton_answer(hci_task *task, const hci_solve_options *options, hci_linearisation *room,
                             hci_answer *answer, hci_solution *solution, hci_note *note);
void hci_newton_release(hci_linearisation *room);

/* Orders, torque and verdicts of the currents of *solution, and their losses. set: whose components could
 * reach an order. */
hci_status hci_solution_evaluate(const hci_task *task, const hci_component_set *set, hci_compare compare,
                                 hci_solution *solution, hci_note *note);

/* True torque of a current at every order at which it has any, that is wanted or that cogging has, and at 0.
 * *torque: out, to be freed with hci_memory_free. */
hci_status hci_torque_spectrum_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                        hci_harmonic **torque, size_t *torque_count, hci_note *note);

/* Weighted error of the true torque of a current: the largest at any order, and the sum of all squares. */
typedef struct {
    double worst_Nm, square_sum;
} hci_torque_error;

hci_status hci_torque_error_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                     hci_torque_error *error, hci_note *note);

/* The pointwise limit i = (T* − T_cog) e⊥/(e⊥·e⊥). mean_square_A2: of the limit, NAN where e⊥ vanishes. */
double hci_pointwise_mean_square_A2(const hci_task *task);

/* The currents of task->strategy as waves in two parts, per N·m of mean torque and the rest (everything is in
 * the rest where currents are not linear in the torque). Angles without an answer are noted in *solution;
 * there the nearest current is taken. *answer is to be released in any case. HCI_ERROR_NUMERIC when e⊥
 * vanishes at an angle. */
hci_status hci_pointwise_answer(const hci_task *task, hci_answer *answer, hci_solution *solution,
                                hci_note *note);

#endif
