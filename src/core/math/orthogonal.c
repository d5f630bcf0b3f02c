/* A P = Q [T 0; 0 0] Zᵀ in two sweeps of Householder reflections:
 *
 *     from the left, with column pivoting       A P = Q [R11 R12; 0 ~0]      R11 r×r
 *     from the right, where r < n               [R11 R12] = [T 0] Zᵀ
 *
 * so that x = P Z [T⁻¹ c; 0] with c the first r entries of Qᵀb. Stored in a: T in the upper triangle, the
 * vectors of Q below it, those of Z to its right (row k for reflection k).
 *
 * The matrix is first scaled by a power of two, exactly, to have its largest element near 1: then no square
 * in here overflows, and one that underflows belongs to a column far below every tolerance. */
#include <float.h>

#include "core/math/householder.h"
#include "hci/math/dense.h"

/* The parts of factor_work. */
typedef struct {
    double *scale;     /* 1: the factors are those of scale·A */
    double *tau_q;     /* min(m, n) */
    double *tau_z;     /* min(m, n) */
    double *norm;      /* n: norm of what is left of each column */
    double *reference; /* n: its value when last computed rather than down-dated */
} layout;

static size_t smaller(size_t m, size_t n)
{
    return m < n ? m : n;
}

size_t hci_orthogonal_workspace(size_t m, size_t n)
{
    return 1 + 2 * smaller(m, n) + 2 * n;
}

static layout lay_out(size_t m, size_t n, double *work)
{
    const size_t k = smaller(m, n);
    const layout w = {work, work + 1, work + 1 + k, work + 1 + 2 * k, work + 1 + 2 * k + n};
    return w;
}

/* Scales a so that its largest element is in [1/2, 1), or as near as 2^±1000 brings it. Returns the scale. */
static double scale_to_unity(size_t count, double *a)
{
    enum { EXPONENT_MAX = 1000 };
    int exponent = 0;
    if (count == 0) return 1.0;
    (void)frexp(a[hci_vector_largest(count, a)], &exponent);
    if (exponent > EXPONENT_MAX) exponent = EXPONENT_MAX;
    if (exponent < -EXPONENT_MAX) exponent = -EXPONENT_MAX;
    const double scale = ldexp(1.0, -exponent);
    for (size_t i = 0; i < count; i++)
        a[i] *= scale;
    return scale;
}

static double norm_2(size_t n, const double *x)
{
    return sqrt(hci_vector_dot(n, x, x));
}

/* ‖(x_2 … x_m)‖ from ‖(x_1 … x_m)‖ and x_1; computed afresh once cancellation since the last time could have
 * cost half the digits (Drmač and Bujanović 2008). tail: x_2 … x_m. */
static void down_date(size_t m, double first, const double *tail, double *norm, double *reference)
{
    if (*norm == 0.0) return;
    const double ratio = first / *norm, left = fmax(0.0, 1.0 - ratio * ratio);
    const double since = *norm / *reference;
    if (left * since * since <= sqrt(DBL_EPSILON)) {
        *norm = *reference = norm_2(m - 1, tail);
    } else {
        *norm *= sqrt(left);
    }
}

static void exchange_columns(size_t m, double *a, size_t j, size_t k, size_t *column, layout w)
{
    const size_t t = column[j];
    column[j] = column[k];
    column[k] = t;
    w.norm[k] = w.norm[j]; /* column j is finished: its own norms are not needed again */
    w.reference[k] = w.reference[j];
    for (size_t i = 0; i < m; i++)
        hci_swap(a + i + j * m, a + i + k * m);
}

/* A P = Q R by columns of largest remaining norm; stops where that is not above the tolerance. Returns the
 * rank. */
static size_t reduce_from_left(size_t m, size_t n, double *a, double tolerance, size_t *column, layout w)
{
    double threshold = 0.0;
    for (size_t j = 0; j < n; j++) {
        column[j] = j;
        w.norm[j] = w.reference[j] = norm_2(m, a + j * m);
        threshold = fmax(threshold, tolerance * w.norm[j]);
    }
    for (size_t k = 0; k < smaller(m, n); k++) {
        const size_t largest = k + hci_vector_largest(n - k, w.norm + k);
        if (!(w.norm[largest] > threshold)) return k;
        exchange_columns(m, a, k, largest, column, w);

        double *head = a + k + k * m;
        w.tau_q[k] = hci_householder(head, m - k - 1, head + 1);
        for (size_t j = k + 1; j < n; j++) {
            double *x = a + k + j * m;
            hci_householder_apply(w.tau_q[k], m - k - 1, head + 1, x, x + 1);
            down_date(m - k, *x, x + 1, w.norm + j, w.reference + j);
        }
    }
    return smaller(m, n);
}

/* [R11 R12] H: rows 0 … k − 1 of column k and of the columns from r on, with v along row k. product: k
 * entries. */
static void apply_from_right(size_t m, size_t n, double *a, size_t k, size_t r, double tau, double *product)
{
    double *head = a + k * m;
    for (size_t i = 0; i < k; i++)
        product[i] = head[i];
    for (size_t j = r; j < n; j++)
        hci_vector_add(k, a[k + j * m], a + j * m, product);
    hci_vector_add(k, -tau, product, head);
    for (size_t j = r; j < n; j++)
        hci_vector_add(k, -tau * a[k + j * m], product, a + j * m);
}

/* [R11 R12] = [T 0] Zᵀ, a row at a time from the last. The norms are done with, and lend their space. */
static void reduce_from_right(size_t m, size_t n, double *a, size_t r, layout w)
{
    double *row = w.norm, *product = w.reference;
    for (size_t k = r; k-- > 0 && r < n;) {
        for (size_t j = r; j < n; j++)
            row[j - r] = a[k + j * m];
        w.tau_z[k] = hci_householder(a + k + k * m, n - r, row);
        for (size_t j = r; j < n; j++)
            a[k + j * m] = row[j - r];
        apply_from_right(m, n, a, k, r, w.tau_z[k], product);
    }
}

hci_status hci_orthogonal_factor(hci_orthogonal *q, double relative_tolerance, double *condition)
{
    const size_t m = q->m, n = q->n;
    double *a = q->a;
    const layout w = lay_out(m, n, q->work);
    const double rounding = (double)(m > n ? m : n) * DBL_EPSILON;
    if (!hci_vector_finite(m * n, a)) return HCI_ERROR_NOT_FINITE;

    *w.scale = scale_to_unity(m * n, a);
    const size_t r =
        reduce_from_left(m, n, a, relative_tolerance > 0.0 ? relative_tolerance : rounding, q->column, w);
    if (condition) *condition = r > 0 ? fabs(a[0] / a[(r - 1) * (m + 1)]) : 1.0;
    reduce_from_right(m, n, a, r, w);
    q->rank = r;
    return HCI_OK;
}

/* y ← Z y: the reflections of Z in the order that undoes their making. */
static void apply_z(size_t m, size_t n, const double *a, size_t r, const double *tau, double *y)
{
    for (size_t k = 0; k < r && r < n; k++) {
        double t = y[k];
        for (size_t j = r; j < n; j++)
            t += a[k + j * m] * y[j];
        t *= tau[k];
        y[k] -= t;
        for (size_t j = r; j < n; j++)
            y[j] -= t * a[k + j * m];
    }
}

void hci_orthogonal_solve(const hci_orthogonal *q, double *b, double *x, double *work)
{
    const size_t m = q->m, n = q->n, rank = q->rank;
    const double *a = q->a, scale = q->work[0], *tau_q = q->work + 1, *tau_z = tau_q + smaller(m, n);
    for (size_t k = 0; k < rank; k++) /* b ← Qᵀb */
        hci_householder_apply(tau_q[k], m - k - 1, a + k * (m + 1) + 1, b + k, b + k + 1);

    for (size_t k = 0; k < n; k++)
        work[k] = k < rank ? b[k] : 0.0;
    for (size_t k = rank; k-- > 0;) { /* T⁻¹ c */
        work[k] /= a[k + k * m];
        hci_vector_add(k, -work[k], a + k * m, work);
    }
    apply_z(m, n, a, rank, tau_z, work);
    for (size_t k = 0; k < n; k++)
        x[q->column[k]] = scale * work[k];
}
