/* A step returns the machine's torque at its start, whatever the shaft does in it. */
#include <math.h>
#include <string.h>

#include "hci/drive/plant.h"
#include "hci/status.h"
#include "unity.h"

enum { POINTS = 512 };

static double rows[12 * (POINTS + 1)];
static hci_plant plant;

/* A sine of 0.5 N·m/A and a cogging torque; 2 mH; friction that stops it within a step of 1 ms. */
void setUp(void)
{
    static const hci_wave emf = {1.0, 1, 0.5, 0.0};
    static const hci_harmonic cogging = {6.0, 0.05, 0.01};
    const hci_machine machine = {
        .pole_pairs = 2, .back_emf = &emf, .back_emf_count = 1, .cogging = &cogging, .cogging_count = 1};
    const hci_plant_inductance winding = {NULL, 0, 2e-3, 2e-3};
    memset(&plant, 0, sizeof plant);
    plant.resistance_ohm = 0.5;
    plant.inertia_kgm2 = 1e-4;
    plant.coulomb_Nm = 0.2;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&machine, &winding, POINTS, rows, &plant.table));
}

void tearDown(void)
{
}

static void steps_from(double speed_rad_per_s, double i_A, double load_Nm)
{
    static const double v[2] = {1.0, -2.0};
    hci_plant_state state = {.theta_m_rad = 0.4, .speed_rad_per_s = speed_rad_per_s, .i = {i_A, 0.5 * i_A}};
    for (int k = 0; k < 20; ++k) {
        const double torque_Nm = hci_plant_torque_Nm(&plant, &state);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque_Nm, hci_plant_step(&plant, &state, v, load_Nm, 1e-3));
        TEST_ASSERT_TRUE(isfinite(state.speed_rad_per_s));
    }
}

static void test_the_torque_at_the_start(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        steps_from(sign * 30.0, sign * 3.0, 0.0); /* it goes on */
        steps_from(sign * 1.0, -sign * 1.0, 0.0); /* it stops, and may turn back */
        steps_from(0.0, sign * 0.01, 0.0);        /* it stays */
        steps_from(0.0, sign * 4.0, sign * 0.1);  /* it breaks away */
    }
    plant.coulomb_Nm = 0.0;
    steps_from(5.0, 1.0, 0.3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_torque_at_the_start);
    return UNITY_END();
}
