/* Normal equations and the sweep operator against sums and Gram and Schmidt's method on the rows themselves.
 */
#include "host/numeric/normal_equations.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST_ROWS = 60, MOST_COLUMNS = 24 };

static uint64_t seed;
static size_t rows, columns;
static double x[MOST_ROWS * MOST_COLUMNS], y[MOST_ROWS];
static hci_normal_equations normal;
static hci_sweep sweep;

void setUp(void)
{
    seed = 20240611;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
}

/* ---- problems ---- */

/* Columns of sizes from 1e-3 to 1e3, as torque by ampere and by radian are. */
static void draw(size_t row_count, size_t column_count)
{
    rows = row_count;
    columns = column_count;
    for (size_t c = 0; c < columns; ++c) {
        const double scale = pow(10.0, ref_uniform(&seed, -3.0, 3.0));
        for (size_t k = 0; k < rows; ++k)
            x[k * columns + c] = scale * ref_uniform(&seed, -1.0, 1.0);
    }
    for (size_t k = 0; k < rows; ++k)
        y[k] = ref_uniform(&seed, -1.0, 1.0);
}

/* Another column but for a share `own` of its size. */
static void copy_column(size_t from, size_t to, double factor, double own)
{
    for (size_t k = 0; k < rows; ++k)
        x[k * columns + to] = factor * x[k * columns + from] * (1.0 + own * ref_uniform(&seed, -1.0, 1.0));
}

static void start(void)
{
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, columns));
    hci_normal_equations_add(&normal, x, y, rows);
    hci_normal_equations_finish(&normal);
    TEST_ASSERT_TRUE(hci_sweep_start(&sweep, &normal));
}

static double dot(const double *u, size_t u_stride, const double *v, size_t v_stride)
{
    double sum = 0.0;
    for (size_t k = 0; k < rows; ++k)
        sum += u[k * u_stride] * v[k * v_stride];
    return sum;
}

/* The sum of squares that the columns marked leave, by Gram and Schmidt on the rows themselves. */
static double left_by(const bool *in)
{
    static double q[MOST_COLUMNS + 1][MOST_ROWS];
    double sum = 0.0;
    size_t n = 0;
    for (size_t c = 0; c <= columns; ++c) { /* y is the last */
        if (c < columns && !in[c]) continue;
        for (size_t k = 0; k < rows; ++k)
            q[n][k] = c < columns ? x[k * columns + c] : y[k];
        for (size_t j = 0; j < n; ++j) {
            const double product = dot(q[j], 1, q[n], 1);
            for (size_t k = 0; k < rows; ++k)
                q[n][k] -= product * q[j][k];
        }
        sum = dot(q[n], 1, q[n], 1);
        for (size_t k = 0; k < rows && c < columns; ++k)
            q[n][k] /= sqrt(sum);
        ++n;
    }
    return sum;
}

/* ---- adding rows ---- */

/* Σ u_k v_k over columns of u and v, to rounding. */
static void is_dot(const double *u, size_t u_stride, const double *v, size_t v_stride, double found)
{
    const double size = sqrt(dot(u, u_stride, u, u_stride) * dot(v, v_stride, v, v_stride));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14 * size, dot(u, u_stride, v, v_stride), found);
}

/* In pieces, and for counts that four does not divide. */
static void test_sums_of_any_number_of_rows(void)
{
    for (size_t count = 0; count <= 11; ++count) {
        for (size_t n = 1; n <= 9; n += 4) {
            const size_t part = count / 3;
            draw(count, n);
            hci_normal_equations_release(&normal);
            TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, n));
            hci_normal_equations_add(&normal, x, y, part);
            hci_normal_equations_add(&normal, x + part * n, y + part, count - part);
            hci_normal_equations_finish(&normal);
            TEST_ASSERT_EQUAL_DOUBLE((double)count, normal.rows);
            is_dot(y, 1, y, 1, normal.square);
            for (size_t i = 0; i < n; ++i) {
                is_dot(x + i, n, y, 1, normal.moment[i]);
                for (size_t j = 0; j < n; ++j)
                    is_dot(x + i, n, x + j, n, normal.gram[i * n + j]);
            }
        }
    }
}

/* ---- in and out ---- */

/* After any path in and out: what is left is at right angles to every column that is in, and of the size that
 * Gram and Schmidt find. Tolerances: 1e-16 times the condition of 40 random rows with up to 24 columns, some
 * hundred, times the steps. */
static void test_any_path_gives_the_direct_solution(void)
{
    for (int round = 0; round < 60; ++round) {
        double rest[MOST_ROWS];
        draw(MOST_ROWS - (size_t)ref_integer(&seed, 0, 20), (size_t)ref_integer(&seed, 1, MOST_COLUMNS));
        start();
        for (int step = 0; step < 40; ++step) {
            const size_t k = (size_t)ref_integer(&seed, 0, (int)columns - 1);
            if (sweep.in[k])
                hci_sweep_out(&sweep, k);
            else
                TEST_ASSERT_TRUE(hci_sweep_in(&sweep, k));
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-10 * normal.square, left_by(sweep.in), sweep.square);
        memcpy(rest, y, sizeof rest);
        for (size_t k = 0; k < rows * columns; ++k)
            rest[k / columns] -= sweep.in[k % columns] ? x[k] * sweep.b[k % columns] : 0.0;
        for (size_t c = 0; c < columns; ++c) {
            const double product = dot(x + c, columns, rest, 1);
            const double size = sqrt(normal.gram[c * columns + c]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * size, sweep.in[c] ? 0.0 : sweep.b[c], product);
        }
    }
}

/* Columns in a random order. */
static void shuffle(size_t *order)
{
    for (size_t k = 0; k < columns; ++k) {
        const size_t j = (size_t)ref_integer(&seed, 0, (int)k);
        order[k] = order[j];
        order[j] = k;
    }
}

static void test_out_again_restores_what_was(void)
{
    for (int round = 0; round < 60; ++round) {
        size_t order[MOST_COLUMNS];
        draw(MOST_ROWS, (size_t)ref_integer(&seed, 1, MOST_COLUMNS));
        start();
        shuffle(order);
        for (size_t k = 0; k < columns; ++k)
            TEST_ASSERT_TRUE(hci_sweep_in(&sweep, order[k]));
        shuffle(order);
        for (size_t k = 0; k < columns; ++k)
            hci_sweep_out(&sweep, order[k]);
        hci_sweep_out(&sweep, order[0]); /* it is out: nothing */
        TEST_ASSERT_DOUBLE_WITHIN(1e-11 * normal.square, normal.square, sweep.square);
        for (size_t i = 0; i < columns; ++i) {
            const double size = sqrt(normal.gram[i * columns + i]);
            TEST_ASSERT_FALSE(sweep.in[i]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * size, normal.moment[i], sweep.b[i]);
            for (size_t j = 0; j < columns; ++j)
                TEST_ASSERT_DOUBLE_WITHIN(1e-10 * size * sqrt(normal.gram[j * columns + j]),
                                          normal.gram[i * columns + j], sweep.a[i * columns + j]);
        }
    }
}

/* ---- reduction of the sum of squares ---- */

/* Groups of 1 … 8 columns on top of others that are in: the fall and the rise of the sum of squares. */
static void test_reduction_is_the_fall_of_the_sum_of_squares(void)
{
    for (size_t count = 1; count <= 8; ++count) {
        for (int round = 0; round < 12; ++round) {
            bool in[MOST_COLUMNS];
            draw(MOST_ROWS, count + (size_t)ref_integer(&seed, 0, MOST_COLUMNS - 8));
            const size_t first = (size_t)ref_integer(&seed, 0, (int)(columns - count));
            start();
            for (size_t c = 0; c < columns; ++c) {
                in[c] = (c < first || c >= first + count) && ref_integer(&seed, 0, 1) == 1;
                if (in[c]) hci_sweep_in(&sweep, c);
            }
            const double before = left_by(in);
            for (size_t c = first; c < first + count; ++c)
                in[c] = true;
            const double fall = before - left_by(in);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * normal.square, fall, hci_sweep_reduction(&sweep, first, count));
            for (size_t c = first; c < first + count; ++c)
                hci_sweep_in(&sweep, c);
            TEST_ASSERT_DOUBLE_WITHIN(1e-10 * normal.square, fall, hci_sweep_reduction(&sweep, first, count));
        }
    }
}

/* A column that differs from one that is in by less than a share 1e-9 of its square, and a column of nothing,
 * are refused and change nothing; in a group they add nothing. */
static void test_dependent_columns_add_nothing(void)
{
    double before[MOST_COLUMNS * MOST_COLUMNS];
    for (int twin = 0; twin < 3; ++twin) {
        static const double OWN[] = {0.0, 1e-7, 2e-5};
        draw(50, 8);
        copy_column(1, 4, -2.5, OWN[twin]);
        copy_column(1, 6, 0.0, 0.0);
        start();
        TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_sweep_reduction(&sweep, 6, 1));
        TEST_ASSERT_TRUE(hci_sweep_in(&sweep, 1));
        const double with = hci_sweep_reduction(&sweep, 3, 1), square = sweep.square;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, with, hci_sweep_reduction(&sweep, 3, 2));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_sweep_reduction(&sweep, 5, 1),
                                  hci_sweep_reduction(&sweep, 5, 2));
        memcpy(before, sweep.a, columns * columns * sizeof *before);
        TEST_ASSERT_FALSE(hci_sweep_in(&sweep, 4));
        TEST_ASSERT_FALSE(hci_sweep_in(&sweep, 6));
        TEST_ASSERT_FALSE(hci_sweep_in(&sweep, 1)); /* it is in */
        TEST_ASSERT_EQUAL_INT(0, memcmp(before, sweep.a, columns * columns * sizeof *before));
        TEST_ASSERT_EQUAL_DOUBLE(square, sweep.square);
        copy_column(1, 3, 3.0, OWN[twin]); /* twins in one group that is out */
        start();
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_sweep_reduction(&sweep, 3, 1),
                                  hci_sweep_reduction(&sweep, 3, 2));
    }
    copy_column(1, 4, 1.0, 2e-4); /* 1e-8 of its square are its own: enough */
    start();
    TEST_ASSERT_TRUE(hci_sweep_in(&sweep, 1) && hci_sweep_in(&sweep, 4));
}

/* ---- copies and memory ---- */

static void test_a_copy_goes_its_own_way(void)
{
    hci_sweep other = {0};
    draw(40, 5);
    start();
    hci_sweep_in(&sweep, 2);
    TEST_ASSERT_TRUE(hci_sweep_start(&other, &normal));
    hci_sweep_copy(&other, &sweep);
    hci_sweep_in(&sweep, 0);
    TEST_ASSERT_TRUE(other.in[2] && !other.in[0]);
    hci_sweep_in(&other, 0);
    TEST_ASSERT_EQUAL_DOUBLE(sweep.square, other.square);
    TEST_ASSERT_EQUAL_INT(0, memcmp(sweep.a, other.a, 25 * sizeof *other.a));
    hci_sweep_release(&other);
}

static void test_memory_is_out(void)
{
    draw(4, 3);
    for (long n = 0; n < 2; ++n) {
        hci_memory_fail_after(n);
        TEST_ASSERT_FALSE(hci_normal_equations_start(&normal, columns));
        TEST_ASSERT_NULL(normal.gram);
    }
    hci_memory_fail_after(-1);
    start();
    hci_sweep_release(&sweep);
    for (long n = 0; n < 2; ++n) {
        hci_memory_fail_after(n);
        TEST_ASSERT_FALSE(hci_sweep_start(&sweep, &normal));
        TEST_ASSERT_NULL(sweep.a);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sums_of_any_number_of_rows);
    RUN_TEST(test_any_path_gives_the_direct_solution);
    RUN_TEST(test_out_again_restores_what_was);
    RUN_TEST(test_reduction_is_the_fall_of_the_sum_of_squares);
    RUN_TEST(test_dependent_columns_add_nothing);
    RUN_TEST(test_a_copy_goes_its_own_way);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
