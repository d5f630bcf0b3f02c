/* From a wanted torque spectrum to harmonic currents: the main job. */
#ifndef HCI_HOST_SOLVE_H
#define HCI_HOST_SOLVE_H

#include "hci/effect.h"
#include "hci/host/machine.h"
#include "hci/host/report.h"
#include "hci/host/tables.h"
#include "hci/strategy.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    HCI_METHOD_AUTO,
    HCI_METHOD_LU,
    HCI_METHOD_UMFPACK,
    HCI_METHOD_QR,
    HCI_METHOD_POINTWISE
} hci_method;
typedef enum { HCI_COMPARE_ALL, HCI_COMPARE_SQUARE } hci_compare;

const char *hci_method_name(hci_method method);

/* Tells of progress on long work: what is done and the share 0 … 1 of it. */
typedef void hci_progress(void *context, const char *what, double share);

typedef struct {
    const hci_target *target;
    const hci_component_set *set; /* NULL: choose (method pointwise needs none) */
    size_t choose_at_most;        /* with set NULL: at most so many components, 0 for as many as it takes */
    const hci_wave *held;         /* a fundamental that is held fixed, or NULL to solve for it too */
    hci_method method;
    hci_strategy strategy; /* of the pointwise method */
    hci_compare compare;
    double tolerance;       /* an order is reached within this share of the mean torque; 0: 1e-6 */
    double loss_allowance;  /* with choose_at_most: copper loss allowed over the pointwise limit; 0: 1.10 */
    double limit_current_A; /* largest phase current allowed; 0: none */
    double limit_voltage_V; /* dc-link voltage that the line voltages must stay below; 0: none */
    double speed_rad_per_s; /* mechanical, for the voltage; 0 with no limit_voltage_V */
    const hci_effects *effects; /* beside the declared machine, or NULL; needed where it has_effects */
    bool at_temperature;        /* magnets are at temperature_C, else at the reference of their effect */
    double temperature_C;
    hci_progress *progress; /* may be NULL */
    void *progress_context;
} hci_solve_options;

/* Why an order is as it is. */
typedef enum {
    HCI_ORDER_REACHED,    /* within the tolerance of its target */
    HCI_ORDER_FREE,       /* weight 0: not cared for */
    HCI_ORDER_MISSED,     /* compared, but not within the tolerance */
    HCI_ORDER_PARASITIC,  /* not compared, and not within the tolerance */
    HCI_ORDER_UNREACHABLE /* no component of the set reaches it */
} hci_order_verdict;

const char *hci_order_verdict_name(hci_order_verdict verdict);

typedef struct {
    hci_harmonic target_Nm, torque_Nm;
    hci_harmonic before_Nm; /* of the plain fundamental with the same mean torque */
    double error_Nm;        /* |torque − target| as a peak amplitude */
    hci_order_verdict verdict;
    hci_component remedy; /* where unreachable: what would reach it with the least current; see below */
} hci_solved_order;

/* Whether an order is unreachable and some component would reach it. */
bool hci_remedy_exists(const hci_solved_order *order);

/* A range of electrical angles. */
typedef struct {
    double from_rad, to_rad;
} hci_angle_gap;

enum { HCI_MOST_GAPS = 32 };

typedef struct {
    /* What flows, a held fundamental included: mean torque × per_Nm + constant, which are NULL where currents
     * are not linear in the mean torque (held fundamental, reluctance torque). */
    hci_currents current;
    hci_wave *per_Nm, *constant;

    /* What it does. Orders ascending; worst of those cared for. */
    hci_solved_order *order;
    size_t order_count;
    double tolerance_Nm;
    double worst_error_Nm, worst_order;
    size_t period_turns; /* electrical turns after which everything repeats */

    /* How it was found. condition: an estimate, NAN where the method has none. newton_change: of the current
     * in the last step, as a share of it; 0 steps for a machine without reluctance torque and saturation. */
    hci_method method;
    size_t rows, unknowns, rank;
    double condition;
    size_t newton_steps;
    double newton_change;
    bool newton_converged; /* else the nearest answer met on the way */

    /* Pointwise: where the strategy has no current (the first ranges; gap_count is of all). least_iq_A: for
     * `cancel`, the i_q from which it has one at every angle, infinite if none, NAN where not known
     * (saturation). */
    hci_angle_gap gap[HCI_MOST_GAPS];
    size_t gap_count;
    double least_iq_A;

    /* What it costs. mean_square: mean of i_a² + i_b² + i_c². Ratios are of copper loss, to the plain
     * fundamental (0 A when no mean torque is wanted; ratio NAN) and to the pointwise limit (NAN when e⊥
     * vanishes at an angle). */
    double mean_square_A2;
    double plain_amplitude_A, loss_to_plain;
    double limit_mean_square_A2, loss_to_limit;

    /* Whether it fits. Voltage: at the speed asked for, NAN without one. torque_at_limit: the largest mean
     * torque with the same ripple that keeps the current limit, NAN when not known or none does. */
    bool within_limits; /* true where no limit was asked for */
    double peak_phase_current_A, peak_line_voltage_V;
    double torque_at_limit_Nm;

    bool with_effects; /* torque and voltage are those of the machine with its effects */
    hci_note remark;   /* what the user should know of them, or "" */
} hci_solution;

/* HCI_OK; HCI_NOT_REACHED with the nearest result when a cared-for order is not within the tolerance or a
 * limit is not kept (the result is not bent to the limit); or an error with a note, and then *solution is
 * empty. Otherwise *solution is to be given to hci_solution_release. */
hci_status hci_solve(const hci_machine_data *machine, const hci_solve_options *options,
                     hci_solution *solution, hci_note *note);
void hci_solution_release(hci_solution *solution);

/* What given currents do on a machine. Torque spectrum: orders ascending, those that have any torque, that
 * are wanted, and 0. rms_error: of the torque from its target, orders of weight 0 left out; ripples: 100 (max
 * − min)/mean and 100·rms(T − mean)/mean, NAN without a mean. */
typedef struct {
    hci_harmonic *torque_Nm;
    size_t order_count, period_turns;
    double mean_Nm, rms_error_Nm, worst_error_Nm, worst_order;
    double peak_to_peak_Nm, T_ripple_percent, F_ripple_percent;
} hci_judgement;

/* Evaluates currents that were found elsewhere, such as for the declared machine, on a machine with effects
 * (or NULL), magnets at the reference temperature. currents: count star waves. *judgement: out; on success to
 * be given to hci_judgement_release, else empty. HCI_ERROR_INPUT when orders have no common period,
 * HCI_ERROR_MEMORY. */
hci_status hci_judge_currents(const hci_machine_data *machine, const hci_effects *effects,
                              const hci_wave *currents, size_t count, const hci_target *target,
                              hci_judgement *judgement, hci_note *note);
void hci_judgement_release(hci_judgement *judgement);

/* Writes currents.csv, waveform.csv, spectrum.csv, solution.svg, summary.json and, where currents are linear
 * in the mean torque, currents_per_Nm.csv and currents_constant.csv into `folder`; all or none. */
hci_status hci_solution_write(const hci_machine_data *machine, const hci_solution *solution,
                              hci_status verdict, const char *folder, hci_note *note);

/* The same, and report.html beside them; NULL: without. */
hci_status hci_solution_write_with_report(const hci_machine_data *machine, const hci_solution *solution,
                                          hci_status verdict, const hci_report_sources *sources,
                                          const char *folder, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
