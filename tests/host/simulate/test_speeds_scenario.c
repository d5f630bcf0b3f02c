/* How long a drive is simulated at a speed: until the start is forgotten, and two turns of the shaft more, or
 * a fifth of a second. */
#include "host/simulate/speeds.c"

#include "unity.h"

static const hci_wave EMF = {1.0, 1, 0.12, 0.0};
static hci_machine_data machine;
static hci_drive_data drive;
static hci_speeds_request request;
static grid g;

void setUp(void)
{
    hci_note note = {{0}};
    memset(&machine, 0, sizeof machine);
    memset(&g, 0, sizeof g);
    machine.pole_pairs = machine.model.pole_pairs = 4;
    machine.model.back_emf = &EMF;
    machine.model.back_emf_count = 1;
    machine.resistance_ohm = 0.5;
    machine.inductance_d_H = machine.inductance_q_H = 1e-3;
    hci_drive_init(&drive);
    drive.sample_s = 1e-4;
    drive.dc_link_voltage_V = 48.0;
    drive.kp_ohm = 2.0;
    drive.ki_ohm_per_s = 1000.0;
    request.drive = &drive;
    request.torque_Nm = 0.7;
    g.request = &request;
    g.machine.model = machine.model;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_model_make_constant(&machine, &g.known, &note),
                                  note.text);
}

void tearDown(void)
{
    hci_machine_model_release(&g.known);
}

static double evaluated_s(double speed_rad_per_s)
{
    hci_scenario s;
    fill_scenario(&g, speed_rad_per_s, &s);
    TEST_ASSERT_EQUAL_DOUBLE(speed_rad_per_s, s.prescribed_speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(0.7, s.torque_reference_Nm);
    TEST_ASSERT_TRUE(s.settle_s >= 12.0 * 1e-3 / 0.5); /* time constants of the winding */
    return s.duration_s - s.settle_s;
}

static void test_two_turns_or_a_fifth_of_a_second(void)
{
    for (int way = -1; way <= 1; way += 2) {
        TEST_ASSERT_DOUBLE_WITHIN(0.1, 2.02 * 2.0 * HCI_PI / 0.5, evaluated_s(way * 0.5));
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.02 * 2.0 * HCI_PI / 20.0, evaluated_s(way * 20.0));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2, evaluated_s(way * 500.0));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_turns_or_a_fifth_of_a_second);
    return UNITY_END();
}
