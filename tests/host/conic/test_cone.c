/* Convex programs: against answers by hand, and at random against the conditions of Karush, Kuhn and Tucker,
 * which say of any x and z whether they are the answer. */
#include "host/conic/solve.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

static hci_cone_answer answer;

void setUp(void)
{
}

void tearDown(void)
{
    hci_cone_answer_release(&answer);
}

static void solve(const hci_cone_problem *p)
{
    hci_note note = {{0}};
    hci_cone_answer_release(&answer);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_cone_solve(p, &answer, &note), note.text);
}

/* ---- by hand ---- */

/* x + 2y is largest under |x| <= 1, −1 <= y <= 3, x + y <= 3.5 at (0.5, 3): multipliers 1 and 1. */
static void test_a_linear_program(void)
{
    const double c[] = {-1, -2}, g[] = {1, 0, 1, 0, 1, 1}, h[] = {1, 3, 3.5}, low[] = {-1, -1};
    const hci_cone_problem p = {
        .unknowns = 2, .c = c, .rows = 3, .two_sided = 2, .linear = 3, .g = g, .h = h, .low = low};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_SOLVED, answer.end);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, answer.x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, answer.x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.0, answer.z[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 1.0, answer.z[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 1.0, answer.z[2]);
}

/* At a lower bound the multiplier is negative: x >= 2 costs 1 for each 1 that it is raised. */
static void test_a_lower_bound(void)
{
    const double c[] = {1}, g[] = {1}, h[] = {5}, low[] = {2};
    const hci_cone_problem p = {
        .unknowns = 1, .c = c, .rows = 1, .two_sided = 1, .linear = 1, .g = g, .h = h, .low = low};
    solve(&p);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, answer.x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, -1.0, answer.z[0]);
}

/* The point of x + y + z = 3, x − y = 1 (named twice) nearest to 0: (1.5, 0.5, 1). */
static void test_equations_alone(void)
{
    const double p_[] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, c[] = {0, 0, 0}, a[] = {1, 1, 2, 1, -1, -2, 1, 0, 0},
                 b[] = {3, 1, 2}, g[] = {1, 0, 0}, h[] = {100};
    const hci_cone_problem p = {.unknowns = 3,
                                .p = p_,
                                .c = c,
                                .equalities = 3,
                                .a = a,
                                .b = b,
                                .rows = 1,
                                .linear = 1,
                                .g = g,
                                .h = h};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_SOLVED, answer.end);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, answer.x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, answer.x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, answer.x[2]);
}

/* 3x + 4y is largest in the circle |(x, y)| <= 2 at (1.2, 1.6): 10, and 5 for each 1 of radius. */
static void test_a_circle(void)
{
    const double c[] = {-3, -4}, g[] = {0, -1, 0, 0, 0, -1}, h[] = {2, 0, 0};
    const size_t size[] = {3};
    const hci_cone_problem p = {.unknowns = 2, .c = c, .rows = 3, .g = g, .h = h, .cones = 1, .cone = size};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_SOLVED, answer.end);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 1.2, answer.x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 1.6, answer.x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 5.0, answer.z[0]);
}

/* The smallest t with |x − 1| <= t, |x + 1| <= t: 1, at x = 0, though the cone is touched at a corner. */
static void test_the_smallest_worst(void)
{
    const double c[] = {0, 1}, g[] = {0, -1, 0, -1, -1, 0, -1, 0}, h[] = {0, -1, 0, 1};
    const size_t size[] = {2, 2};
    const hci_cone_problem p = {.unknowns = 2, .c = c, .rows = 4, .g = g, .h = h, .cones = 2, .cone = size};
    solve(&p);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, answer.x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, answer.x[1]);
}

/* ---- no answer ---- */

/* x >= 2 and x <= 1; the multipliers prove it: G'z = 0, h·z < 0. */
static void test_rows_that_exclude_each_other(void)
{
    const double c[] = {1, -1}, g[] = {1, -1, 0, 0, 0, 1}, h[] = {1, -2, 1};
    const hci_cone_problem p = {.unknowns = 2, .c = c, .rows = 3, .linear = 3, .g = g, .h = h};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_INFEASIBLE, answer.end);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * answer.z[0], answer.z[0], answer.z[1]);
    TEST_ASSERT_TRUE(answer.z[0] > 0.0);
}

static void test_equations_that_exclude_each_other(void)
{
    const double c[] = {1, 1}, a[] = {1, 1, 1, 1}, b[] = {1, 2}, g[] = {1, 0}, h[] = {1};
    const hci_cone_problem p = {
        .unknowns = 2, .c = c, .equalities = 2, .a = a, .b = b, .rows = 1, .linear = 1, .g = g, .h = h};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_INFEASIBLE, answer.end);
}

static void test_an_objective_without_end(void)
{
    const double c[] = {-1, 0}, g[] = {-1, 0, 0, 1}, h[] = {0, 1};
    const hci_cone_problem p = {.unknowns = 2, .c = c, .rows = 2, .linear = 2, .g = g, .h = h};
    solve(&p);
    TEST_ASSERT_EQUAL(HCI_CONE_UNBOUNDED, answer.end);
    TEST_ASSERT_TRUE(answer.error > 1e300); /* there is no point that answers */
}

static void test_memory_runs_out(void)
{
    const double c[] = {1}, g[] = {1}, h[] = {5}, low[] = {2};
    const hci_cone_problem p = {
        .unknowns = 1, .c = c, .rows = 1, .two_sided = 1, .linear = 1, .g = g, .h = h, .low = low};
    hci_status status = HCI_ERROR_MEMORY;
    for (long k = 0; status && k < 20; ++k) {
        hci_note note = {{0}};
        hci_cone_answer_release(&answer);
        hci_memory_fail_after(k);
        status = hci_cone_solve(&p, &answer, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(!status || (status == HCI_ERROR_MEMORY && note.text[0]));
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
}

/* ---- at random ---- */

enum { MOST_N = 24, MOST_ROWS = 280, MOST_EQUALITIES = 6 };

static uint64_t seed;
static bool has_balls; /* cones of many rows whose head is a number: |…| <= radius */
static double p_[MOST_N * MOST_N], c_[MOST_N], a_[MOST_EQUALITIES * MOST_N], b_[MOST_EQUALITIES],
    g_[MOST_ROWS * MOST_N], h_[MOST_ROWS], low_[MOST_ROWS];
static size_t size_[8];
static hci_cone_problem random_problem;

static double draw(void)
{
    return ref_uniform(&seed, -1.0, 1.0);
}

static size_t count(size_t low, size_t high)
{
    return low + (size_t)ref_uniform(&seed, 0.0, (double)(high - low) + 0.999);
}

/* Whether row k is the head of a ball. */
static bool is_of_ball(size_t k)
{
    size_t at = random_problem.linear;
    for (size_t q = 0; has_balls && q < random_problem.cones; at += size_[q++])
        if (k == at) return true;
    return false;
}

/* A point x0 inside of every row and on every equation makes the program solvable. The box |x| <= 3 makes it
 * bounded; half of the programs have a P, of low rank. */
static void make_random(void)
{
    hci_cone_problem *p = &random_problem;
    double x0[MOST_N];
    size_t at;
    memset(p, 0, sizeof *p);
    p->unknowns = count(2, MOST_N);
    p->equalities = count(0, p->unknowns > MOST_EQUALITIES ? MOST_EQUALITIES : 1);
    p->two_sided = p->unknowns + count(0, 20);
    p->linear = p->two_sided + count(0, 60);
    p->cones = count(0, 8);
    p->rows = p->linear;
    for (size_t k = 0; k < p->cones; ++k)
        p->rows += size_[k] = has_balls ? count(15, 20) : count(2, 6);
    for (size_t j = 0; j < p->unknowns; ++j) {
        x0[j] = draw();
        c_[j] = draw();
    }
    for (size_t k = 0; k < p->rows; ++k) {
        double value = 0.0;
        for (size_t j = 0; j < p->unknowns; ++j) {
            const double g = k < p->unknowns ? (double)(k == j) : is_of_ball(k) ? 0.0 : draw();
            g_[k + j * p->rows] = g;
            value += g * x0[j];
        }
        h_[k] = k < p->unknowns ? 3.0 : value + (k < p->linear ? ref_uniform(&seed, 0.0, 0.5) : 0.1 * draw());
        if (k < p->two_sided) low_[k] = k < p->unknowns ? -3.0 : value - ref_uniform(&seed, 0.0, 0.5);
    }
    at = p->linear;
    for (size_t k = 0; k < p->cones; at += size_[k++])
        h_[at] += 0.1 * sqrt((double)size_[k]) + ref_uniform(&seed, 0.01, 0.5);
    for (size_t k = 0; k < p->equalities; ++k) {
        b_[k] = 0.0;
        for (size_t j = 0; j < p->unknowns; ++j) {
            a_[k + j * p->equalities] = draw();
            b_[k] += a_[k + j * p->equalities] * x0[j];
        }
    }
    if (draw() > 0.0) {
        memset(p_, 0, sizeof p_);
        for (size_t r = 0; r < p->unknowns / 2; ++r) {
            double v[MOST_N];
            for (size_t j = 0; j < p->unknowns; ++j)
                v[j] = draw();
            for (size_t i = 0; i < p->unknowns; ++i)
                for (size_t j = 0; j < p->unknowns; ++j)
                    p_[i + j * p->unknowns] += v[i] * v[j];
        }
        p->p = p_;
    }
    p->c = c_, p->a = a_, p->b = b_, p->g = g_, p->h = h_, p->low = low_, p->cone = size_;
}

/* What is left of a vector without its parts along the rows of A. */
static double length_across(double *r)
{
    const hci_cone_problem *p = &random_problem;
    double q[MOST_EQUALITIES][MOST_N], sum = 0.0;
    for (size_t k = 0; k < p->equalities; ++k) {
        double length = 0.0;
        for (size_t j = 0; j < p->unknowns; ++j)
            q[k][j] = a_[k + j * p->equalities];
        for (size_t i = 0; i < 2 * k; ++i) {
            double along = 0.0;
            for (size_t j = 0; j < p->unknowns; ++j)
                along += q[i % k][j] * q[k][j];
            for (size_t j = 0; j < p->unknowns; ++j)
                q[k][j] -= along * q[i % k][j];
        }
        for (size_t j = 0; j < p->unknowns; ++j)
            length += q[k][j] * q[k][j];
        for (size_t j = 0; j < p->unknowns; ++j)
            q[k][j] /= sqrt(length);
    }
    for (size_t k = 0; k < p->equalities; ++k) {
        double along = 0.0;
        for (size_t j = 0; j < p->unknowns; ++j)
            along += q[k][j] * r[j];
        for (size_t j = 0; j < p->unknowns; ++j)
            r[j] -= along * q[k][j];
    }
    for (size_t j = 0; j < p->unknowns; ++j)
        sum += r[j] * r[j];
    return sqrt(sum);
}

static double slack(size_t k, bool lower)
{
    double value = 0.0;
    for (size_t j = 0; j < random_problem.unknowns; ++j)
        value += g_[k + j * random_problem.rows] * answer.x[j];
    return lower ? value - low_[k] : h_[k] - value;
}

static void check_stationary(double most)
{
    const hci_cone_problem *p = &random_problem;
    double r[MOST_N];
    for (size_t j = 0; j < p->unknowns; ++j) {
        r[j] = c_[j];
        for (size_t k = 0; k < p->rows; ++k)
            r[j] += g_[k + j * p->rows] * answer.z[k];
        for (size_t i = 0; p->p && i < p->unknowns; ++i)
            r[j] += p_[j + i * p->unknowns] * answer.x[i];
    }
    TEST_ASSERT_DOUBLE_WITHIN(most, 0.0, length_across(r));
}

static void check_linear(double most)
{
    const hci_cone_problem *p = &random_problem;
    for (size_t k = 0; k < p->linear; ++k) {
        const double above = slack(k, false), z = answer.z[k];
        TEST_ASSERT_TRUE(above > -most);
        const double below = k < p->two_sided ? slack(k, true) : HUGE_VAL;
        TEST_ASSERT_TRUE(below > -most && (k < p->two_sided || z > -most));
        TEST_ASSERT_DOUBLE_WITHIN(most, 0.0, z > 0.0 ? z * above : k < p->two_sided ? z * below : z);
    }
}

static void check_cones(double most)
{
    size_t at = random_problem.linear;
    for (size_t k = 0; k < random_problem.cones; at += size_[k++]) {
        double s_side = 0.0, z_side = 0.0, product = 0.0;
        for (size_t i = 0; i < size_[k]; ++i) {
            const double s = slack(at + i, false), z = answer.z[at + i];
            product += s * z;
            s_side += i > 0 ? s * s : 0.0;
            z_side += i > 0 ? z * z : 0.0;
        }
        TEST_ASSERT_TRUE(slack(at, false) > sqrt(s_side) - most);
        TEST_ASSERT_TRUE(answer.z[at] > sqrt(z_side) - most);
        TEST_ASSERT_DOUBLE_WITHIN(most, 0.0, product);
    }
}

/* Returns the steps of all of them. */
static size_t solve_random(uint64_t programs)
{
    size_t steps = 0;
    for (seed = 1; seed <= programs; ++seed) {
        const uint64_t now = seed;
        make_random();
        seed = now;
        solve(&random_problem);
        TEST_ASSERT_EQUAL(HCI_CONE_SOLVED, answer.end);
        TEST_ASSERT_TRUE(answer.error <= 1e-10 && answer.steps <= 40);
        check_stationary(1e-8);
        check_linear(1e-8);
        check_cones(1e-8);
        steps += answer.steps;
    }
    return steps;
}

/* A method of predictor and corrector takes few steps, hardly more with more rows. */
static void test_random_programs(void)
{
    TEST_ASSERT_TRUE(solve_random(400) <= 5430); /* 5384 */
}

/* The same where cones are balls, whose products are made once. */
static void test_random_balls(void)
{
    has_balls = true;
    TEST_ASSERT_TRUE(solve_random(200) <= 2940); /* 2909 */
    has_balls = false;
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_linear_program);
    RUN_TEST(test_a_lower_bound);
    RUN_TEST(test_equations_alone);
    RUN_TEST(test_a_circle);
    RUN_TEST(test_the_smallest_worst);
    RUN_TEST(test_rows_that_exclude_each_other);
    RUN_TEST(test_equations_that_exclude_each_other);
    RUN_TEST(test_an_objective_without_end);
    RUN_TEST(test_memory_runs_out);
    RUN_TEST(test_random_programs);
    RUN_TEST(test_random_balls);
    return UNITY_END();
}
