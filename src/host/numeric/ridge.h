/* What rows y = X x + noise and an expectation say of the unknowns x, and how far that is to be trusted.
 *
 *     A = Σ XᵀX + diag(precision)      mean = A⁻¹ (Σ Xᵀy + precision·centre)      covariance = s² A⁻¹
 *
 * s, the size of the noise and of the expectations in the units that the rows were weighted to, comes from
 * groups of rows that are left out in turn: with K = Fᵀ A⁻¹ F and u = g − Fᵀ mean of a group (condensed.h)
 *
 *     e = (I − K)⁻¹ u            what the mean from all other groups leaves in it
 *     cov e = s² (I − K)⁻¹       what was to be expected
 *     s² ≈ uᵀ K (I − K)⁻¹ u / tr K
 *
 * each direction weighted by what the group tells of the unknowns in it, so that noise between them has no
 * say. */
#ifndef HCI_SRC_HOST_NUMERIC_RIDGE_H
#define HCI_SRC_HOST_NUMERIC_RIDGE_H

#include "host/numeric/condensed.h"
#include "host/numeric/draws.h"

/* Expected of each unknown. */
typedef struct {
    const double *precision; /* [n]: one over the variance; 0: nothing is expected */
    const double *centre;    /* [n] */
} hci_expectation;

/* Start with {0}. */
typedef struct {
    size_t n;
    double *factor; /* [n][n], column-major: L of A = D⁻¹ L Lᵀ D⁻¹ */
    double *scale;  /* [n]: D */
    double *mean;   /* [n] */
} hci_ridge;

/* False when memory is out or A is singular to working precision, and then *ridge is empty. An unknown of
 * which neither rows nor expectation say anything is taken for 0 without an error. O(n³/3). */
bool hci_ridge_make(const hci_condensed *rows, const hci_expectation *expected, hci_ridge *ridge);
void hci_ridge_release(hci_ridge *ridge);

/* What leaving each group out tells. */
typedef struct {
    double square;     /* Σ (y − X x)² with the mean from all others; with shares eᵀ(I − K)e + rest */
    double misfit;     /* s² of this group; NAN where it tells of no unknown */
    double directions; /* of how many squares that is the mean, (tr K)²/tr K² */
    double noise;      /* mean square of what no unknown describes; 0 where there is nothing else */
    double spread; /* ln |(I − K)⁻¹|: how uncertain what is expected of the group is, of all directions */
    double surprise; /* eᵀ(I − K)e, which is s² for each direction where that is right */
} hci_left_out_group;

/* K of each group, row by row: what share of all that is known each direction of it tells.
 * share[rows->count]: out, each of [rank²], to be freed with hci_memory_free; on failure, when memory is out
 * or rows->watch stops, all are NULL. O(n² Σ rank). */
bool hci_ridge_shares(const hci_ridge *ridge, const hci_condensed *rows, double **share);

/* share: of a ridge, or NULL: what a group alone tells by it has no say in `square`, since no mean from
 * others describes it but by chance. out[rows->count]. False when memory is out or rows->watch stops.
 * O(n² Σ rank). */
bool hci_ridge_leave_out(const hci_ridge *ridge, const hci_condensed *rows, double *const *share,
                         hci_left_out_group *out);

/* By how much groups differ in the size of their errors, beyond what chance makes of few numbers.
 *
 * In: s² of each group, the mean of ν squares. Out: s² of each as it is to be expected of the group, and how
 * well their mean is known. Of the mean s̄² a share f is noise, as large as what no unknown describes, and its
 * squares are independent of each other: by chance s² scatters with the variance 2 f² s̄⁴/ν. What it scatters
 * more, τ², is a difference of the groups (DerSimonian and Laird 1986). The rest of s̄² is what the unknowns
 * cannot describe; that is the same law in all directions of a group, which counts as one value of it
 * (Satterthwaite 1946):
 *
 *     s̃² = s̄² + (s² − s̄²) τ²/(τ² + 2 f² s̄⁴/ν)
 *     freedom of the mean = 2 s̄⁴ n/(max(τ², 2 (1 − f)² s̄⁴) + mean of 2 f² s̄⁴/ν)
 *
 * size[count]: out, s̃ of each; NAN where the group tells nothing. Returns the freedom, at least 1; 0 where no
 * group shows an error. */
double hci_group_sizes(const hci_left_out_group *left, size_t count, double *size);

/* x[n]: one draw of mean + s A^(−1/2) z. O(n²). */
void hci_ridge_draw(const hci_ridge *ridge, double s, hci_draws *draws, double *x);

#endif
