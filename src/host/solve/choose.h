/* The steps of choosing components: candidates, subsets, level errors. choose.c puts them together. */
#ifndef HCI_SRC_HOST_SOLVE_CHOOSE_H
#define HCI_SRC_HOST_SOLVE_CHOOSE_H

#include "host/solve/harmonic_system.h"

/* What a solution is worth: its largest weighted error and its mean square current. */
typedef struct {
    double worst_Nm, mean_square_A2;
} hci_set_cost;

typedef struct {
    double tolerance_Nm, allowed_A2;
} hci_set_preference;

/* Within the allowed copper first (less copper where neither is); then, when both are exact, less copper;
 * else the smaller worst order. */
bool hci_set_cost_less(const hci_set_preference *p, hci_set_cost a, hci_set_cost b);

/* ---- candidates.c */

/* The highest order that is wanted or disturbed, and the highest of the back-EMF. */
void hci_candidates_span(const hci_task *task, double *torque_order, double *emf_order);

/* Every component up to `top_order` that is connected with an order that is wanted or disturbed. */
hci_status hci_candidates(const hci_task *task, double top_order, hci_component_set *set, hci_note *note);

/* ---- choose.c: measures of a solution x (unknowns × 2: per N·m of mean torque, and the rest) */

/* (3/2) Σ I² over components that are all different. */
double hci_coordinates_mean_square_A2(const hci_component_set *set, const double *x, double mean_Nm);

/* Amplitude of the residual r at compared order k, and the largest of all. r: workspace of rows, out the
 * residual. */
double hci_residual_amplitude_Nm(const hci_harmonic_system *b, const double *r, size_t k);
double hci_worst_error_Nm(const hci_harmonic_system *b, const double *x, double mean_Nm, double *r);

/* ---- subset.c */

/* Least squares over subsets of candidates. Dense and column-major, n = 2 × candidates. */
typedef struct {
    size_t n;
    double *gram, *b; /* UᵀU (n×n) and Uᵀh (n) */
    double ridge;     /* ρ: the price of copper */
} hci_subset_cost;

/* Room for a search; the subset itself is active[0 … count) and in[]. */
typedef struct {
    double *p, *work, *x, *v; /* n×n, n×n, n, 2n */
    size_t *active;           /* n */
    bool *in;                 /* n */
} hci_subset_workspace;

/* From all candidates down to `most`, each time leaving out the component that costs least. HCI_ERROR_NUMERIC
 * when ρ is too small for the normal equations. */
hci_status hci_subset_eliminate(const hci_subset_cost *c, size_t most, hci_subset_workspace *room);

/* Exchanges a member for a candidate, the best pair each time, as long as that lowers f; at most 20 per
 * member. */
hci_status hci_subset_exchange(const hci_subset_cost *c, hci_subset_workspace *room, size_t count);

/* ---- level.c */

/* Makes the row of the mean torque ten times as heavy, so that a small set does not trade it for less
 * ripple. */
void hci_minimax_weight_mean(hci_harmonic_system *b);

/* Doubles of `room` that hci_minimax_solve needs. */
size_t hci_minimax_workspace(const hci_harmonic_system *b);

/* The best x (out, unknowns × 2) met while errors are levelled at one price of copper. */
hci_status hci_minimax_solve(const hci_harmonic_system *b, const hci_component_set *set, double mean_Nm,
                             double ridge, const hci_set_preference *preference, double *room, double *best_x,
                             hci_set_cost *best);

#endif
