/* At which orders of the turn something is missing.
 *
 * In: the residual r of all runs with its variance σ². Out, for each order n: by how much χ² would fall if a
 * torque S sin nθ + C cos nθ were added,
 *
 *     Δχ²(n) = 2 ((Σ w r cos nθ)² + (Σ w r sin nθ)²) / Σ w,     w = 1/σ²
 *
 * which for noise alone is χ² with two degrees of freedom; the same for a torque in proportion to i_q. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATE_ORDERS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATE_ORDERS_H

#include "host/diagnose/candidates/candidates.h"

/* For each order, in multiples of `stride` periods in a mechanical turn, how much χ² a torque of that order,
 * alone or in proportion to i_q, and in phase in all runs, would explain. Start with {0}. */
typedef struct {
    size_t stride, slots; /* slots: of the machine; 0: not known */
    size_t count;         /* orders 0 … count − 1 */
    double resolved; /* highest electrical order that the samples tell; INFINITY: no run covers an angle */
    double *still, *with_current;
    double *of_run; /* [run][2][count]: weighted sums with cos and with sin */
    double *weight; /* of each run */
} hci_candidate_orders;

/* What stands out: once in 400 by chance, of a χ² with two degrees of freedom. */
#define HCI_STANDS_OUT 12.0

/* False when memory is out, and then there is nothing to release. O(samples·orders). */
bool hci_candidate_orders_make(const hci_candidates_source *source, size_t stride,
                               hci_candidate_orders *lines);
void hci_candidate_orders_release(hci_candidate_orders *lines);

typedef enum {
    HCI_ORDERS_OF_SLOTS, /* of slots and poles, which stand there without a current */
    HCI_ORDERS_OF_TURN,  /* that repeat with the mechanical turn only */
    HCI_ORDERS_OF_LOAD   /* of slots and poles, fractional ones that grow with the current */
} hci_order_kind;

/* The strongest order of its kind that stands out but is weaker than *under, in periods in a turn; 0: none.
 * under: in/out. */
size_t hci_candidate_orders_next(const hci_candidate_orders *lines, size_t pole_pairs, hci_order_kind kind,
                                 double *under);

/* Whether orders 3, 9, 15 … stand out that grow with the current: they take even harmonics of the back-EMF,
 * which poles that are alike do not make. */
bool hci_candidate_orders_poles_differ(const hci_candidate_orders *lines, size_t pole_pairs);

/* The order and growth in which no known effect grows, at an order that is not in taken[count], that would
 * explain most. Returns the order, as a multiple of the stride; 0: none does. growth: out. */
size_t hci_candidate_orders_empirical(const hci_candidate_orders *lines, const hci_binned_samples *samples,
                                      const size_t *taken, size_t count, size_t *growth);

#endif
