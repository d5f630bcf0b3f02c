/* Values along straight lines between nodes are found and taken back; anything else is not. */
#include "host/numeric/straight_lines.c"

#include <stdlib.h>

#include "support/draws.h"
#include "unity.h"

enum { ROWS = 3000, NODES = 2500 };

static double row[ROWS], value[ROWS], node[NODES], found[ROWS];
static hci_line_nodes nodes;

void setUp(void)
{
    nodes = (hci_line_nodes){0};
    for (int k = 0; k < ROWS; ++k)
        row[k] = k;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* White noise at nodes, some early or late by a share of their distance, and rows between them. */
static void make_lines(double first, double step, double jitter)
{
    uint64_t draws = 7;
    double *at = malloc(NODES * sizeof *at);
    for (int k = 0; k < NODES; ++k) {
        at[k] = first + step * (k + jitter * ref_uniform(&draws, -1.0, 1.0));
        node[k] = sin(0.05 * k) + 0.02 * ref_normal(&draws);
    }
    int before = 0;
    for (int k = 0; k < ROWS; ++k) {
        while (before + 2 < NODES && at[before + 1] <= row[k])
            ++before;
        const double share = (row[k] - at[before]) / (at[before + 1] - at[before]);
        value[k] = node[before] + share * (node[before + 1] - node[before]);
    }
    free(at);
}

/* How far the nodes that were found are from those that were made, at most, but for one at each end. */
static double worst_node(double first, double step)
{
    double worst = 0.0;
    for (size_t k = 1; k + 1 < nodes.count; ++k) {
        const long made = lround((nodes.first + nodes.step * (double)k - first) / step);
        worst = fmax(worst, fabs(found[k] - node[made]));
    }
    return worst;
}

static void test_nodes_and_their_values_come_back(void)
{
    static const double steps[] = {1.45, 1.7, 2.0, 2.5, 3.37, 5.0, 10.0, 20.0, 24.7};
    for (size_t k = 0; k < sizeof steps / sizeof *steps; ++k) {
        make_lines(-0.3, steps[k], 0.0);
        TEST_ASSERT_TRUE(hci_line_nodes_find(row, value, ROWS, &nodes));
        TEST_ASSERT_DOUBLE_WITHIN(2e-4 * steps[k], steps[k], nodes.step);
        TEST_ASSERT_TRUE(hci_line_nodes_fit(row, value, ROWS, &nodes, found) < 0.1);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.0, worst_node(-0.3, steps[k]));
    }
}

/* By less than a tenth of a row. */
static void test_nodes_that_jitter_a_little(void)
{
    static const double steps[] = {1.7, 2.5, 3.37, 5.0, 10.0};
    for (size_t k = 0; k < sizeof steps / sizeof *steps; ++k) {
        make_lines(-0.3, steps[k], 0.04 / steps[k]);
        TEST_ASSERT_TRUE(hci_line_nodes_find(row, value, ROWS, &nodes));
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * steps[k], steps[k], nodes.step);
        make_lines(-0.3, steps[k], 0.2 / steps[k]);
        TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes));
    }
}

static void test_rows_that_were_left_out(void)
{
    for (int k = 0; k < ROWS; ++k)
        row[k] = k + 3 * (k / 100);
    make_lines(-0.3, 2.5, 0.0);
    TEST_ASSERT_TRUE(hci_line_nodes_find(row, value, ROWS, &nodes));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 2.5, nodes.step);
}

static void test_nothing_else_is_lines(void)
{
    uint64_t draws = 3;
    for (int k = 0; k < ROWS; ++k)
        value[k] = ref_normal(&draws);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* noise */
    for (int k = 0; k < ROWS; ++k)
        value[k] = sin(0.07 * k) + 0.3 * sin(0.5 * k);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* smooth */
    for (int k = 0; k < ROWS; ++k)
        value[k] = sin(k);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* quick, and smooth all the same */
    for (int k = 0; k < ROWS; ++k)
        value[k] = k % 5 ? value[k - 1] : ref_normal(&draws);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* held */
    for (int k = 0; k < ROWS; ++k)
        value[k] = round(8.0 * sin(0.003 * k));
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* coarse */
    for (int k = 0; k < ROWS; ++k)
        value[k] = k % 7;
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* a sawtooth */
    for (int k = 0; k < ROWS; ++k)
        value[k] = 3.0;
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes)); /* nothing */
}

/* Few rows a period, of a ripple that is large beside its noise: lines go near all of them. */
static void test_what_repeats_is_no_lines(void)
{
    for (uint64_t draws = 1; draws <= 10; ++draws) {
        uint64_t state = draws;
        for (int k = 0; k < 200; ++k) {
            const double x = 0.36 * REF_PI * k;
            value[k] = 0.03 * sin(x + 0.5) + 0.01 * cos(2.0 * x) - 0.03 * cos(x + 0.3) +
                       0.006 * sin(x + 0.3) + 0.002 * ref_normal(&state);
        }
        TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, 200, &nodes));
    }
}

/* Nodes of which every fifth is one of the lines, as when the rows in the middle lie well between others:
 * those alone, wherever the first of them is. */
static void test_every_nth_of_the_nodes(void)
{
    for (int late = 0; late < 5; ++late) {
        rows x = {0};
        const rows all = {.row = row, .value = value, .n = ROWS};
        make_lines(-0.3, 12.5, 0.0);
        nodes = (hci_line_nodes){-0.3 - 2.5 * late, 2.5, NODES};
        TEST_ASSERT_TRUE(rows_new(NODES, &x));
        widen(&all, &x, &nodes);
        hci_memory_free(x.diagonal);
        TEST_ASSERT_EQUAL_DOUBLE(12.5, nodes.step);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, remainder(nodes.first + 0.3, 12.5));
    }
}

static void test_nodes_at_every_row_are_none(void)
{
    make_lines(-0.3, 1.2, 0.0);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes));
    make_lines(-0.3, 2.5, 0.0);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, 199, &nodes));
    TEST_ASSERT_TRUE(hci_line_nodes_find(row, value, 200, &nodes));
}

static void test_memory_that_is_short(void)
{
    make_lines(-0.3, 2.5, 0.0);
    (void)hci_memory_was_short();
    hci_memory_fail_after(0);
    TEST_ASSERT_FALSE(hci_line_nodes_find(row, value, ROWS, &nodes));
    TEST_ASSERT_TRUE(hci_memory_was_short());
    nodes = (hci_line_nodes){-0.3, 2.5, 1202};
    TEST_ASSERT_TRUE(isinf(hci_line_nodes_fit(row, value, ROWS, &nodes, found)));
    TEST_ASSERT_TRUE(hci_memory_was_short());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nodes_and_their_values_come_back);
    RUN_TEST(test_nodes_that_jitter_a_little);
    RUN_TEST(test_rows_that_were_left_out);
    RUN_TEST(test_nothing_else_is_lines);
    RUN_TEST(test_what_repeats_is_no_lines);
    RUN_TEST(test_every_nth_of_the_nodes);
    RUN_TEST(test_nodes_at_every_row_are_none);
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
