/* The sparse solvers against singular values and a pseudo-inverse by one-sided Jacobi rotations. */
#include "host/numeric/sparse.h"

#include <string.h>

#include "host/base/memory.h"
#include "support/jacobi.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST = 40, SIDES = 2, DRAWS = 200 };

/* A dense matrix with its compressed columns. */
typedef struct {
    size_t rows, columns;
    double dense[MOST * MOST];
    int64_t start[MOST + 1], row[MOST * MOST];
    double value[MOST * MOST];
} matrix;

void setUp(void)
{
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

static hci_sparse compress(matrix *a)
{
    int64_t count = 0;
    for (size_t j = 0; j < a->columns; ++j) {
        a->start[j] = count;
        for (size_t i = 0; i < a->rows; ++i) {
            if (a->dense[i + j * a->rows] == 0.0) continue;
            a->row[count] = (int64_t)i;
            a->value[count++] = a->dense[i + j * a->rows];
        }
    }
    a->start[a->columns] = count;
    return (hci_sparse){a->rows, a->columns, a->start, a->row, a->value};
}

/* Entries in −1 … 1, of which the share `fill` is not zero. */
static void draw(uint64_t *seed, size_t rows, size_t columns, double fill, matrix *a)
{
    a->rows = rows;
    a->columns = columns;
    for (size_t k = 0; k < rows * columns; ++k)
        a->dense[k] = ref_uniform(seed, 0.0, 1.0) < fill ? ref_uniform(seed, -1.0, 1.0) : 0.0;
}

/* The product of rows × rank and rank × columns. */
static void draw_of_rank(uint64_t *seed, size_t rows, size_t columns, size_t rank, matrix *a)
{
    double left[MOST * MOST], right[MOST * MOST];
    for (size_t k = 0; k < rows * rank; ++k)
        left[k] = ref_uniform(seed, -1.0, 1.0);
    for (size_t k = 0; k < rank * columns; ++k)
        right[k] = ref_uniform(seed, -1.0, 1.0);
    a->rows = rows;
    a->columns = columns;
    memset(a->dense, 0, sizeof a->dense);
    for (size_t j = 0; j < columns; ++j)
        for (size_t k = 0; k < rank; ++k)
            for (size_t i = 0; i < rows; ++i)
                a->dense[i + j * rows] += left[i + k * rows] * right[k + j * rank];
}

static void draw_sides(uint64_t *seed, size_t rows, double *b)
{
    for (size_t k = 0; k < SIDES * rows; ++k)
        b[k] = ref_uniform(seed, -1.0, 1.0);
}

static double largest_of(const double *x, size_t n)
{
    double largest = 0.0;
    for (size_t k = 0; k < n; ++k)
        largest = ref_worse(largest, x[k]);
    return largest;
}

static double largest_difference(const double *x, const double *y, size_t n)
{
    double largest = 0.0;
    for (size_t k = 0; k < n; ++k)
        largest = ref_worse(largest, x[k] - y[k]);
    return largest;
}

/* Solution, rank and condition of SPQR against those of the singular values. Values between 1e-13 and 1e-9 of
 * the largest would leave the rank open; the draws have none (asserted). */
static void check_qr(matrix *a, uint64_t *seed)
{
    double b[SIDES * MOST], x[SIDES * MOST], expected[SIDES * MOST];
    const hci_sparse s = compress(a);
    hci_sparse_rank found = {99, -1.0};
    hci_note note = {{0}};
    jacobi_values truth;
    draw_sides(seed, a->rows, b);
    truth = jacobi_solve(a->rows, a->columns, a->dense, 1e-11, SIDES, b, expected);
    TEST_ASSERT_TRUE(truth.dropped <= 1e-13 * truth.largest && truth.smallest >= 1e-9 * truth.largest);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_sparse_qr_solve(&s, b, SIDES, x, &found, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(truth.rank, found.rank);
    if (truth.rank == 0) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, largest_of(x, SIDES * a->columns));
        TEST_ASSERT_TRUE(isnan(found.condition));
        return;
    }
    const double ratio = truth.largest / truth.smallest;
    /* The error of a least-squares solution grows by the condition squared times the residual; 100 for sums.
     */
    const double bound =
        100.0 * 2.2e-16 * ratio *
        (ratio * largest_of(b, SIDES * a->rows) / truth.largest + largest_of(expected, SIDES * a->columns));
    TEST_ASSERT_DOUBLE_WITHIN(bound, 0.0, largest_difference(x, expected, SIDES * a->columns));
    TEST_ASSERT_TRUE(found.condition >= 0.5 * ratio && found.condition <= 2.0 * ratio);
}

static void test_qr_of_every_shape_and_fill(void)
{
    static matrix a;
    uint64_t seed = 20201;
    for (int k = 0; k < DRAWS; ++k) {
        const size_t rows = (size_t)ref_integer(&seed, 1, 30), columns = (size_t)ref_integer(&seed, 1, 30);
        draw(&seed, rows, columns, ref_uniform(&seed, 0.15, 1.0), &a);
        check_qr(&a, &seed);
    }
}

static void test_qr_of_every_rank(void)
{
    static matrix a;
    uint64_t seed = 20202;
    for (int k = 0; k < DRAWS; ++k) {
        const size_t rows = (size_t)ref_integer(&seed, 1, 30), columns = (size_t)ref_integer(&seed, 1, 30);
        const size_t least = rows < columns ? rows : columns;
        draw_of_rank(&seed, rows, columns, (size_t)ref_integer(&seed, 0, (int)least), &a);
        check_qr(&a, &seed);
    }
}

static void test_qr_with_zero_rows_and_columns(void)
{
    static matrix a;
    uint64_t seed = 20203;
    for (int k = 0; k < DRAWS / 4; ++k) {
        const size_t rows = (size_t)ref_integer(&seed, 2, 20), columns = (size_t)ref_integer(&seed, 2, 20);
        const size_t row = (size_t)ref_integer(&seed, 0, (int)rows - 1);
        const size_t column = (size_t)ref_integer(&seed, 0, (int)columns - 1);
        draw(&seed, rows, columns, 0.7, &a);
        for (size_t i = 0; i < rows; ++i)
            a.dense[i + column * rows] = 0.0;
        for (size_t j = 0; j < columns; ++j)
            a.dense[row + j * rows] = 0.0;
        check_qr(&a, &seed);
    }
}

static void test_qr_condition_over_many_scales(void)
{
    static matrix a;
    uint64_t seed = 20204;
    for (int k = 0; k < DRAWS / 4; ++k) {
        const size_t rows = (size_t)ref_integer(&seed, 2, 24), columns = (size_t)ref_integer(&seed, 2, 24);
        draw(&seed, rows, columns, 1.0, &a);
        for (size_t j = 0; j < columns; ++j) {
            const double scale = pow(10.0, ref_uniform(&seed, -3.0, 3.0));
            for (size_t i = 0; i < rows; ++i)
                a.dense[i + j * rows] *= scale;
        }
        check_qr(&a, &seed);
    }
}

static void test_qr_of_nothing(void)
{
    static matrix a;
    const size_t shape[4][2] = {{0, 0}, {0, 5}, {5, 0}, {3, 4}}; /* the last: all zero */
    uint64_t seed = 20205;
    for (size_t k = 0; k < 4; ++k) {
        memset(&a, 0, sizeof a);
        a.rows = shape[k][0];
        a.columns = shape[k][1];
        check_qr(&a, &seed);
    }
}

/* UMFPACK and the pseudo-inverse of a regular square matrix. */
static void test_lu_of_regular_squares(void)
{
    static matrix a;
    uint64_t seed = 20206;
    int regular = 0;
    for (int k = 0; k < DRAWS; ++k) {
        double b[SIDES * MOST], x[SIDES * MOST], expected[SIDES * MOST], condition = -1.0;
        const size_t n = (size_t)ref_integer(&seed, 1, 30);
        draw(&seed, n, n, ref_uniform(&seed, 0.2, 1.0), &a);
        for (size_t j = 0; j < n; ++j)
            a.dense[j + j * n] += ref_uniform(&seed, 0.5, 1.0);
        draw_sides(&seed, n, b);
        const hci_sparse s = compress(&a);
        const jacobi_values truth = jacobi_solve(n, n, a.dense, 1e-11, SIDES, b, expected);
        if (truth.rank < n) continue; /* a few of the sparse draws are singular */
        hci_note note = {{0}};
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_sparse_lu_solve(&s, b, SIDES, x, &condition, &note), note.text);
        const double ratio = truth.largest / truth.smallest;
        TEST_ASSERT_DOUBLE_WITHIN(100.0 * 2.2e-16 * ratio * largest_of(expected, SIDES * n), 0.0,
                                  largest_difference(x, expected, SIDES * n));
        TEST_ASSERT_TRUE(condition >= 0.5 * ratio && condition <= 2.0 * ratio);
        ++regular;
    }
    TEST_ASSERT_TRUE(regular > DRAWS / 2);
}

static void check_singular(matrix *a, const char *what)
{
    double b[SIDES * MOST], x[SIDES * MOST], condition = -1.0;
    const hci_sparse s = compress(a);
    hci_note note = {{0}};
    uint64_t seed = 20207;
    draw_sides(&seed, a->rows, b);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_SINGULAR, hci_sparse_lu_solve(&s, b, SIDES, x, &condition, &note),
                              what);
    TEST_ASSERT_EQUAL_STRING_MESSAGE("", note.text, what);
}

static void test_lu_of_singular_squares(void)
{
    static matrix a;
    uint64_t seed = 20208;
    for (int k = 0; k < DRAWS / 4; ++k) {
        const size_t n = (size_t)ref_integer(&seed, 2, 30);
        const size_t j = (size_t)ref_integer(&seed, 0, (int)n - 1), other = (j + 1) % n;
        draw_of_rank(&seed, n, n, (size_t)ref_integer(&seed, 0, (int)n - 1), &a);
        check_singular(&a, "rank");
        draw(&seed, n, n, 0.8, &a);
        for (size_t i = 0; i < n; ++i)
            a.dense[i + j * n] = 0.0;
        check_singular(&a, "zero column");
        draw(&seed, n, n, 0.8, &a);
        for (size_t i = 0; i < n; ++i)
            a.dense[j + i * n] = 0.0;
        check_singular(&a, "zero row");
        draw(&seed, n, n, 0.8, &a);
        memcpy(a.dense + j * n, a.dense + other * n, n * sizeof *a.dense);
        check_singular(&a, "equal columns");
    }
}

/* With the memory of a solve running out after each of its allocations in turn: no memory, or the solution.
 */
typedef hci_status solve_of(const hci_sparse *a, const double *b, double *x, hci_note *note);

static hci_status by_lu(const hci_sparse *a, const double *b, double *x, hci_note *note)
{
    double condition;
    return hci_sparse_lu_solve(a, b, SIDES, x, &condition, note);
}

static hci_status by_qr(const hci_sparse *a, const double *b, double *x, hci_note *note)
{
    hci_sparse_rank found;
    return hci_sparse_qr_solve(a, b, SIDES, x, &found, note);
}

typedef struct {
    solve_of *solve;
    hci_sparse matrix;
    double sides[SIDES * MOST], expected[SIDES * MOST];
} system_of;

/* After `succeed` allocations one fails, or all: HCI_ERROR_MEMORY, or the solution. */
static hci_status solve_short_of_memory(const system_of *s, void (*fail_after)(long), long succeed)
{
    double x[SIDES * MOST];
    hci_note note = {{0}};
    fail_after(succeed);
    const hci_status status = s->solve(&s->matrix, s->sides, x, &note);
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_MESSAGE(status ? HCI_ERROR_MEMORY : HCI_OK, status, note.text);
    if (!status) TEST_ASSERT_EQUAL_MEMORY(s->expected, x, SIDES * s->matrix.columns * sizeof *x);
    return status;
}

static void check_every_allocation(solve_of *solve, size_t rows, size_t columns)
{
    static matrix a;
    uint64_t seed = 20209;
    long count = 0;
    draw(&seed, rows, columns, 0.4, &a);
    system_of s = {.solve = solve, .matrix = compress(&a)};
    draw_sides(&seed, rows, s.sides);
    TEST_ASSERT_EQUAL(HCI_OK, solve(&s.matrix, s.sides, s.expected, NULL));
    while (solve_short_of_memory(&s, hci_memory_fail_after, count))
        TEST_ASSERT_TRUE(++count < 10000);
    TEST_ASSERT_TRUE(count > 20); /* those of the libraries are among them */
    for (long k = 0; k < count; ++k)
        solve_short_of_memory(&s, hci_memory_fail_once_after, k);
}

static void test_memory_that_runs_out(void)
{
    check_every_allocation(by_lu, 20, 20);
    check_every_allocation(by_qr, 20, 20);
    check_every_allocation(by_qr, 30, 20);
    check_every_allocation(by_qr, 20, 30);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_qr_of_every_shape_and_fill);
    RUN_TEST(test_qr_of_every_rank);
    RUN_TEST(test_qr_with_zero_rows_and_columns);
    RUN_TEST(test_qr_condition_over_many_scales);
    RUN_TEST(test_qr_of_nothing);
    RUN_TEST(test_lu_of_regular_squares);
    RUN_TEST(test_lu_of_singular_squares);
    RUN_TEST(test_memory_that_runs_out);
    return UNITY_END();
}
