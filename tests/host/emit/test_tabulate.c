/* What a table is said to hold: the highest order of its columns. */
#include "host/emit/tabulate.h"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Whichever part the order stands in; in the rotor frame order n of sequence σ is n − σ. */
static void test_the_highest_order_is_of_both_parts(void)
{
    const hci_wave low[2] = {{1.0, 1, 1.0, 0.0}, {5.0, -1, 0.0, 1.0}},
                   high[2] = {{13.0, 1, 0.0, 1.0}, {11.0, -1, 1.0, 0.0}};
    for (int swapped = 0; swapped < 2; ++swapped) {
        hci_tabulation t = {.constant = swapped ? high : low,
                            .per_Nm = swapped ? low : high,
                            .constant_count = 2,
                            .per_Nm_count = 2,
                            .frame = HCI_TABLE_ABC};
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_seen(&t));
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_order(&t));
        t.frame = HCI_TABLE_DQ;
        TEST_ASSERT_EQUAL_DOUBLE(12.0, hci_tabulation_highest_seen(&t));
        t.constant_count = t.per_Nm_count = 1;
        TEST_ASSERT_EQUAL_DOUBLE(12.0, hci_tabulation_highest_seen(&t));
        TEST_ASSERT_EQUAL_DOUBLE(13.0, hci_tabulation_highest_order(&t));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_highest_order_is_of_both_parts);
    return UNITY_END();
}
