/* Groups of rows in few numbers: they say the same as their rows, and those that tell the same are joined. */
#include "host/numeric/condensed.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { N = 6, ROWS = 9 };

static const double UNIT[N] = {1.0, 0.5, 2.0, 1.0, 3.0, 1.0};

static hci_condensed all;
static uint64_t seed;

void setUp(void)
{
    seed = 61;
    all = (hci_condensed){0};
}

void tearDown(void)
{
    hci_condensed_release(&all);
}

/* Rows that tell of the unknowns with a bit in `of`, and of as many sums of them as `rank`. */
static void draw(unsigned of, int rank, hci_normal_equations *g)
{
    double x[ROWS * N] = {0.0}, y[ROWS], direction[N][N];
    for (int r = 0; r < rank; ++r)
        for (int k = 0; k < N; ++k)
            direction[r][k] = of >> k & 1u ? ref_uniform(&seed, -1.0, 1.0) : 0.0;
    for (int i = 0; i < ROWS; ++i) {
        y[i] = ref_uniform(&seed, -2.0, 2.0);
        for (int r = 0; r < rank; ++r) {
            const double share = ref_uniform(&seed, -1.0, 1.0);
            for (int k = 0; k < N; ++k)
                x[i * N + k] += share * direction[r][k];
        }
    }
    TEST_ASSERT_TRUE(hci_normal_equations_start(g, N));
    hci_normal_equations_add(g, x, y, ROWS);
    hci_normal_equations_finish(g);
}

/* XᵀX = F Fᵀ, Xᵀy = F g, yᵀy = gᵀg + rest. */
static void says_the_same(const hci_condensed_group *c, const hci_normal_equations *g)
{
    double square = c->rest;
    for (size_t i = 0; i < N; ++i) {
        double moment = 0.0;
        for (size_t r = 0; r < c->rank; ++r)
            moment += c->factor[i * c->rank + r] * c->moment[r];
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, g->moment[i], moment);
        for (size_t j = 0; j < N; ++j) {
            double sum = 0.0;
            for (size_t r = 0; r < c->rank; ++r)
                sum += c->factor[i * c->rank + r] * c->factor[j * c->rank + r];
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, g->gram[i * N + j], sum);
        }
    }
    for (size_t r = 0; r < c->rank; ++r)
        square += c->moment[r] * c->moment[r];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, g->square, square);
    TEST_ASSERT_EQUAL_DOUBLE(g->rows, c->rows);
}

static void test_a_group_says_the_same_in_fewer_numbers(void)
{
    static const unsigned OF[] = {0x3F, 0x3F, 0x07, 0x2A, 0x00};
    static const int RANK[] = {6, 2, 3, 1, 0};
    hci_normal_equations g[5], sum = {0};
    TEST_ASSERT_TRUE(hci_condensed_start(&all, N, 5));
    TEST_ASSERT_TRUE(hci_normal_equations_start(&sum, N));
    for (int k = 0; k < 5; ++k) {
        draw(OF[k], RANK[k], &g[k]);
        TEST_ASSERT_TRUE(hci_condensed_add(&all, &g[k], UNIT));
        TEST_ASSERT_EQUAL_UINT64((size_t)RANK[k], all.group[k].rank);
        says_the_same(&all.group[k], &g[k]);
        for (int i = 0; i < N * N; ++i)
            sum.gram[i] += g[k].gram[i];
        for (int i = 0; i < N; ++i)
            sum.moment[i] += g[k].moment[i];
        hci_normal_equations_release(&g[k]);
    }
    TEST_ASSERT_EQUAL_UINT64(5, all.count);
    for (int i = 0; i < N * N; ++i)
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, sum.gram[i], all.gram[i]);
    for (int i = 0; i < N; ++i)
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, sum.moment[i], all.moment[i]);
    hci_normal_equations_release(&sum);
}

/* A column whose regressor at its expected size is 1e-7 of the largest is left out, 1e-5 is not. */
static void test_what_is_small_is_left_out(void)
{
    for (int small = 0; small < 2; ++small) {
        const double x[2 * N] = {3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, small ? 6e-7 : 6e-5, 0.0, 0.0, 0.0, 0.0};
        const double y[2] = {1.0, 1.0};
        hci_normal_equations g = {0};
        hci_condensed one = {0};
        TEST_ASSERT_TRUE(hci_normal_equations_start(&g, N));
        hci_normal_equations_add(&g, x, y, 2);
        hci_normal_equations_finish(&g);
        TEST_ASSERT_TRUE(hci_condensed_start(&one, N, 1));
        TEST_ASSERT_TRUE(hci_condensed_add(&one, &g, UNIT));
        TEST_ASSERT_EQUAL_UINT64(small ? 1 : 2, one.group[0].rank);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, small ? 1.0 : 0.0, one.group[0].rest);
        hci_condensed_release(&one);
        hci_normal_equations_release(&g);
    }
}

/* Of five groups the first, third and fifth are the same rows twice over; the others stay alone. */
static void test_groups_that_tell_the_same_are_joined(void)
{
    hci_normal_equations g[3];
    hci_condensed joined = {0};
    size_t of[5];
    static const unsigned OF[] = {0x07, 0x38, 0x2A};
    static const int WHICH[] = {0, 1, 0, 2, 0};
    TEST_ASSERT_TRUE(hci_condensed_start(&all, N, 5));
    for (int k = 0; k < 3; ++k)
        draw(OF[k], 2, &g[k]);
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_TRUE(hci_condensed_add(&all, &g[WHICH[k]], UNIT));
    TEST_ASSERT_TRUE(hci_condensed_join(&all, UNIT, 0.999, &joined, of));
    TEST_ASSERT_EQUAL_UINT64(3, joined.count);
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_UINT64((size_t)WHICH[k], of[k]);
    for (int i = 0; i < N * N; ++i)
        g[0].gram[i] *= 3.0;
    for (int i = 0; i < N; ++i)
        g[0].moment[i] *= 3.0;
    g[0].square *= 3.0;
    g[0].rows *= 3.0;
    for (int k = 0; k < 3; ++k) {
        says_the_same(&joined.group[k], &g[k]);
        hci_normal_equations_release(&g[k]);
    }
    for (int i = 0; i < N * N; ++i)
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, all.gram[i], joined.gram[i]);
    hci_condensed_release(&joined);
}

/* Two groups of a row each: the cosine of their XᵀX decides, each unknown in units of what both tell. */
static void test_how_alike_is_a_cosine(void)
{
    for (int k = 0; k < 2; ++k) {
        const double rows[2][2 * N] = {{1.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                                       {0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
        /* told: 1.04 of each; F_a = (1, .2), F_b = (.2, 1): x = 0.4/1.04 against 1.04/1.04, its square 0.148
         */
        const double y[2] = {1.0, 0.0}, unit[N] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
        const double cosine = pow(0.4 / 1.04, 2.0), least = k ? 1.01 * cosine : 0.99 * cosine;
        hci_condensed joined = {0}, two = {0};
        size_t of[2];
        TEST_ASSERT_TRUE(hci_condensed_start(&two, N, 2));
        for (int j = 0; j < 2; ++j) {
            hci_normal_equations g = {0};
            TEST_ASSERT_TRUE(hci_normal_equations_start(&g, N));
            hci_normal_equations_add(&g, rows[j], y, 2);
            hci_normal_equations_finish(&g);
            TEST_ASSERT_TRUE(hci_condensed_add(&two, &g, unit));
            hci_normal_equations_release(&g);
        }
        TEST_ASSERT_TRUE(hci_condensed_join(&two, unit, least, &joined, of));
        TEST_ASSERT_EQUAL_UINT64(k ? 2 : 1, joined.count);
        hci_condensed_release(&joined);
        hci_condensed_release(&two);
    }
}

/* A group of one direction, f, and one of that and another one, e: told is 2 and 0.66, and both groups' XᵀX
 * over it has the entries a and b. Just below their cosine they are joined. */
static void test_a_second_direction_is_compared_with_the_first(void)
{
    const double rows[2][2 * N] = {{1.0, 0.5}, {1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.4}};
    const double y[2] = {1.0, 0.0}, unit[N] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const double a[3] = {0.5, 0.5 / sqrt(2.0 * 0.66), 0.25 / 0.66}, b[3] = {a[0], a[1], 0.41 / 0.66};
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (int k = 0; k < 3; ++k) { /* the entry beside the diagonal is there twice */
        ab += (k == 1 ? 2.0 : 1.0) * a[k] * b[k];
        aa += (k == 1 ? 2.0 : 1.0) * a[k] * a[k];
        bb += (k == 1 ? 2.0 : 1.0) * b[k] * b[k];
    }
    for (int k = 0; k < 2; ++k) {
        hci_condensed joined = {0}, two = {0};
        size_t of[2];
        TEST_ASSERT_TRUE(hci_condensed_start(&two, N, 2));
        for (int j = 0; j < 2; ++j) {
            hci_normal_equations g = {0};
            TEST_ASSERT_TRUE(hci_normal_equations_start(&g, N));
            hci_normal_equations_add(&g, rows[j], y, 2);
            hci_normal_equations_finish(&g);
            TEST_ASSERT_TRUE(hci_condensed_add(&two, &g, unit));
            hci_normal_equations_release(&g);
        }
        const double least = (k ? 1.001 : 0.999) * ab / sqrt(aa * bb);
        TEST_ASSERT_TRUE(hci_condensed_join(&two, unit, least, &joined, of));
        TEST_ASSERT_EQUAL_UINT64(k ? 2 : 1, joined.count);
        hci_condensed_release(&joined);
        hci_condensed_release(&two);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_group_says_the_same_in_fewer_numbers);
    RUN_TEST(test_what_is_small_is_left_out);
    RUN_TEST(test_groups_that_tell_the_same_are_joined);
    RUN_TEST(test_how_alike_is_a_cosine);
    RUN_TEST(test_a_second_direction_is_compared_with_the_first);
    return UNITY_END();
}
