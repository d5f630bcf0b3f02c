/* A slow turn whose recorded speed is noise around 0 turns the way its angle goes. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>

#include "hci/host/recording/run.h"
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_noise);
    RUN_TEST(test_what_stays);
    return UNITY_END();
}
