/* What a solve takes from a drive: what the machine does not have, the voltage it reaches, whether its loop
 * is stable. */
#include <math.h>
#include <string.h>

#include "hci/host/drive/drive.h"
#include "unity.h"

static const hci_wave EMF = {1.0, 1, 0.12, 0.0};

static hci_machine_data m;
static hci_drive_data d;
static hci_note remark, note;

void setUp(void)
{
    memset(&m, 0, sizeof m);
    memset(&remark, 0, sizeof remark);
    memset(&note, 0, sizeof note);
    m.model.pole_pairs = 2;
    m.model.back_emf = &EMF;
    m.model.back_emf_count = 1;
    m.resistance_ohm = m.inductance_d_H = m.inductance_q_H = m.dc_link_voltage_V = NAN;
    hci_drive_init(&d);
}

void tearDown(void)
{
}

static void test_the_machine_comes_first(void)
{
    hci_inductance table = {.order = 0.0};
    d.resistance_ohm = 0.7;
    d.inductance_d_H = 2e-3;
    d.inductance_q_H = 3e-3;
    m.inductance_q_H = 5e-3;
    hci_drive_complete(&d, &m);
    TEST_ASSERT_TRUE(m.resistance_ohm == 0.7 && m.inductance_d_H == 2e-3 && m.inductance_q_H == 5e-3);
    setUp();
    m.inductance = &table;
    m.inductance_count = 1; /* a table says it all */
    d.resistance_ohm = 0.7;
    d.inductance_d_H = 2e-3;
    hci_drive_complete(&d, &m);
    TEST_ASSERT_TRUE(m.resistance_ohm == 0.7 && isnan(m.inductance_d_H));
}

/* The dc link of the drive comes before that of the machine, and the modulation says what it is a limit of.
 */
static void test_voltages_that_a_drive_reaches(void)
{
    double link_V;
    m.dc_link_voltage_V = 48.0;
    m.resistance_ohm = 0.7;
    m.inductance_d_H = m.inductance_q_H = 2e-3;
    d.dc_link_voltage_V = 60.0;
    TEST_ASSERT_TRUE(hci_drive_limits_voltage(&d, &m, &link_V));
    TEST_ASSERT_EQUAL_DOUBLE(60.0, link_V);
}

/* The limit takes link, resistance and inductances; each alone is missed. */
static void test_a_voltage_limit_takes_all_of_the_machine(void)
{
    for (int without = 0; without <= 4; ++without) {
        double link_V = -1.0;
        setUp();
        m.dc_link_voltage_V = without == 1 ? (double)NAN : 48.0;
        m.resistance_ohm = without == 2 ? (double)NAN : 0.7;
        m.inductance_d_H = without == 3 ? (double)NAN : 2e-3;
        m.inductance_q_H = without == 4 ? (double)NAN : 3e-3;
        TEST_ASSERT_EQUAL(without == 0, hci_drive_limits_voltage(&d, &m, &link_V));
        TEST_ASSERT_EQUAL_DOUBLE(without == 1 ? 0.0 : 48.0, link_V);
    }
    m.model.slope_count = 1; /* L(θ) by its slopes does, too */
    double link_V;
    TEST_ASSERT_TRUE(hci_drive_limits_voltage(&d, &m, &link_V));
}

/* The first of what is missing is named, and nothing is refused for it. */
static void test_a_loop_is_checked_where_it_can_be(void)
{
    static const char *const NAME[] = {"`resistance`", "`inductance_d`", "`inductance_q`"};
    for (int given = 0; given < 3; ++given) {
        setUp();
        if (given > 0) m.resistance_ohm = 0.7;
        if (given > 1) d.inductance_d_H = 2e-3;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_drive_check_loop(&d, &m, 100.0, &remark, &note));
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, NAME[given]), remark.text);
    }
    d.inductance_q_H = 3e-3;
    remark.text[0] = '\0';
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_drive_check_loop(&d, &m, 100.0, &remark, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", remark.text);
    TEST_ASSERT_TRUE(isnan(d.kp_ohm)); /* the drive stays as it was */
    /* fewer than ten samples of 100 µs in an electrical turn */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_drive_check_loop(&d, &m, 6500.0, &remark, &note));
    d.kp_ohm = 2.2 * 2e-3 / 1e-4; /* beyond L/T a sampled loop with a sample of delay swings up */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_drive_check_loop(&d, &m, 0.0, &remark, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_machine_comes_first);
    RUN_TEST(test_voltages_that_a_drive_reaches);
    RUN_TEST(test_a_voltage_limit_takes_all_of_the_machine);
    RUN_TEST(test_a_loop_is_checked_where_it_can_be);
    return UNITY_END();
}
