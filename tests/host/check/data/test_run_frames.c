/* Waves that turn with an angle, in frames that turn so many times as fast: closed forms of single waves. */
#include <math.h>
#include <string.h>

#include "host/check/data/run_samples.h"
#include "unity.h"

enum { N = 1200 };

static const double PI = 3.14159265358979323846, TIGHT = 1e-12;

static double theta[N], torque[N];
static check_vector current[N], voltage[N];
static check_samples s;
static check_run run;
static check_data data;

/* Three turns of a mechanical angle; frames of 1, 4 and 7. */
void setUp(void)
{
    s = (check_samples){.count = N, .theta = theta};
    memset(&run, 0, sizeof run);
    memset(&data, 0, sizeof data);
    data.scales = 3;
    data.scale[0] = 1.0;
    data.scale[1] = 4.0;
    data.scale[2] = 7.0;
    for (size_t k = 0; k < N; ++k)
        theta[k] = 6.0 * PI * (double)k / N;
    run.theta = theta;
    run.angle_range = theta[N - 1];
}

void tearDown(void)
{
}

/* a e^{j(nθ + 0.4)} + b e^{−j(nθ + 0.4)}; sign: of a current that is switched. */
static void wave(check_vector *x, double order, double a, double b, bool switched)
{
    double square = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double phase = order * theta[k] + 0.4, sign = switched && k % 2 ? -1.0 : 1.0;
        x[k] = (check_vector){sign * (a + b) * cos(phase), sign * (a - b) * sin(phase)};
        square += (x[k].re * x[k].re + x[k].im * x[k].im) / N;
    }
    if (x == current) {
        s.current = current;
        run.current_square = square;
    } else {
        s.voltage = voltage;
        run.voltage_square = square;
    }
}

static void check_vector_is(double re, double im, check_vector x)
{
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, re, x.re);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, im, x.im);
}

static void test_means_in_the_frames(void)
{
    wave(current, 4.0, 3.0, 0.5, false);
    wave(voltage, 7.0, 0.25, 20.0, false);
    hci_check_run_frames(&data, &s, &run);
    for (int k = 0; k < 3; ++k) {
        const bool of_current = k == 1, of_voltage = k == 2;
        TEST_ASSERT_EQUAL_DOUBLE(data.scale[k], run.frame[k].scale);
        check_vector_is(of_current ? 3.0 * cos(0.4) : 0.0, of_current ? 3.0 * sin(0.4) : 0.0,
                        run.frame[k].current[CHECK_FORWARD]);
        check_vector_is(of_current ? 0.5 * cos(0.4) : 0.0, of_current ? -0.5 * sin(0.4) : 0.0,
                        run.frame[k].current[CHECK_BACKWARD]);
        check_vector_is(of_voltage ? 0.25 * cos(0.4) : 0.0, of_voltage ? 0.25 * sin(0.4) : 0.0,
                        run.frame[k].voltage[CHECK_FORWARD]);
        check_vector_is(of_voltage ? 20.0 * cos(0.4) : 0.0, of_voltage ? -20.0 * sin(0.4) : 0.0,
                        run.frame[k].voltage[CHECK_BACKWARD]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(4.0, run.current_order);
    TEST_ASSERT_EQUAL_DOUBLE(-7.0, run.voltage_order);
    TEST_ASSERT_TRUE(run.current_is_steady);
    TEST_ASSERT_EQUAL_PTR(&run.frame[1], hci_check_frame_of(&run, -4.0));
    TEST_ASSERT_NULL(hci_check_frame_of(&run, 5.0));
    run.theta = NULL;
    TEST_ASSERT_NULL(hci_check_frame_of(&run, 4.0));
}

/* Six tenths of the square turn with the angle: b² is two thirds of a². */
static void test_what_is_coherent(void)
{
    for (int more = 0; more < 2; ++more) {
        run.is_electrical = true; /* nothing else is looked for */
        wave(current, 4.0, 1.0, sqrt((more ? 0.98 : 1.02) * 2.0 / 3.0), false);
        hci_check_run_frames(&data, &s, &run);
        TEST_ASSERT_EQUAL(more, !isnan(run.current_order));
        TEST_ASSERT_EQUAL(more, run.current_is_steady);
        TEST_ASSERT_TRUE(isnan(run.voltage_order));
        setUp();
    }
}

/* What has not turned three quarters of a turn is nothing: a range of 1.5 π over the order. */
static void test_what_has_not_turned(void)
{
    for (int more = 0; more < 2; ++more) {
        run.is_electrical = true;
        wave(current, 4.0, 1.0, 0.0, false);
        run.angle_range = (more ? 1.01 : 0.99) * 1.5 * PI / 4.0;
        hci_check_run_frames(&data, &s, &run);
        TEST_ASSERT_EQUAL(more, !isnan(run.current_order));
        setUp();
    }
}

/* Orders of no frame are counted, by a mechanical angle: those of a current that changes its sign, too. */
static void test_orders_that_are_counted(void)
{
    for (int switched = 0; switched < 2; ++switched)
        for (int back = 0; back < 2; ++back) {
            const int at = CHECK_SCALES;
            wave(current, 11.0, back ? 0.1 : 2.0, back ? 2.0 : 0.1, switched);
            hci_check_run_frames(&data, &s, &run);
            TEST_ASSERT_EQUAL_DOUBLE(back ? -11.0 : 11.0, run.current_order);
            TEST_ASSERT_EQUAL_DOUBLE(11.0, run.frame[at].scale);
            TEST_ASSERT_EQUAL(!switched, run.current_is_steady);
            if (!switched)
                TEST_ASSERT_DOUBLE_WITHIN(
                    1e-9, 2.0,
                    hci_check_length(run.frame[at].current[back ? CHECK_BACKWARD : CHECK_FORWARD]));
            setUp();
        }
    wave(voltage, 60.0, 1.0, 0.0, false);
    hci_check_run_frames(&data, &s, &run);
    TEST_ASSERT_EQUAL_DOUBLE(60.0, run.voltage_order);
    TEST_ASSERT_TRUE(isnan(run.current_order));
    TEST_ASSERT_EQUAL_DOUBLE(60.0, run.frame[CHECK_SCALES].scale);
    setUp();
    wave(voltage, 61.0, 1.0, 0.0, false);
    hci_check_run_frames(&data, &s, &run); /* beyond those, and between them, by the slope */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 61.0, run.voltage_order);
    setUp();
    wave(voltage, 1.4, 0.0, 1.0, false);
    hci_check_run_frames(&data, &s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -1.4, run.voltage_order);
    setUp();
    run.is_electrical = true; /* an electrical angle counts nothing */
    wave(voltage, 11.0, 1.0, 0.0, false);
    hci_check_run_frames(&data, &s, &run);
    TEST_ASSERT_TRUE(isnan(run.voltage_order));
}

/* S sin nθ + C cos nθ about the mean; what has been asked for is kept. */
static void test_orders_of_the_torque(void)
{
    run.torque = torque;
    run.count = N;
    run.torque_mean = 5.0;
    for (size_t k = 0; k < N; ++k)
        torque[k] =
            5.0 + 0.3 * sin(12.0 * theta[k]) - 0.2 * cos(12.0 * theta[k]) + 0.7 * cos(18.0 * theta[k]);
    check_vector_is(0.3, -0.2, hci_check_torque_order(&run, 12.0));
    check_vector_is(0.0, 0.7, hci_check_torque_order(&run, 18.0));
    check_vector_is(0.0, 0.0, hci_check_torque_order(&run, 24.0));
    TEST_ASSERT_EQUAL(3, run.cached_count);
    torque[0] += 1000.0;
    check_vector_is(0.3, -0.2, hci_check_torque_order(&run, 12.0)); /* as it was */
    TEST_ASSERT_EQUAL(3, run.cached_count);
    for (int k = 0; k < CHECK_CACHED_ORDERS; ++k)
        (void)hci_check_torque_order(&run, 30.0 + k);
    TEST_ASSERT_TRUE(hci_check_torque_order(&run, 12.0).im > 0.0); /* the oldest gave way */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_in_the_frames);
    RUN_TEST(test_what_is_coherent);
    RUN_TEST(test_what_has_not_turned);
    RUN_TEST(test_orders_that_are_counted);
    RUN_TEST(test_orders_of_the_torque);
    return UNITY_END();
}
