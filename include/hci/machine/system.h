/* The linear system U x = h between current components and torque harmonics, in closed form.
 *
 * A component (n, σ) with coordinates (S, C) = (I cos γ, I sin γ) and a back-EMF wave (μ, ρ, E, φ) give the
 * torque
 *
 *     + (3/2) I E cos((n − μ)θ + γ − φ)     if ρ =  σ
 *     − (3/2) I E cos((n + μ)θ + γ + φ)     if ρ = −σ
 *
 * both for ρ = σ = 0, neither otherwise. A negative order folds: cos(−mθ + ψ) = cos(mθ − ψ).
 *
 * Columns of U: (S, C) of each component in turn. Rows: (S_n, C_n) of each compared order in ascending order,
 * and a single row C_0 for order 0. */
#ifndef HCI_MACHINE_SYSTEM_H
#define HCI_MACHINE_SYSTEM_H

#include <stdint.h>

#include "hci/math/harmonic.h"
#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One current component whose coordinates are to be found. */
typedef struct {
    double order; /* n >= 0 */
    int sequence; /* σ */
} hci_component;

/* Sorts `orders` ascending in place and keeps one of each (within HCI_ORDER_TOLERANCE). Returns how many are
 * left. O(n log n), no workspace. */
size_t hci_orders_sort(double *orders, size_t count);

/* Position of `order` in a sorted list, or `count` when it is not there. O(log n). */
size_t hci_orders_find(const double *orders, size_t count, double order);

/* Number of rows of U for these compared orders: two for each, one for order 0. */
size_t hci_orders_rows(const double *orders, size_t count);

/* The first row of order k of these compared orders. */
size_t hci_orders_row(const double *orders, size_t count, size_t k);

/* The torque orders that one component reaches with a back-EMF: at most 2·emf_count entries, unsorted,
 * repeats possible. Returns their number. */
size_t hci_component_orders(const hci_wave *back_emf, size_t emf_count, hci_component component,
                            double *orders);

/* Largest number of entries of U, for allocating `row` and `value`. */
size_t hci_system_capacity(size_t emf_count, size_t component_count);

/* What mutual torque is made with, and at which orders it is compared. The arrays are borrowed. */
typedef struct {
    const hci_wave *back_emf; /* waves of e(θ)/Ω, V·s/rad mechanical */
    size_t back_emf_count;    /* how many */
    const double *order;      /* as hci_orders_sort leaves them */
    size_t order_count;       /* how many */
} hci_mutual_torque;

/* U in compressed columns, rows ascending within a column, equal positions already summed. The pattern
 * depends only on orders and sequences, not on the values of the back-EMF, so it can be analysed once for
 * many machines.
 * column_start: out, 2·component_count + 1 entries; row, value: out, hci_system_capacity entries. Torque at
 * orders that are not compared is left out. O(nonzeros · log orders). */
void hci_system_sparse(const hci_mutual_torque *torque, const hci_component *components,
                       size_t component_count, int64_t *column_start, int64_t *row, double *value);

/* The same U, dense and column-major: hci_orders_rows × 2·component_count doubles, all written. */
void hci_system_dense(const hci_mutual_torque *torque, const hci_component *components,
                      size_t component_count, double *u);

/* Spectrum of the mutual torque of given current waves, added to spectrum[order_count]. */
void hci_system_add_torque(const hci_mutual_torque *torque, const hci_wave *currents, size_t current_count,
                           hci_harmonic *spectrum);

/* Coordinates (S_n, C_n), (C_0 at order 0) of a spectrum as a column. rows: out, hci_orders_rows entries. */
void hci_spectrum_to_rows(const hci_harmonic *spectrum, size_t count, double *rows);

/* The column back to a spectrum. spectrum: out, count entries, whose orders are those given. */
void hci_spectrum_from_rows(const double *orders, size_t count, const double *rows, hci_harmonic *spectrum);

#ifdef __cplusplus
}
#endif

#endif
