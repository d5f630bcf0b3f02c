/* A log with one message of a bus in each row is refused, and others with empty cells are not. */
#include "host/csv/table.h"

#include <stdio.h>
#include <string.h>

#include "support/files.h"
#include "unity.h"

enum { ROWS = 60 };

static hci_csv *csv;
static hci_note note;

void setUp(void)
{
    memset(&note, 0, sizeof note);
    csv = NULL;
    files_begin();
}

void tearDown(void)
{
    hci_csv_free(csv);
    files_end();
}

/* Of three signals, `each` of them in a row, the others empty; `slow` has a value in one row of ten. */
static hci_status refused(int each, bool slow)
{
    char text[64 * ROWS];
    int used = snprintf(text, sizeof text, "time_s,torque_Nm,theta_m_deg,iq_A,temperature_C\n");
    for (int k = 0; k < ROWS; ++k) {
        used += snprintf(text + used, sizeof text - (size_t)used, "%d.5", k);
        for (int c = 0; c < 3; ++c)
            used += snprintf(text + used, sizeof text - (size_t)used,
                             (c - k % 3 + 3) % 3 < each ? ",%d.25" : ",", k);
        used += snprintf(text + used, sizeof text - (size_t)used, slow && k % 10 ? ",\n" : ",40\n");
    }
    const char *path = files_path("run.csv");
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read_recording(path, &csv, &note), note.text);
    return hci_csv_refuse_messages(csv, &note);
}

static void test_one_signal_a_row(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, refused(1, true));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "run.csv"));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "the last value held"));
}

static void test_two_of_three_signals_a_row(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, refused(2, true));
}

static void test_a_slow_column_beside_whole_ones(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, refused(3, true));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_signal_a_row);
    RUN_TEST(test_two_of_three_signals_a_row);
    RUN_TEST(test_a_slow_column_beside_whole_ones);
    return UNITY_END();
}
