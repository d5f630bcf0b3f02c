/* P A = L U with partial pivoting, by halves (Toledo 1997):
 *
 *     P [A11 A12] = [L11    ] [U11 U12]      factor the left half, then U12 = L11⁻¹ A12,
 *       [A21 A22]   [L21 L22] [    U22]      A22 ← A22 − L21 U12, and factor A22.
 *
 * Nearly all of the work falls into A22 − L21 U12 at every scale: one kernel decides the speed, and no block
 * size has to be tuned to a cache. The left half is a whole number of UNROLL columns wide, so the kernel
 * never has a remainder in k. The recursion is log2(n) deep. */
#include "core/math/vector.h"
#include "hci/math/dense.h"

enum {
    UNROLL = 4, /* columns of A for one pass over C, and columns of C for one pass over A */
    STRIP = 64  /* rows of C that stay in the first-level cache while A passes by */
};

/* c −= [a0 a1 a2 a3] b */
static void subtract_one(size_t m, const double *restrict a, const double *restrict b, double *restrict c,
                         size_t ld)
{
    const double b0 = b[0], b1 = b[1], b2 = b[2], b3 = b[3];
    const double *a1 = a + ld, *a2 = a1 + ld, *a3 = a2 + ld;
    for (size_t i = 0; i < m; i++)
        c[i] -= a[i] * b0 + a1[i] * b1 + a2[i] * b2 + a3[i] * b3;
}

/* [c0 c1 c2 c3] −= [a0 a1 a2 a3] B over whole lanes of rows; returns the rows done. The columns of C are
 * arguments so that each is restrict. */
static size_t subtract_lanes(size_t m, const double *restrict a, const double *restrict b,
                             double *restrict c0, double *restrict c1, double *restrict c2,
                             double *restrict c3, size_t ld)
{
    const double *a1 = a + ld, *a2 = a1 + ld, *a3 = a2 + ld;
    const double *b1 = b + ld, *b2 = b1 + ld, *b3 = b2 + ld;
    const double b00 = b[0], b10 = b[1], b20 = b[2], b30 = b[3];
    const double b01 = b1[0], b11 = b1[1], b21 = b1[2], b31 = b1[3];
    const double b02 = b2[0], b12 = b2[1], b22 = b2[2], b32 = b2[3];
    const double b03 = b3[0], b13 = b3[1], b23 = b3[2], b33 = b3[3];
    size_t i = 0;
    for (; i + HCI_LANES <= m; i += HCI_LANES)
        for (size_t r = i; r < i + HCI_LANES; r++) {
            c0[r] -= a[r] * b00 + a1[r] * b10 + a2[r] * b20 + a3[r] * b30;
            c1[r] -= a[r] * b01 + a1[r] * b11 + a2[r] * b21 + a3[r] * b31;
            c2[r] -= a[r] * b02 + a1[r] * b12 + a2[r] * b22 + a3[r] * b32;
            c3[r] -= a[r] * b03 + a1[r] * b13 + a2[r] * b23 + a3[r] * b33;
        }
    return i;
}

static void subtract_four(size_t m, const double *a, const double *b, double *c, size_t ld)
{
    const size_t done = subtract_lanes(m, a, b, c, c + ld, c + 2 * ld, c + 3 * ld, ld);
    for (size_t j = 0; j < UNROLL; j++)
        subtract_one(m - done, a + done, b + j * ld, c + done + j * ld, ld);
}

/* C −= A B with C m×n, A m×k, B k×n; k is a multiple of UNROLL. */
static void subtract_product(size_t m, size_t n, size_t k, const double *a, const double *b, double *c,
                             size_t ld)
{
    for (size_t i = 0; i < m; i += STRIP) {
        const size_t rows = m - i < STRIP ? m - i : STRIP;
        size_t j = 0;
        for (; j + UNROLL <= n; j += UNROLL)
            for (size_t p = 0; p < k; p += UNROLL)
                subtract_four(rows, a + i + p * ld, b + p + j * ld, c + i + j * ld, ld);
        for (; j < n; j++)
            for (size_t p = 0; p < k; p += UNROLL)
                subtract_one(rows, a + i + p * ld, b + p + j * ld, c + i + j * ld, ld);
    }
}

/* B ← L⁻¹ B with L unit lower k×k, B k×n; k is a multiple of UNROLL. By halves, as the factorisation. */
static void solve_unit_lower(size_t k, size_t n, const double *l, double *b, size_t ld)
{
    if (k > UNROLL) {
        const size_t half = UNROLL * (k / (2 * UNROLL));
        solve_unit_lower(half, n, l, b, ld);
        subtract_product(k - half, n, half, l + half, b, b + half, ld);
        solve_unit_lower(k - half, n, l + half + half * ld, b + half, ld);
        return;
    }
    for (size_t j = 0; j < n; j++, b += ld)
        for (size_t p = 0; p < k; p++)
            for (size_t i = p + 1; i < k; i++)
                b[i] -= l[i + p * ld] * b[p];
}

/* Exchanges the rows chosen at steps first … last − 1 in `columns` columns. */
static void exchange_rows(size_t columns, double *a, size_t ld, const size_t *pivot, size_t first,
                          size_t last)
{
    for (size_t j = 0; j < columns; j++, a += ld)
        for (size_t k = first; k < last; k++)
            hci_swap(a + k, a + pivot[k]);
}

/* Rows k … n − 1 of columns first … last − 1: one step of elimination. */
static hci_status eliminate(size_t n, double *a, size_t *pivot, size_t k, size_t first, size_t last)
{
    double *column = a + k * n;
    pivot[k] = k + hci_vector_largest(n - k, column + k);
    exchange_rows(last - first, a + first * n, n, pivot, k, k + 1);
    if (column[k] == 0.0) return HCI_ERROR_SINGULAR;
    if (!isfinite(column[k])) return HCI_ERROR_NOT_FINITE;

    const double diagonal = column[k];
    for (size_t i = k + 1; i < n; i++)
        column[i] /= diagonal; /* not times 1/u_kk, which may overflow */
    for (size_t j = k + 1; j < last; j++)
        hci_vector_add(n - k - 1, -a[k + j * n], column + k + 1, a + k + 1 + j * n);
    return HCI_OK;
}

/* Factors columns first … last − 1 from row `first` down; exchanges rows in these columns only. */
static hci_status factor_columns(size_t n, double *a, size_t *pivot, size_t first, size_t last)
{
    hci_status status = HCI_OK;
    if (last - first <= UNROLL) {
        for (size_t k = first; k < last && status == HCI_OK; k++)
            status = eliminate(n, a, pivot, k, first, last);
        return status;
    }
    const size_t left = UNROLL * ((last - first + UNROLL) / (2 * UNROLL)), middle = first + left;
    double *a11 = a + first + first * n, *a12 = a + first + middle * n;

    status = factor_columns(n, a, pivot, first, middle);
    if (status != HCI_OK) return status;
    exchange_rows(last - middle, a + middle * n, n, pivot, first, middle);
    solve_unit_lower(left, last - middle, a11, a12, n);
    subtract_product(n - middle, last - middle, left, a11 + left, a12, a12 + left, n);

    status = factor_columns(n, a, pivot, middle, last);
    if (status == HCI_OK) exchange_rows(left, a + first * n, n, pivot, middle, last);
    return status;
}

hci_status hci_lu_factor(size_t n, double *a, size_t *pivot)
{
    if (!hci_vector_finite(n * n, a)) return HCI_ERROR_NOT_FINITE;
    return factor_columns(n, a, pivot, 0, n);
}

/* x = U⁻¹ L⁻¹ P b, a column of L or U at a time. */
void hci_lu_solve(size_t n, const double *lu, const size_t *pivot, double *x)
{
    for (size_t k = 0; k < n; k++)
        hci_swap(x + k, x + pivot[k]);
    for (size_t k = 0; k < n; k++)
        hci_vector_add(n - k - 1, -x[k], lu + k * n + k + 1, x + k + 1);
    for (size_t k = n; k-- > 0;) {
        x[k] /= lu[k + k * n];
        hci_vector_add(k, -x[k], lu + k * n, x);
    }
}

/* x = Pᵀ L⁻ᵀ U⁻ᵀ b: the columns of U and L are the rows of their transposes. */
void hci_lu_solve_transposed(size_t n, const double *lu, const size_t *pivot, double *x)
{
    for (size_t k = 0; k < n; k++)
        x[k] = (x[k] - hci_vector_dot(k, lu + k * n, x)) / lu[k + k * n];
    for (size_t k = n; k-- > 0;)
        x[k] -= hci_vector_dot(n - k - 1, lu + k * n + k + 1, x + k + 1);
    for (size_t k = n; k-- > 0;)
        hci_swap(x + k, x + pivot[k]);
}
