/* Solving over a grid: ripple against limits, the largest torque at each speed, maps over torque and speed.
 * A grid is a plan of points that do not depend on each other, so that they can be solved in any order, in
 * several processes and on several computers, with the same result. */
#ifndef HCI_HOST_SWEEP_SWEEP_H
#define HCI_HOST_SWEEP_SWEEP_H

#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a grid is for. */
typedef enum {
    HCI_GRID_TRADE_OFF, /* one torque: ripple by the limit of the peak current, and by the limit of copper */
    HCI_GRID_ENVELOPE,  /* the largest torque at each speed with a ripple that is allowed */
    HCI_GRID_MAP        /* each torque at each speed */
} hci_grid_kind;

/* Their words in files and options: X(kind, word). */
#define HCI_GRID_KIND_NAMES(X)                                                                               \
    X(HCI_GRID_TRADE_OFF, "trade-off")                                                                       \
    X(HCI_GRID_ENVELOPE, "envelope")                                                                         \
    X(HCI_GRID_MAP, "map")

/* The word of a kind; a static string. */
const char *hci_grid_kind_name(hci_grid_kind kind);

/* One point of a grid. NAN: not asked for. */
typedef struct {
    double torque_Nm;       /* mean that is wanted; NAN: the largest */
    double speed_rad_per_s; /* mechanical */
    double link_V;          /* dc link; NAN: as the options or the machine say */
    double limit_current_A; /* peak of a phase, in place of that of the options */
    double limit_copper;    /* copper loss over that of the plain sine, in place of that of the options */
} hci_grid_point;

/* Values of one axis of a grid. */
typedef struct {
    const double *value; /* of it */
    size_t count;        /* entries of value */
} hci_grid_axis;

/* What is asked for. Start with {0}. */
typedef struct {
    hci_grid_kind kind;              /* what it is for */
    const hci_machine_data *machine; /* of all points */
    const hci_solve_options
        *options;                  /* of each point; target, speed and dc link are the point's own; envelope
                                    * of a torque linear in the current: HCI_MINIMISE_AUTO is the swing */
    double ripple_percent;         /* envelope: largest T_ripple; 0: 1 */
    hci_grid_axis torque_Nm;       /* trade-off: one; map */
    hci_grid_axis speed_rad_per_s; /* trade-off: at most one, 0 without it; envelope; map */
    hci_grid_axis link_V;          /* envelope, map: may be empty */
    hci_grid_axis limit_current_A; /* trade-off: chosen where it is empty */
    hci_grid_axis limit_copper;    /* the same; copper loss over that of the plain sine */
    const hci_grid_point *point;   /* map: these in place of the axes, or NULL */
    size_t point_count;            /* entries of point */
} hci_grid_request;

/* What currents do. NAN: not known. */
typedef struct {
    double mean_Nm;               /* mean torque */
    double T_ripple_percent;      /* 100 (max − min)/mean */
    double worst_Nm, worst_order; /* the largest error of an order, and that order */
    double mean_square_A2;        /* mean of i_a² + i_b² + i_c² */
    double loss_to_plain;         /* copper loss over that of the plain sine of the torque that is wanted */
    double peak_A, rms_A;         /* of a phase; the rms is that of the three phases together */
    double line_V;                /* largest |line voltage|; only where it is limited */
    bool binds[HCI_LIMIT_COPPER + 1]; /* by hci_limit_kind: that limit is touched and costs something */
} hci_grid_figures;

/* How a point came out. */
typedef enum {
    HCI_GRID_REACHED, /* the torque is as wanted; envelope: with no more ripple than is allowed */
    HCI_GRID_RIPPLE,  /* the mean is, and the ripple the smallest that was found */
    HCI_GRID_TORQUE,  /* the mean is the nearest to the wanted one */
    HCI_GRID_LIMITS,  /* no current keeps the limits; no figures */
    HCI_GRID_FAILED   /* no result, for the reason that is given */
} hci_grid_verdict;

/* Their words in files: X(verdict, word). */
#define HCI_GRID_VERDICT_NAMES(X)                                                                            \
    X(HCI_GRID_REACHED, "reached")                                                                           \
    X(HCI_GRID_RIPPLE, "ripple")                                                                             \
    X(HCI_GRID_TORQUE, "torque")                                                                             \
    X(HCI_GRID_LIMITS, "limits")                                                                             \
    X(HCI_GRID_FAILED, "failed")

/* The word of a verdict; a static string. */
const char *hci_grid_verdict_name(hci_grid_verdict verdict);

/* Bytes of a reason. */
enum { HCI_GRID_REASON_SIZE = 240 };

/* A point that is solved. */
typedef struct {
    hci_grid_point point;     /* what was asked for */
    hci_grid_verdict verdict; /* how it came out */
    hci_grid_figures best;    /* of the currents that were found; envelope: with the ripple allowed */
    hci_grid_figures most;    /* envelope: of the largest mean torque with any ripple */
    hci_grid_figures sine;    /* of the plain sine: envelope: of its largest mean torque within the same
                               * limits; else of the one with the wanted mean, without limits */
    char reason[HCI_GRID_REASON_SIZE]; /* of a point that failed, or "" */
    bool out_of_memory;                /* it failed for that: to be solved again, and not to be kept */
} hci_grid_row;

/* A row of a point that failed. */
void hci_grid_fail(const hci_grid_point *point, const char *reason, hci_grid_row *row);

/* What a trade-off ranges over: found without limits of current and copper. */
typedef struct {
    double plain_A; /* amplitude of the plain sine of the torque */
    double peak_A;  /* of the currents with the smallest ripple and the least copper */
    double copper;  /* copper loss of these over that of the plain sine */
} hci_grid_span;

/* Solves for it. HCI_ERROR_INPUT, _NUMERIC, _MEMORY, of a wrong machine _ARGUMENT. */
hci_status hci_grid_span_find(const hci_grid_request *request, hci_grid_span *span, hci_note *note);

/* The points of a grid in their order. Start with {0}. */
typedef struct {
    hci_grid_point *point; /* of the grid */
    size_t count;          /* entries of point */
    size_t by_current;     /* trade-off: so many of them limit the current, those behind the copper */
} hci_grid_plan;

/* span: of a trade-off, else NULL. *plan: out, to be given to hci_grid_plan_release. HCI_ERROR_ARGUMENT for
 * a grid that is empty or lacks an axis, HCI_ERROR_MEMORY. */
hci_status hci_grid_plan_make(const hci_grid_request *request, const hci_grid_span *span, hci_grid_plan *plan,
                              hci_note *note);

/* Frees what a plan holds and empties it. */
void hci_grid_plan_release(hci_grid_plan *plan);

/* Solves one point. What goes wrong is its verdict and reason; a lack of memory is told apart. */
void hci_grid_solve(const hci_grid_request *request, const hci_grid_point *point, hci_grid_row *row);

/* A grid, solved as far as it is. Start with {0}. */
typedef struct {
    hci_grid_request request; /* what was asked for */
    hci_grid_plan plan;       /* its points */
    hci_grid_row *row;        /* plan.count; of those that are done */
    bool *done;               /* plan.count */
    hci_note remark;          /* what was left out of points.csv, in words; empty otherwise */
} hci_grid;

/* Rows for a plan, none of them done; the sweep takes the plan. HCI_ERROR_MEMORY. */
hci_status hci_grid_begin(const hci_grid_request *request, hci_grid_plan *plan, hci_grid *sweep,
                          hci_note *note);

/* How many points are done. */
size_t hci_grid_done(const hci_grid *sweep);

/* Of a trade-off the row with the least limit at which the mean is reached with at most so much T_ripple, of
 * the points that limit the copper or of those that limit the current; HUGE_VAL: any ripple. NULL: none. */
const hci_grid_row *hci_grid_least(const hci_grid *sweep, bool of_copper, double ripple_percent);

/* T_ripple up to which there is none, in percent. */
#define HCI_GRID_SMOOTH 0.01

/* Points by their verdict. */
void hci_grid_count(const hci_grid *sweep, size_t count[HCI_GRID_FAILED + 1]);

/* Bytes of the words of limits, and of those that bind. */
enum { HCI_GRID_WORDS_SIZE = 256, HCI_GRID_BINDS_SIZE = 64 };

/* "phase current at most 12 A; line voltage at most 311 V": the limits of all points. */
void hci_grid_limits_words(const hci_grid_request *request, char text[HCI_GRID_WORDS_SIZE]);

/* Copper loss in W of a mean of i_a² + i_b² + i_c²; NAN where the machine does not say its resistance. */
double hci_grid_copper_W(const hci_grid_request *request, const hci_grid_figures *figures);

/* "current+voltage": the limits that bind, or "". */
void hci_grid_binds_text(const hci_grid_figures *figures, char text[HCI_GRID_BINDS_SIZE]);

/* Frees what a sweep holds and empties it. */
void hci_grid_release(hci_grid *sweep);

#ifdef __cplusplus
}
#endif

#endif
