/* Anderson's acceleration on iterations whose fixed point is known. */
#include "host/numeric/anderson.h"

#include <math.h>

#include "host/base/memory.h"
#include "unity.h"

enum { N = 4 };

static const double FACTOR[N] = {-1.8, 0.5, -0.9, 0.1}, POINT[N] = {1.0, -2.0, 3.0, 0.5};

void setUp(void)
{
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* g(x) = p + A (x − p), diagonal: the first coordinate swings and diverges by itself. */
static double answer(const double *x, double *g)
{
    double distance = 0.0;
    for (int k = 0; k < N; ++k) {
        g[k] = POINT[k] + FACTOR[k] * (x[k] - POINT[k]);
        distance = fmax(distance, fabs(x[k] - POINT[k]));
    }
    return distance;
}

/* On a linear iteration in n unknowns the n + 1 steps that span it lead to the fixed point. */
static void test_a_linear_iteration_that_diverges_ends_at_its_fixed_point(void)
{
    hci_anderson mixing = {0};
    double x[N] = {0.0}, g[N];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_anderson_reset(&mixing, N));
    for (int step = 0; step < N + 2; ++step) {
        answer(x, g);
        hci_anderson_step(&mixing, x, g);
    }
    TEST_ASSERT_TRUE(answer(x, g) < 1e-9);
    hci_anderson_release(&mixing);
}

static void test_the_first_step_goes_to_the_answer(void)
{
    hci_anderson mixing = {0};
    double x[N] = {0.0}, g[N];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_anderson_reset(&mixing, N));
    answer(x, g);
    hci_anderson_step(&mixing, x, g);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(g[k], x[k]);
    hci_anderson_release(&mixing);
}

/* A reset forgets: the step after it is a first step again. */
static void test_a_reset_forgets(void)
{
    hci_anderson mixing = {0};
    double x[N] = {0.0}, g[N];
    for (int round = 0; round < 2; ++round) {
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_anderson_reset(&mixing, N));
        for (int step = 0; step < 3; ++step) {
            answer(x, g);
            if (step == 0) x[0] = 0.0;
            hci_anderson_step(&mixing, x, g);
            if (step > 0) continue;
            for (int k = 1; k < N; ++k)
                TEST_ASSERT_EQUAL_DOUBLE(g[k], x[k]);
        }
    }
    hci_anderson_release(&mixing);
}

/* x = cos x in each unknown, from different places; more steps than are remembered. */
static void test_a_nonlinear_iteration(void)
{
    hci_anderson mixing = {0};
    double x[2] = {0.0, 1.5}, g[2];
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_anderson_reset(&mixing, 2));
    for (int step = 0; step < 12; ++step) {
        g[0] = cos(x[0]);
        g[1] = cos(x[1]);
        hci_anderson_step(&mixing, x, g);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.73908513321516064, x[0]); /* bare, twelve steps leave 1e-2 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.73908513321516064, x[1]);
    hci_anderson_release(&mixing);
}

static void test_memory_that_runs_out(void)
{
    hci_anderson mixing = {0};
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_anderson_reset(&mixing, N));
    hci_anderson_release(&mixing);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_linear_iteration_that_diverges_ends_at_its_fixed_point);
    RUN_TEST(test_the_first_step_goes_to_the_answer);
    RUN_TEST(test_a_reset_forgets);
    RUN_TEST(test_a_nonlinear_iteration);
    RUN_TEST(test_memory_that_runs_out);
    return UNITY_END();
}
