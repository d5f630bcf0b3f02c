/* From a wanted torque spectrum to harmonic currents: the main job. */
#ifndef HCI_HOST_SOLVE_SOLVE_H
#define HCI_HOST_SOLVE_SOLVE_H

#include <stdbool.h>

#include "hci/drive/plant.h"
#include "hci/effects/effect.h"
#include "hci/host/base/progress.h"
#include "hci/host/currents/currents.h"
#include "hci/host/currents/target.h"
#include "hci/host/machine/corrections.h"
#include "hci/host/machine/expected_ripple.h"
#include "hci/host/machine/machine.h"
#include "hci/host/solve/loop_reach.h"
#include "hci/machine/strategy.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How U x = h is solved. */
typedef enum {
    HCI_METHOD_AUTO,     /* by shape and size: one of the next three */
    HCI_METHOD_LU,       /* dense LU, for square systems */
    HCI_METHOD_UMFPACK,  /* sparse LU, for square systems */
    HCI_METHOD_QR,       /* orthogonal: least squares, and of those the least current */
    HCI_METHOD_POINTWISE /* angle by angle, by a strategy, without U */
} hci_method;

/* Their words in files and options: X(method, word). */
#define HCI_METHOD_NAMES(X)                                                                                  \
    X(HCI_METHOD_AUTO, "auto")                                                                               \
    X(HCI_METHOD_LU, "lu")                                                                                   \
    X(HCI_METHOD_UMFPACK, "umfpack")                                                                         \
    X(HCI_METHOD_QR, "qr")                                                                                   \
    X(HCI_METHOD_POINTWISE, "pointwise")

/* Which torque orders are rows of U. */
typedef enum {
    HCI_COMPARE_ALL,   /* every order that the components reach or that is wanted */
    HCI_COMPARE_SQUARE /* as many as unknowns; what the others do is reported */
} hci_compare;

/* The name of a method as on the command line; a static string. */
const char *hci_method_name(hci_method method);

/* Which ripple is made smallest where the wanted torque is not reached. */
typedef enum {
    HCI_MINIMISE_AUTO,         /* the sum of squares of all orders; within limits that act, the worst order */
    HCI_MINIMISE_WORST,        /* the largest weighted error of an order */
    HCI_MINIMISE_PEAK_TO_PEAK, /* the swing of the torque less what is wanted; weights 0 count as not there */
    HCI_MINIMISE_RMS           /* the weighted root of the sum of squares */
} hci_minimise;

/* Their words in files and options: X(minimise, word). */
#define HCI_MINIMISE_NAMES(X)                                                                                \
    X(HCI_MINIMISE_WORST, "worst")                                                                           \
    X(HCI_MINIMISE_PEAK_TO_PEAK, "peak-to-peak")                                                             \
    X(HCI_MINIMISE_RMS, "rms")

/* What the currents have to keep, beside limit_current_A and limit_voltage_V. 0: no such limit. Voltages need
 * a speed; without limit_voltage_V the dc_link_voltage that the machine declares is the limit at a speed that
 * is not 0, and its max_current is one of each phase that has none, unless ignore_ratings. */
typedef struct {
    double current_A[3];                  /* largest |current| of each phase, in place of limit_current_A */
    bool is_open[3];                      /* phases that carry no current */
    double rms_A[3];                      /* of each phase */
    double voltage_reserve;               /* share of the dc link that is left for the control, below 1 */
    double dead_time_s, pwm_frequency_Hz; /* line voltages lose 2 · dead time · frequency of the dc link */
    hci_modulation modulation;            /* what is within limit_voltage_V: line voltages, twice each phase
                                           * voltage, or √3 times the amplitude of the vector */
    double copper_W;                      /* copper loss of all phases; needs `resistance` */
    double copper_ratio;                  /* copper loss over that of the plain sine */
    bool ignore_ratings;                  /* leave out what the machine declares */
} hci_solve_limits;

/* What is asked for. Start with {0}; all but target may stay so. */
typedef struct {
    const hci_target *target;     /* wanted torque */
    const hci_component_set *set; /* NULL: choose; only NULL goes with choose_at_most and method pointwise */
    size_t choose_at_most;        /* at most so many components, 0 for as many as it takes */
    const hci_wave *held;         /* a fundamental that is held fixed, or NULL to solve for it too */
    hci_method method;            /* how to solve */
    hci_strategy strategy;        /* of the pointwise method */
    const double *current_angle_rad; /* of the pointwise method in place of a strategy, or NULL: β that the
                                      * current keeps in the rotor frame, i_d = −I sin β, i_q = I cos β; at 0
                                      * i_q alone makes the torque. Any sign of I; star currents */
    hci_compare compare;             /* which orders are rows */
    double tolerance;                /* an order is reached within this share of the mean torque; 0: 1e-6 */
    double loss_allowance;   /* with choose_at_most: copper loss allowed over the pointwise limit; 0: 1.10 */
    double limit_current_A;  /* largest phase current allowed; 0: none */
    double limit_voltage_V;  /* dc-link voltage that the line voltages must stay below; 0: none */
    double speed_rad_per_s;  /* mechanical, for the voltage */
    bool at_speed;           /* a speed is given, be it 0: then a declared dc_link_voltage is a limit. Any
                              * speed_rad_per_s other than 0 counts as given */
    hci_solve_limits limits; /* more of them */
    hci_minimise minimise;   /* which ripple, where it cannot be as wanted */
    /* Components whose order in the rotor frame, |n − σ|, is above it are not chosen; 0: all may be. A set
     * keeps what it names. */
    double highest_rotor_order;
    /* Electrical angle between two samples of the current loop: of currents with the same torque those are
     * taken of which the loop misses least between its samples, or 1 % of the mean torque, peak to peak,
     * with at most loss_allowance (0: 1.5) times the copper; needs speed_rad_per_s, R and L_d, L_q, without
     * which, or with interior magnets, squares of high orders are priced in its place. 0: a loop without
     * samples. Without effect on choose_at_most and method pointwise. */
    double sample_rad;
    const hci_effects *effects; /* beside the declared machine, or NULL; needed where it has_effects */
    const hci_uncertainty *uncertainty; /* what recordings of the machine leave open, or NULL */
    double loop_bandwidth_Hz; /* of the current loop that is to make the currents, at speed_rad_per_s where
                               * that is not 0; 0: none is told */
    bool at_temperature;      /* magnets are at temperature_C, else at the reference of their effect */
    double temperature_C;     /* of the magnets */
    hci_progress *progress;   /* may be NULL */
    void *progress_context;   /* first argument of progress */
    hci_stop *stop;           /* may be NULL; then HCI_ERROR_STOPPED, and nothing is kept */
    void *stop_context;       /* first argument of stop */
} hci_solve_options;

/* Why an order is as it is. */
typedef enum {
    HCI_ORDER_REACHED,    /* within the tolerance of its target */
    HCI_ORDER_FREE,       /* weight 0: not cared for */
    HCI_ORDER_MISSED,     /* compared, but not within the tolerance */
    HCI_ORDER_PARASITIC,  /* not compared, and not within the tolerance */
    HCI_ORDER_UNREACHABLE /* no component of the set reaches it */
} hci_order_verdict;

/* The verdict in a word, as in summary.json; a static string. */
const char *hci_order_verdict_name(hci_order_verdict verdict);

/* One order of the torque. */
typedef struct {
    hci_harmonic target_Nm, torque_Nm; /* what was wanted, and what the currents make */
    hci_harmonic before_Nm;            /* of the plain fundamental with the same mean torque */
    double error_Nm;                   /* |torque − target| as a peak amplitude */
    hci_order_verdict verdict;         /* why it is so */
    hci_component remedy; /* where unreachable: what would reach it with the least current; see below */
} hci_solved_order;

/* Whether an order is unreachable and some component would reach it. */
bool hci_remedy_exists(const hci_solved_order *order);

/* A range of electrical angles. */
typedef struct {
    double from_rad, to_rad; /* ends, electrical */
} hci_angle_gap;

/* Most ranges that are kept. */
enum { HCI_MOST_GAPS = 32 };

/* U at the solution, in compressed columns, in N·m/A and without the weights of the orders. Columns: S and C
 * of each component of the set in turn. Rows: S and C of each order of the solution in turn, order 0 with C
 * alone. */
typedef struct {
    hci_component_set
        set; /* asked for or chosen, those without current included; empty for method pointwise */
    int64_t *column_start, *row; /* where each column begins, one more than columns; row of each value */
    double *value;               /* of the entries */
} hci_solved_system;

/* Kinds of limits. */
typedef enum {
    HCI_LIMIT_CURRENT, /* |current| of a phase, A */
    HCI_LIMIT_RMS,     /* rms current of a phase, A */
    HCI_LIMIT_VOLTAGE, /* |voltage| between two phases, V, or twice that of a phase */
    HCI_LIMIT_COPPER   /* mean of i_a² + i_b² + i_c², A² */
} hci_limit_kind;

/* The kind in a word, as in summary.json; a static string. */
const char *hci_limit_kind_name(hci_limit_kind kind);

/* Most limits that there are at once, and most places at which one is told to be touched. */
enum { HCI_MOST_LIMITS = 8, HCI_MOST_TOUCHES = 24 };

/* Where a limit is touched. */
typedef struct {
    int phase;        /* 0, 1, 2: a, b, c; of voltages between two phases ab, bc, ca */
    double theta_rad; /* electrical */
} hci_limit_touch;

/* One limit and how the currents stand to it. */
typedef struct {
    hci_limit_kind kind;       /* of what */
    int phase;                 /* 0, 1, 2: of phase a, b, c alone; −1: the same for all */
    double limit, value;       /* what is allowed, and the largest there is; unit of the kind */
    bool is_declared;          /* by the machine, not asked for */
    hci_modulation modulation; /* of a voltage: which */
    bool binds;                /* it is touched and costs something */
    double gain; /* what 1 more of it would give, by solution.limit_cost; 0 where it does not bind, no number
                  * where it is not known: the currents are the best that were found, and not at rest */
    hci_limit_touch touch[HCI_MOST_TOUCHES]; /* currents and voltages: where it is touched */
    size_t touch_count;                      /* of them; those beyond HCI_MOST_TOUCHES are not kept */
} hci_limit;

/* "a", or "ab" of a voltage between two phases; a static string. phase: 0, 1, 2. */
const char *hci_limit_place_name(const hci_limit *limit, int phase);

/* What limits have cost, the worst first of which applies, and so what a wider limit would give. */
typedef enum {
    HCI_COST_NONE,   /* the currents without limits keep them all */
    HCI_COST_COPPER, /* the torque is as wanted, for more copper loss: gain is A² less */
    HCI_COST_RIPPLE, /* the mean torque is as wanted, its ripple is not: gain is N·m less of it */
    HCI_COST_TORQUE, /* the mean torque is the nearest that there is: gain is N·m nearer */
    HCI_COST_LIMITS  /* no current keeps them: the one that exceeds all by the same share; gain is that share
                      * less */
} hci_limit_cost;

/* The cost in a word, as in summary.json; a static string. */
const char *hci_limit_cost_name(hci_limit_cost cost);

/* Currents, what they do and what they cost. Made by hci_solve. */
typedef struct {
    hci_currents current; /* what flows, a held fundamental included */
    hci_wave *per_Nm; /* A/(N·m): current = mean torque × per_Nm + constant, current.count waves each; NULL
                       * where that is not so (held fundamental, reluctance torque) */
    hci_wave *constant; /* A; NULL as per_Nm */

    hci_solved_order *order;            /* what it does; ascending */
    size_t order_count;                 /* entries of order */
    double tolerance_Nm;                /* within which an order is reached */
    double worst_error_Nm, worst_order; /* of those cared for */
    double T_ripple_percent;            /* 100 (max − min)/mean of the torque; NAN without a mean */
    double T_ripple_before_percent;     /* the same of the plain fundamental; NAN without one */
    size_t period_turns;                /* electrical turns after which everything repeats */

    hci_method method;           /* how it was found */
    size_t rows, unknowns, rank; /* of U; 0 for the pointwise method */
    double condition;            /* an estimate; NAN where the method has none */
    hci_solved_system system;    /* U itself */
    size_t newton_steps;         /* 0 for a machine without reluctance torque and saturation */
    double newton_change;        /* of the current in the last step, as a share of it */
    bool newton_converged;       /* else the nearest answer met on the way */

    hci_angle_gap gap[HCI_MOST_GAPS]; /* pointwise: where the strategy has no current, the first ranges */
    size_t gap_count;                 /* of all ranges */
    double least_iq_A; /* for `cancel`, the i_q from which it has a current at every angle; infinite if none,
                        * NAN where not known (saturation) */

    double mean_square_A2;    /* what it costs: mean of i_a² + i_b² + i_c² */
    hci_wave plain;           /* compared with: the fundamental that is held, or the least sine whose mutual
                               * torque has the wanted mean; before_Nm is of it */
    bool plain_is_held;       /* which of the two */
    double plain_amplitude_A; /* of it; 0 without one */
    double loss_to_plain;     /* copper loss over that of the plain fundamental; NAN without one */
    double limit_mean_square_A2, loss_to_limit; /* of the pointwise limit, and copper loss over that; NAN when
                                                 * e⊥ vanishes at an angle */

    bool within_limits;                   /* whether it fits; true where there is no limit */
    double peak_phase_current_A;          /* largest |phase current| */
    double rms_phase_current_A;           /* of the phase that has most */
    double peak_neutral_A, rms_neutral_A; /* of the neutral conductor; NAN without one */
    double peak_line_voltage_V;           /* largest |line voltage| at the speed asked for; NAN without one */
    double peak_open_voltage_V; /* the same against an open phase, which is not limited; NAN without one */
    double torque_at_limit_Nm;  /* the largest mean torque at which the currents without limits, scaled with
                                 * it, keep the current limit; NAN when they do anyhow, or not known */

    hci_limit limit[HCI_MOST_LIMITS]; /* each limit there is */
    size_t limit_count;               /* of them */
    hci_limit_cost limit_cost;        /* what they cost */
    double resistance_ohm;            /* of a phase, by which the copper loss is in W; NAN where not known */
    double exceeded_share;            /* HCI_COST_LIMITS: by how much every limit is widened; else 0 */
    double wanted_mean_Nm;            /* mean torque asked for */
    hci_minimise minimised;           /* which ripple was made smallest within limits */
    double minimised_Nm;              /* how small it is; NAN where no limit acts */

    hci_expected_ripple expected; /* of the real machine, where recordings tell of it; with what the loop adds
                                   * where a bandwidth and a speed were given */
    hci_loop_reach loop;          /* what a current loop makes of the currents */

    bool with_effects;            /* torque and voltage are those of the machine with its effects */
    hci_machine_identity machine; /* they are of */
    hci_note remark;              /* what the user should know of them, or "" */
    /* What the drive has to correct where it has the sensors of the recordings, as hci_corrections_words says
     * it, or "". */
    char corrections[HCI_CORRECTIONS_SIZE];
} hci_solution;

/* Finds the currents. HCI_OK; HCI_NOT_REACHED with the nearest result when a cared-for order is not within
 * the tolerance or no currents keep the limits; or an error with a note, and then *solution is empty. Within
 * limits these come in turn: the mean torque, the ripple of `minimise`, the copper loss. Otherwise *solution
 * is to be given to hci_solution_release. */
hci_status hci_solve(const hci_machine_data *machine, const hci_solve_options *options,
                     hci_solution *solution, hci_note *note);

/* Whether the bound of `expected`, as it is said, is above the mean torque and above the ripple of the plain
 * sine, so that it tells nothing. */
bool hci_solution_is_boundless(const hci_solution *solution);

/* Frees what a solution holds and empties it. */
void hci_solution_release(hci_solution *solution);

/* What given currents do on a machine. */
typedef struct {
    hci_harmonic *torque_Nm; /* spectrum, ascending: orders that have torque or are wanted, and 0 */
    size_t order_count;      /* entries of torque_Nm */
    size_t period_turns;     /* electrical turns after which it repeats */
    double mean_Nm;          /* order 0 */
    double rms_error_Nm;     /* of the torque from its target, orders of weight 0 left out */
    double worst_error_Nm, worst_order; /* the largest error of an order that is cared for, and that order */
    double peak_to_peak_Nm;             /* max − min over the angle */
    double T_ripple_percent;            /* 100 (max − min)/mean; NAN without a mean */
    double F_ripple_percent;            /* 100 rms(T − mean)/mean; NAN without a mean */
} hci_torque_evaluation;

/* Evaluates currents that were found elsewhere, such as for the declared machine, on a machine with effects
 * (or NULL), magnets at the reference temperature. currents: star waves in A. *evaluation: out; on success to
 * be given to hci_torque_evaluation_release, else empty. HCI_ERROR_INPUT when orders have no common period,
 * HCI_ERROR_MEMORY. */
hci_status hci_evaluate_currents(const hci_machine_data *machine, const hci_effects *effects,
                                 const hci_currents *currents, const hci_target *target,
                                 hci_torque_evaluation *evaluation, hci_note *note);

/* Frees what an evaluation holds and empties it. */
void hci_torque_evaluation_release(hci_torque_evaluation *evaluation);

#ifdef __cplusplus
}
#endif

#endif
