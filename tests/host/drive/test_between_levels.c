/* What a table says of the torque between its levels, of a machine whose torque is linear in the current, so
 * that all of it follows from parabolas by hand. */
#include <math.h>
#include <string.h>

#include "host/drive/between_levels.h"
#include "support/files.h"
#include "support/reference.h"
#include "unity.h"

static hci_machine_data machine;
static hci_machine_plant plant;

void setUp(void)
{
    hci_note note = {{0}};
    files_begin();
    memset(&plant, 0, sizeof plant);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_a", &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_plant_make("data/machine_a", &machine, &plant, &note),
                              note.text);
}

void tearDown(void)
{
    hci_machine_plant_release(&plant);
    hci_machine_release(&machine);
    files_end();
}

/* Levels 0, 1, … N·m in name with constant i_q. */
static hci_between_levels find(const double *iq_A, size_t count)
{
    hci_wave wave[3];
    hci_loop_level level[3];
    hci_drive_data drive;
    hci_machine_data fitted;
    hci_loop_set set;
    hci_between_levels found;
    hci_note note = {{0}};
    for (size_t k = 0; k < count; ++k) {
        wave[k] = (hci_wave){1.0, 1, iq_A[k], 0.0};
        level[k] = (hci_loop_level){(double)k, &wave[k], 1};
    }
    files_write(files_path("drive.csv"), "name,value,unit\nresistance,0.1,ohm\ninductance_d,0.5,mH\n"
                                         "inductance_q,0.5,mH\ndc_link_voltage,1000,V\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_drive_read(files_path("drive.csv"), &drive, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_drive_fit(&drive, &machine, &fitted, &note), note.text);
    const hci_loop_task task = {
        .machine = &fitted, .drive = &drive, .levels = level, .level_count = count, .max_error_A = 1e-6};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_loop_set_make(&task, &set, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_between_levels_find(&set, &plant, &found, &note), note.text);
    hci_loop_set_release(&set);
    hci_drive_release(&drive);
    return found;
}

/* Mean and peak to peak of the torque that 1 A of i_q makes, cogging apart. */
static void torque_of_one_ampere(double *mean_Nm, double *swing_Nm)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    *mean_Nm = 0.0;
    for (int k = 0; k < 3600; ++k) {
        double torque_Nm = 0.0;
        for (size_t n = 0; n < machine.model.back_emf_count; ++n)
            for (int s = 0; s < 3; ++s) {
                const hci_wave e = machine.model.back_emf[n];
                const double theta = 2.0 * REF_PI * k / 3600.0, third = 2.0 * REF_PI * s / 3.0,
                             x = e.order * theta - e.sequence * third;
                torque_Nm += (e.sine * sin(x) + e.cosine * cos(x)) * sin(theta - third);
            }
        *mean_Nm += torque_Nm / 3600.0;
        least = fmin(least, torque_Nm);
        most = fmax(most, torque_Nm);
    }
    *swing_Nm = most - least;
}

/* The parabola through 0, q and 3 q lies q/8 below the straight line halfway. */
static void test_a_parabola_departs_from_the_straight_line(void)
{
    const double iq_A[] = {0.0, 2.0, 6.0}, off_A = 2.0 / 8.0;
    const hci_between_levels found = find(iq_A, 3);
    double mean_Nm, swing_Nm;
    torque_of_one_ampere(&mean_Nm, &swing_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * mean_Nm, -off_A * mean_Nm, found.mean_off_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * swing_Nm, off_A * swing_Nm, found.ripple_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, fmod(found.mean_at_Nm, 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, fmod(found.ripple_at_Nm, 1.0));
}

/* What is linear in the torque has nothing between; 1e-6 is rounding of single precision. */
static void test_a_straight_line_has_nothing_between(void)
{
    const double iq_A[] = {1.0, 3.0, 5.0};
    for (size_t count = 2; count <= 3; ++count) {
        const hci_between_levels found = find(iq_A, count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, found.mean_off_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, 0.0, found.ripple_Nm);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_parabola_departs_from_the_straight_line);
    RUN_TEST(test_a_straight_line_has_nothing_between);
    return UNITY_END();
}
