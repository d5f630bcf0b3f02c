/* Orders that imitate a few, as many and of as many columns as there is room for. */
#include "host/diagnose/search/group_selection.h"

#include <string.h>

#include "host/diagnose/fit/fit.h"
#include "support/reference.h"
#include "unity.h"

enum { ORDERS = 30, ROWS = 600, MOST_TERMS = 2 };

static hci_candidate item[ORDERS];
static hci_candidates list;
static size_t column[ORDERS];
static hci_normal_equations normal;
static hci_sweep base, sweep;
static bool in[ORDERS], spare[ORDERS];
static double x[ORDERS * MOST_TERMS], y;

void setUp(void)
{
}

void tearDown(void)
{
    hci_normal_equations_release(&normal);
    hci_sweep_release(&base);
    hci_sweep_release(&sweep);
}

/* Of each order: the torque of a constant current over a sixth of a turn, and in samples of its own again for
 * a second term. y: orders 5, 7 and 11. */
static void row_fill(size_t row, size_t terms)
{
    const double theta_rad = REF_PI / 3.0 * (((double)(row / terms) + 0.5) / (ROWS / (double)terms) - 0.5);
    memset(x, 0, sizeof x);
    y = 1000.0 * (0.06 * cos(5.0 * theta_rad) + 0.03 * cos(7.0 * theta_rad) - 0.015 * cos(11.0 * theta_rad));
    for (size_t k = 0; k < ORDERS; ++k)
        x[k * terms + row % terms] = 1000.0 * cos(item[k].term[0].order * theta_rad);
}

static void make(size_t terms)
{
    list = (hci_candidates){item, ORDERS, 1.0};
    memset(item, 0, sizeof item);
    for (size_t k = 0; k < ORDERS; ++k) {
        item[k] = (hci_candidate){.type = hci_effect_type_find("back_emf"),
                                  .count = terms,
                                  .price = (double)terms * log((double)ROWS)};
        for (size_t j = 0; j < terms; ++j)
            item[k].term[j] = (hci_effect_term){j, 1.0 + 0.4 * (double)k, 0.0, NAN};
        column[k] = k * terms;
    }
    TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, ORDERS * terms));
    for (size_t row = 0; row < ROWS; ++row) {
        row_fill(row, terms);
        hci_normal_equations_add(&normal, x, &y, 1);
    }
    hci_normal_equations_finish(&normal);
    normal.rows = ROWS;
}

/* However many imitate them, few are found that make all, whatever the number of columns. */
static void test_more_imitators_than_there_is_room_for(void)
{
    for (size_t terms = 1; terms <= MOST_TERMS; ++terms) {
        size_t chosen = 0;
        make(terms);
        const hci_selection problem = {&list, column, &base, normal.rows};
        TEST_ASSERT_TRUE(hci_sweep_start(&base, &normal) && hci_sweep_start(&sweep, &normal));
        const hci_effect_type *type = hci_effect_type_find("back_emf");
        const double gain = hci_group_select(&problem, type, type, in, &sweep, spare);
        for (size_t k = 0; k < ORDERS; ++k)
            chosen += in[k];
        TEST_ASSERT_TRUE(chosen >= 1 && chosen <= 4);
        TEST_ASSERT_TRUE(gain > 0.99 * normal.square);
        tearDown();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_more_imitators_than_there_is_room_for);
    return UNITY_END();
}
