/* A slow turn whose recorded speed is noise around 0 turns the way its angle goes. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>

#include "hci/host/recording/run.h"
#include "hci/math/harmonic.h"
#include "host/recording/speed_variation.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_run run;

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    hci_run_release(&run);
    files_end();
}

/* There and back at 0.2 rad/s; the speed reads `off` to and fro beside it, times `sign`. Or a shaft that
 * shivers. */
static void read_turn(double off, double sign, double shiver)
{
    const char *path = files_path("run.csv");
    FILE *file = fopen(path, "w");
    hci_note note = {{0}};
    double theta = 1.0;
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (int k = 0; k < 2000; ++k) {
        const double speed = k < 1000 ? 0.2 : -0.2, noise = off * sin(1e3 * k * k);
        theta += 0.01 * (speed + shiver * cos(0.2 * k));
        fprintf(file, "%.9g,%.9g,%.9g,1\n", 0.01 * k, theta, sign * (speed + noise + shiver * cos(0.2 * k)));
    }
    fclose(file);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_read(path, &(hci_run_options){.pole_pairs = 3, .holding = true}, &run, &note),
        note.text);
}

static bool is_slope(void)
{
    return run.speed_window > 0;
}

static void test_noise(void)
{
    read_turn(0.3, 1.0, 0.0);
    TEST_ASSERT_TRUE(is_slope());
    text_has("noise turns the sign of the recorded speed about", run.remark.text);
    for (size_t k = 100; k < 1900; ++k)
        if (k < 900 || k > 1100)
            TEST_ASSERT_DOUBLE_WITHIN(1e-3, k < 1000 ? 0.2 : -0.2, run.speed_rad_per_s[k]);
}

static void test_what_stays(void)
{
    read_turn(0.1, 1.0, 0.0); /* always of the direction */
    TEST_ASSERT_FALSE(is_slope());
    read_turn(0.3, -1.0, 0.0); /* another convention */
    TEST_ASSERT_FALSE(is_slope());
    read_turn(0.0, 1.0, 0.5); /* the shaft does turn to and fro */
    TEST_ASSERT_FALSE(is_slope());
}

/* At 0.4 rad/s on the whole, in jerks of `jerk_rad` with rests between; 0: evenly, with a pause in the
 * middle. */
static void read_jerks(double jerk_rad)
{
    const char *path = files_path("run.csv");
    FILE *file = fopen(path, "w");
    hci_note note = {{0}};
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,iq_A\n");
    for (int k = 0; k < 4000; ++k) {
        const double way = 0.004 * (k < 2000 ? k : k < 2400 ? 2000 : k - 400), rest = fmod(way, jerk_rad);
        const double theta = jerk_rad > 0.0 ? way - rest + fmax(0.0, 5.0 * rest - 4.0 * jerk_rad) : way;
        fprintf(file, "%.9g,%.9g,%.9g\n", 0.01 * k, theta, cos(0.1 * k));
    }
    fclose(file);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_read(path, &(hci_run_options){.pole_pairs = 3, .holding = true}, &run, &note),
        note.text);
}

/* Of an electrical turn and of a twelfth of it: longer than what its own neighbourhood tells, and shorter. */
static void test_a_shaft_that_sticks_and_slips(void)
{
    read_jerks(2.0 * HCI_PI / 3.0);
    TEST_ASSERT_TRUE(run.is_unsteady);
    text_has("comes to rest", run.remark.text);
    read_jerks(2.0 * HCI_PI / 36.0);
    TEST_ASSERT_TRUE(run.is_unsteady);
    read_jerks(0.0);
    TEST_ASSERT_FALSE(run.is_unsteady);
}

/* A shaft that stands at 64 of 320 samples twice on its way of so many electrical turns: 0.05 of a turn at
 * the mean pace has to be some samples, and not most of them. */
static void test_stops_on_the_way(void)
{
    enum { N = 320, PAIRS = 3 };
    static double theta_m_rad[N], time_s[N];
    static const double TURNS[] = {0.15, 2.0, 8.0};
    for (int j = 0; j < 3; ++j) {
        double share = 0.0, path_turns;
        for (int k = 0; k < N; ++k) {
            const bool stands = (k >= 64 && k < 128) || (k >= 192 && k < 256);
            time_s[k] = 0.01 * k;
            theta_m_rad[k] = 2.0 * 3.14159265358979 * TURNS[j] / PAIRS * share;
            share += stands ? 0.0 : 1.0 / (N - 129);
        }
        const hci_run shaft = {.time_s = time_s, .theta_m_rad = theta_m_rad, .count = N};
        TEST_ASSERT_EQUAL_UINT64(j == 0 ? 0 : 2, hci_speed_stops(&shaft, PAIRS, &path_turns));
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, TURNS[j], path_turns);
    }
}

/* A shaft that starts and stops, with torques: five rows in which noise has the other sign than the angle. */
static void test_noise_where_the_shaft_starts(void)
{
    enum { N = 1000 };
    static double theta_m_rad[N], time_s[N], speed[N], slope[N];
    hci_run shaft = {.time_s = time_s, .theta_m_rad = theta_m_rad, .speed_rad_per_s = speed, .count = N};
    for (int k = 0; k < N; ++k) {
        time_s[k] = 0.01 * k;
        slope[k] = 0.1 + 10.0 * sin(HCI_PI * k / N);
        theta_m_rad[k] = k > 0 ? theta_m_rad[k - 1] + 0.01 * slope[k] : 0.0;
        speed[k] = slope[k] - (k < 10 && k % 2 ? 0.5 : 0.0);
    }
    TEST_ASSERT_EQUAL_UINT64(5, hci_speed_sign_mend(&shaft, slope));
    TEST_ASSERT_DOUBLE_WITHIN(0.0, slope[3], speed[3]);
    TEST_ASSERT_DOUBLE_WITHIN(0.0, slope[4], speed[4]);
    TEST_ASSERT_EQUAL_UINT64(0, hci_speed_sign_mend(&shaft, slope));
    for (int k = 0; k < N; ++k) /* where it turns round in both, a row earlier, it is no noise */
        slope[k] = k < N / 2 ? 1.0 : -1.0, speed[k] = k <= N / 2 ? 1.0 : -1.0;
    TEST_ASSERT_EQUAL_UINT64(0, hci_speed_sign_mend(&shaft, slope));
    for (int k = 0; k < N; ++k) /* a speed without a sign */
        slope[k] = -1.0, speed[k] = k == 5 ? -1.0 : 1.0;
    TEST_ASSERT_EQUAL_UINT64(0, hci_speed_sign_mend(&shaft, slope));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_shaft_that_sticks_and_slips);
    RUN_TEST(test_stops_on_the_way);
    RUN_TEST(test_noise_where_the_shaft_starts);
    RUN_TEST(test_noise);
    RUN_TEST(test_what_stays);
    return UNITY_END();
}
