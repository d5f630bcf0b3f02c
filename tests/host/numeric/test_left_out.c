/* Errors of groups left out, against the mean of the others and against an orthogonal solution of the rows
 * themselves. */
#include "host/numeric/left_out.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#include <time.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { GROUPS = 5, ROWS = 7, COLUMNS = 4, ALL = GROUPS * ROWS };

static uint64_t seed;
static double x[ALL * COLUMNS], y[ALL];
static hci_normal_equations group[GROUPS];

void setUp(void)
{
    seed = 7;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    for (int g = 0; g < GROUPS; ++g)
        hci_normal_equations_release(&group[g]);
}

static hci_groups groups_of(size_t columns)
{
    for (size_t g = 0; g < GROUPS; ++g) {
        TEST_ASSERT_TRUE(hci_normal_equations_start(&group[g], columns));
        hci_normal_equations_add(&group[g], x + g * ROWS * columns, y + g * ROWS, ROWS);
        hci_normal_equations_finish(&group[g]);
    }
    return (hci_groups){group, GROUPS};
}

static void draw(size_t columns)
{
    for (size_t k = 0; k < ALL * columns; ++k)
        x[k] = ref_uniform(&seed, -1.0, 1.0);
    for (size_t k = 0; k < ALL; ++k)
        y[k] = ref_uniform(&seed, -1.0, 1.0);
}

/* Of one row with the unknowns of a solution. */
static double square_left(size_t row, const double solution[COLUMNS])
{
    double left = y[row];
    for (size_t c = 0; c < COLUMNS; ++c)
        left -= x[row * COLUMNS + c] * solution[c];
    return left * left;
}

/* Rows of the other groups over rows √precision, solved by an orthogonal decomposition. */
static double square_by_rows(size_t out, const double *precision)
{
    enum { M = ALL - ROWS + COLUMNS };
    double a[M * COLUMNS] = {0.0}, b[M] = {0.0}, solution[COLUMNS], work[COLUMNS], sum = 0.0;
    double factor[4 * (M + COLUMNS)];
    size_t column[COLUMNS], row = 0;
    hci_orthogonal q = {.m = M, .n = COLUMNS, .a = a, .column = column, .work = factor};
    for (size_t k = 0; k < ALL; ++k) {
        if (k / ROWS == out) continue;
        for (size_t c = 0; c < COLUMNS; ++c)
            a[row + c * M] = x[k * COLUMNS + c];
        b[row++] = y[k];
    }
    for (size_t c = 0; c < COLUMNS; ++c)
        a[row + c + c * M] = sqrt(precision[c]);
    TEST_ASSERT_TRUE(hci_orthogonal_workspace(M, COLUMNS) <= sizeof factor / sizeof *factor);
    TEST_ASSERT_EQUAL(HCI_OK, hci_orthogonal_factor(&q, 0.0, NULL));
    hci_orthogonal_solve(&q, b, solution, work);
    for (size_t k = out * ROWS; k < (out + 1) * ROWS; ++k)
        sum += square_left(k, solution);
    return sum;
}

static void test_one_constant_is_the_mean_of_the_others(void)
{
    const double none = 0.0;
    double square[GROUPS];
    for (size_t k = 0; k < ALL; ++k) {
        x[k] = 1.0;
        y[k] = (double)(k / ROWS); /* group g is g all along; the mean of the others is (10 − g)/4 */
    }
    const hci_groups groups = groups_of(1);
    TEST_ASSERT_TRUE(hci_left_out_squares(&groups, &none, square));
    for (int g = 0; g < GROUPS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, ROWS * pow(g - (10.0 - g) / 4.0, 2.0), square[g]);
}

static void test_squares_are_those_of_the_rows(void)
{
    const double precision[COLUMNS] = {0.0, 0.3, 20.0, 1e-3};
    double square[GROUPS];
    draw(COLUMNS);
    const hci_groups groups = groups_of(COLUMNS);
    TEST_ASSERT_TRUE(hci_left_out_squares(&groups, precision, square));
    for (size_t g = 0; g < GROUPS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, square_by_rows(g, precision), square[g]);
}

/* One constant for all is their mean. */
static void test_all_in_is_the_fit_of_all(void)
{
    const double none = 0.0;
    double square, wanted = 0.0;
    for (size_t k = 0; k < ALL; ++k) {
        x[k] = 1.0;
        y[k] = (double)(k / ROWS);
        wanted += pow(y[k] - 2.0, 2.0);
    }
    const hci_groups groups = groups_of(1);
    TEST_ASSERT_TRUE(hci_all_in_square(&groups, &none, &square));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted, square);
}

/* Without group g the mean of the others fits better by 7 · 4/5 · (g − that mean)². */
static void test_falls_of_the_fit(void)
{
    const double none = 0.0;
    double fall[GROUPS], square[GROUPS], sum = 0.0, all;
    for (size_t k = 0; k < ALL; ++k) {
        x[k] = 1.0;
        y[k] = (double)(k / ROWS);
    }
    const hci_groups groups = groups_of(1);
    TEST_ASSERT_TRUE(hci_left_out_falls(&groups, &none, fall));
    TEST_ASSERT_TRUE(hci_all_in_squares(&groups, &none, square));
    TEST_ASSERT_TRUE(hci_all_in_square(&groups, &none, &all));
    for (int g = 0; g < GROUPS; ++g) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, ROWS * 0.8 * pow(g - (10.0 - g) / 4.0, 2.0), fall[g]);
        sum += square[g];
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, all, sum);
}

/* The sum of the squares of the rows of a fit, and of what is expected of its unknowns, without a group; out
 * GROUPS: of all. x is solved for by the normal equations of these rows, summed here. */
static double least_by_rows(size_t out, const double *precision)
{
    double a[COLUMNS * COLUMNS] = {0.0}, solution[COLUMNS] = {0.0}, sum = 0.0;
    for (size_t c = 0; c < COLUMNS; ++c)
        a[c + c * COLUMNS] = precision[c];
    for (size_t k = 0; k < ALL; ++k)
        for (size_t c = 0; k / ROWS != out && c < COLUMNS; ++c) {
            solution[c] += x[k * COLUMNS + c] * y[k];
            for (size_t j = 0; j < COLUMNS; ++j)
                a[c + j * COLUMNS] += x[k * COLUMNS + c] * x[k * COLUMNS + j];
        }
    TEST_ASSERT_EQUAL(0, hci_cholesky_factor(COLUMNS, a));
    hci_cholesky_solve(COLUMNS, a, solution);
    for (size_t k = 0; k < ALL; ++k)
        if (k / ROWS != out) sum += square_left(k, solution);
    for (size_t c = 0; c < COLUMNS; ++c)
        sum += precision[c] * solution[c] * solution[c];
    return sum;
}

static void test_falls_are_those_of_the_rows(void)
{
    const double precision[COLUMNS] = {0.0, 0.3, 20.0, 1e-3};
    double fall[GROUPS];
    draw(COLUMNS);
    const hci_groups groups = groups_of(COLUMNS);
    TEST_ASSERT_TRUE(hci_left_out_falls(&groups, precision, fall));
    for (size_t g = 0; g < GROUPS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, least_by_rows(GROUPS, precision) - least_by_rows(g, precision),
                                  fall[g]);
}

/* A list may have 4096 recordings: the time goes with their number, not with its square, which would be 4 s
 * where this is 20 ms. */
static void test_many_groups(void)
{
    enum { MANY = 4096, WIDE = 16 };
    static double gram[WIDE * WIDE], moment[WIDE], precision[WIDE], fall[MANY];
    static hci_normal_equations many[MANY];
    const clock_t start = clock();
    for (size_t k = 0; k < WIDE; ++k) {
        gram[k + k * WIDE] = moment[k] = 1.0;
    }
    for (size_t g = 0; g < MANY; ++g)
        many[g] = (hci_normal_equations){.n = WIDE, .gram = gram, .moment = moment, .square = 18.0};
    TEST_ASSERT_TRUE(hci_left_out_falls(&(hci_groups){many, MANY}, precision, fall));
    for (size_t g = 0; g < MANY; ++g) /* x = 1 whichever is left out, and each misses 18 − 32 + 16 */
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, fall[g]);
    TEST_ASSERT_TRUE((double)(clock() - start) < 1.5 * CLOCKS_PER_SEC);
}

/* An unknown that one group alone tells: what that group misses is large, what the fit loses by it is not. */
static void test_what_others_do_not_tell(void)
{
    const double weak[2] = {0.0, 1e-9};
    double fall[GROUPS], square[GROUPS];
    for (size_t k = 0; k < ALL; ++k) {
        x[2 * k] = 1.0;
        x[2 * k + 1] = k / ROWS == 2 ? 1.0 : 0.0;
        y[k] = k / ROWS == 2 ? 50.0 : 1.0;
    }
    const hci_groups groups = groups_of(2);
    TEST_ASSERT_TRUE(hci_left_out_squares(&groups, weak, square));
    TEST_ASSERT_TRUE(hci_left_out_falls(&groups, weak, fall));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, ROWS * 49.0 * 49.0, square[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, fall[2]);
}

/* What is held at 0 leaves the rows as they are. */
static void test_infinite_precision_takes_an_unknown_out(void)
{
    const double all_out[COLUMNS] = {INFINITY, INFINITY, INFINITY, INFINITY};
    double square[GROUPS];
    draw(COLUMNS);
    const hci_groups groups = groups_of(COLUMNS);
    TEST_ASSERT_TRUE(hci_left_out_squares(&groups, all_out, square));
    for (size_t g = 0; g < GROUPS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, group[g].square, square[g]);
}

/* Columns that have nothing to do with y make the error of the fit fall and that of what is left out rise. */
static void test_columns_of_noise_cost(void)
{
    const double free_of_charge[COLUMNS] = {0.0}, held[COLUMNS] = {INFINITY, INFINITY, INFINITY, INFINITY};
    double with = 0.0, without = 0.0, square[GROUPS];
    for (int n = 0; n < 40; ++n) {
        draw(COLUMNS);
        const hci_groups groups = groups_of(COLUMNS);
        TEST_ASSERT_TRUE(hci_left_out_squares(&groups, free_of_charge, square));
        for (int g = 0; g < GROUPS; ++g)
            with += square[g];
        TEST_ASSERT_TRUE(hci_left_out_squares(&groups, held, square));
        for (int g = 0; g < GROUPS; ++g)
            without += square[g];
        tearDown();
    }
    TEST_ASSERT_TRUE(with > 1.05 * without);
}

static void test_memory_runs_out(void)
{
    const double precision[COLUMNS] = {0.0};
    double square[GROUPS];
    draw(COLUMNS);
    const hci_groups groups = groups_of(COLUMNS);
    hci_memory_fail_after(0);
    TEST_ASSERT_FALSE(hci_left_out_squares(&groups, precision, square));
    TEST_ASSERT_FALSE(hci_left_out_falls(&groups, precision, square));
    TEST_ASSERT_FALSE(hci_all_in_squares(&groups, precision, square));
    TEST_ASSERT_FALSE(hci_all_in_square(&groups, precision, square));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_constant_is_the_mean_of_the_others);
    RUN_TEST(test_squares_are_those_of_the_rows);
    RUN_TEST(test_all_in_is_the_fit_of_all);
    RUN_TEST(test_falls_of_the_fit);
    RUN_TEST(test_falls_are_those_of_the_rows);
    RUN_TEST(test_many_groups);
    RUN_TEST(test_what_others_do_not_tell);
    RUN_TEST(test_infinite_precision_takes_an_unknown_out);
    RUN_TEST(test_columns_of_noise_cost);
    RUN_TEST(test_memory_runs_out);
    return UNITY_END();
}
