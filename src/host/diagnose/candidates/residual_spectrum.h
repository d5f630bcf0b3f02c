/* Orders that stand out of the residual of several runs. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_RESIDUAL_SPECTRUM_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_RESIDUAL_SPECTRUM_H

#include "host/diagnose/candidates/candidates.h"

/* For each order, in multiples of `stride` periods in a mechanical turn, how much χ² a torque of that order,
 * alone or in proportion to i_q, and in phase in all runs, would explain. Start with {0}. */
typedef struct {
    size_t stride;
    size_t count; /* orders 0 … count − 1 */
    double *still, *with_current;
    double *of_run; /* [run][count][2]: weighted sums with cos and sin */
    double *weight; /* of each run */
} hci_line_spectrum;

/* What stands out: once in 400 by chance, of a χ² with two degrees of freedom. */
#define HCI_STANDS_OUT 12.0

/* False when memory is out, and then there is nothing to release. O(cells·orders). */
bool hci_line_spectrum_make(const hci_suspects_source *source, size_t stride, hci_line_spectrum *lines);
void hci_line_spectrum_release(hci_line_spectrum *lines);

/* The strongest order of its kind that stands out but is weaker than *under, in periods in a turn; 0: none.
 * slots: those of slots and poles, else those that repeat with the turn only. under: in/out. */
size_t hci_line_spectrum_next(const hci_line_spectrum *lines, size_t pole_pairs, bool slots, double *under);

/* The order and growth in which no known effect grows, at an order that is not in taken[count], that would
 * explain most. Returns the order, as a multiple of the stride; 0: none does. growth: out. */
size_t hci_line_spectrum_unknown(const hci_line_spectrum *lines, const hci_cells *cells, const size_t *taken,
                                 size_t count, size_t *growth);

#endif
