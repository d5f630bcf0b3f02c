/* Condition and backward error of the solution of a square system, and its refinement. */
#include <float.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"

double hci_norm_1(size_t m, size_t n, const double *a)
{
    double largest = 0.0;
    for (size_t j = 0; j < n; j++) {
        const double sum = hci_vector_norm_1(m, a + j * m);
        if (sum > largest || isnan(sum)) largest = sum; /* NaN stays */
    }
    return largest;
}

/* x ← A⁻¹ x; returns its 1-norm, infinite where the solve overflows. */
static double inverse_norm(size_t n, const double *lu, const size_t *pivot, double *x)
{
    hci_lu_solve(n, lu, pivot, x);
    const double norm = hci_vector_norm_1(n, x);
    return isfinite(norm) ? norm : HUGE_VAL;
}

/* Higham's vector of alternating signs, against matrices built to deceive the search:
 * x_i = (−1)^i (1 + i/(n − 1)) with ‖x‖₁ = 3n/2. */
static double alternating_estimate(size_t n, const double *lu, const size_t *pivot, double *x)
{
    for (size_t i = 0; i < n; i++) {
        const double magnitude = 1.0 + (double)i / (double)(n - 1);
        x[i] = i % 2 == 0 ? magnitude : -magnitude;
    }
    return inverse_norm(n, lu, pivot, x) / (1.5 * (double)n);
}

/* x ← A⁻ᵀ sign(x): the subgradient of ‖A⁻¹x‖₁. False when the signs are those of the step before, in `sign`.
 */
static bool subgradient(size_t n, const double *lu, const size_t *pivot, double *x, double *sign)
{
    bool changed = false;
    for (size_t i = 0; i < n; i++) {
        const double s = x[i] < 0.0 ? -1.0 : 1.0;
        if (s != sign[i]) changed = true;
        sign[i] = x[i] = s;
    }
    if (changed) hci_lu_solve_transposed(n, lu, pivot, x);
    return changed;
}

static void unit_vector(size_t n, size_t k, double *x)
{
    for (size_t i = 0; i < n; i++)
        x[i] = 0.0;
    x[k] = 1.0;
}

/* Hager 1984, Higham 1988: ‖A⁻¹x‖₁ is convex, so over the unit ball it is largest at some e_k. Climb from e/n
 * along subgradients z: from the present vertex to e_k with |z_k| largest, until nothing rises. */
double hci_lu_condition(size_t n, const double *lu, const size_t *pivot, double norm_1, double *work)
{
    enum { STEPS_MAX = 5 };
    double *x = work, *sign = work + n;
    if (n == 0) return 1.0;
    for (size_t i = 0; i < n; i++) {
        x[i] = 1.0 / (double)n;
        sign[i] = 0.0;
    }
    double estimate = inverse_norm(n, lu, pivot, x);
    if (n == 1) return norm_1 * estimate;

    size_t vertex = n;
    for (int step = 1; step < STEPS_MAX && estimate < HUGE_VAL; step++) {
        if (!subgradient(n, lu, pivot, x, sign)) break;
        const size_t k = hci_vector_largest(n, x);
        if (vertex < n && fabs(x[k]) <= fabs(x[vertex])) break;
        vertex = k;
        unit_vector(n, vertex, x);
        const double next = inverse_norm(n, lu, pivot, x);
        if (next <= estimate) break;
        estimate = next;
    }
    return norm_1 * fmax(estimate, alternating_estimate(n, lu, pivot, x));
}

enum { STRIP = 32 };

/* Rows first … first + rows − 1 of r = b − A y and s = |A||y| + |b|, with y = x + d (d may be NULL). */
static void residual_strip(size_t n, size_t rows, const double *restrict a, const double *restrict b,
                           const double *x, const double *d, double *restrict r, double *restrict s)
{
    for (size_t i = 0; i < rows; i++) {
        r[i] = b[i];
        s[i] = fabs(b[i]);
    }
    for (size_t j = 0; j < n; j++, a += n) {
        const double y = d ? x[j] + d[j] : x[j];
        for (size_t i = 0; i < rows; i++) {
            r[i] -= a[i] * y;
            s[i] += fabs(a[i] * y);
        }
    }
}

/* Componentwise backward error of y = x + d (Oettli and Prager 1964); residual, n entries or NULL: b − A y.
 * The small term keeps a row that underflows from counting as wholly wrong (it is below any s that is a
 * normal sum). */
static double backward_error(size_t n, const double *a, const double *b, const double *x, const double *d,
                             double *residual)
{
    const double smallest = (double)(n + 1) * DBL_MIN;
    double r[STRIP], s[STRIP], worst = 0.0;
    for (size_t i = 0; i < n; i += STRIP) {
        const size_t rows = n - i < STRIP ? n - i : STRIP;
        residual_strip(n, rows, a + i, b + i, x, d, r, s);
        for (size_t k = 0; k < rows; k++) {
            const double error = fabs(r[k]) / (s[k] + smallest);
            if (error > worst || isnan(error)) worst = error;
            if (residual) residual[i + k] = r[k];
        }
    }
    return worst;
}

/* x ← x + A⁻¹(b − A x) as long as it pays. A step is tried before it is taken, so that x never becomes worse.
 */
double hci_lu_refine(size_t n, const double *a, const double *lu, const size_t *pivot, const double *b,
                     double *x, double *work)
{
    enum { STEPS_MAX = 5 };
    double error = backward_error(n, a, b, x, NULL, work);
    for (int step = 0; step < STEPS_MAX && error > 0.5 * DBL_EPSILON; step++) {
        hci_lu_solve(n, lu, pivot, work);
        const double next = backward_error(n, a, b, x, work, NULL);
        if (!(next < error)) break;
        hci_vector_add(n, 1.0, work, x);
        error = next;
        (void)backward_error(n, a, b, x, NULL, work);
    }
    return error;
}
