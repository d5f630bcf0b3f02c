/* LU, Cholesky and the complete orthogonal decomposition: closed forms, laws over seeded draws, refused
 * input. */
#include "hci/math/dense.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

static uint64_t seed;

void setUp(void)
{
    seed = 20240607u;
}

void tearDown(void)
{
}

static double draw(void)
{
    return ref_uniform(&seed, -1.0, 1.0);
}

/* Blocks of exactly the stated length, so that the address sanitizer sees one step too far. */
static void *block(size_t count, size_t size)
{
    void *p = calloc(count > 0 ? count : 1, size);
    TEST_ASSERT_NOT_NULL(p);
    return p;
}

static double *doubles(size_t count)
{
    return (double *)block(count, sizeof(double));
}

static size_t *indices(size_t count)
{
    return (size_t *)block(count, sizeof(size_t));
}

static double *random_matrix(size_t m, size_t n)
{
    double *a = doubles(m * n);
    for (size_t i = 0; i < m * n; i++)
        a[i] = draw();
    return a;
}

static double *copy_of(size_t count, const double *x)
{
    double *y = doubles(count);
    memcpy(y, x, count * sizeof *x);
    return y;
}

/* C = A B with the sums in long double: A m×k, B k×n. */
static double *product(size_t m, size_t k, size_t n, const double *a, const double *b)
{
    double *c = doubles(m * n);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++) {
            long double sum = 0.0L;
            for (size_t p = 0; p < k; p++)
                sum += (long double)a[i + p * m] * b[p + j * k];
            c[i + j * m] = (double)sum;
        }
    return c;
}

static double *transposed(size_t m, size_t n, const double *a)
{
    double *t = doubles(m * n);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            t[j + i * n] = a[i + j * m];
    return t;
}

static double largest(size_t count, const double *x)
{
    double l = 0.0;
    for (size_t i = 0; i < count; i++)
        l = fmax(l, fabs(x[i]));
    return l;
}

static double largest_difference(size_t count, const double *x, const double *y)
{
    double l = 0.0;
    for (size_t i = 0; i < count; i++)
        l = fmax(l, fabs(x[i] - y[i]));
    return l;
}

/* --- LU
 * ------------------------------------------------------------------------------------------------------- */

/* ‖A⁻¹‖₁ by Gauss–Jordan in long double: the second implementation. */
static double inverse_norm(size_t n, const double *a)
{
    long double *w = (long double *)block(2 * n * n, sizeof(long double));
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < 2 * n; j++)
            w[i * 2 * n + j] = j < n ? (long double)a[i + j * n] : (j - n == i);
    for (size_t k = 0; k < n; k++) {
        size_t p = k;
        for (size_t i = k; i < n; i++)
            if (fabsl(w[i * 2 * n + k]) > fabsl(w[p * 2 * n + k])) p = i;
        for (size_t j = 0; j < 2 * n; j++) {
            const long double t = w[k * 2 * n + j];
            w[k * 2 * n + j] = w[p * 2 * n + j];
            w[p * 2 * n + j] = t;
        }
        const long double d = w[k * 2 * n + k];
        for (size_t j = 0; j < 2 * n; j++)
            w[k * 2 * n + j] /= d;
        for (size_t i = 0; i < n; i++) {
            const long double f = w[i * 2 * n + k];
            for (size_t j = 0; i != k && j < 2 * n; j++)
                w[i * 2 * n + j] -= f * w[k * 2 * n + j];
        }
    }
    long double norm = 0.0L;
    for (size_t j = n; j < 2 * n; j++) {
        long double sum = 0.0L;
        for (size_t i = 0; i < n; i++)
            sum += fabsl(w[i * 2 * n + j]);
        if (sum > norm) norm = sum;
    }
    free(w);
    return (double)norm;
}

/* Componentwise backward error in long double, one row at a time. */
static double backward_error(size_t n, const double *a, const double *b, const double *x)
{
    long double worst = 0.0L;
    for (size_t i = 0; i < n; i++) {
        long double r = b[i], s = fabsl((long double)b[i]);
        for (size_t j = 0; j < n; j++) {
            r -= (long double)a[i + j * n] * x[j];
            s += fabsl((long double)a[i + j * n] * x[j]);
        }
        if (s > 0.0L && fabsl(r) / s > worst) worst = fabsl(r) / s;
    }
    return (double)worst;
}

static void check_factors(size_t n, const double *a)
{
    double *lu = copy_of(n * n, a), *l = doubles(n * n), *u = doubles(n * n), *pa = copy_of(n * n, a);
    size_t *pivot = indices(n);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, lu, pivot));
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) {
            l[i + j * n] = i > j ? lu[i + j * n] : i == j;
            u[i + j * n] = i <= j ? lu[i + j * n] : 0.0;
        }
    for (size_t k = 0; k < n; k++) {
        TEST_ASSERT_TRUE(pivot[k] >= k && pivot[k] < n);
        for (size_t j = 0; j < n; j++) {
            const double t = pa[k + j * n];
            pa[k + j * n] = pa[pivot[k] + j * n];
            pa[pivot[k] + j * n] = t;
        }
    }
    double *back = product(n, n, n, l, u);
    TEST_ASSERT_TRUE(largest(n * n, l) <= 1.0); /* what partial pivoting promises */
    /* |PA − LU| <= n u |L||U| (Higham, theorem 9.3) with |L| <= 1 */
    const double bound = (double)n * DBL_EPSILON * (double)n * largest(n * n, u);
    TEST_ASSERT_TRUE(largest_difference(n * n, pa, back) <= bound);
    free(lu), free(l), free(u), free(pa), free(pivot), free(back);
}

static void test_lu_factors_multiply_back(void)
{
    const size_t more[] = {63, 64, 65, 66, 67, 97, 128, 131, 150};
    for (size_t n = 0; n <= 40; n++) {
        double *a = random_matrix(n, n);
        check_factors(n, a);
        free(a);
    }
    for (size_t k = 0; k < sizeof more / sizeof *more; k++) {
        double *a = random_matrix(more[k], more[k]);
        check_factors(more[k], a);
        free(a);
    }
}

static void test_lu_solves_both_ways(void)
{
    for (size_t n = 1; n <= 90; n += 1 + n / 8) {
        double *a = random_matrix(n, n), *at = transposed(n, n, a), *b = random_matrix(n, 1);
        double *lu = copy_of(n * n, a), *x = copy_of(n, b), *y = copy_of(n, b);
        size_t *pivot = indices(n);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, lu, pivot));
        hci_lu_solve(n, lu, pivot, x);
        hci_lu_solve_transposed(n, lu, pivot, y);
        /* normwise stable: ‖b − Ax‖ <= c n u ‖A‖‖x‖; random matrices grow little, c = 4 */
        double *ax = product(n, n, 1, a, x), *ay = product(n, n, 1, at, y);
        const double c = 4.0 * (double)n * DBL_EPSILON * (double)n;
        TEST_ASSERT_TRUE(largest_difference(n, ax, b) <= c * (largest(n, x) + 1.0));
        TEST_ASSERT_TRUE(largest_difference(n, ay, b) <= c * (largest(n, y) + 1.0));
        free(a), free(at), free(b), free(lu), free(x), free(y), free(pivot), free(ax), free(ay);
    }
}

static double hilbert(size_t i, size_t j)
{
    return 1.0 / (double)(i + j + 1);
}

static double binomial(size_t n, size_t k)
{
    double c = 1.0;
    for (size_t i = 1; i <= k; i++)
        c = c * (double)(n - k + i) / (double)i;
    return c;
}

/* (H⁻¹)_ij = (−1)^(i+j) (i+j−1) C(n+i−1, n−j) C(n+j−1, n−i) C(i+j−2, i−1)² with i, j from 1 */
static double inverse_hilbert(size_t n, size_t i, size_t j)
{
    const double c = binomial(i + j, i);
    const double magnitude =
        (double)(i + j + 1) * binomial(n + i, n - j - 1) * binomial(n + j, n - i - 1) * c * c;
    return (i + j) % 2 == 0 ? magnitude : -magnitude;
}

static void test_lu_hilbert_inverse_and_condition(void)
{
    for (size_t n = 1; n <= 9; n++) {
        double a[81], lu[81], inverse[81], x[9], work[18];
        size_t pivot[9];
        for (size_t j = 0; j < n; j++)
            for (size_t i = 0; i < n; i++) {
                a[i + j * n] = lu[i + j * n] = hilbert(i, j);
                inverse[i + j * n] = inverse_hilbert(n, i, j);
            }
        const double condition = hci_norm_1(n, n, a) * hci_norm_1(n, n, inverse);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, lu, pivot));
        for (size_t j = 0; j < n; j++) {
            for (size_t i = 0; i < n; i++)
                x[i] = i == j;
            hci_lu_solve(n, lu, pivot, x);
            /* the entries 1/(i+j+1) are themselves rounded: the error is some u·condition */
            const double scale = largest(n, inverse + j * n);
            TEST_ASSERT_TRUE(largest_difference(n, x, inverse + j * n) <=
                             4.0 * DBL_EPSILON * condition * scale);
        }
        const double estimate = hci_lu_condition(n, lu, pivot, hci_norm_1(n, n, a), work);
        TEST_ASSERT_TRUE(estimate <= condition * (1.0 + 4.0 * DBL_EPSILON * condition));
        TEST_ASSERT_TRUE(estimate >= condition / 3.0);
    }
}

/* x_i = i-th power of the nodes: the interpolating polynomial of Σ c_k t^k has the coefficients c_k. */
static void test_lu_vandermonde(void)
{
    enum { N = 8 };
    double a[N * N], b[N] = {0}, lu[N * N], work[2 * N];
    size_t pivot[N];
    for (size_t i = 0; i < N; i++) {
        double power = 1.0;
        for (size_t j = 0; j < N; j++, power *= (double)i - 3.0) {
            a[i + j * N] = lu[i + j * N] = power;
            b[i] += (double)(j + 1) * power; /* whole numbers: exact */
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, lu, pivot));
    hci_lu_solve(N, lu, pivot, b);
    const double condition = hci_norm_1(N, N, a) * inverse_norm(N, a);
    const double estimate = hci_lu_condition(N, lu, pivot, hci_norm_1(N, N, a), work);
    TEST_ASSERT_TRUE(estimate >= condition / 3.0 && estimate <= condition * (1.0 + 1e-9));
    for (size_t j = 0; j < N; j++)
        TEST_ASSERT_DOUBLE_WITHIN(8.0 * DBL_EPSILON * condition, (double)(j + 1), b[j]);
}

static void test_lu_permutations_are_exact(void)
{
    for (size_t n = 1; n <= 37; n++) {
        double *a = doubles(n * n), *x = doubles(n), *y = doubles(n), *work = doubles(2 * n);
        size_t *pivot = indices(n), *row = indices(n);
        for (size_t i = 0; i < n; i++)
            row[i] = i;
        for (size_t i = n; i-- > 1;) {
            const size_t k = (size_t)((draw() + 1.0) * 0.5 * (double)(i + 1)), t = row[i];
            row[i] = row[k];
            row[k] = t;
        }
        for (size_t i = 0; i < n * n; i++)
            a[i] = 0.0;
        for (size_t j = 0; j < n; j++) {
            a[row[j] + j * n] = 1.0;
            x[row[j]] = y[j] = (double)j + 1.0;
        }
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, a, pivot));
        hci_lu_solve(n, a, pivot, x);
        for (size_t j = 0; j < n; j++)
            TEST_ASSERT_EQUAL_DOUBLE((double)j + 1.0, x[j]);
        hci_lu_solve_transposed(n, a, pivot, y);
        for (size_t j = 0; j < n; j++)
            TEST_ASSERT_EQUAL_DOUBLE((double)j + 1.0, y[row[j]]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0, hci_lu_condition(n, a, pivot, 1.0, work));
        free(a), free(x), free(y), free(work), free(pivot), free(row);
    }
}

/* Wilkinson's matrix of largest growth: 1 on the diagonal and in the last column, −1 below: u_nn = 2^(n−1).
 */
static void test_lu_wilkinson_growth(void)
{
    enum { N = 50 };
    static double a[N * N];
    size_t pivot[N];
    for (size_t j = 0; j < N; j++)
        for (size_t i = 0; i < N; i++)
            a[i + j * N] = i == j || j == N - 1 ? 1.0 : i > j ? -1.0 : 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, a, pivot));
    for (size_t k = 0; k < N; k++)
        TEST_ASSERT_EQUAL_UINT(k, pivot[k]); /* ties stay in place */
    TEST_ASSERT_EQUAL_DOUBLE(ldexp(1.0, N - 1), a[N * N - 1]);
}

/* Random, and graded: random with column j scaled by 10^(−j/3) on both sides of another random factor. */
static void test_lu_condition_within_three(void)
{
    for (size_t n = 2; n <= 26; n += 4)
        for (int trial = 0; trial < 12; trial++) {
            double *a = random_matrix(n, n), *work = doubles(2 * n);
            size_t *pivot = indices(n);
            if (trial % 3 != 0) {
                double *g = random_matrix(n, n);
                for (size_t j = 0; j < n; j++)
                    for (size_t i = 0; i < n; i++)
                        g[i + j * n] *= pow(10.0, -(double)j * 9.0 / (double)n);
                double *graded = product(n, n, n, g, a);
                memcpy(a, graded, n * n * sizeof *a);
                free(g), free(graded);
            }
            const double norm = hci_norm_1(n, n, a), condition = norm * inverse_norm(n, a);
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, a, pivot));
            const double estimate = hci_lu_condition(n, a, pivot, norm, work);
            /* a lower bound up to the rounding of the solves, n·u·condition */
            TEST_ASSERT_TRUE(estimate <= condition * (1.0 + 100.0 * DBL_EPSILON * condition));
            TEST_ASSERT_TRUE(estimate >= condition / 3.0);
            free(a), free(work), free(pivot);
        }
}

/* The inverse's large column is hidden from the start e/n: its signs cancel. A = inverse of I + big·(e1 −
 * e2)e3ᵀ… */
static void test_lu_condition_needs_the_climb(void)
{
    /* A⁻¹ = [1 t −t; 0 1 0; 0 0 1]: A⁻¹e/n sees no t, columns 2 and 3 hold it; ‖A⁻¹‖₁ = 1 + t */
    const double t = 1e6;
    double a[9] = {1, 0, 0, -t, 1, 0, t, 0, 1}, work[6];
    size_t pivot[3];
    TEST_ASSERT_EQUAL_DOUBLE(1.0 + t, hci_norm_1(3, 3, a));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(3, a, pivot));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, (1.0 + t) * (1.0 + t), hci_lu_condition(3, a, pivot, 1.0 + t, work));
}

/* A⁻¹ = [2 0.9 2; 0 1 0.1; 0 1 0]: its largest column is the second one, 2.9. A⁻¹e/n = (4.9, 1.1, 1)/3, whose
 * signs lead there; its sizes lead to the third one, 2.1. */
static void test_lu_condition_goes_by_signs(void)
{
    double a[9] = {0.5, 0, 0, -10, 0, 10, 9.55, 1, -10}, work[6];
    size_t pivot[3];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(3, a, pivot));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.9, hci_lu_condition(3, a, pivot, 1.0, work));
}

/* A⁻¹ = diag(2, 1 … 1) + θccᵀ with c = (0, 1, −1, 1 … −1): the search sees nothing of θ, neither from e/n nor
 * from the first column, to which that leads. With the alternating x_i, ‖x‖₁ = 13.5 and cᵀx = −12.5,
 * ‖A⁻¹x‖₁ = 14.5 + 100 θ; in truth the norm is 1 + 8 θ. */
static void test_lu_condition_where_the_search_is_deceived(void)
{
    enum { N = 9 };
    const double theta = 1000.0, t = theta / (1.0 + 8.0 * theta);
    double a[N * N], work[2 * N];
    size_t pivot[N];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double product = i == 0 || j == 0 ? 0.0 : (i + j) % 2 ? -1.0 : 1.0;
            a[i + j * N] = (i != j ? 0.0 : i == 0 ? 0.5 : 1.0) - t * product;
        }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, a, pivot));
    const double estimate = hci_lu_condition(N, a, pivot, 1.0, work);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8 * estimate, (14.5 + 100.0 * theta) / 13.5, estimate);
    TEST_ASSERT_TRUE(estimate >= (1.0 + 8.0 * theta) / 3.0);
}

/* Row 0 is so large that its small first element (10⁻⁹ of the row) is the pivot all the same. The elimination
 * then costs the other rows nine digits: invisible beside row 0, but not componentwise. */
static void test_lu_refinement_of_badly_scaled_systems(void)
{
    enum { N = 45 };
    double worst_before = 0.0;
    for (int trial = 0; trial < 8; trial++) {
        double *a = random_matrix(N, N), *b = random_matrix(N, 1), *work = doubles(N);
        size_t pivot[N];
        a[0] = 1e-9;
        for (size_t i = 0; i < N; i++) {
            const double scale = i == 0 ? 1e24 : pow(10.0, 12.0 * draw());
            for (size_t j = 0; j < N; j++)
                a[i + j * N] *= scale;
            b[i] *= scale;
        }
        double *lu = copy_of(N * N, a), *x = copy_of(N, b);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, lu, pivot));
        hci_lu_solve(N, lu, pivot, x);
        const double before = backward_error(N, a, b, x);
        const double returned = hci_lu_refine(N, a, lu, pivot, b, x, work);
        const double after = backward_error(N, a, b, x);
        worst_before = fmax(worst_before, before);
        TEST_ASSERT_TRUE(after <= before);
        TEST_ASSERT_TRUE(after <=
                         4.0 * DBL_EPSILON); /* Skeel: one step in the same precision reaches about u */
        /* the residual is rounded in double: (n+1) u of the denominator */
        TEST_ASSERT_DOUBLE_WITHIN((N + 1) * DBL_EPSILON, after, returned);
        free(a), free(b), free(work), free(lu), free(x);
    }
    TEST_ASSERT_TRUE(worst_before > 1e-9); /* the systems are hard enough to tell */
}

/* With the factors of a wholly different matrix each step would go astray: x must stay as it was. */
static void test_lu_refinement_never_makes_it_worse(void)
{
    enum { N = 20 };
    double *a = random_matrix(N, N), *wrong = random_matrix(N, N), *b = random_matrix(N, 1),
           *work = doubles(N);
    size_t pivot[N];
    double *lu = copy_of(N * N, a), *x = copy_of(N, b);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, lu, pivot));
    hci_lu_solve(N, lu, pivot, x);
    double *kept = copy_of(N, x);
    for (size_t i = 0; i < N; i++)
        kept[i] = x[i] = x[i] * (1.0 + 1e-7 * draw());
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(N, wrong, pivot));
    for (size_t i = 0; i < N * N; i++)
        wrong[i] *= 1e-3;
    const double error = hci_lu_refine(N, a, wrong, pivot, b, x, work);
    for (size_t i = 0; i < N; i++)
        TEST_ASSERT_EQUAL_DOUBLE(kept[i], x[i]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, backward_error(N, a, b, kept), error);
    free(a), free(wrong), free(b), free(work), free(lu), free(x), free(kept);
}

/* An error in one component alone, of systems of one row and of more rows than are looked at together. */
static void test_lu_refinement_of_each_component(void)
{
    enum { MOST = 40 };
    static const size_t sizes[] = {1, 2, 31, 32, 33, MOST};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (size_t wrong = 0; wrong < sizes[s]; wrong++) {
            const size_t n = sizes[s];
            double a[MOST * MOST] = {0}, b[MOST], x[MOST], work[3 * MOST];
            size_t pivot[MOST];
            for (size_t k = 0; k < n; k++) {
                a[k + k * n] = b[k] = 1.0 + (double)k;
                pivot[k] = k;
                x[k] = k == wrong ? 1.0 + 1e-6 : 1.0;
            }
            TEST_ASSERT_TRUE(hci_lu_refine(n, a, a, pivot, b, x, work) <= DBL_EPSILON);
            for (size_t k = 0; k < n; k++)
                TEST_ASSERT_DOUBLE_WITHIN(DBL_EPSILON, 1.0, x[k]);
        }
}

static void test_lu_refuses(void)
{
    const double bad[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
    size_t pivot[6];
    for (size_t position = 0; position < 36; position++)
        for (size_t k = 0; k < 3; k++) {
            double a[36] = {0}; /* singular too: not finite is said first */
            a[position] = bad[k];
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, hci_lu_factor(6, a, pivot));
        }
    double zero[1] = {0.0};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_lu_factor(1, zero, pivot));
    double dependent[36]; /* whole numbers, rank 2: i + j; elimination by halves and thirds stays exact enough
                             to hit 0 */
    for (size_t j = 0; j < 6; j++)
        for (size_t i = 0; i < 6; i++)
            dependent[i + j * 6] = j < 2 ? (double)(i == j) : (double)(i < 2);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_lu_factor(6, dependent, pivot));
    double overflow[4] = {1e308, -1e308, 1e308, 1e308}; /* u_22 = 2e308 */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, hci_lu_factor(2, overflow, pivot));
}

/* Ones below the diagonal of ones, but for the last columns, which are equal: the right half has no pivot
 * left. */
static void test_lu_refuses_in_the_right_half(void)
{
    double a[64];
    size_t pivot[8];
    for (size_t j = 0; j < 8; j++)
        for (size_t i = 0; i < 8; i++)
            a[i + j * 8] = i >= (j < 7 ? j : 6) ? 1.0 : 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_lu_factor(8, a, pivot));
}

/* [1 1; 1 1 + 2⁻⁵²] scaled so that its inverse overflows; and a solution that is no number stays as wrong as
 * it is. */
static void test_lu_condition_and_refinement_beyond_all_numbers(void)
{
    const double a[4] = {1e-300, 1e-300, 1e-300, 1.0000000000000002e-300};
    double lu[4] = {a[0], a[1], a[2], a[3]}, x[2] = {(double)NAN, 1.0}, work[4];
    const double b[2] = {1.0, 1.0};
    size_t pivot[2];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(2, lu, pivot));
    TEST_ASSERT_TRUE(isinf(hci_lu_condition(2, lu, pivot, hci_norm_1(2, 2, a), work)));
    TEST_ASSERT_TRUE(isnan(hci_lu_refine(2, a, lu, pivot, b, x, work)));
    TEST_ASSERT_TRUE(isnan(x[0]) && x[1] == 1.0);
}

static void test_lu_extreme_scales(void)
{
    const double scales[] = {1e300, 1e-300, 4.9e-322};
    for (size_t k = 0; k < 3; k++) { /* [2 1; 1 3] x = [5; 10] has x = [1; 3] */
        double a[4] = {2.0 * scales[k], scales[k], scales[k], 3.0 * scales[k]},
               b[2] = {5.0 * scales[k], 10.0 * scales[k]};
        size_t pivot[2];
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(2, a, pivot));
        hci_lu_solve(2, a, pivot, b);
        const double tolerance = k == 2 ? 0.1 : 1e-15; /* subnormals of 99 units have two digits */
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 1.0, b[0]);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 3.0, b[1]);
    }
}

static void test_lu_of_nothing(void)
{
    double none = 7.0;
    size_t pivot = 7;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(0, &none, &pivot));
    hci_lu_solve(0, &none, &pivot, &none);
    hci_lu_solve_transposed(0, &none, &pivot, &none);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_norm_1(0, 0, &none));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_lu_condition(0, &none, &pivot, 0.0, &none));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_lu_refine(0, &none, &none, &pivot, &none, &none, &none));
    TEST_ASSERT_EQUAL_DOUBLE(7.0, none);
}

/* --- complete orthogonal decomposition
 * ----------------------------------------------------------------------- */

/* x = A⁺ b; returns the rank. */
static size_t least_squares(size_t m, size_t n, const double *a, double tolerance, const double *b, double *x,
                            double *condition)
{
    double *qr = copy_of(m * n, a), *factor_work = doubles(hci_orthogonal_workspace(m, n));
    double *c = copy_of(m, b), *work = doubles(n);
    size_t *column = indices(n);
    hci_orthogonal q = {.m = m, .n = n, .a = qr, .column = column, .work = factor_work, .rank = 99};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_orthogonal_factor(&q, tolerance, condition));
    hci_orthogonal_solve(&q, c, x, work);
    free(qr), free(factor_work), free(c), free(work), free(column);
    return q.rank;
}

/* The workspace is not larger than what is used of it. */
static void test_all_of_the_workspace_is_used(void)
{
    for (size_t m = 1; m <= 5; ++m)
        for (size_t n = 1; n <= 5; ++n) {
            const size_t size = hci_orthogonal_workspace(m, n);
            double *a = doubles(m * n), *work = doubles(size), condition;
            size_t *column = indices(n);
            for (size_t k = 0; k < m * n; ++k)
                a[k] = 1.0 + sin(2.0 * (double)(k * k));
            work[size - 1] = -7.0;
            hci_orthogonal q = {.m = m, .n = n, .a = a, .column = column, .work = work};
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_orthogonal_factor(&q, 0.0, &condition));
            TEST_ASSERT_TRUE(work[size - 1] >= 0.0); /* a norm */
            free(a), free(work), free(column);
        }
}

/* X = A⁺, a column for each unit vector. */
static double *pseudo_inverse(size_t m, size_t n, const double *a, size_t rank)
{
    double *x = doubles(n * m), *unit = doubles(m), condition;
    for (size_t i = 0; i < m; i++) {
        for (size_t k = 0; k < m; k++)
            unit[k] = k == i;
        TEST_ASSERT_EQUAL_UINT(rank, least_squares(m, n, a, 0.0, unit, x + i * n, &condition));
        TEST_ASSERT_TRUE(condition >= 1.0);
    }
    free(unit);
    return x;
}

/* A X A = A, X A X = X, (A X)ᵀ = A X, (X A)ᵀ = X A */
static void check_moore_penrose(size_t m, size_t n, const double *a, size_t rank)
{
    double *x = pseudo_inverse(m, n, a, rank), *ax = product(m, n, m, a, x), *xa = product(n, m, n, x, a);
    double *axa = product(m, m, n, ax, a), *xax = product(n, n, m, xa, x);
    double *ax_t = transposed(m, m, ax), *xa_t = transposed(n, n, xa);
    const double size = (double)(m + n), la = largest(m * n, a), lx = largest(m * n, x);
    const double u =
        4.0 * size * size * DBL_EPSILON * fmax(1.0, la * lx); /* la·lx: the condition within a factor n */
    TEST_ASSERT_TRUE(largest_difference(m * n, axa, a) <= u * la * size);
    TEST_ASSERT_TRUE(largest_difference(m * n, xax, x) <= u * lx * size);
    TEST_ASSERT_TRUE(largest_difference(m * m, ax_t, ax) <= u);
    TEST_ASSERT_TRUE(largest_difference(n * n, xa_t, xa) <= u);
    free(x), free(ax), free(xa), free(axa), free(xax), free(ax_t), free(xa_t);
}

static void check_shape(size_t m, size_t n, size_t rank)
{
    double *left = random_matrix(m, rank), *right = random_matrix(rank, n);
    double *a = product(m, rank, n, left, right);
    check_moore_penrose(m, n, a, rank);
    free(left), free(right), free(a);
}

static void test_orthogonal_moore_penrose_for_every_small_shape(void)
{
    for (size_t m = 0; m <= 8; m++)
        for (size_t n = 0; n <= 8; n++)
            for (size_t rank = 0; rank <= m && rank <= n; rank++)
                check_shape(m, n, rank);
}

static void test_orthogonal_moore_penrose_for_larger_shapes(void)
{
    const size_t shape[][3] = {{40, 40, 40}, {40, 40, 23}, {50, 30, 30},
                               {50, 30, 17}, {30, 50, 30}, {30, 50, 8}};
    for (size_t k = 0; k < sizeof shape / sizeof *shape; k++)
        check_shape(shape[k][0], shape[k][1], shape[k][2]);
}

/* Rounding in the entries of a product must not count as rank, and a full matrix must not lose any. */
static void test_orthogonal_rank_over_many_draws(void)
{
    for (int trial = 0; trial < 1500; trial++) {
        const size_t m = 2 + (size_t)trial % 17, n = 2 + (size_t)trial % 13, least = m < n ? m : n;
        const size_t rank = (size_t)trial % (least + 1);
        double *left = random_matrix(m, rank), *right = random_matrix(rank, n), *b = random_matrix(m, 1);
        double *a = product(m, rank, n, left, right), *x = doubles(n);
        TEST_ASSERT_EQUAL_UINT(rank, least_squares(m, n, a, 0.0, b, x, NULL));
        free(left), free(right), free(a), free(b), free(x);
    }
}

/* Aᵀ(b − A x) = 0, and x ⊥ null(A): A = L R, so null(A) = null(R) and x = Rᵀy for some y. */
static void test_orthogonal_least_squares_and_least_norm(void)
{
    enum { M = 25, N = 18, RANK = 11 };
    double *left = random_matrix(M, RANK), *right = random_matrix(RANK, N), *b = random_matrix(M, 1), x[N];
    double *a = product(M, RANK, N, left, right), *at = transposed(M, N, a), *rt = transposed(RANK, N, right);
    TEST_ASSERT_EQUAL_UINT(RANK, least_squares(M, N, a, 0.0, b, x, NULL));
    double *r = product(M, N, 1, a, x);
    for (size_t i = 0; i < M; i++)
        r[i] = b[i] - r[i];
    double *atr = product(N, M, 1, at, r);
    TEST_ASSERT_TRUE(largest(M, r) > 0.1);      /* there is a residual to speak of */
    TEST_ASSERT_TRUE(largest(N, atr) <= 1e-12); /* 25 terms of size 10, condition some 10² */

    double y[RANK]; /* Rᵀ y = x is overdetermined, and consistent only if x ∈ range(Rᵀ) */
    TEST_ASSERT_EQUAL_UINT(RANK, least_squares(N, RANK, rt, 0.0, x, y, NULL));
    double *back = product(N, RANK, 1, rt, y);
    TEST_ASSERT_TRUE(largest_difference(N, back, x) <= 1e-13 * (1.0 + largest(N, x)));
    free(left), free(right), free(b), free(a), free(at), free(rt), free(r), free(atr), free(back);
}

static void test_orthogonal_closed_forms(void)
{
    double x[4];
    const double row[2] = {3.0, 4.0}, ten[1] = {10.0}; /* the foot of the perpendicular on 3x + 4y = 10 */
    TEST_ASSERT_EQUAL_UINT(1, least_squares(1, 2, row, 0.0, ten, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.2, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.6, x[1]);

    const double column[3] = {1.0, 1.0, 1.0}, three[3] = {1.0, 2.0, 6.0}; /* the mean */
    TEST_ASSERT_EQUAL_UINT(1, least_squares(3, 1, column, 0.0, three, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0, x[0]);

    const double twice[8] = {2, 1, 1, 3, 2, 1, 1, 3},
                 b[2] = {5.0, 10.0}; /* [M M]: each half takes half of [1; 3] */
    TEST_ASSERT_EQUAL_UINT(2, least_squares(2, 4, twice, 0.0, b, x, NULL));
    for (size_t k = 0; k < 4; k++)
        TEST_ASSERT_DOUBLE_WITHIN(2e-15, k % 2 == 0 ? 0.5 : 1.5, x[k]);
}

/* Columns that already lie almost along the axes they are reflected onto: β − α must not cancel. */
static void test_orthogonal_of_nearly_triangular(void)
{
    const double e = 1e-10, a[4] = {1.0, e, 0.0, 0.5}, b[2] = {1.0, 0.5 + e};
    double x[2];
    TEST_ASSERT_EQUAL_UINT(2, least_squares(2, 2, a, 0.0, b, x, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, x[1]);
}

static void test_orthogonal_tolerance_decides_the_rank(void)
{
    const double a[9] = {1e-9, 0, 0, 0, 1.0, 0, 0, 0, 1e-3}, b[3] = {1.0, 1.0, 1.0};
    double x[3], condition = 0.0;
    TEST_ASSERT_EQUAL_UINT(2, least_squares(3, 3, a, 1e-6, b, x, &condition));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1e3, condition);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1e3, x[2]);
    TEST_ASSERT_EQUAL_UINT(3, least_squares(3, 3, a, 0.0, b, x, &condition));
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 1e9, condition);
}

/* Columns that differ by 1e-9 from one direction: 1 − cos² has no digit left, so down-dating alone would
 * choose the second column by chance. The third, whose own part is largest, must come second, then the others
 * in order. */
static void test_orthogonal_norms_survive_cancellation(void)
{
    enum { M = 6, N = 4 };
    const double own[N] = {0.0, 1.0, 3.0, 2.0};
    double a[M * N], factor_work[64];
    size_t column[N];
    hci_orthogonal q = {.m = M, .n = N, .a = a, .column = column, .work = factor_work};
    TEST_ASSERT_TRUE(hci_orthogonal_workspace(M, N) <= 64);
    for (size_t j = 0; j < N; j++)
        for (size_t i = 0; i < M; i++)
            a[i + j * M] = (j == 0 ? 1.0 + 1e-6 : 1.0) + (i == j ? 1e-9 * own[j] : 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_orthogonal_factor(&q, 0.0, NULL));
    const size_t expected[N] = {0, 2, 3, 1};
    for (size_t j = 0; j < N; j++)
        TEST_ASSERT_EQUAL_UINT(expected[j], column[j]);
    TEST_ASSERT_EQUAL_UINT(4, q.rank);
}

/* Scaling by a power of two changes no digit; the squares of these elements are beyond the range of a double.
 */
static void test_orthogonal_extreme_scales(void)
{
    const int exponents[] = {1022, 600, -600, -960};
    for (size_t m = 3; m <= 9; m += 3) {
        double *a = random_matrix(m, 6), *b = random_matrix(m, 1), x[6], y[6];
        const size_t rank = least_squares(m, 6, a, 0.0, b, x, NULL);
        for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
            double *scaled = doubles(6 * m);
            for (size_t i = 0; i < 6 * m; i++)
                scaled[i] = ldexp(a[i], exponents[k]);
            TEST_ASSERT_EQUAL_UINT(rank, least_squares(m, 6, scaled, 0.0, b, y, NULL));
            for (size_t j = 0; j < 6 && exponents[k] < 1022; j++)
                TEST_ASSERT_EQUAL_DOUBLE(ldexp(x[j], -exponents[k]), y[j]);
            for (size_t j = 0; j < 6; j++) /* 2^−1022 leaves a subnormal result fewer digits */
                TEST_ASSERT_DOUBLE_WITHIN(fabs(x[j]) * 1e-9 + 1e-9, x[j], ldexp(y[j], exponents[k]));
            free(scaled);
        }
        free(a), free(b);
    }
    double tiny[1] = {4.9406564584124654e-324}, one[1] = {0x1p-1073}, x[1];
    TEST_ASSERT_EQUAL_UINT(
        1, least_squares(1, 1, tiny, 0.0, one, x, NULL)); /* the smallest subnormal: 2^−1074 x = 2^−1073 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2.0, x[0]);
}

static void test_orthogonal_refuses_and_degenerates(void)
{
    const double bad[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
    double factor_work[32], condition = 0.0;
    size_t column[4];
    TEST_ASSERT_TRUE(hci_orthogonal_workspace(3, 4) <= 32);
    for (size_t position = 0; position < 12; position++)
        for (size_t k = 0; k < 3; k++) {
            double a[12] = {0};
            a[position] = bad[k];
            hci_orthogonal q = {.m = 3, .n = 4, .a = a, .column = column, .work = factor_work, .rank = 42};
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, hci_orthogonal_factor(&q, 0.0, &condition));
            TEST_ASSERT_EQUAL_UINT(42, q.rank); /* untouched */
        }

    double zero[12] = {0}, b[3] = {1, 2, 3}, x[4] = {9, 9, 9, 9};
    TEST_ASSERT_EQUAL_UINT(0, least_squares(3, 4, zero, 0.0, b, x, &condition));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, condition);
    for (size_t j = 0; j < 4; j++)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, x[j]);
    x[0] = x[3] = 9.0;
    TEST_ASSERT_EQUAL_UINT(0, least_squares(0, 4, zero, 0.0, b, x, NULL)); /* no equations: x = 0 */
    for (size_t j = 0; j < 4; j++)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, x[j]);
    TEST_ASSERT_EQUAL_UINT(0, least_squares(3, 0, zero, 0.0, b, x, NULL));
}

static void test_lu_and_orthogonal_agree(void)
{
    for (size_t n = 1; n <= 60; n += 1 + n / 4) {
        double *a = random_matrix(n, n), *b = random_matrix(n, 1), *lu = copy_of(n * n, a),
               *x = copy_of(n, b);
        double *y = doubles(n), *work = doubles(2 * n);
        size_t *pivot = indices(n);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_lu_factor(n, lu, pivot));
        hci_lu_solve(n, lu, pivot, x);
        TEST_ASSERT_EQUAL_UINT(n, least_squares(n, n, a, 0.0, b, y, NULL));
        const double condition = hci_lu_condition(n, lu, pivot, hci_norm_1(n, n, a), work);
        TEST_ASSERT_TRUE(largest_difference(n, x, y) <= 4.0 * DBL_EPSILON * condition * largest(n, y));
        free(a), free(b), free(lu), free(x), free(y), free(work), free(pivot);
    }
}

/* --- Cholesky
 * ------------------------------------------------------------------------------------------------ */

/* Pascal's symmetric matrix C(i+j, i) is L Lᵀ with Pascal's triangle for L: whole numbers, no rounding. */
static void test_cholesky_of_pascal_is_exact(void)
{
    enum { N = 14 };
    double a[N * N], x[N];
    for (size_t j = 0; j < N; j++)
        for (size_t i = 0; i < N; i++)
            a[i + j * N] = i >= j ? binomial(i + j, i) : (double)NAN; /* not read */
    for (size_t i = 0; i < N; i++) { /* A·(1, −1, 1, …): Σ_j (−1)^j C(i+j, i) */
        x[i] = 0.0;
        for (size_t j = 0; j < N; j++)
            x[i] += (j % 2 == 0 ? 1.0 : -1.0) * binomial(i + j, i);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_cholesky_factor(N, a));
    for (size_t j = 0; j < N; j++)
        for (size_t i = j; i < N; i++)
            TEST_ASSERT_EQUAL_DOUBLE(binomial(i, j), a[i + j * N]);
    hci_cholesky_solve(N, a, x);
    for (size_t i = 0; i < N; i++)
        TEST_ASSERT_EQUAL_DOUBLE(i % 2 == 0 ? 1.0 : -1.0, x[i]);
}

static void test_cholesky_of_gram_matrices(void)
{
    for (size_t n = 1; n <= 50; n += 1 + n / 5) {
        const size_t m = n + 10;
        double *g = random_matrix(m, n), *gt = transposed(m, n, g), *a = product(n, m, n, gt, g);
        double *b = random_matrix(n, 1), *x = copy_of(n, b), *l = copy_of(n * n, a);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_cholesky_factor(n, l));
        hci_cholesky_solve(n, l, x);
        double *ax = product(n, n, 1, a, x);
        const double bound = 4.0 * (double)n * DBL_EPSILON * (double)n * largest(n * n, a);
        TEST_ASSERT_TRUE(largest_difference(n, ax, b) <= bound * (largest(n, x) + 1.0));
        free(g), free(gt), free(a), free(b), free(x), free(l), free(ax);
    }
}

static void test_cholesky_refuses(void)
{
    double indefinite[4] = {1, 2, 2, 1}, zero[1] = {0}, negative[1] = {-1}, none = 0.0;
    double not_a_number[4] = {1, 0, 0, (double)NAN}, infinite[1] = {HUGE_VAL};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(2, indefinite));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(1, zero));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(1, negative));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(2, not_a_number));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(1, infinite));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_cholesky_factor(0, &none));
    for (int trial = 0; trial < 200;
         trial++) { /* GᵀG of a wide G, where rounding makes the last pivots ± nothing */
        double *g = random_matrix(5, 8), *gt = transposed(5, 8, g), *a = product(8, 5, 8, gt, g);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, hci_cholesky_factor(8, a));
        free(g), free(gt), free(a);
    }
}

/* The largest sum of a column, whichever it is; what is not a number stays. */
static void test_norm_is_that_of_the_largest_column(void)
{
    for (int k = 0; k < 3; ++k) {
        double a[6] = {1.0, -1.0, 0.5, 1.0, -1.0, 0.25};
        a[2 * k] = 3.0;
        a[2 * k + 1] = -4.0;
        TEST_ASSERT_EQUAL_DOUBLE(7.0, hci_norm_1(2, 3, a));
        a[2 * k] = NAN;
        TEST_ASSERT_TRUE(isnan(hci_norm_1(2, 3, a)));
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_norm_1(2, 0, NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_lu_factors_multiply_back);
    RUN_TEST(test_lu_solves_both_ways);
    RUN_TEST(test_lu_hilbert_inverse_and_condition);
    RUN_TEST(test_lu_vandermonde);
    RUN_TEST(test_lu_permutations_are_exact);
    RUN_TEST(test_lu_wilkinson_growth);
    RUN_TEST(test_lu_condition_within_three);
    RUN_TEST(test_lu_condition_needs_the_climb);
    RUN_TEST(test_lu_condition_goes_by_signs);
    RUN_TEST(test_lu_condition_where_the_search_is_deceived);
    RUN_TEST(test_all_of_the_workspace_is_used);
    RUN_TEST(test_lu_refinement_of_badly_scaled_systems);
    RUN_TEST(test_lu_refinement_never_makes_it_worse);
    RUN_TEST(test_lu_refinement_of_each_component);
    RUN_TEST(test_lu_refuses);
    RUN_TEST(test_lu_refuses_in_the_right_half);
    RUN_TEST(test_lu_condition_and_refinement_beyond_all_numbers);
    RUN_TEST(test_lu_extreme_scales);
    RUN_TEST(test_lu_of_nothing);
    RUN_TEST(test_orthogonal_moore_penrose_for_every_small_shape);
    RUN_TEST(test_orthogonal_moore_penrose_for_larger_shapes);
    RUN_TEST(test_orthogonal_rank_over_many_draws);
    RUN_TEST(test_orthogonal_least_squares_and_least_norm);
    RUN_TEST(test_orthogonal_closed_forms);
    RUN_TEST(test_orthogonal_of_nearly_triangular);
    RUN_TEST(test_orthogonal_tolerance_decides_the_rank);
    RUN_TEST(test_orthogonal_norms_survive_cancellation);
    RUN_TEST(test_orthogonal_extreme_scales);
    RUN_TEST(test_orthogonal_refuses_and_degenerates);
    RUN_TEST(test_lu_and_orthogonal_agree);
    RUN_TEST(test_cholesky_of_pascal_is_exact);
    RUN_TEST(test_cholesky_of_gram_matrices);
    RUN_TEST(test_cholesky_refuses);
    RUN_TEST(test_norm_is_that_of_the_largest_column);
    return UNITY_END();
}
