/* The best subset of candidates by least squares: f(S) = ‖U_S x − h‖² + ρ‖x‖². */
#ifndef HCI_SRC_HOST_SOLVE_SUBSET_H
#define HCI_SRC_HOST_SOLVE_SUBSET_H

#include "host/solve/harmonic_system.h"

/* The cost of all subsets, and the one that is looked at. Matrices are dense and column-major; n = 2 ×
 * candidates. */
typedef struct {
    size_t n;
    double *gram, *b; /* G = UᵀU (n×n) and b = Uᵀh (n), h at the wanted mean torque */
    double scale;     /* largest diagonal of G */
    double ridge;     /* ρ: the price of copper; the caller's to set */

    size_t count;   /* members of the subset */
    size_t *member; /* which candidates they are; n */
    bool *is_in;    /* whether a candidate is a member; n */

    double *p, *work, *x, *v; /* n×n, n×n, n, 2n: workspace */
} hci_subset_search;

/* Fills G, b and scale. The search is to be released in any case. HCI_ERROR_MEMORY. O(n · nonzeros). */
hci_status hci_subset_search_make(const hci_harmonic_system *system, double mean_Nm,
                                  hci_subset_search *search, hci_note *note);
void hci_subset_search_release(hci_subset_search *search);

/* From all candidates down to `most` (at most as many as there are), each time leaving out the one that costs
 * least. HCI_ERROR_NUMERIC when ρ is too small for the normal equations. O(n³). */
hci_status hci_subset_eliminate(hci_subset_search *search, size_t most);

/* Exchanges a member for a candidate, the best pair each time, as long as that lowers f; at most 20 per
 * member. HCI_ERROR_NUMERIC as above. O(candidates · count²) an exchange. */
hci_status hci_subset_exchange(hci_subset_search *search);

#endif
