/* A slow turn whose recorded speed is noise around 0 turns the way its angle goes. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* ---- by numbers ---- */

enum { MOST = 900, POLE_PAIRS = 3 };

static double at_s[MOST], theta_rad[MOST], rate[MOST];

static hci_run shaft_of(size_t count)
{
    return (hci_run){.time_s = at_s,
                     .theta_m_rad = theta_rad,
                     .speed_rad_per_s = rate,
                     .count = count,
                     .rough_clock = true}; /* so that the recorded speed is looked at */
}

/* The slope over a window around row k of `half` rows on both sides. */
static double slope_at(size_t k, size_t half)
{
    return (theta_rad[k + half] - theta_rad[k - half]) / (at_s[k + half] - at_s[k - half]);
}

/* rms of speed over mean less 1, where the windows before and behind go on at half to twice the pace. */
static double share_by_hand(size_t count)
{
    double pace = 0.0, sum = 0.0, used = 0.0;
    for (size_t k = 0; k < count; ++k)
        pace += fabs(rate[k]) / (double)count;
    const double rows =
        0.5 * HCI_PI * (double)(count - 1) / (POLE_PAIRS * pace * (at_s[count - 1] - at_s[0]));
    const size_t half = rows < (double)(count / 8) ? (size_t)rows + 1 : count / 8;
    for (size_t k = half; k + half < count; ++k) {
        const double mean = slope_at(k, half);
        bool counts = fabs(mean) > 0.2 * pace;
        if (k >= 3 * half)
            counts = counts && fabs(log2(fmax(1e-9, slope_at(k - 2 * half, half) / mean))) < 1.0;
        if (k + 3 * half < count)
            counts = counts && fabs(log2(fmax(1e-9, slope_at(k + 2 * half, half) / mean))) < 1.0;
        if (!counts) continue;
        sum += pow(rate[k] / mean - 1.0, 2.0);
        used += 1.0;
    }
    return used > 0.2 * (double)count ? sqrt(sum / used) : 0.0;
}

/* A shaft that goes at several paces, turns round and waits, over uneven times; noise of its speed. */
static void make_way(size_t count, double pace, double swing)
{
    for (size_t k = 0; k < count; ++k) {
        const double part = (double)k / (double)count, way = part < 0.3   ? 1.0
                                                             : part < 0.4 ? 0.1
                                                             : part < 0.6 ? 2.6
                                                                          : -1.3;
        rate[k] = pace * way * (1.0 + swing * sin(0.9 * (double)k));
        at_s[k] = k > 0 ? at_s[k - 1] + 0.01 * (1.0 + 0.3 * sin((double)k)) : 5.0;
        theta_rad[k] = k > 0 ? theta_rad[k - 1] + rate[k] * (at_s[k] - at_s[k - 1]) : 2.0;
    }
}

static void test_the_share_by_which_a_speed_varies(void)
{
    static const double PACES[] = {0.02, 0.5, 1.4, 3.0, 9.0};
    int told = 0;
    for (size_t j = 0; j < sizeof PACES / sizeof *PACES; ++j)
        for (size_t count = 400; count <= MOST; count += 250) {
            double share;
            make_way(count, PACES[j], 0.3);
            const hci_run shaft = shaft_of(count);
            TEST_ASSERT_TRUE(hci_speed_variation(&shaft, POLE_PAIRS, &share));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, share_by_hand(count), share);
            told += share > 0.0;
        }
    TEST_ASSERT_TRUE(told >= 6);
}

/* Without a way to look at there is no share. */
static void test_no_share(void)
{
    double share = 1.0;
    make_way(MOST, 1.4, 0.3);
    hci_run shaft = shaft_of(15);
    TEST_ASSERT_TRUE(hci_speed_variation(&shaft, POLE_PAIRS, &share));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, share);
    shaft = shaft_of(MOST);
    for (int which = 0; which < 2; ++which) {
        hci_run lacking = shaft;
        *(which ? &lacking.time_s : &lacking.theta_m_rad) = NULL;
        TEST_ASSERT_TRUE(hci_speed_variation(&lacking, POLE_PAIRS, &share));
        TEST_ASSERT_EQUAL_DOUBLE(0.0, share);
    }
    memset(rate, 0, sizeof rate);
    TEST_ASSERT_TRUE(hci_speed_variation(&shaft, POLE_PAIRS, &share));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, share);
}

/* Signs that alternate in so many of 1000 rows, of a shaft that goes one way. */
static bool is_noise(int rows, int apart)
{
    static double slope[1000], speed[1000];
    hci_run shaft = {.speed_rad_per_s = speed, .count = 1000};
    for (int k = 0; k < 1000; ++k) {
        const int turn = (k - 100) / apart;
        slope[k] = 2.0;
        speed[k] = k >= 100 && k % apart == 0 && turn < rows ? -0.5 : 3.0;
    }
    return hci_speed_sign_is_noise(&shaft, slope);
}

/* One row of a hundred, and four changes for one of the angle and one more. */
static void test_how_often_noise_turns_a_sign(void)
{
    TEST_ASSERT_TRUE(is_noise(10, 5));
    TEST_ASSERT_FALSE(is_noise(9, 5));
    TEST_ASSERT_FALSE(is_noise(10, 1)); /* ten rows together change it twice */
    const double x[] = {0.0, 1.0, 0.0, -2.0, -1.0, 0.0, 3.0, 3.0, -1.0};
    TEST_ASSERT_EQUAL_UINT64(3, hci_speed_sign_changes(x, 9));
    TEST_ASSERT_EQUAL_UINT64(2, hci_speed_sign_changes(x, 8));
    TEST_ASSERT_EQUAL_UINT64(0, hci_speed_sign_changes(x, 3));
}

/* Of an angle that turns round once itself it is eight changes. */
static void test_changes_beside_those_of_the_angle(void)
{
    static double slope[1000], speed[1000];
    const hci_run shaft = {.speed_rad_per_s = speed, .count = 1000};
    for (int changes = 7; changes <= 9; changes += 2) {
        for (int k = 0; k < 1000; ++k) {
            slope[k] = k < 500 ? 2.0 : -2.0;
            const int turn = (k - 100) / 5; /* each of them turns twice, for five rows */
            speed[k] = slope[k] * (k >= 100 && turn % 2 == 0 && turn / 2 < changes / 2 ? -0.2 : 1.0);
        }
        TEST_ASSERT_EQUAL_UINT64(changes, hci_speed_sign_changes(speed, 1000));
        TEST_ASSERT_EQUAL(changes == 9, hci_speed_sign_is_noise(&shaft, slope));
    }
}

/* A shaft that slows down to a share of its pace and goes on, there or round. */
static size_t stops_with(double slow, double then, double *path_turns)
{
    for (size_t k = 0; k < 800; ++k) {
        const double way = k < 300 ? 1.0 : k < 400 ? slow : then;
        at_s[k] = 0.01 * (double)k;
        theta_rad[k] = k > 0 ? theta_rad[k - 1] + 0.02 * way : 0.5;
    }
    const hci_run shaft = {.time_s = at_s, .theta_m_rad = theta_rad, .count = 800};
    return hci_speed_stops(&shaft, POLE_PAIRS, path_turns);
}

/* A fifth of the mean pace, and half of it to go on. Of 0.02 a row in 700 of 800 rows and `slow` in the
 * others that is (700 + 100·slow)/800 of it. */
static void test_what_a_stop_is(void)
{
    double path_turns;
    TEST_ASSERT_EQUAL_UINT64(1, stops_with(0.165, 1.0, &path_turns));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.02 * (699.0 + 16.5) * POLE_PAIRS / (2.0 * HCI_PI), path_turns);
    TEST_ASSERT_EQUAL_UINT64(0, stops_with(0.195, 1.0, &path_turns));
    TEST_ASSERT_EQUAL_UINT64(0, stops_with(0.1, -1.0, &path_turns));
    TEST_ASSERT_EQUAL_UINT64(1, stops_with(-0.1, 1.0, &path_turns));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_share_by_which_a_speed_varies);
    RUN_TEST(test_no_share);
    RUN_TEST(test_how_often_noise_turns_a_sign);
    RUN_TEST(test_changes_beside_those_of_the_angle);
    RUN_TEST(test_what_a_stop_is);
    RUN_TEST(test_a_shaft_that_sticks_and_slips);
    RUN_TEST(test_stops_on_the_way);
    RUN_TEST(test_noise_where_the_shaft_starts);
    RUN_TEST(test_noise);
    RUN_TEST(test_what_stays);
    return UNITY_END();
}
