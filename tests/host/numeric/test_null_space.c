/* All solutions of linear equations: they meet them, the point is the shortest, and rows that depend on
 * others or contradict them are noticed. */
#include "host/numeric/null_space.h"

#include <math.h>

#include "support/draws.h"
#include "unity.h"

enum { ROWS = 5, UNKNOWNS = 8 };

static double a[ROWS * UNKNOWNS], b[ROWS];
static uint64_t seed;

void setUp(void)
{
    seed = 51;
    for (int k = 0; k < ROWS * UNKNOWNS; ++k)
        a[k] = ref_uniform(&seed, -1.0, 1.0);
    for (int k = 0; k < ROWS; ++k)
        b[k] = ref_uniform(&seed, -3.0, 3.0);
}

void tearDown(void)
{
}

static double product(const double *x, const double *y)
{
    double sum = 0.0;
    for (int k = 0; k < UNKNOWNS; ++k)
        sum += x[k] * y[k];
    return sum;
}

/* Row i of A times x. */
static double row(size_t i, const double *x)
{
    double sum = 0.0;
    for (size_t j = 0; j < UNKNOWNS; ++j)
        sum += a[i + j * ROWS] * x[j];
    return sum;
}

static void meets(size_t dependent)
{
    hci_null_space s = {0};
    double y[UNKNOWNS], x[UNKNOWNS];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_null_space_make(ROWS, UNKNOWNS, a, b, &s));
    TEST_ASSERT_EQUAL_UINT64(UNKNOWNS - ROWS + dependent, s.free);
    TEST_ASSERT_TRUE(s.error < 1e-13);
    for (size_t i = 0; i < s.free; ++i) {
        const double *u = s.basis + i * UNKNOWNS;
        for (size_t j = 0; j < s.free; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, i == j, product(u, s.basis + j * UNKNOWNS));
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 0.0, product(u, s.point)); /* so the point is the shortest */
        y[i] = ref_uniform(&seed, -2.0, 2.0);
    }
    hci_null_space_point(&s, y, x);
    for (size_t i = 0; i < ROWS; ++i)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, b[i], row(i, x));
    for (size_t k = 0; k < UNKNOWNS; ++k)
        x[k] -= s.point[k];
    for (size_t j = 0; j < s.free; ++j)
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, y[j], product(s.basis + j * UNKNOWNS, x));
    hci_null_space_release(&s);
    TEST_ASSERT_NULL(s.point);
}

/* Row `to` as a sum of the first two, its right side off by so much. */
static void depend(size_t to, double off)
{
    for (size_t j = 0; j < UNKNOWNS; ++j)
        a[to + j * ROWS] = 2.0 * a[j * ROWS] - 3.0 * a[1 + j * ROWS];
    b[to] = 2.0 * b[0] - 3.0 * b[1] + off;
}

static void test_equations_are_met(void)
{
    meets(0);
    depend(3, 0.0);
    meets(1);
    depend(4, 0.0);
    meets(2);
}

/* A contradiction shows in the error: 2.5 in one row, as a share of the largest right side. */
static void test_a_contradiction_is_noticed(void)
{
    hci_null_space s = {0};
    double largest = 0.0, error = 0.0;
    depend(2, 2.5);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_null_space_make(ROWS, UNKNOWNS, a, b, &s));
    TEST_ASSERT_EQUAL_UINT64(UNKNOWNS - ROWS + 1, s.free);
    for (size_t i = 0; i < ROWS; ++i) {
        largest = fmax(largest, fabs(b[i]));
        error = fmax(error, fabs(row(i, s.point) - b[i]));
    }
    TEST_ASSERT_TRUE(error > 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, error / largest, s.error);
    hci_null_space_release(&s);
}

/* ½x = 1 and x = 5, in either order: the longer one is met, and the other is off by 1.5 of at most 5. */
static void test_a_contradiction_is_noticed_in_any_row(void)
{
    const double factor[2][2] = {{0.5, 1.0}, {1.0, 0.5}}, side[2][2] = {{1.0, 5.0}, {5.0, 1.0}};
    for (int k = 0; k < 2; ++k) {
        hci_null_space s = {0};
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_null_space_make(2, 1, factor[k], side[k], &s));
        TEST_ASSERT_EQUAL_UINT64(0, s.free);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 5.0, s.point[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.3, s.error);
        hci_null_space_release(&s);
    }
}

static void test_no_equation_no_condition(void)
{
    const double zero[ROWS] = {0.0};
    hci_null_space s = {0};
    double y[3] = {1.0, -2.0, 3.0}, x[3];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_null_space_make(0, 3, NULL, NULL, &s));
    TEST_ASSERT_EQUAL_UINT64(3, s.free);
    hci_null_space_point(&s, y, x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 14.0, x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    hci_null_space_release(&s);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_null_space_make(ROWS, UNKNOWNS, a, zero, &s));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.error);
    for (size_t k = 0; k < UNKNOWNS; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, s.point[k]);
    hci_null_space_release(&s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_equations_are_met);
    RUN_TEST(test_a_contradiction_is_noticed);
    RUN_TEST(test_a_contradiction_is_noticed_in_any_row);
    RUN_TEST(test_no_equation_no_condition);
    return UNITY_END();
}
