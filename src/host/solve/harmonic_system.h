/* The harmonic system U x = h of one task and one list of components (theory.md, section 4). */
#ifndef HCI_SRC_HOST_SOLVE_HARMONIC_SYSTEM_H
#define HCI_SRC_HOST_SOLVE_HARMONIC_SYSTEM_H

#include "host/numeric/sparse.h"
#include "host/solve/task.h"

/* U, h and what their rows mean: S and C of each compared order in turn, order 0 with C alone. h has two
 * columns: what 1 N·m of mean torque adds, and the rest (wanted ripple less cogging less the torque of what
 * is held), so that h = mean torque × first + second. Rows of U and h carry the weights of their orders;
 * orders of weight 0 are left out. */
typedef struct {
    double *order; /* compared orders, ascending */
    size_t order_count, rows, unknowns;
    double *row_weight; /* rows */
    double *h;          /* rows × 2 */
    hci_sparse u;       /* rows × unknowns; owned */
    double *size;       /* unknowns: root of what a square of the current counts; NULL: 1 */
} hci_harmonic_system;

/* component: `count` of them, two unknowns each. *system is to be released on success, else empty.
 * HCI_ERROR_MEMORY. O(nonzeros · log orders). */
hci_status hci_harmonic_system_make(const hci_task *task, const hci_component *component, size_t count,
                                    hci_compare compare, hci_harmonic_system *system, hci_note *note);

/* The least-squares solution of least size of both right-hand sides, into x (unknowns × 2). *found: out.
 * HCI_ERROR_NUMERIC, _MEMORY. */
hci_status hci_harmonic_system_solve(const hci_harmonic_system *system, double *x, hci_sparse_rank *found,
                                     hci_note *note);
void hci_harmonic_system_release(hci_harmonic_system *system);

/* Mean of i_a² + i_b² + i_c² that 1 A² of a component's S (part 0) or C (part 1) makes, over 3/2: 1; of a
 * direct current of zero sequence 2 for C, and 0 for S, which flows in no phase. */
double hci_component_copper(hci_component component, int part);

/* Root of what a square of a component's current counts beside its copper. */
double hci_task_size_of(const hci_task *task, hci_component component);

#endif
