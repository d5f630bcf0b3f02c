/* The limits of one solve: which of what is asked for and what the machine declares holds, and what
 * contradicts itself. */
#include "host/limit/bounds.h"

#include <math.h>
#include <string.h>

#include "unity.h"

static hci_machine_data machine;
static hci_solve_options options;
static hci_bounds bounds;
static hci_note note;

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&note, 0, sizeof note);
    machine.max_current_A = machine.dc_link_voltage_V = machine.resistance_ohm = NAN;
}

void tearDown(void)
{
}

static hci_status make(double plain_A)
{
    memset(&note, 0, sizeof note);
    return hci_bounds_make(&machine, &options, plain_A, &bounds, &note);
}

static void check_refused(const char *word)
{
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, make(1.0));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, word), note.text);
}

/* ---- currents ---- */

static void check_currents(double a_A, double b_A, double c_A)
{
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(a_A, bounds.current_A[0]);
    TEST_ASSERT_EQUAL_DOUBLE(b_A, bounds.current_A[1]);
    TEST_ASSERT_EQUAL_DOUBLE(c_A, bounds.current_A[2]);
}

static void check_declared(bool a, bool b, bool c)
{
    TEST_ASSERT_EQUAL(a, bounds.current_is_declared[0]);
    TEST_ASSERT_EQUAL(b, bounds.current_is_declared[1]);
    TEST_ASSERT_EQUAL(c, bounds.current_is_declared[2]);
}

/* That of a phase before that of all, and that before the machine's. */
static void test_which_current_holds(void)
{
    check_currents(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    check_declared(false, false, false);
    machine.max_current_A = 20.0;
    check_currents(20.0, 20.0, 20.0);
    check_declared(true, true, true);
    options.limits.current_A[1] = 7.0;
    check_currents(20.0, 7.0, 20.0);
    check_declared(true, false, true);
    options.limits.is_open[2] = true;
    check_currents(20.0, 7.0, 0.0);
    check_declared(true, false, false);
    options.limit_current_A = 30.0;
    check_currents(30.0, 7.0, 0.0);
    check_declared(false, false, false);
    options.limit_current_A = 0.0;
    options.limits.ignore_ratings = true;
    check_currents(HUGE_VAL, 7.0, 0.0);
    check_declared(false, false, false);
}

static void test_rms_of_the_phases(void)
{
    options.limits.rms_A[0] = 3.0;
    options.limits.rms_A[2] = 4.0;
    options.limits.is_open[2] = true;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, bounds.rms_A[0]);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, bounds.rms_A[1]);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, bounds.rms_A[2]);
}

/* ---- voltage and copper ---- */

/* The link less a reserve of 0.1 and 2 · 2 µs · 10 kHz = 0.04. */
static void test_voltage_of_the_link(void)
{
    options.limit_voltage_V = 50.0;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, bounds.line_V);
    TEST_ASSERT_FALSE(bounds.modulation || bounds.voltage_is_declared);
    options.limits.voltage_reserve = 0.1;
    options.limits.dead_time_s = 2e-6;
    options.limits.pwm_frequency_Hz = 1e4;
    options.limits.modulation = HCI_MODULATION_SINUSOIDAL;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.86, bounds.line_V_per_V);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 43.0, bounds.line_V);
    TEST_ASSERT_EQUAL_INT(HCI_MODULATION_SINUSOIDAL, bounds.modulation);
}

/* A declared link counts at a speed, were it 0 that is given, and where no other is. */
static void test_voltage_that_is_declared(void)
{
    machine.dc_link_voltage_V = 24.0;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, bounds.line_V);
    options.at_speed = true;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(24.0, bounds.line_V);
    TEST_ASSERT_TRUE(bounds.voltage_is_declared);
    options.at_speed = false;
    options.speed_rad_per_s = -3.0;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(24.0, bounds.line_V);
    options.limit_voltage_V = 60.0;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(60.0, bounds.line_V);
    TEST_ASSERT_FALSE(bounds.voltage_is_declared);
    options.limit_voltage_V = 0.0;
    options.limits.ignore_ratings = true;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, bounds.line_V);
}

/* R Σ i² = 12 W of 0.5 Ω; 1.2 times that of a sine of 4 A, whose Σ i² is 1.5 · 16. */
static void test_copper(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, make(4.0));
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, bounds.mean_square_A2);
    options.limits.copper_ratio = 1.2;
    TEST_ASSERT_EQUAL(HCI_OK, make(4.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 28.8, bounds.mean_square_A2);
    options.limits.copper_W = 12.0;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, make(4.0));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "resistance"));
    machine.resistance_ohm = 0.5;
    TEST_ASSERT_EQUAL(HCI_OK, make(4.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 24.0, bounds.mean_square_A2);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, bounds.resistance_ohm);
    TEST_ASSERT_EQUAL(HCI_OK, make(3.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 16.2, bounds.mean_square_A2);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, make(0.0));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "no sine"));
}

/* ---- what is refused ---- */

static void test_negative_values(void)
{
    double *const value[] = {&options.limit_current_A,     &options.limit_voltage_V,
                             &options.limits.copper_W,     &options.limits.copper_ratio,
                             &options.limits.dead_time_s,  &options.limits.pwm_frequency_Hz,
                             &options.limits.current_A[0], &options.limits.current_A[2],
                             &options.limits.rms_A[0],     &options.limits.rms_A[2]};
    for (size_t k = 0; k < sizeof value / sizeof *value; ++k) {
        *value[k] = -1.0;
        check_refused("negative");
        *value[k] = NAN;
        check_refused("negative");
        *value[k] = 0.0;
        TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    }
    options.speed_rad_per_s = INFINITY;
    check_refused("no number");
}

/* A star carries current in two phases at least, and with a neutral in one. */
static void test_open_phases(void)
{
    static const char *const ANSWER[2][4] = {
        {NULL, NULL, "two phases are limited to 0 A, and a star", "all three"},
        {NULL, NULL, NULL, "all three phases are limited to 0 A, and no"}};
    for (int neutral = 0; neutral < 2; ++neutral)
        for (int open = 0; open <= 3; ++open) {
            machine.has_neutral = neutral == 1;
            for (int s = 0; s < 3; ++s)
                options.limits.is_open[s] = s < open;
            if (ANSWER[neutral][open])
                check_refused(ANSWER[neutral][open]);
            else
                TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
        }
    memset(options.limits.is_open, 0, sizeof options.limits.is_open);
    options.choose_at_most = 3;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    options.limits.is_open[2] = true;
    check_refused("at most K");
    options.choose_at_most = 0;
    const hci_wave held = {1.0, 1, 2.0, 0.0};
    options.held = &held;
    check_refused("phase c carries no current");
    options.limits.is_open[2] = false;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
}

static void test_voltage_that_is_lost(void)
{
    options.limits.dead_time_s = 1e-6;
    check_refused("give both");
    options.limits.pwm_frequency_Hz = 1e5; /* a fifth */
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    options.limits.dead_time_s = 0.0;
    check_refused("give both");
    options.limits.dead_time_s = 1e-6;
    options.limits.voltage_reserve = 0.8;
    check_refused("1 times");
    options.limits.voltage_reserve = 0.79;
    TEST_ASSERT_EQUAL(HCI_OK, make(1.0));
    options.limits.voltage_reserve = -0.1;
    check_refused("from 0 to below 1");
}

/* ---- pairs of phases ---- */

static void test_pairs_that_are_driven(void)
{
    for (int open = 0; open < 3; ++open)
        for (int pair = 0; pair < 3; ++pair) {
            bounds = (hci_bounds){.current_A = {1.0, 1.0, 1.0}};
            TEST_ASSERT_TRUE(hci_bounds_drive_pair(&bounds, pair));
            bounds.current_A[open] = 0.0; /* ab is the pair 0, ca the pair 2 */
            TEST_ASSERT_EQUAL(pair == (open + 1) % 3, hci_bounds_drive_pair(&bounds, pair));
            bounds.modulation = HCI_MODULATION_SINUSOIDAL;
            TEST_ASSERT_EQUAL(pair != open, hci_bounds_drive_pair(&bounds, pair));
            bounds.current_A[(open + 1) % 3] = 0.0; /* no two phases */
            TEST_ASSERT_TRUE(hci_bounds_drive_pair(&bounds, pair));
        }
}

static void test_phases_that_are_alike(void)
{
    bounds = (hci_bounds){.current_A = {1.0, 1.0, 1.0}, .rms_A = {2.0, 2.0, 2.0}};
    TEST_ASSERT_TRUE(hci_bounds_are_alike(&bounds));
    for (int s = 0; s < 3; ++s) {
        bounds.current_A[s] = 1.5;
        TEST_ASSERT_FALSE(hci_bounds_are_alike(&bounds));
        bounds.current_A[s] = 1.0;
        bounds.rms_A[s] = 1.5;
        TEST_ASSERT_FALSE(hci_bounds_are_alike(&bounds));
        bounds.rms_A[s] = 2.0;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_which_current_holds);
    RUN_TEST(test_rms_of_the_phases);
    RUN_TEST(test_voltage_of_the_link);
    RUN_TEST(test_voltage_that_is_declared);
    RUN_TEST(test_copper);
    RUN_TEST(test_negative_values);
    RUN_TEST(test_open_phases);
    RUN_TEST(test_voltage_that_is_lost);
    RUN_TEST(test_pairs_that_are_driven);
    RUN_TEST(test_phases_that_are_alike);
    return UNITY_END();
}
