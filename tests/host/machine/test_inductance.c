/* Tables of slopes: what their mean over a turn may be. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/machine.h"
#include "support/files.h"
#include "unity.h"

enum { ROWS = 24 };

void setUp(void)
{
    files_begin();
    files_write(files_path("machine.csv"), "name,value\npole_pairs,3\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.5,0\n");
}

void tearDown(void)
{
    files_end();
}

/* Slopes of amplitude 1 mH/rad at order 2, in phase a with a mean as a share of that; the angle of one row is
 * off. */
static hci_status read_rows(double mean, int at, double off_rad, hci_machine_data *machine, hci_note *note)
{
    char text[ROWS * 160];
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "theta_e_rad,dLa_H_per_rad,dLb_H_per_rad,dLc_H_per_rad,"
                                   "dMab_H_per_rad,dMbc_H_per_rad,dMca_H_per_rad\n");
    for (int k = 0; k < ROWS; ++k) {
        const double theta = 2.0 * HCI_PI * k / ROWS, third = 2.0 * HCI_PI / 3.0;
        used += (size_t)snprintf(text + used, sizeof text - used, "%.17g,%.17g,%.17g,%.17g,0,0,0\n",
                                 theta + (k == at ? off_rad : 0.0), 1e-3 * (sin(2.0 * theta) + mean),
                                 1e-3 * sin(2.0 * (theta - third)), 1e-3 * sin(2.0 * (theta + third)));
    }
    files_write(files_path("inductance.csv"), text);
    return hci_machine_read(files_root, machine, note);
}

static hci_status read_slopes(double mean, hci_machine_data *machine, hci_note *note)
{
    return read_rows(mean, 0, 0.0, machine, note);
}

/* What finite elements leave of a mean is no slope: it would make energy of nothing.
 */
static void test_a_small_mean_is_left_out(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_slopes(0.03, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(1, machine.model.slope_count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, machine.model.slope[0].order);
    hci_machine_release(&machine);
}

static void test_a_large_mean_is_no_slope(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_slopes(0.07, &machine, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "inductance.csv"));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "subtract the mean"));
}

/* Any row but the first, from which the others are counted; its line is named. */
static void test_uneven_angles_are_refused(void)
{
    for (int at = 1; at < ROWS; ++at)
        for (int sign = -1; sign <= 1; sign += 2) {
            hci_machine_data machine;
            hci_note note = {{0}};
            char where[40];
            snprintf(where, sizeof where, "inductance.csv:%d:", at + 2);
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_rows(0.0, at, sign * 2e-4, &machine, &note));
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, where), note.text);
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "equal steps"), note.text);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_small_mean_is_left_out);
    RUN_TEST(test_uneven_angles_are_refused);
    RUN_TEST(test_a_large_mean_is_no_slope);
    return UNITY_END();
}
