/* Orders of a mechanical turn where nobody knows the pole pairs: which column, and what to do. */
#include "hci/host/csv/csv.h"

#include "support/files.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void test_the_column_is_named(void)
{
    hci_csv *csv;
    double order[2];
    hci_note note = {{0}};
    files_write(files_path("cogging.csv"), "amplitude_Nm,mechanical_order\n0.1,36\n0.2,72\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_csv_read(files_path("cogging.csv"), &csv, &note), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_csv_numbers(csv, "order", order, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "cogging.csv:1"), note.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "mechanical_order"), note.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "divide them by the pole pairs"), note.text);
    hci_csv_orders_of(csv, 6, HCI_ORDER_ELECTRICAL);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_csv_numbers(csv, "order", order, &note));
    TEST_ASSERT_EQUAL_DOUBLE(6.0, order[0]);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, order[1]);
    hci_csv_free(csv);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_column_is_named);
    return UNITY_END();
}
