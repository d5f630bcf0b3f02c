/* What a set of components costs: the error that it leaves and its copper loss. */
#ifndef HCI_SRC_HOST_SOLVE_SET_COST_H
#define HCI_SRC_HOST_SOLVE_SET_COST_H

#include "host/solve/answer.h"
#include "host/solve/harmonic_system.h"

typedef struct {
    double worst_Nm;       /* largest weighted error of a compared order, peak */
    double mean_square_A2; /* mean of i_a² + i_b² + i_c² */
} hci_set_cost;

/* What is exact enough, and the copper that is allowed. */
typedef struct {
    double tolerance_Nm, allowed_A2;
} hci_set_preference;

/* Whether a is better than b: within the allowed copper first (less copper where neither is); then, when both
 * are exact, less copper; else the smaller worst order. */
bool hci_set_cost_less(const hci_set_preference *preference, hci_set_cost a, hci_set_cost b);

/* Of the coordinates x (unknowns × 2) of a set at a mean torque. r: workspace of system->rows, out the
 * weighted residual U x − h. */
hci_set_cost hci_set_cost_of(const hci_harmonic_system *system, const hci_component_set *set, const double *x,
                             double mean_Nm, double *r);

/* Amplitude of the residual r at compared order k. */
double hci_residual_amplitude_Nm(const hci_harmonic_system *system, const double *r, size_t k);

/* The largest of them for x. r: workspace of rows, out the residual. */
double hci_worst_residual_Nm(const hci_harmonic_system *system, const double *x, double mean_Nm, double *r);

/* A set with its currents and their cost; answer.x is NULL where there is none yet. Start with {0}. */
typedef struct {
    hci_answer answer;
    hci_set_cost cost;
} hci_choice;

/* Solves the system of the choice's set for the least norm, into answer.x (room of unknowns × 2), and takes
 * the cost. HCI_ERROR_MEMORY, _NUMERIC. */
hci_status hci_choice_solve(const hci_harmonic_system *system, double mean_Nm, hci_choice *choice,
                            hci_note *note);
void hci_choice_release(hci_choice *choice);

#endif
