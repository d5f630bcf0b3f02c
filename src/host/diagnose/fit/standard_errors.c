#include "host/diagnose/fit/standard_errors.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/linearise.h"

#define REGULAR                                                                                              \
    1e-10 /* share of a diagonal that is added to it, so that rounding makes no pivot negative               \
           */

enum { LEAST_BLOCKS = 5 }; /* for each parameter */

/* uᵀ M u of the scatter M. */
static double scatter_along(const double *square, const double *u, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j)
            sum += u[i] * square[i * n + j] * u[j];
    return sum;
}

/* variance[n]: the diagonal of G⁻¹ M G⁻¹. work: n² + n. False where G is singular. */
static bool sandwich(const hci_normal_equations *normal, const hci_scatter *scatter, double *work,
                     double *variance)
{
    const size_t n = normal->n;
    double *unit = work + n * n;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i)
            work[i + j * n] = normal->gram[i + j * n] * (i == j ? 1.0 + REGULAR : 1.0);
    if (hci_cholesky_factor(n, work)) return false;
    for (size_t k = 0; k < n; ++k) {
        memset(unit, 0, n * sizeof *unit);
        unit[k] = 1.0;
        hci_cholesky_solve(n, work, unit);
        variance[k] = scatter_along(scatter->square, unit, n);
    }
    return true;
}

/* Raises the standard errors of the terms that are in, which are in the order of the columns. */
static void errors_raise(hci_candidates *candidates, const double *variance)
{
    size_t column = 0;
    for (size_t k = 0; k < candidates->count; ++k) {
        hci_candidate *x = &candidates->candidate[k];
        for (size_t j = 0; x->in && j < x->count; ++j, ++column)
            x->term[j].std_error = fmax(x->term[j].std_error, sqrt(fmax(0.0, variance[column])));
    }
}

hci_status hci_regression_standard_errors(const hci_regression *regression, hci_candidates *candidates,
                                          hci_note *note)
{
    const size_t n = hci_candidates_terms_in(candidates);
    hci_normal_equations normal = {0};
    hci_scatter scatter = {NULL, 0};
    double *work = hci_memory_new(n * n + 2 * n + 1, sizeof *work);
    if (!work) return hci_note_memory(note, NULL, "standard errors");
    const hci_status status = hci_regression_scatter(regression, candidates, &normal, &scatter, note);
    if (!status && n > 0 && scatter.blocks > LEAST_BLOCKS * n &&
        sandwich(&normal, &scatter, work, work + n * n + n))
        errors_raise(candidates, work + n * n + n);
    hci_memory_free(work);
    hci_memory_free(scatter.square);
    hci_normal_equations_release(&normal);
    return status;
}
