/* Voltages that are 0 in every row of a recording: which kinds are taken away, and when none is. */
#include "host/recording/zero_voltages.h"

#include <string.h>

#include "host/recording/holes.h"
#include "support/files.h"
#include "unity.h"

static hci_csv *csv;
static hci_run_columns columns;
static hci_note remark, note;

void setUp(void)
{
    memset(&columns, 0, sizeof columns);
    memset(&remark, 0, sizeof remark);
    memset(&note, 0, sizeof note);
    csv = NULL;
    files_begin();
}

static void forget(void)
{
    hci_run_columns_release(&columns);
    hci_csv_free(csv);
    csv = NULL;
    memset(&remark, 0, sizeof remark);
}

void tearDown(void)
{
    forget();
    files_end();
}

static void open_text(const char *text)
{
    const char *path = files_path("run.csv");
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read_recording(path, &csv, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_columns_open_any(csv, &columns, &remark, &note), note.text);
}

static void test_zeros_throughout_are_no_voltage(void)
{
    open_text("theta_m_rad,iq_A,vd,vq\n0.1,1,0,0\n0.2,2,0,0\n0.3,1,0,0\n");
    TEST_ASSERT_FALSE(columns.has[HCI_RUN_VD] || columns.has[HCI_RUN_VQ]);
    TEST_ASSERT_TRUE(columns.has[HCI_RUN_IQ] && columns.has[HCI_RUN_THETA_M]);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "`vd`, `vq`: 0 in every row"), remark.text);
    forget();
    open_text("theta_m_rad,iq_A,va,vb,vc\n0.1,1,0,0,0\n0.2,2,0,0,0\n0.3,1,0,0,0\n");
    TEST_ASSERT_EQUAL(0, hci_run_phase_count(&columns, HCI_RUN_VA));
}

/* v_d is 0 in many a drive, and a voltage that is 0 for a while is one. */
static void test_one_of_them_is_a_voltage(void)
{
    open_text("theta_m_rad,iq_A,vd,vq\n0.1,1,0,0\n0.2,2,0,0.5\n0.3,1,0,0\n");
    TEST_ASSERT_TRUE(columns.has[HCI_RUN_VD] && columns.has[HCI_RUN_VQ]);
    TEST_ASSERT_NULL(strstr(remark.text, "in every row"));
}

/* Without them the file would have nothing to be read by: what is wrong there is another's to say. */
static void test_what_would_leave_nothing_stays(void)
{
    open_text("time_s,va,vb,vc\n0.1,0,0,0\n0.2,0,0,0\n0.3,0,0,0\n");
    TEST_ASSERT_EQUAL(3, hci_run_phase_count(&columns, HCI_RUN_VA));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_zeros_throughout_are_no_voltage);
    RUN_TEST(test_one_of_them_is_a_voltage);
    RUN_TEST(test_what_would_leave_nothing_stays);
    return UNITY_END();
}
