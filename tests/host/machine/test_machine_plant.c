/* The torque of a machine with what its effects.csv says: its slopes are those of differences, and phase
 * currents are those of d and q. */
#include "host/machine/machine_plant.h"

#include <math.h>

#include "support/recording.h"
#include "support/reference.h"
#include "unity.h"

static hci_machine_data machine;
static hci_machine_plant plant;

void setUp(void)
{
}

void tearDown(void)
{
    hci_machine_plant_release(&plant);
    hci_machine_release(&machine);
}

static void make(const char *folder)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(folder, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_plant_make(folder, &machine, &plant, &note), note.text);
}

static void test_phases(void)
{
    for (double theta = -7.0; theta < 7.0; theta += 0.9) {
        const double dq[] = {-1.5, 2.5};
        double found[3], wanted[3];
        hci_machine_plant_phases(theta, dq, found);
        rec_phases(dq[0], dq[1], theta, wanted);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, wanted[s], found[s]);
    }
}

/* Central differences of 1e-3 A: what the third derivative leaves is below 1e-6 of the slope. */
static void check_slopes(void)
{
    uint64_t seed = 5;
    for (int k = 0; k < 20; ++k) {
        const double theta = ref_uniform(&seed, 0.0, 6.0),
                     dq[] = {ref_uniform(&seed, -5.0, 0.0), ref_uniform(&seed, -5.0, 5.0)};
        double i[3], slope[3];
        hci_machine_plant_phases(theta, dq, i);
        const double torque_Nm = hci_machine_plant_torque_at(&plant, theta, i, slope);
        TEST_ASSERT_EQUAL_DOUBLE(torque_Nm, hci_machine_plant_torque_at(&plant, theta, i, NULL));
        for (int s = 0; s < 3; ++s) {
            double up[] = {i[0], i[1], i[2]}, down[] = {i[0], i[1], i[2]};
            up[s] += 1e-3;
            down[s] -= 1e-3;
            const double difference = (hci_machine_plant_torque_at(&plant, theta, up, NULL) -
                                       hci_machine_plant_torque_at(&plant, theta, down, NULL)) /
                                      2e-3;
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (fabs(difference) + 0.1), difference, slope[s]);
        }
    }
}

static void test_slopes_without_effects(void)
{
    make("data/machine_c");
    TEST_ASSERT_EQUAL(machine.model.pole_pairs, hci_machine_plant_pole_pairs(&plant));
    TEST_ASSERT_EQUAL_DOUBLE(hci_machine_torque_constant(&machine), plant.torque_constant_Nm_per_A);
    check_slopes();
}

/* Saturation is of higher degree than the second, and stands beside the quadratic model. */
static void test_slopes_with_saturation(void)
{
    make("data/machine_c_saturated");
    TEST_ASSERT_NOT_NULL(plant.model.higher.effects);
    check_slopes();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_phases);
    RUN_TEST(test_slopes_without_effects);
    RUN_TEST(test_slopes_with_saturation);
    return UNITY_END();
}
