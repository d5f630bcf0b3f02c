/* Which variables the FMU of a machine has: those of the inverter belong to voltages, not to imposed
 * currents, and a temperature to magnets that depend on it. */
#include "host/fmu/machine_code.h"

#include <string.h>

#include "hci/host/machine/machine.h"
#include "unity.h"

static hci_machine_data machine;
static hci_fmu_machine_model model;
static hci_note note;

void setUp(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine, &note), note.text);
}

void tearDown(void)
{
    hci_fmu_machine_release(&model);
    hci_machine_release(&machine);
}

static void test_variables_that_are_left_out(void)
{
    static const int OF_VOLTAGES[] = {HCI_FMU_MACHINE_VA,
                                      HCI_FMU_MACHINE_VA + 1,
                                      HCI_FMU_MACHINE_VA + 2,
                                      HCI_FMU_MACHINE_RESISTANCE,
                                      HCI_FMU_MACHINE_DEAD_TIME_VOLTAGE,
                                      HCI_FMU_MACHINE_DEAD_TIME_CROSSING};
    for (int imposed = 0; imposed < 2; ++imposed) {
        const hci_fmu_request request = {.fmi_version = 2, .machine = &machine, .imposed = imposed};
        hci_fmu_machine_release(&model);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_fmu_machine_make(&request, &machine, &model, &note), note.text);
        for (size_t k = 0; k < sizeof OF_VOLTAGES / sizeof *OF_VOLTAGES; ++k)
            TEST_ASSERT_EQUAL(imposed, model.left_out[OF_VOLTAGES[k]]);
        for (int k = 0; k < 3; ++k) {
            TEST_ASSERT_EQUAL(!imposed, model.left_out[HCI_FMU_MACHINE_IA_IMPOSED + k]);
            TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_IA + k]);
        }
        TEST_ASSERT_TRUE(model.left_out[HCI_FMU_MACHINE_TEMPERATURE]);
        TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_TORQUE]);
        TEST_ASSERT_FALSE(model.left_out[HCI_FMU_MACHINE_INERTIA]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_variables_that_are_left_out);
    return UNITY_END();
}
