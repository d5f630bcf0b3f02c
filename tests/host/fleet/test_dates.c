/* Dates as people write them; one that may be read in two ways is not read, unless another date of the list
 * says how. */
#include "host/fleet/dates.h"

#include <math.h>
#include <stddef.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_day(double day, const char *date, hci_date_order order)
{
    TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(day, hci_date_day(date, order), date);
}

static void test_forms(void)
{
    const double day = hci_date_day("2026-10-05", HCI_DATE_OPEN);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_date_day("2024-03-01", HCI_DATE_OPEN) -
                                      hci_date_day("2024-02-29", HCI_DATE_OPEN));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_date_day("2100-03-01", HCI_DATE_OPEN) -
                                      hci_date_day("2100-02-28", HCI_DATE_OPEN));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_date_day("2026-09-01", HCI_DATE_OPEN) -
                                      hci_date_day("2026-08-31", HCI_DATE_OPEN));
    TEST_ASSERT_EQUAL_DOUBLE(365.0, hci_date_day("2027-10-05", HCI_DATE_OPEN) - day);
    is_day(day, "2026/10/5", HCI_DATE_OPEN);
    is_day(day, "2026-10-05T08:00:00", HCI_DATE_OPEN);
    is_day(day, "05.10.2026", HCI_DATE_OPEN);
    is_day(day, "5.10.2026 08:00", HCI_DATE_MONTH_FIRST);
    is_day(day, "05/10/2026", HCI_DATE_DAY_FIRST);
    is_day(day, "10/05/2026", HCI_DATE_MONTH_FIRST);
    is_day(day + 15.0, "10/20/2026", HCI_DATE_OPEN);
    is_day(day + 15.0, "20-10-2026", HCI_DATE_OPEN);
    is_day(day + 5.0, "10/10/2026", HCI_DATE_OPEN);
}

static void test_not_read(void)
{
    static const char *const WRONG[] = {"",           "05/10/2026", "5.10.26",    "2026-13-01", "2026-10-32",
                                        "2026-02-29", "2100-02-29", "2026-09-31", "13/13/2026", "2026-10/05",
                                        "-026-10-05", "monday",     "2026-10-05x"};
    for (size_t k = 0; k < sizeof WRONG / sizeof *WRONG; ++k)
        TEST_ASSERT_TRUE_MESSAGE(isnan(hci_date_day(WRONG[k], HCI_DATE_OPEN)), WRONG[k]);
    TEST_ASSERT_EQUAL(HCI_DATE_OPEN, hci_date_order_of("05/10/2026"));
    TEST_ASSERT_EQUAL(HCI_DATE_MONTH_FIRST, hci_date_order_of("05/13/2026"));
    TEST_ASSERT_EQUAL(HCI_DATE_DAY_FIRST, hci_date_order_of("05.10.2026"));
    TEST_ASSERT_EQUAL(HCI_DATE_NONE, hci_date_order_of("2026-10-05"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_forms);
    RUN_TEST(test_not_read);
    return UNITY_END();
}
