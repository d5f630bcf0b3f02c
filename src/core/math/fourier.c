#include "hci/math/fourier.h"

#include <float.h>
#include <math.h>

#include "core/math/householder.h"

/* Coefficients at bin q: (2/N) Σ x_j sin, cos(2π (q j mod N)/N). Reducing the product in whole numbers keeps
 * the angle exact to its last digit for any length of record. */
static hci_harmonic correlate(const double *samples, size_t count, size_t bin)
{
    const double step_rad = 2.0 * HCI_PI / (double)count;
    hci_harmonic sum = {0.0, 0.0, 0.0};
    size_t index = 0;
    for (size_t j = 0; j < count; j++) {
        const double angle_rad = step_rad * (double)index;
        sum.sine += samples[j] * sin(angle_rad);
        sum.cosine += samples[j] * cos(angle_rad);
        index += bin;
        if (index >= count) index -= count;
    }
    const double weight = (bin == 0 ? 1.0 : 2.0) / (double)count;
    sum.sine *= weight;
    sum.cosine *= weight;
    return sum;
}

hci_status hci_fourier_uniform(const double *samples, size_t count, size_t turns, double order,
                               hci_harmonic *out)
{
    const double bin = round(order * (double)turns);
    const bool whole = turns > 0 && fabs(order - bin / (double)turns) <= HCI_ORDER_TOLERANCE;
    if (!whole || bin < 0.0 || !(bin < 0.5 * (double)count)) return HCI_ERROR_ARGUMENT;

    hci_harmonic result = correlate(samples, count, (size_t)bin);
    if (!isfinite(result.sine) || !isfinite(result.cosine)) return HCI_ERROR_NOT_FINITE;
    result.order = order;
    *out = result;
    return HCI_OK;
}

/* The fit by blocks: a triangle R with Qᵀx beside it holds all that is known of the samples so far. Each
 * block of BLOCK_ROWS further samples is reflected into it,
 *
 *     H [R c]  =  [R' c']        B: rows (sin n_1θ, cos n_1θ, …), one per sample; y: the samples
 *       [B y]     [0  ~ ]
 *
 * and R z = c is left to solve. No normal equations: the condition of B enters once, not squared. */
enum { BLOCK_ROWS = 32 };

typedef struct {
    size_t columns;   /* unknowns; column number `columns` is the right-hand side */
    double *triangle; /* columns × (columns + 1) */
    double *block;    /* BLOCK_ROWS × (columns + 1) */
} accumulator;

static bool is_mean(double order)
{
    return order <= HCI_ORDER_TOLERANCE;
}

static bool valid_orders(const double *orders, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        if (!(orders[k] >= 0.0) || !isfinite(orders[k])) return false;
        if (k > 0 && !(orders[k] - orders[k - 1] > HCI_ORDER_TOLERANCE)) return false;
    }
    return true;
}

/* order_count: one or more. */
static accumulator start(const double *orders, size_t order_count, double *work)
{
    const size_t columns = 2 * order_count - (is_mean(orders[0]) ? 1 : 0);
    const accumulator fit = {columns, work, work + columns * (columns + 1)};
    for (size_t i = 0; i < columns * (columns + 1); i++)
        work[i] = 0.0;
    return fit;
}

size_t hci_fourier_fit_workspace(size_t order_count)
{
    const size_t columns = 2 * order_count;
    return (columns + BLOCK_ROWS) * (columns + 1);
}

/* Fills the block with `rows` samples, and with zeros below them. */
static void fill_block(accumulator fit, const double *theta_rad, const double *samples, size_t rows,
                       const double *orders, size_t order_count)
{
    for (size_t i = 0; i < BLOCK_ROWS * (fit.columns + 1); i++)
        fit.block[i] = 0.0;
    double *column = fit.block;
    for (size_t k = 0; k < order_count; k++) {
        const bool mean = is_mean(orders[k]);
        for (size_t i = 0; i < rows && !mean; i++)
            column[i] = sin(orders[k] * theta_rad[i]);
        if (!mean) column += BLOCK_ROWS;
        for (size_t i = 0; i < rows; i++)
            column[i] = mean ? 1.0 : cos(orders[k] * theta_rad[i]);
        column += BLOCK_ROWS;
    }
    for (size_t i = 0; i < rows; i++)
        column[i] = samples[i];
}

static void reflect_block_into_triangle(accumulator fit)
{
    const size_t n = fit.columns;
    for (size_t k = 0; k < n; k++) {
        const double *v = fit.block + k * BLOCK_ROWS;
        const double tau = hci_householder(fit.triangle + k + k * n, BLOCK_ROWS, fit.block + k * BLOCK_ROWS);
        for (size_t j = k + 1; j <= n; j++)
            hci_householder_apply(tau, BLOCK_ROWS, v, fit.triangle + k + j * n, fit.block + j * BLOCK_ROWS);
    }
}

/* |R_kk| is the distance of column k from the span of those before it; the columns have norms up to √count.
 */
static bool dependent(accumulator fit, size_t count, double tolerance)
{
    for (size_t k = 0; k < fit.columns; k++)
        if (!(fabs(fit.triangle[k * (fit.columns + 1)]) > tolerance * sqrt((double)count))) return true;
    return false;
}

/* z = R⁻¹ c in place of c. */
static double *solve_triangle(accumulator fit)
{
    const size_t n = fit.columns;
    double *z = fit.triangle + n * n;
    for (size_t k = n; k-- > 0;) {
        z[k] /= fit.triangle[k + k * n];
        hci_vector_add(k, -z[k], fit.triangle + k * n, z);
    }
    return z;
}

/* Below 1e-10 two orders are one as far as any measurement goes; and the angle n θ itself is known to a few ε
 * n θ. */
static double dependence_tolerance(const double *theta_rad, size_t count, double highest_order)
{
    const double reach_rad = count > 0 ? fabs(theta_rad[hci_vector_largest(count, theta_rad)]) : 0.0;
    return 1e-10 + 4.0 * DBL_EPSILON * highest_order * reach_rad;
}

hci_status hci_fourier_fit(const double *theta_rad, const double *samples, size_t count, const double *orders,
                           size_t order_count, hci_harmonic *out, double *work)
{
    if (!valid_orders(orders, order_count)) return HCI_ERROR_ARGUMENT;
    if (!hci_vector_finite(count, theta_rad) || !hci_vector_finite(count, samples))
        return HCI_ERROR_NOT_FINITE;
    if (order_count == 0) return HCI_OK;

    const accumulator fit = start(orders, order_count, work);
    for (size_t i = 0; i < count; i += BLOCK_ROWS) {
        fill_block(fit, theta_rad + i, samples + i, count - i < BLOCK_ROWS ? count - i : BLOCK_ROWS, orders,
                   order_count);
        reflect_block_into_triangle(fit);
    }
    if (dependent(fit, count, dependence_tolerance(theta_rad, count, orders[order_count - 1])))
        return HCI_ERROR_SINGULAR;

    const double *z = solve_triangle(fit);
    for (size_t k = 0; k < order_count; k++) {
        out[k].order = orders[k];
        out[k].sine = is_mean(orders[k]) ? 0.0 : *z++;
        out[k].cosine = *z++;
    }
    return HCI_OK;
}
