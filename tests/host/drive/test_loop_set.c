/* What a controller holds in flash, of a machine and currents that a pencil does: orders, their currents and
 * voltages, the speeds at which they end, the points of a table, and what a measured response says. */
#include "host/drive/loop_set.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "support/current_waves.h"
#include "unity.h"

static const double R_ohm = 0.7, L_d = 2e-3, L_q = 3.5e-3, E = 0.12, T_s = 1e-4, LINK_V = 48.0;
static const int PAIRS = 2;
static const hci_wave EMF = {1.0, 1, 0.12, 0.0};

/* i_q = 4 A, i_d = −3 A, and orders that make 6 and 12 in the rotor frame. */
static const hci_wave WAVES[] = {{1.0, 1, 4.0, 3.0}, {5.0, -1, 0.4, -0.2}, {13.0, 1, -0.3, 0.1}};

static hci_machine_data machine, fitted;
static hci_drive_data drive;
static hci_loop_set set;
static hci_loop_task task;
static hci_note note;

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    machine.model.pole_pairs = PAIRS;
    machine.model.back_emf = &EMF;
    machine.model.back_emf_count = 1;
    machine.resistance_ohm = R_ohm;
    machine.inductance_d_H = L_d;
    machine.inductance_q_H = L_q;
    hci_drive_init(&drive);
    drive.dc_link_voltage_V = LINK_V;
    drive.sample_s = T_s;
    memset(&set, 0, sizeof set);
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_loop_set_release(&set);
}

static void make(const hci_loop_level *level, size_t count, double max_error_A, double speed_rad_per_s)
{
    hci_loop_set_release(&set);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_drive_fit(&drive, &machine, &fitted, &note), note.text);
    task = (hci_loop_task){&fitted, &drive, level, count, max_error_A, speed_rad_per_s, NULL};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_loop_set_make(&task, &set, &note), note.text);
}

/* ---- orders ---- */

enum { ANGLES = 256 };

/* Cosine and sine of d or q at an electrical order, by sums over two turns. */
static hci_loop_pair order_of(const currents *c, double order, int axis)
{
    double cosine = 0.0, sine = 0.0, i[3];
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = 4.0 * REF_PI * k / ANGLES;
        reference_currents(c, HCI_TABLE_DQ, theta, i);
        cosine += (order > 0.0 ? 2.0 : 1.0) / ANGLES * i[axis] * cos(order * theta);
        sine += 2.0 / ANGLES * i[axis] * sin(order * theta);
    }
    return (hci_loop_pair){(float)cosine, order > 0.0 ? (float)sine : 0.0f};
}

static currents currents_of(const hci_wave *wave, size_t count)
{
    currents c = {.count = 0};
    for (size_t k = 0; k < count; ++k)
        add(&c, wave[k].order, wave[k].sequence, hypot(wave[k].sine, wave[k].cosine),
            atan2(wave[k].cosine, wave[k].sine));
    return c;
}

/* A float has 6e-8 of the largest current; of a voltage times the order. */
static void check_pair(double cosine, double sine, hci_loop_pair x, double scale)
{
    TEST_ASSERT_DOUBLE_WITHIN(2e-7 * scale, cosine, (double)x.c);
    TEST_ASSERT_DOUBLE_WITHIN(2e-7 * scale, sine, (double)x.s);
}

/* v_d = L_d di_d/dθ − L_q i_q, v_q = L_q di_q/dθ + L_d i_d + E/p; d/dθ of c cos nθ + s sin nθ has the cosine
 * n s and the sine −n c. The decoupling adds what is no derivative. */
static void check_order(const currents *c, double order, const hci_loop_wave *wave)
{
    const hci_loop_pair d = order_of(c, order, 0), q = order_of(c, order, 1);
    const double e = order > 0.0 ? 0.0 : E / PAIRS, scale_Vs = 5.0 * L_q * (1.0 + order);
    check_pair((double)d.c, (double)d.s, wave->current_A[0], 5.0);
    check_pair((double)q.c, (double)q.s, wave->current_A[1], 5.0);
    check_pair(L_d * order * (double)d.s - L_q * (double)q.c, -L_d * order * (double)d.c - L_q * (double)q.s,
               wave->voltage_Vs[0], scale_Vs);
    check_pair(L_q * order * (double)q.s + L_d * (double)d.c + e,
               -L_q * order * (double)q.c + L_d * (double)d.s, wave->voltage_Vs[1], scale_Vs);
    check_pair(-L_q * (double)q.c, -L_q * (double)q.s, wave->own_Vs[0], scale_Vs);
    check_pair(L_d * (double)d.c + e, L_d * (double)d.s, wave->own_Vs[1], scale_Vs);
}

static void test_orders_of_currents_and_voltages(void)
{
    const currents c = currents_of(WAVES, 3);
    const hci_loop_level level = {0.5, WAVES, 3};
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_UINT32(3, set.loop.order_count);
    TEST_ASSERT_EQUAL_UINT32(1, set.loop.levels);
    TEST_ASSERT_EQUAL_UINT32(6, set.loop.repeats);
    TEST_ASSERT_EQUAL_UINT32(1, set.loop.period_turns);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, (double)set.loop.base_order);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, hci_loop_set_highest_order(&set));
    for (uint16_t k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_UINT16(k, set.loop.orders[k]);
        check_order(&c, 6.0 * k, &set.loop.waves[k]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, set.share_left_out);
}

/* Order 5/2 is 3/2 in the rotor frame: it repeats after two turns, and so does 9/2 of order 11/2. */
static void test_fractional_orders(void)
{
    const hci_wave wave[] = {WAVES[0], {2.5, 1, 0.2, 0.1}, {5.5, 1, -0.1, 0.2}};
    const currents c = currents_of(wave, 3);
    const hci_loop_level level = {0.5, wave, 3};
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_UINT32(3, set.loop.order_count);
    TEST_ASSERT_EQUAL_UINT32(3, set.loop.repeats);
    TEST_ASSERT_EQUAL_UINT32(2, set.loop.period_turns);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, (double)set.loop.base_order);
    TEST_ASSERT_EQUAL_DOUBLE(4.5, hci_loop_set_highest_order(&set));
    for (int k = 0; k < 3; ++k)
        check_order(&c, k == 2 ? 4.5 : 1.5 * k, &set.loop.waves[k]);
}

/* The largest current of the two levels is √(5² + 0²) A at constant i_d and i_q. An order of less than 1e-4
 * of it, whose voltage by ω is less than 2e-4 of that of order 0, is left out and told. */
static void test_small_orders_are_left_out_and_told(void)
{
    static const double SMALL_A[] = {0.9e-4 * 5.0, 1.1e-4 * 5.0};
    for (size_t k = 0; k < 2; ++k) {
        /* of order 1, which makes order 2 there: e by which its voltage is small beside E/p stays away */
        const hci_wave wave[2][2] = {{{1.0, 1, 2.0, 0.0}, {3.0, 1, 0.0, 0.0}},
                                     {{1.0, 1, 5.0, 0.0}, {3.0, 1, SMALL_A[k], 0.0}}};
        const hci_loop_level level[2] = {{0.5, wave[0], 2}, {1.0, wave[1], 2}};
        machine.inductance_d_H = machine.inductance_q_H = 1e-3; /* 2 ω L i is below 2e-4 of E/p */
        make(level, 2, 0.0, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(2.0 * SMALL_A[k], 5.0, set.peak_A);
        TEST_ASSERT_EQUAL_UINT32(1 + k, set.loop.order_count);
        TEST_ASSERT_EQUAL_UINT32(2, set.loop.levels);
        if (k == 0) TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.9e-4, set.share_left_out);
        TEST_ASSERT_EQUAL_DOUBLE(5.0, (double)set.loop.waves[1].current_A[1].c);
        TEST_ASSERT_EQUAL_DOUBLE(0.5, (double)set.loop.torque_low_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, (double)set.loop.torque_high_Nm);
    }
}

/* Order 901 makes 900 in the rotor frame, near the 1024 that a turn is sampled for: of a current that is too
 * small to matter, and a voltage 900 ω L i of 7e-3 of E/p, which is not. */
static void test_a_high_order_is_kept_by_its_voltage(void)
{
    const hci_wave wave[] = {{1.0, 1, 5.0, 0.0}, {901.0, 1, 0.9e-4 * 5.0, 0.0}};
    const hci_loop_level level = {0.5, wave, 2};
    machine.inductance_d_H = machine.inductance_q_H = 1e-3;
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_UINT32(2, set.loop.order_count);
    TEST_ASSERT_EQUAL_DOUBLE(900.0, hci_loop_set_highest_order(&set));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, set.share_left_out);
}

/* ---- where they end ---- */

/* 0.8 of half the sampling is the highest frequency; an order is whole up to 0.9 of that, or to the speed
 * that is asked for. */
static void test_ends_by_the_sampling(void)
{
    const hci_loop_level level = {0.5, WAVES, 3};
    const double highest = 0.8 * REF_PI / T_s;
    drive.dc_link_voltage_V = 1e6;
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, set.voltage_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, set.measured_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * highest, 0.9 * highest / 12.0 / PAIRS, set.sampled_rad_per_s);
    TEST_ASSERT_TRUE((double)set.loop.ranges[0].whole_rad_per_s > 1e30);
    for (int k = 1; k < 3; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * highest, 0.9 * highest / (6.0 * k),
                                  (double)set.loop.ranges[k].whole_rad_per_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * highest, highest / (6.0 * k),
                                  (double)set.loop.ranges[k].none_rad_per_s);
    }
    TEST_ASSERT_EQUAL_DOUBLE((double)set.loop.ranges[2].whole_rad_per_s, (double)set.loop.whole_rad_per_s);
    const double asked = 1.5 * highest / 12.0 / PAIRS; /* more than order 12 goes to, and less than order 6 */
    make(&level, 1, 0.0, asked);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * highest, asked * PAIRS, (double)set.loop.ranges[1].whole_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * highest, asked * PAIRS / 0.9, (double)set.loop.ranges[1].none_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * highest, 0.9 * highest / 12.0,
                              (double)set.loop.ranges[2].whole_rad_per_s);
}

/* |R i + ω v| √3 is the dc link at the positive root of a quadratic equation. */
static double end_of(double id, double iq, double direction)
{
    const double d0 = R_ohm * id, d1 = -direction * L_q * iq;
    const double q0 = R_ohm * iq, q1 = direction * (L_d * id + E / PAIRS);
    const double a = d1 * d1 + q1 * q1, b = d0 * d1 + q0 * q1, c = d0 * d0 + q0 * q0 - LINK_V * LINK_V / 3.0;
    return (sqrt(b * b - a * c) - b) / a;
}

static void test_ends_by_the_voltage(void)
{
    const hci_wave drives[] = {{1.0, 1, 2.0, 1.0}, {1.0, 1, 4.0, 3.0}},
                   brakes[] = {{1.0, 1, -4.0, 3.0}, {1.0, 1, -2.0, 1.0}};
    const hci_loop_level forward[2] = {{0.2, &drives[0], 1}, {0.4, &drives[1], 1}},
                         backward[2] = {{-0.4, &brakes[0], 1}, {-0.2, &brakes[1], 1}},
                         both[2] = {{-0.2, &brakes[1], 1}, {0.4, &drives[1], 1}};
    const double weak = fmin(end_of(-1.0, 2.0, 1.0), end_of(-3.0, 4.0, 1.0));
    const double tolerance = 1e-5 * weak; /* the samples of a turn miss the crest by 1e-6 */
    make(forward, 2, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, weak / PAIRS, set.voltage_rad_per_s);
    make(backward, 2, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, weak / PAIRS, set.voltage_rad_per_s);
    make(both, 2, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, fmin(end_of(-1.0, -2.0, 1.0), end_of(-3.0, 4.0, 1.0)) / PAIRS,
                              set.voltage_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(HUGE_VAL, set.sampled_rad_per_s); /* a constant has no order to end */
}

/* ---- the loop ---- */

static void test_constants_of_the_loop(void)
{
    const hci_loop_level level = {0.5, WAVES, 3};
    drive.kp_ohm = 3.0;
    drive.kp_q_ohm = 5.0;
    drive.ki_ohm_per_s = 700.0;
    drive.ki_q_ohm_per_s = 900.0;
    drive.filter_s = 2e-4;
    drive.computing_delay_s = 0.25 * T_s;
    make(&level, 1, 0.0, 0.0);
    const hci_loop_f32 *l = &set.loop;
    TEST_ASSERT_EQUAL_FLOAT((float)R_ohm, l->resistance_ohm);
    TEST_ASSERT_EQUAL_FLOAT((float)L_d, l->inductance_H[0]);
    TEST_ASSERT_EQUAL_FLOAT((float)L_q, l->inductance_H[1]);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, l->proportional_ohm[0]);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, l->proportional_ohm[1]);
    TEST_ASSERT_EQUAL_FLOAT(700.0f, l->integral_ohm_per_s[0]);
    TEST_ASSERT_EQUAL_FLOAT(900.0f, l->integral_ohm_per_s[1]);
    TEST_ASSERT_EQUAL_FLOAT((float)(1.0 - exp(-0.5)), l->filter);
    TEST_ASSERT_EQUAL_FLOAT((float)T_s, l->sample_s);
    TEST_ASSERT_EQUAL_FLOAT((float)(0.75 * T_s), l->delay_s);
    TEST_ASSERT_TRUE(isnan(set.response_error[0]) && isnan(set.response_error[1]));
    TEST_ASSERT_TRUE(isnan(hci_loop_set_response_percent(&set, &task, 0, 10.0)));
}

/* ---- the table ---- */

/* The largest error of the splines, by the sine formula, at angles that the points do not share. */
static double error_A(const currents *c)
{
    static float memory[40000];
    hci_loop_tables tables;
    double most = 0.0, i[3];
    TEST_ASSERT_TRUE(hci_loop_floats(&set.loop, HCI_LOOP_TABLE) <= 40000);
    hci_loop_start(&tables, &set.loop, HCI_LOOP_TABLE, memory);
    hci_loop_make(&tables, 0.0f);
    for (uint32_t k = 0; k < 3000; ++k) {
        const uint32_t angle = k * 2654435769u;
        reference_currents(c, HCI_TABLE_DQ, 2.0 * REF_PI * angle / 4294967296.0, i);
        const hci_loop_reference r = hci_loop_at(&tables, angle, 0.5f, 0.0f);
        most = fmax(most, hypot((double)r.id_A - i[0], (double)r.iq_A - i[1]));
    }
    return most;
}

/* No more than is asked for, with few points where little is asked: a fourth of the error takes about √2
 * times the points of a cubic spline. */
static void test_points_by_the_error(void)
{
    const currents c = currents_of(WAVES, 3);
    const hci_loop_level level = {0.5, WAVES, 3};
    uint32_t before = 0;
    for (double most_A = 0.1; most_A > 1e-4; most_A /= 4.0) {
        make(&level, 1, most_A, 0.0);
        TEST_ASSERT_TRUE(set.max_error_A <= most_A);
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * set.max_error_A + 1e-6, set.max_error_A, error_A(&c));
        TEST_ASSERT_TRUE(set.loop.points >= 4 * 2); /* the highest order has two periods of the table */
        TEST_ASSERT_TRUE(before == 0 || (set.loop.points >= before && set.loop.points < 2 * before));
        before = set.loop.points;
    }
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_TRUE(set.max_error_A <= 2e-4 * set.peak_A);
    const hci_loop_level constant = {0.5, WAVES, 1};
    make(&constant, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_UINT32(4, set.loop.points);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, set.max_error_A);
}

/* ---- a measured response ---- */

enum { POINTS = 12 };

static hci_loop_point point[POINTS];

/* At multiples of a frequency, of a gain that goes up and down; d is 0.3 ms late, q 0.2 ms. */
static void give_response(double step_Hz, double gain)
{
    for (int k = 0; k < POINTS; ++k) {
        point[k].frequency_Hz = step_Hz * (k + 1);
        for (int axis = 0; axis < 2; ++axis) {
            point[k].gain[axis] = (k % 2 ? 1.2 : 0.8) * gain;
            point[k].phase_rad[axis] = -2.0 * REF_PI * point[k].frequency_Hz * (axis == 0 ? 3e-4 : 2e-4);
        }
    }
    drive.response = point;
    drive.response_count = POINTS;
}

/* (1/G − F)/(R + jνL) at the points themselves: three are too few to find anything better than straight
 * lines. What is read of the filtered current is about 1, 1/G a hundred thousand. */
static void test_responses_at_the_points(void)
{
    const hci_loop_level level = {0.5, WAVES, 3};
    give_response(1000.0, 1e-5);
    drive.response_count = 3;
    drive.response_of = HCI_RESPONSE_OF_CURRENT;
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_EQUAL_UINT32(3, set.loop.response_count);
    for (int k = 0; k < 3; ++k) {
        const double nu = 2.0 * REF_PI * 1000.0 * (k + 1);
        TEST_ASSERT_EQUAL_FLOAT((float)nu, set.loop.responses[k].frequency_rad_per_s);
        for (int axis = 0; axis < 2; ++axis) {
            const double complex through = (double complex)set.loop.responses[k].re[axis] +
                                           (double complex)I * (double)set.loop.responses[k].im[axis];
            const double complex inverse =
                cexp(-(double complex)I * point[k].phase_rad[axis]) / point[k].gain[axis];
            const double complex wanted =
                inverse / (R_ohm + (double complex)I * nu * (axis == 0 ? L_d : L_q));
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * cabs(wanted), 0.0, cabs(through - wanted));
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 2.0 * REF_PI * 3000.0 / 12.0 / PAIRS, set.measured_rad_per_s);
    TEST_ASSERT_TRUE(isnan(hci_loop_set_response_error(&set)));
}

/* i_q = 4 A + A cos 6θ and no i_d, without decoupling: the loop lacks (R + jνL) i of it, and of that a share
 * is missed: 2·share·A, peak to peak, times 3/2 E. The larger one of both shares is told. */
static void test_swing_of_a_response_that_is_off(void)
{
    static const double A = 0.4;
    const hci_wave wave[] = {{1.0, 1, 4.0, 0.0}, {7.0, 1, 0.2, 0.0}, {5.0, -1, -0.2, 0.0}};
    const hci_loop_level level = {0.5, wave, 3};
    machine.inductance_d_H = L_q;
    drive.decoupling = HCI_DECOUPLING_NONE;
    make(&level, 1, 0.0, 0.0);
    set.response_error[0] = 0.03;
    set.response_error[1] = 0.02;
    TEST_ASSERT_EQUAL_DOUBLE(0.03, hci_loop_set_response_error(&set));
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 100.0 * 2.0 * 0.02 * A * 1.5 * E / 0.5,
                              hci_loop_set_response_percent(&set, &task, 0, 50.0));
    set.response_error[1] = 0.04;
    TEST_ASSERT_EQUAL_DOUBLE(0.04, hci_loop_set_response_error(&set));
}

/* The lead is the median of the lateness of q, over the frequencies at which it is below half a radian. */
static void test_lead_of_a_measured_response(void)
{
    const hci_loop_level level = {0.5, WAVES, 1};
    give_response(100.0, 1.0); /* below half a radian: at 100, 200, 300 Hz */
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2e-4, (double)set.loop.lead_s);
    point[0].phase_rad[1] *= 3.0;
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2e-4, (double)set.loop.lead_s);
    point[2].phase_rad[1] *= 1.3; /* 0.49 rad: of 6, 2 and 2.6, a tenth of a millisecond each */
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.6e-4, (double)set.loop.lead_s);
    point[2].phase_rad[1] *= 1.1; /* beyond it: the mean of the two others */
    make(&level, 1, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4e-4, (double)set.loop.lead_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_of_currents_and_voltages);
    RUN_TEST(test_fractional_orders);
    RUN_TEST(test_small_orders_are_left_out_and_told);
    RUN_TEST(test_a_high_order_is_kept_by_its_voltage);
    RUN_TEST(test_ends_by_the_sampling);
    RUN_TEST(test_ends_by_the_voltage);
    RUN_TEST(test_constants_of_the_loop);
    RUN_TEST(test_points_by_the_error);
    RUN_TEST(test_responses_at_the_points);
    RUN_TEST(test_swing_of_a_response_that_is_off);
    RUN_TEST(test_lead_of_a_measured_response);
    return UNITY_END();
}
