/* What an error of a table's currents and a table of few points make of the torque of a sinusoidal machine,
 * by closed forms. */
#include "host/emit/table_ripple.h"

#include <math.h>
#include <string.h>

#include "support/files.h"
#include "support/reference.h"
#include "unity.h"

static const double E = 0.2; /* N·m/A, peak, of each phase */

static hci_machine_data machine;
static hci_machine_plant plant;
static hci_emit_request request;
static hci_emission emission;
static hci_wave wave;

void setUp(void)
{
    hci_note note = {{0}};
    files_begin();
    files_write(files_path("machine.csv"), "name,value\npole_pairs,3\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n");
    memset(&plant, 0, sizeof plant);
    memset(&emission, 0, sizeof emission);
    memset(&request, 0, sizeof request);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_plant_make(files_root, &machine, &plant, &note), note.text);
    wave = (hci_wave){1.0, 1, 4.0, 0.0};
    emission.request = &request;
    emission.plant = &plant;
    emission.tabulation = (hci_tabulation){.constant = &wave,
                                           .constant_count = 1,
                                           .frame = HCI_TABLE_ABC,
                                           .columns = 3,
                                           .parts = 1,
                                           .period_turns = 1};
}

void tearDown(void)
{
    hci_machine_plant_release(&plant);
    hci_machine_release(&machine);
    files_end();
}

/* Each phase by itself: E(|sin θ| + |sin(θ − 120°)| + |sin(θ + 120°)|) is at most 2 E. Of a star two are
 * given, and the third is what they leave: E √3 (|sin(θ − 30°)| + |sin(θ − 90°)|), at most 3 E. In the rotor
 * frame i_q makes 3/2 E at all angles, i_d nothing. */
static void test_torque_of_an_error(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * E, 2.0 * E, hci_table_torque_per_error(&emission));
    emission.tabulation.columns = 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * E, 3.0 * E, hci_table_torque_per_error(&emission));
    request.frame = emission.tabulation.frame = HCI_TABLE_DQ;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * E, 1.5 * E, hci_table_torque_per_error(&emission));
}

/* A table whose i_q is 5 A over a part of the turn makes from 3/2 E 4 A to 3/2 E 5 A; the waves that it was
 * made of have 4 A. */
static void test_ripple_of_a_table(void)
{
    float rows[2 * 65] = {0.0f};
    for (int k = 0; k <= 64; ++k)
        rows[2 * k + 1] = k > 20 && k < 40 ? 5.0f : 4.0f;
    request.frame = emission.tabulation.frame = HCI_TABLE_DQ;
    request.format = HCI_EMIT_F32;
    emission.tabulation.columns = 2;
    emission.table = (hci_table_f32){
        .rows = rows, .points = 64, .columns = 2, .parts = 1, .frame = HCI_TABLE_DQ, .period_turns = 1};
    emission.result.chosen.points = 64;
    hci_table_ripples(&emission);
    TEST_ASSERT_EQUAL_UINT64(1, emission.result.ripples);
    const hci_table_ripple *r = &emission.result.ripple[0];
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * E, 1.5 * E * 4.0, r->torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * E, 0.0, r->sine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * E, 1.5 * E, r->with_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * E, 1.5 * E, r->own_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_of_an_error);
    RUN_TEST(test_ripple_of_a_table);
    return UNITY_END();
}
