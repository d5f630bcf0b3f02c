/* Minimax and exchange of components on small systems that are made here, against searches that need no
 * cleverness: the smallest worst order of a convex function by nested golden sections, and all subsets one by
 * one. */
#include "host/solve/minimax.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/subset.h"
#include "support/reference.h"
#include "unity.h"

enum { CANDIDATES = 7, UNKNOWNS = 2 * CANDIDATES, ORDERS = 5, ROWS = 2 * ORDERS - 1 };

#define RIDGE 1e-3

static double order[ORDERS], weight[ROWS], h[2 * ROWS], value[UNKNOWNS * ROWS];
static int64_t column_start[UNKNOWNS + 1], row[UNKNOWNS * ROWS];
static hci_component component[CANDIDATES];
static hci_set name[CANDIDATES];
static hci_component_set set;
static hci_harmonic_system system_;
static uint64_t seed;

/* A full U of `components` and a wanted torque, drawn. The mean torque of 1 N·m is all in the first column of
 * h. */
static void draw_system(size_t components)
{
    const size_t unknowns = 2 * components;
    for (size_t k = 0; k < ORDERS; ++k)
        order[k] = 6.0 * (double)k;
    for (size_t j = 0; j < unknowns; ++j)
        for (size_t i = 0; i < ROWS; ++i) {
            value[j * ROWS + i] = ref_uniform(&seed, -1.0, 1.0);
            row[j * ROWS + i] = (int64_t)i;
        }
    for (size_t j = 0; j <= unknowns; ++j)
        column_start[j] = (int64_t)(j * ROWS);
    for (size_t i = 0; i < ROWS; ++i) {
        h[i] = ref_uniform(&seed, -1.0, 1.0);
        h[ROWS + i] = 0.0;
        weight[i] = 1.0;
    }
    for (size_t k = 0; k < components; ++k)
        component[k] = (hci_component){(double)k + 1.0, 1};
    set = (hci_component_set){component, name, components, {{0}}};
    system_ = (hci_harmonic_system){.order = order,
                                    .order_count = ORDERS,
                                    .rows = ROWS,
                                    .unknowns = unknowns,
                                    .row_weight = weight,
                                    .h = h,
                                    .u = {ROWS, unknowns, column_start, row, value}};
}

void setUp(void)
{
    seed = 50;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* ---- minimax ---- */

static double entry(size_t i, size_t j)
{
    return value[j * ROWS + i];
}

/* Largest amplitude of U x − h at any order, for one component. */
static double worst_at(double s, double c)
{
    double worst = 0.0, r[ROWS];
    for (size_t i = 0; i < ROWS; ++i)
        r[i] = entry(i, 0) * s + entry(i, 1) * c - h[i];
    worst = fabs(r[0]);
    for (size_t k = 1; k < ORDERS; ++k)
        worst = fmax(worst, hypot(r[2 * k - 1], r[2 * k]));
    return worst;
}

static double least_over_c(double s)
{
    double low = -10.0, high = 10.0;
    for (int step = 0; step < 60; ++step) {
        const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
        if (worst_at(s, a) < worst_at(s, b))
            high = b;
        else
            low = a;
    }
    return worst_at(s, 0.5 * (low + high));
}

/* The function is convex, so its least over one unknown is convex in the other. */
static double least_of_all(void)
{
    double low = -10.0, high = 10.0;
    for (int step = 0; step < 60; ++step) {
        const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
        if (least_over_c(a) < least_over_c(b))
            high = b;
        else
            low = a;
    }
    return least_over_c(0.5 * (low + high));
}

static hci_set_cost solve(double ridge, double *x)
{
    static double workspace[UNKNOWNS * UNKNOWNS + 2 * UNKNOWNS + 3 * ROWS + ORDERS];
    const hci_set_preference any = {0.0, HUGE_VAL};
    const hci_minimax problem = {&system_, &set, 1.0, ridge, &any};
    hci_set_cost cost;
    TEST_ASSERT_TRUE(hci_minimax_workspace(&system_) <= sizeof workspace / sizeof *workspace);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_minimax_solve(&problem, workspace, x, &cost));
    return cost;
}

/* Never below the least, and within 2 % of it: sixty steps that converge linearly (1.2 % at worst when
 * written). */
static void test_the_worst_order_is_the_least_there_is(void)
{
    double most = 0.0;
    for (int trial = 0; trial < 30; ++trial) {
        double x[4], least;
        draw_system(1);
        least = least_of_all();
        const hci_set_cost found = solve(1e-12, x);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, worst_at(x[0], x[1]), found.worst_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * (x[0] * x[0] + x[1] * x[1]), found.mean_square_A2);
        TEST_ASSERT_TRUE(found.worst_Nm >= least * (1.0 - 1e-9));
        most = fmax(most, found.worst_Nm / least);
    }
    TEST_ASSERT_TRUE(most < 1.02);
}

/* As many unknowns as rows and more: nothing is left. */
static void test_what_can_be_exact_is(void)
{
    double x[2 * UNKNOWNS];
    draw_system(CANDIDATES);
    TEST_ASSERT_TRUE(solve(1e-12, x).worst_Nm < 1e-9);
}

/* Dear copper is saved: ρ far above UᵀU leaves h less U x nearly h. */
static void test_the_price_of_copper(void)
{
    double x[2 * UNKNOWNS];
    draw_system(3);
    const double cheap_A2 = solve(1e-12, x).mean_square_A2;
    TEST_ASSERT_TRUE(solve(1e3, x).mean_square_A2 < 1e-3 * cheap_A2);
}

static void test_the_mean_weighs_ten_times(void)
{
    draw_system(1);
    const double u = value[0], wanted = h[0], other = value[1];
    hci_minimax_weight_mean(&system_);
    TEST_ASSERT_EQUAL_DOUBLE(10.0 * u, value[0]);
    TEST_ASSERT_EQUAL_DOUBLE(10.0 * wanted, h[0]);
    TEST_ASSERT_EQUAL_DOUBLE(other, value[1]);
    order[0] = 6.0;
    order[1] = 12.0;
    hci_minimax_weight_mean(&system_); /* no mean among the orders */
    TEST_ASSERT_EQUAL_DOUBLE(10.0 * u, value[0]);
}

static void test_which_cost_is_less(void)
{
    const hci_set_preference p = {0.1, 100.0};
    const hci_set_cost exact = {0.05, 90.0}, cheaper = {0.08, 80.0}, off = {0.5, 50.0}, dear = {0.0, 101.0},
                       dearer = {0.0, 150.0};
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, cheaper, exact)); /* both exact: less copper */
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, exact, off));     /* else the smaller error */
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, off, dear));      /* allowed copper first */
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, dear, dearer));   /* neither: less copper */
    TEST_ASSERT_FALSE(hci_set_cost_less(&p, exact, cheaper));
    const hci_set_cost just_exact = {0.1, 85.0}, just_allowed = {0.0, 100.0}; /* the bounds are met there */
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, just_exact, exact));
    TEST_ASSERT_FALSE(hci_set_cost_less(&p, exact, just_exact));
    TEST_ASSERT_TRUE(hci_set_cost_less(&p, just_allowed, off));
    TEST_ASSERT_FALSE(hci_set_cost_less(&p, off, just_allowed));
}

/* ---- subsets ---- */

/* min ‖U_S x − h‖² + ρ‖x‖² less ‖h‖², by elimination. members: a bit for each candidate. */
static double subset_cost(unsigned members)
{
    double a[UNKNOWNS][UNKNOWNS], b[UNKNOWNS], g[UNKNOWNS], sum = 0.0;
    size_t pick[UNKNOWNS], n = 0;
    for (size_t j = 0; j < UNKNOWNS; ++j)
        if (members >> (j / 2) & 1U) pick[n++] = j;
    for (size_t i = 0; i < n; ++i) {
        g[i] = 0.0;
        for (size_t q = 0; q < ROWS; ++q)
            g[i] += entry(q, pick[i]) * h[q];
        b[i] = g[i];
        for (size_t j = 0; j < n; ++j) {
            a[i][j] = i == j ? RIDGE : 0.0;
            for (size_t q = 0; q < ROWS; ++q)
                a[i][j] += entry(q, pick[i]) * entry(q, pick[j]);
        }
    }
    for (size_t k = 0; k < n; ++k)
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (size_t j = k; j < n; ++j)
                a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; ++j)
            b[i] -= a[i][j] * b[j];
        b[i] /= a[i][i];
        sum -= g[i] * b[i];
    }
    return sum;
}

static unsigned members_of(const hci_subset_search *s)
{
    unsigned members = 0;
    for (size_t k = 0; k < s->count; ++k)
        members |= 1U << s->member[k];
    for (size_t k = 0; k < CANDIDATES; ++k)
        TEST_ASSERT_EQUAL_INT(members >> k & 1U, s->is_in[k]);
    return members;
}

/* Leaving out what costs least, one by one. */
static unsigned eliminate(size_t most)
{
    unsigned members = (1U << CANDIDATES) - 1U;
    for (size_t left = CANDIDATES; left > most; --left) {
        double least = HUGE_VAL;
        unsigned best = 0;
        for (unsigned k = 0; k < CANDIDATES; ++k) {
            const unsigned without = members & ~(1U << k);
            if (without == members || subset_cost(without) >= least) continue;
            least = subset_cost(without);
            best = without;
        }
        members = best;
    }
    return members;
}

static void begin_search(hci_subset_search *s)
{
    draw_system(CANDIDATES);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_subset_search_make(&system_, 1.0, s, NULL));
    s->ridge = RIDGE;
}

static void test_elimination_leaves_out_what_costs_least(void)
{
    for (int trial = 0; trial < 10; ++trial) {
        hci_subset_search s;
        begin_search(&s);
        for (size_t most = 1; most <= CANDIDATES; ++most) {
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_subset_eliminate(&s, most));
            TEST_ASSERT_EQUAL_UINT(most, s.count);
            TEST_ASSERT_EQUAL_UINT(eliminate(most), members_of(&s));
        }
        hci_subset_search_release(&s);
    }
}

/* No exchange of one member for one candidate is left that lowers the cost. */
static void test_exchange_ends_where_no_exchange_is_better(void)
{
    size_t changed = 0;
    for (int trial = 0; trial < 30; ++trial) {
        hci_subset_search s;
        begin_search(&s);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_subset_eliminate(&s, 3));
        const unsigned before = members_of(&s);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_subset_exchange(&s));
        const unsigned members = members_of(&s);
        const double cost = subset_cost(members);
        changed += members != before;
        TEST_ASSERT_EQUAL_UINT(3, s.count);
        TEST_ASSERT_TRUE(cost <= subset_cost(before) + 1e-12);
        for (unsigned k = 0; k < CANDIDATES * CANDIDATES; ++k) {
            const unsigned out = 1U << k / CANDIDATES, in = 1U << k % CANDIDATES;
            if (!(members & out) || (members & in)) continue;
            TEST_ASSERT_TRUE(subset_cost((members & ~out) | in) >= cost - 1e-9);
        }
        hci_subset_search_release(&s);
    }
    TEST_ASSERT_TRUE(changed > 3); /* elimination alone does not get there */
}

static void test_memory_that_runs_out(void)
{
    draw_system(CANDIDATES);
    for (long n = 0; n < 9; ++n) {
        hci_subset_search s;
        hci_memory_fail_after(n);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_subset_search_make(&system_, 1.0, &s, NULL));
        hci_memory_fail_after(-1);
        hci_subset_search_release(&s);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_worst_order_is_the_least_there_is);
    RUN_TEST(test_what_can_be_exact_is);
    RUN_TEST(test_the_price_of_copper);
    RUN_TEST(test_the_mean_weighs_ten_times);
    RUN_TEST(test_which_cost_is_less);
    RUN_TEST(test_elimination_leaves_out_what_costs_least);
    RUN_TEST(test_exchange_ends_where_no_exchange_is_better);
    RUN_TEST(test_memory_that_runs_out);
    return UNITY_END();
}
