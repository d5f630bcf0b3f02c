/* What is said of a current loop, against the closed form of an inductance behind one sample of delay, and
 * which reading of a measured response is found. */
#include <complex.h>
#include <math.h>
#include <string.h>

#include "hci/host/drive/drive_facts.h"
#include "support/files.h"
#include "unity.h"

static const double SAMPLE_s = 1e-4, L_H = 2e-3, TWO_PI = 6.283185307179586;

static hci_machine_data machine;

void setUp(void)
{
    hci_note note = {{0}};
    files_begin();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_read("data/machine_a", &machine, &note));
    machine.resistance_ohm = 1e-9;
    machine.inductance_d_H = machine.inductance_q_H = L_H;
    machine.dc_link_voltage_V = 100.0;
}

void tearDown(void)
{
    hci_machine_release(&machine);
    files_end();
}

/* k_p = g L/T: the poles are those of z² − z + g, and G = P H C/(1 + C P_s). */
static double complex answer(double g, double delay_samples, double frequency_Hz)
{
    const double nu = TWO_PI * frequency_Hz, x = 0.5 * nu * SAMPLE_s;
    const double complex j = (double complex)I, z = cexp(j * nu * SAMPLE_s);
    const double complex held = g * sin(x) / x / (j * nu * SAMPLE_s);
    const double complex sampled = g * (1.0 - delay_samples + delay_samples / z) / (z - 1.0);
    return held * cexp(-j * nu * SAMPLE_s * (delay_samples + 0.5)) / (1.0 + sampled);
}

static hci_status look(const char *rows, double speed_rad_per_s, hci_drive_facts *f, hci_note *note)
{
    hci_drive_data d;
    char text[256];
    memset(note, 0, sizeof *note);
    snprintf(text, sizeof text, "name,value,unit\ncurrent_ki,0,\n%s", rows);
    files_write(files_path("drive.csv"), text);
    hci_status status = hci_drive_read(files_path("drive.csv"), &d, note);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, status, note->text);
    status = hci_drive_facts_of(&d, &machine, speed_rad_per_s, f, note);
    hci_drive_release(&d);
    return status;
}

static void test_an_inductance_behind_one_sample(void)
{
    static const double G[] = {0.1, 0.2, 0.5};
    for (int k = 0; k < 3; ++k) {
        hci_drive_facts f;
        hci_note note;
        char rows[64];
        snprintf(rows, sizeof rows, "current_kp,%.17g,ohm\n", G[k] * L_H / SAMPLE_s);
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, look(rows, 100.0, &f, &note), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 / G[k], 1.0 / G[k], f.gain_margin);
        const double pole = G[k] > 0.25 ? sqrt(G[k]) : 0.5 + sqrt(0.25 - G[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, pole, f.largest_pole);
        for (int axis = 0; axis < 2; ++axis)
            TEST_ASSERT_DOUBLE_WITHIN(1e-5, sqrt(0.5), cabs(answer(G[k], 1.0, f.bandwidth_Hz[axis])));
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-6, -carg(answer(G[k], 1.0, 0.01 / SAMPLE_s)) / (TWO_PI * 0.01) * SAMPLE_s, f.lead_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, TWO_PI * 1000.0 / 2.0, f.sampled_rad_per_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.8 * 0.5 * TWO_PI / SAMPLE_s / 200.0, f.highest_order);
        TEST_ASSERT_TRUE(isnan(f.response_off));
    }
}

/* What the samples read: k_p P_s/(1 + k_p P_s). */
static double complex reading(double g, double delay_samples, double frequency_Hz)
{
    const double complex z = cexp(TWO_PI * frequency_Hz * SAMPLE_s * (double complex)I);
    const double complex sampled = g * (1.0 - delay_samples + delay_samples / z) / (z - 1.0);
    return sampled / (1.0 + sampled);
}

/* What a column is times of, or more by: frequency, every gain, every second gain, phase. */
typedef struct {
    double frequency, gain, second, turn_rad;
} slip;

/* loop.csv of a loop with k_p = g L/T. of: `samples` or `current`. */
static void write_response(double g, double delay_samples, const char *of, slip s)
{
    static const double FREQUENCY[] = {50, 100, 200, 400, 1200, 3200};
    char text[1024] = "frequency_Hz,gain_d,phase_d_rad,gain_q,phase_q_rad\n";
    for (int k = 0; k < 6; ++k) {
        const double complex x = strcmp(of, "samples") == 0 ? reading(g, delay_samples, FREQUENCY[k])
                                                            : answer(g, delay_samples, FREQUENCY[k]);
        const double gain = cabs(x) * s.gain * (k % 2 ? s.second : 1.0),
                     phase = remainder(carg(x) + s.turn_rad, TWO_PI);
        const size_t end = strlen(text);
        snprintf(text + end, sizeof text - end, "%.9g,%.9g,%.9g,%.9g,%.9g\n", FREQUENCY[k] * s.frequency,
                 gain, phase, gain, phase);
    }
    files_write(files_path("loop.csv"), text);
}

static hci_drive_facts facts_of_response(const char *of)
{
    hci_drive_facts f;
    hci_note note;
    char rows[128];
    snprintf(rows, sizeof rows, "current_kp,%.17g,ohm\nresponse,loop.csv,\nresponse_of,%s,\n",
             0.2 * L_H / SAMPLE_s, of);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, look(rows, 0.0, &f, &note), note.text);
    TEST_ASSERT_EQUAL_UINT(6, f.response_count);
    return f;
}

static void test_a_response_is_that_of_the_gains_or_why_not(void)
{
#define NONE                                                                                                 \
    {                                                                                                        \
        1.0, 1.0, 1.0, 0.0                                                                                   \
    }
#define PI 3.14159265358979323846
    static const struct {
        double g, delay;
        const char *of, *declared;
        slip of_columns;
        hci_response_reading reading;
        double value;
    } CASE[] = {
        {0.2, 1.0, "samples", "samples", NONE, HCI_RESPONSE_AS_DECLARED, NAN},
        {0.2, 1.0, "current", "current", NONE, HCI_RESPONSE_AS_DECLARED, NAN},
        {0.22, 1.0, "samples", "samples", NONE, HCI_RESPONSE_AS_DECLARED, NAN},
        {0.2, 1.0, "current", "samples", NONE, HCI_RESPONSE_OTHER_CURRENT, NAN},
        {0.2, 1.0, "samples", "current", NONE, HCI_RESPONSE_OTHER_CURRENT, NAN},
        {0.1, 1.0, "samples", "samples", NONE, HCI_RESPONSE_GAINS, 0.5},
        {0.2, 0.0, "samples", "samples", NONE, HCI_RESPONSE_DELAY, 0.0},
        {0.2, 1.0, "samples", "samples", {2.0 * PI, 1.0, 1.0, 0.0}, HCI_RESPONSE_FREQUENCY, 0.5 / PI},
        {0.2, 1.0, "current", "current", {0.5 / PI, 1.0, 1.0, 0.0}, HCI_RESPONSE_FREQUENCY, 2.0 * PI},
        {0.2,
         1.0,
         "samples",
         "samples",
         {1.0, 0.70710678118654752, 1.0, 0.0},
         HCI_RESPONSE_SCALE,
         1.4142135623730951},
        {0.2, 1.0, "samples", "samples", {1.0, 0.01, 1.0, 0.0}, HCI_RESPONSE_SCALE, 100.0},
        {0.2, 1.0, "samples", "samples", {1.0, 1.0, 1.0, PI}, HCI_RESPONSE_HALF_TURN, NAN},
        {0.2, 1.0, "samples", "samples", {1.0, 1.0, 4.0, 0.0}, HCI_RESPONSE_UNKNOWN, NAN},
    };
#undef NONE
#undef PI
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        write_response(CASE[k].g, CASE[k].delay, CASE[k].of, CASE[k].of_columns);
        const hci_drive_facts f = facts_of_response(CASE[k].declared);
        TEST_ASSERT_EQUAL_STRING(hci_response_reading_name(CASE[k].reading),
                                 hci_response_reading_name(f.reading));
        TEST_ASSERT_EQUAL(isnan(CASE[k].value), isnan(f.reading_value));
        if (!isnan(CASE[k].value)) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, CASE[k].value, f.reading_value);
        }
        TEST_ASSERT_TRUE(k > 1 || f.response_off < 1e-4);
        TEST_ASSERT_TRUE(f.reading != HCI_RESPONSE_UNKNOWN || f.response_off == f.reading_off);
    }
}

static void test_what_is_not_stable_is_refused(void)
{
    hci_drive_facts f;
    hci_note note;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, look("current_kp,21,ohm\n", 0.0, &f, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "not stable at 0 rpm"), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, look("", 4000.0, &f, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "samples in an electrical turn"), note.text);
    /* without decoupling, and with as much gain as it takes, speed alone makes it unstable */
    TEST_ASSERT_EQUAL_INT(HCI_OK, look("current_kp,18,ohm\ndecoupling,none,\n", 0.0, &f, &note));
    TEST_ASSERT_TRUE(isfinite(f.stable_rad_per_s) && f.stable_rad_per_s > 0.0);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, look("current_kp,18,ohm\ndecoupling,none,\n", 0.99 * f.stable_rad_per_s, &f, &note));
    TEST_ASSERT_EQUAL_INT(
        HCI_ERROR_INPUT, look("current_kp,18,ohm\ndecoupling,none,\n", 1.01 * f.stable_rad_per_s, &f, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_inductance_behind_one_sample);
    RUN_TEST(test_a_response_is_that_of_the_gains_or_why_not);
    RUN_TEST(test_what_is_not_stable_is_refused);
    return UNITY_END();
}
