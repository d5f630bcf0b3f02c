/* A conic program without its equations, and where its solution stands: what the parts of solve.c share. */
#ifndef HCI_SRC_HOST_CONIC_STATE_H
#define HCI_SRC_HOST_CONIC_STATE_H

#include <stdbool.h>

#include "host/conic/problem.h"
#include "host/conic/scaling.h"
#include "host/numeric/null_space.h"

/* A two-sided row stands once in G, and twice in s and z: its lower side comes after all rows. */
typedef struct {
    const hci_cone_problem *problem;
    hci_null_space space;
    hci_cone cone;
    hci_cone_scaling scaling;
    size_t n, rows, entries, degree;
    double *p, *c, *g, *h; /* reduced to the null space; h has `entries`, with −low behind; p may be NULL */
    double *x, *s, *z, *rx, *rs;
    double *dx, *ds, *dz, *affine_s, *affine_z, *right, *weighed, *product, *gradient;
    double *normal, *factor, *scaled, *few; /* n×n, n×n, rows×n, 4·n */
    double **ball; /* of each cone whose head does not depend on x GᵀG of its rows, n×n; NULL of others and of
                    * small ones */
    double *best_x, *best_z, best;
    size_t idle;
    double *block;
} hci_cone_state;

/* Eliminates the equations and takes all memory. HCI_ERROR_MEMORY, without a note. To be released in any
 * case. */
hci_status hci_cone_state_make(const hci_cone_problem *problem, hci_cone_state *solver);
void hci_cone_state_release(hci_cone_state *solver);

/* y = G x, entries long; y += Gᵀ u, u entries; y = P x. */
void hci_cone_multiply(const hci_cone_state *solver, const double *x, double *y);
void hci_cone_multiply_transposed(const hci_cone_state *solver, const double *u, double *y);
void hci_cone_multiply_p(const hci_cone_state *solver, const double *x, double *y);

#endif
