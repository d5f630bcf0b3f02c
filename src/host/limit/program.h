/* What a stage of solving within limits is made of, and what it gives (theory.md, section 15). */
#ifndef HCI_SRC_HOST_LIMIT_PROGRAM_H
#define HCI_SRC_HOST_LIMIT_PROGRAM_H

#include "host/limit/points.h"

/* The wishes in their order. */
typedef enum {
    HCI_STAGE_FIT,    /* the smallest share by which all limits are widened until a current keeps them */
    HCI_STAGE_MEAN,   /* the mean torque nearest to the wanted one */
    HCI_STAGE_RIPPLE, /* with that mean the smallest ripple */
    HCI_STAGE_COPPER  /* with that ripple the least copper */
} hci_limit_stage;

/* Phase currents, line voltages, torque: a grid of each. */
enum { HCI_MOST_GRIDS = 7 };

typedef struct {
    hci_limit_field field;
    const hci_bounds *bounds;
    hci_minimise minimise;
    double scale_A, scale_Nm; /* sizes of current and torque, for unknowns near 1 */

    hci_limit_grid grid[HCI_MOST_GRIDS];
    size_t grids;
    hci_limit_points points; /* rows beside those of the grids */

    const double *centre; /* coordinates from which x is at most radius_A away, √Σ of squares; 0: no bound */
    double radius_A;
    double
        idle_Nm; /* RIPPLE within that distance: orders that cannot exceed it there are left out; 0: none */

    double precision;     /* of the solver, relative; 0: as precise as it gets */
    double widened;       /* share by which every limit is wider than asked for */
    double mean_Nm;       /* RIPPLE and COPPER: nearest mean torque */
    bool has_mean;        /* it is the wanted one */
    double ripple_Nm;     /* COPPER: smallest ripple */
    const hci_task *task; /* what a square of current counts */
    double slack;         /* share of the ripple by which the copper may make it worse */
    bool has_ripple;      /* none is left: all orders are as wanted */
} hci_limit_program;

/* What a stage gives. gain and rows: see hci_limit; by the kind, and of the phase where phases differ. */
typedef struct {
    double *x;                    /* S and C of each component, A */
    double smallest;              /* of what the stage minimises: share, N·m, N·m, A² */
    double highest_Nm, lowest_Nm; /* of a peak-to-peak: torque less what is wanted */
    double current_gain[3], rms_gain[3], voltage_gain, copper_gain;
    double pull; /* what it would gain from a distance from the centre that is wider by the whole current */
    bool is_infeasible;
    bool is_settled; /* it keeps the limits at every angle */
} hci_limit_optimum;

/* Where Newton's method of a stage came to rest. Start with {0}. */
typedef struct {
    double *x; /* n unknowns, then the multipliers of `rest` rows of no angle and of `peaks` peaks */
    hci_limit_point *at; /* peaks */
    size_t n, rest, peaks;
} hci_limit_rest;

/* A share of a limit that is kept free, so that peaks found to the same share beyond are within it. */
#define HCI_LIMIT_MARGIN 1e-9

/* What `slack` is, unless that leaves no room; that of the mean always. */
#define HCI_LIMIT_SLACK 5e-7

#endif
