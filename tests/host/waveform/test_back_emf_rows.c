/* Which rows of a recording with an angle tell the back-EMF: those at a tenth of the highest speed or more.
 */
#include "host/waveform/back_emf.c"

#include "support/texts.h"
#include "unity.h"

enum { ROWS = 6 };

static double theta[ROWS], speed[ROWS], voltage[3 * ROWS];
static hci_run run;
static hci_waveform result;
static hci_note note;
static emf_work work;

void setUp(void)
{
    for (int k = 0; k < ROWS; ++k) {
        theta[k] = 0.1 * k;
        for (int s = 0; s < 3; ++s)
            voltage[3 * k + s] = 10.0 * k + s;
    }
    memset(&note, 0, sizeof note);
    memset(&work, 0, sizeof work);
    run = (hci_run){
        .name = "spin", .count = ROWS, .theta_m_rad = theta, .speed_rad_per_s = speed, .v_V = voltage};
}

void tearDown(void)
{
    release(&work);
}

static hci_status take(const double as[ROWS])
{
    static const hci_waveform_options OPTIONS = {.pole_pairs = 7};
    const hci_waveform_task task = {.run = &run, .options = &OPTIONS, .result = &result, .note = &note};
    memcpy(speed, as, sizeof speed);
    release(&work);
    memset(&work, 0, sizeof work);
    TEST_ASSERT_EQUAL_INT(HCI_OK, allocate(&task, &work));
    return take_recorded(&task, &work);
}

static void test_rows_that_are_fast_enough(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const double as[ROWS] = {sign * 100.0, 9.9, -10.1, 10.1, 0.0, -9.9};
        TEST_ASSERT_EQUAL_INT(HCI_OK, take(as));
        TEST_ASSERT_EQUAL_UINT64(3, work.count);
        for (size_t k = 0; k < 3; ++k) {
            const size_t row = k == 0 ? 0 : k + 1;
            TEST_ASSERT_DOUBLE_WITHIN(1e-15, 7.0 * theta[row], work.angle_rad[k]);
            TEST_ASSERT_EQUAL_DOUBLE(as[row], work.speed_rad_per_s[k]);
            for (size_t s = 0; s < 3; ++s)
                TEST_ASSERT_EQUAL_DOUBLE(voltage[3 * row + s], work.voltage_V[3 * k + s]);
        }
    }
}

/* The fastest may be the last one. */
static void test_the_fastest_counts_wherever_it_is(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, take((double[ROWS]){9.0, 9.9, 10.1, 11.0, 12.0, 100.0}));
    TEST_ASSERT_EQUAL_UINT64(4, work.count);
}

static void test_a_rotor_that_stands(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, take((double[ROWS]){0.0}));
    text_has("spin: found a speed of 0, expected a rotor that turns; drive it and record again", note.text);
    TEST_ASSERT_EQUAL_UINT64(0, work.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_that_are_fast_enough);
    RUN_TEST(test_the_fastest_counts_wherever_it_is);
    RUN_TEST(test_a_rotor_that_stands);
    return UNITY_END();
}
