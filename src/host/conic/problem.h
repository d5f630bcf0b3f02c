/* A convex program over linear inequalities and second-order cones, of a few hundred unknowns (theory.md,
 * section 15). */
#ifndef HCI_SRC_HOST_CONIC_PROBLEM_H
#define HCI_SRC_HOST_CONIC_PROBLEM_H

#include <stddef.h>

/* Minimise ½ xᵀP x + c·x under A x = b and, row by row of G,
 *
 *     low <= g·x <= h                       the first `two_sided` rows
 *     g·x <= h                              up to row `linear`
 *     h − G x in a second-order cone        the rest, blocks of cone[0], cone[1], … rows, u_0 >= |u_1 …|
 *
 * Matrices are dense and column-major. Rows of G should be scaled to be of like size. */
typedef struct {
    size_t unknowns;
    const double *p; /* unknowns × unknowns, symmetric, positive semidefinite; NULL: 0 */
    const double *c; /* unknowns */
    size_t equalities;
    const double *a, *b; /* equalities × unknowns; rows may depend on one another */
    size_t rows, two_sided, linear;
    const double *g, *h, *low; /* rows × unknowns, rows, two_sided */
    size_t cones;
    const size_t *cone; /* rows of each second-order cone, at least 2 */
    double precision;   /* relative residuals and gap at which it may end; 0: as precise as it gets */
} hci_cone_problem;

typedef enum {
    HCI_CONE_SOLVED,
    HCI_CONE_INFEASIBLE, /* z is the proof: G'z + A'y = 0, h·z + b·y < 0 */
    HCI_CONE_UNBOUNDED,
    HCI_CONE_STALLED /* the nearest point that was met; see error */
} hci_cone_end;

/* Start with {0}. */
typedef struct {
    hci_cone_end end;
    double *x;    /* unknowns */
    double *z;    /* multipliers of the rows of G; of a two-sided row that of h less that of low. The
                   * objective falls by z_k for each 1 that h_k grows, as long as z stays */
    double error; /* largest of residuals and gap, relative; HUGE_VAL where it was proved that there is no
                     answer */
    size_t steps;
} hci_cone_answer;

#endif
