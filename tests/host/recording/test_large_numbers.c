/* Numbers of a recording that are too large for what is made of them are refused with words. */
#include "hci/host/recording/run.h"

#include <math.h>
#include <stdint.h>

#include "support/files.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

/* Eight rows, of which one has the cells that are given. */
static hci_status read_with(const char *header, const char *row, const char *odd, hci_note *note)
{
    char text[1000];
    size_t used = (size_t)snprintf(text, sizeof text, "%s\n", header);
    for (int k = 0; k < 8; ++k) {
        used += (size_t)snprintf(text + used, sizeof text - used, "%.3f,", 0.001 * k);
        used += (size_t)snprintf(text + used, sizeof text - used, k == 5 ? odd : row, 0.3 * k);
    }
    files_write(files_path("run.csv"), text);
    hci_run run;
    const hci_run_options options = {.pole_pairs = 3};
    memset(note, 0, sizeof *note);
    const hci_status status = hci_run_read(files_path("run.csv"), &options, &run, note);
    if (!status) {
        for (size_t k = 0; k < 3 * run.count; ++k)
            TEST_ASSERT_TRUE(isfinite(run.i_A[k]));
        hci_run_release(&run);
    }
    return status;
}

static void refused(const char *header, const char *row, const char *odd, const char *what)
{
    hci_note note;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_with(header, row, row, &note), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_with(header, row, odd, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, what), note.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "run.csv: found"), note.text);
}

static void test_what_overflows(void)
{
    const char *const dq = "index,theta_m_rad,id_A,iq_A,torque_Nm";
    refused(dq, "%.2f,0.1,4,1.1\n", "1.551e308,0.1,4,1.1\n", "currents");
    refused(dq, "%.2f,0.1,4,1.1\n", "%.2f,1.7e308,1.7e308,1.1\n", "currents");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_overflows);
    return UNITY_END();
}
