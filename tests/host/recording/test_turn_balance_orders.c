/* The inertia that makes slow turns agree, of orders that are written by hand: k i = J α − T with one T for
 * all ways, errors about it, and what an inertia could be where none is told. */
#include "host/recording/turn_balance.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { RUNS = 3, ORDERS = 8 };

static const double INERTIA = 3e-4, CONSTANT = 0.2;

static hci_way_order order[RUNS][2][ORDERS + 1];
static size_t seen[RUNS][2][2];
static hci_turn_ways ways[RUNS];

/* Both ways of each run have the orders 3 and 5, of which 3 moves; α differs from way to way. */
void setUp(void)
{
    memset(order, 0, sizeof order);
    for (size_t r = 0; r < RUNS; ++r) {
        ways[r] = (hci_turn_ways){.scale = 1.0, .highest = ORDERS};
        for (size_t d = 0; d < 2; ++d) {
            seen[r][d][0] = 3;
            seen[r][d][1] = 5;
            ways[r].way[d] = (hci_way){d ? -2.0 : 2.0, order[r][d], seen[r][d], 2, true};
            for (size_t k = 0; k <= ORDERS; ++k) {
                hci_way_order *o = &order[r][d][k];
                const double way = (double)(2 * r + d);
                o->alpha_sine = 10.0 * sin(way + (double)k);
                o->alpha_cosine = 7.0 * cos(2.0 * way - (double)k);
                o->iq_A.sine = (INERTIA * o->alpha_sine - 0.04) / CONSTANT;
                o->iq_A.cosine = (INERTIA * o->alpha_cosine + 0.01 * (double)k) / CONSTANT;
                o->time_s = (hci_way_wave){0.0, 0.0, 1e-4, k == 3};
                o->iq_A.stands_out = k == 5;
            }
        }
    }
}

void tearDown(void)
{
}

/* ---- told by ways that differ ---- */

static void test_the_inertia_of_one_torque(void)
{
    for (size_t runs = 1; runs <= RUNS; ++runs)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, INERTIA, hci_balance_inertia(ways, runs, CONSTANT, NULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * INERTIA, hci_balance_inertia(ways, RUNS, 2.0 * CONSTANT, NULL));
    order[2][1][4].alpha_sine = 1e6; /* of orders that do not move nothing is taken */
    order[2][1][0].alpha_sine = 1e6;
    order[2][1][0].time_s.stands_out = true; /* nor of order 0 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, INERTIA, hci_balance_inertia(ways, RUNS, CONSTANT, NULL));
}

/* An order that moves in the very last way only is one of all; orders up to the least `highest`. */
static void test_which_orders_count(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t d = 0; d < 2; ++d)
            order[r][d][3].time_s.stands_out = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, RUNS, CONSTANT, NULL));
    order[2][1][ORDERS].time_s.stands_out = true;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, INERTIA, hci_balance_inertia(ways, RUNS, CONSTANT, NULL));
    ways[1].highest = ORDERS - 1;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, RUNS, CONSTANT, NULL));
}

/* One way says nothing, nor do turns of two kinds, nor an inertia below 0. */
static void test_what_tells_no_inertia(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, RUNS, -CONSTANT, NULL));
    ways[1].scale = 2.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, RUNS, CONSTANT, NULL));
    ways[0].way[1].any = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, 1, CONSTANT, NULL));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_balance_inertia(ways, 0, CONSTANT, NULL));
}

/* α = ±a in one coordinate, the current the same with an error e in the other one: of two ways, two
 * coordinates and one degree of freedom, the standard error of J is e/a, and what is left is e² beside J²a².
 */
static void test_how_well_it_is_told(void)
{
    static const struct {
        double share; /* e/(J a) */
        bool is_told;
    } CASE[] = {{0.09, true}, {0.11, false}};
    for (size_t c = 0; c < 2; ++c) {
        for (size_t d = 0; d < 2; ++d) {
            hci_way_order *o = &order[0][d][3];
            const double sign = d ? -1.0 : 1.0;
            o->alpha_sine = 10.0 * sign;
            o->alpha_cosine = 0.0;
            o->iq_A.sine = INERTIA * 10.0 * sign / CONSTANT;
            o->iq_A.cosine = CASE[c].share * INERTIA * 10.0 * sign / CONSTANT;
        }
        const double found = hci_balance_inertia(ways, 1, CONSTANT, NULL);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, CASE[c].is_told ? INERTIA : 0.0, found);
    }
}

/* Errors of many orders make a small one of J, but a share of what the currents differ by stays: e² beside
 * J²a² + e² is a quarter where e = J a/√3. */
static void test_what_it_leaves(void)
{
    enum { MANY = 1000 };
    static hci_way_order list[2][MANY + 1];
    for (int more = 0; more < 2; ++more) {
        const double e = (more ? 1.02 : 0.98) * INERTIA * 10.0 / sqrt(3.0);
        for (size_t d = 0; d < 2; ++d) {
            ways[0].way[d].order = list[d];
            for (size_t k = 0; k <= MANY; ++k) {
                const double sign = d ? -1.0 : 1.0;
                list[d][k] = (hci_way_order){.alpha_sine = 10.0 * sign};
                list[d][k].iq_A.sine = INERTIA * 10.0 * sign / CONSTANT;
                list[d][k].iq_A.cosine = e * sign / CONSTANT;
                list[d][k].time_s.stands_out = true;
            }
        }
        ways[0].highest = MANY;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, more ? 0.0 : INERTIA, hci_balance_inertia(ways, 1, CONSTANT, NULL));
    }
}

/* ---- not told ---- */

/* A tenth of the torque of the currents over the acceleration: of order 3 that is its own, of order 5, which
 * does not stand out in the time, twice what the error of the time makes, n² ω³ σ. */
static void test_the_most_that_it_could_be(void)
{
    double alpha2 = 0.0, made2 = 0.0;
    for (size_t d = 0; d < 2; ++d) {
        const hci_way_order *a = &order[0][d][3], *b = &order[0][d][5];
        const double of_5 = 25.0 * 8.0 * 2.0 * 1e-4;
        alpha2 += pow(hypot(a->alpha_sine, a->alpha_cosine), 2.0) + of_5 * of_5;
        made2 +=
            CONSTANT * CONSTANT *
            (pow(hypot(a->iq_A.sine, a->iq_A.cosine), 2.0) + pow(hypot(b->iq_A.sine, b->iq_A.cosine), 2.0));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.1 * sqrt(made2 / alpha2), hci_balance_limit(ways, CONSTANT));
    for (size_t d = 0; d < 2; ++d)
        ways[0].way[d].count = 0;
    TEST_ASSERT_TRUE(isinf(hci_balance_limit(ways, CONSTANT)));
}

/* The same of an electrical turn of four pole pairs: ω of the turn is four times that of the shaft. */
static void test_the_scale_of_the_turn(void)
{
    ways[0].scale = 4.0;
    ways[0].way[1].count = 0;
    seen[0][0][0] = 5;
    ways[0].way[0].count = 1;
    const double alpha = 25.0 * 512.0 / 4.0 * 2.0 * 1e-4;
    const double made_Nm = CONSTANT * hypot(order[0][0][5].iq_A.sine, order[0][0][5].iq_A.cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * made_Nm / alpha, hci_balance_limit(ways, CONSTANT));
}

/* A rotor that swings at 20 Hz: α n is more than a tenth of (2π · 20 Hz)², at either way. */
static void test_where_it_is_needed(void)
{
    const double limit = 0.1 * pow(2.0 * REF_PI * 20.0, 2.0) / 3.0;
    for (int more = 0; more < 2; ++more)
        for (size_t at = 0; at < 2; ++at) {
            for (size_t d = 0; d < 2; ++d) {
                const double size = (d == at && more ? 1.01 : 0.99) * limit;
                order[0][d][3].alpha_sine = 0.6 * size;
                order[0][d][3].alpha_cosine = 0.8 * size;
            }
            TEST_ASSERT_EQUAL(more, hci_balance_needs_inertia(ways));
        }
    ways[0].scale = 2.0; /* six events of a turn of the shaft */
    for (size_t d = 0; d < 2; ++d) {
        order[0][d][3].alpha_sine *= 0.51;
        order[0][d][3].alpha_cosine *= 0.51;
    }
    TEST_ASSERT_TRUE(hci_balance_needs_inertia(ways));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_inertia_of_one_torque);
    RUN_TEST(test_which_orders_count);
    RUN_TEST(test_what_tells_no_inertia);
    RUN_TEST(test_how_well_it_is_told);
    RUN_TEST(test_what_it_leaves);
    RUN_TEST(test_the_most_that_it_could_be);
    RUN_TEST(test_the_scale_of_the_turn);
    RUN_TEST(test_where_it_is_needed);
    return UNITY_END();
}
