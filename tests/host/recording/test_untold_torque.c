/* Parts of untold_torque.c by closed forms: how far slopes reach, what is said of a load, of a declared
 * inertia and of stops, what is taken out of the current, and an inertia of several recordings. */
#define hci_untold_torque_set   torque_set
#define hci_untold_torques_join torques_join
#include "host/recording/untold_torque.c"
#undef hci_untold_torque_set
#undef hci_untold_torques_join

#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { P = 3, MOST_ORDER = 12 };

static hci_run run;
static hci_run_options options;
static task t;
static hci_way_order order[2][MOST_ORDER + 1];
static size_t seen[2][4];

/* A run at one speed that goes so many times forward, and as many rows back. */
static void make(size_t forward, size_t back)
{
    rec_release(&run);
    run = rec_make(forward + back);
    run.pole_pairs = P;
    for (size_t k = 0; k < run.count; ++k) {
        run.time_s[k] = 0.02 * (double)k;
        run.speed_rad_per_s[k] = k < forward ? 0.5 : -0.5;
        run.theta_m_rad[k] = 0.01 * (k < forward ? (double)k : 2.0 * (double)forward - (double)k);
    }
}

void setUp(void)
{
    memset(&run, 0, sizeof run);
    memset(order, 0, sizeof order);
    options = (hci_run_options){.pole_pairs = P, .inertia_kgm2 = NAN, .torque_constant_Nm_per_A = 0.2};
    t = (task){.run = &run, .options = &options};
    t.ways.scale = 1.0;
    t.ways.highest = MOST_ORDER;
    for (int d = 0; d < 2; ++d)
        t.ways.way[d] =
            (hci_way){.speed_rad_per_s = d ? -0.5 : 0.5, .order = order[d], .seen = seen[d], .any = true};
}

void tearDown(void)
{
    rec_release(&run);
}

/* i_q of each way, and an i_d. */
static void flow(double forward_A, double back_A)
{
    for (size_t k = 0; k < run.count; ++k)
        rec_phases(0.3, run.speed_rad_per_s[k] > 0.0 ? forward_A : back_A, P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
}

/* ---- how far slopes reach ---- */

/* What a tenth of the samples do not exceed; of more than a thousand samples so many evenly. */
static void test_the_slowest_tenth(void)
{
    make(50, 0);
    for (size_t k = 0; k < 50; ++k)
        run.speed_rad_per_s[k] = (k % 2 ? -1.0 : 1.0) * (double)(k * 7 % 50);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, slowest_of(&run));
    make(2500, 0);
    for (size_t k = 0; k < 2500; ++k)
        run.speed_rad_per_s[k] = (double)(2499 - k);
    TEST_ASSERT_EQUAL_DOUBLE(2499.0 - 2247.0, slowest_of(&run)); /* 0 is left out: 2499 − 899·2.5 */
}

/* The order of which both windows last a period at the slowest speed. */
static void test_the_order_that_slopes_reach(void)
{
    make(101, 0);
    run.torque_window = 11;
    run.speed_window = 4;
    /* 15 of 100 steps of 0.02 s at 0.5 rad/s */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * HCI_PI / (15.0 * 0.02 * 0.5 * P), reach_of(&run));
}

static void test_what_can_accelerate(void)
{
    make(3, 0);
    options.inertia_kgm2 = 1e-3;
    TEST_ASSERT_TRUE(can_accelerate(&t, false));
    TEST_ASSERT_TRUE(can_accelerate(&t, true));
    double v_V[9] = {0.0};
    run.v_V = v_V;
    TEST_ASSERT_TRUE(can_accelerate(&t, false));
    TEST_ASSERT_FALSE(can_accelerate(&t, true));
    run.v_V = NULL;
    run.count = 2;
    TEST_ASSERT_FALSE(can_accelerate(&t, false));
    run.count = 3;
    options.inertia_kgm2 = 0.0;
    TEST_ASSERT_FALSE(can_accelerate(&t, false));
    options.inertia_kgm2 = 1e-3;
    double *const time_s = run.time_s, *const speed = run.speed_rad_per_s;
    run.time_s = NULL;
    TEST_ASSERT_FALSE(can_accelerate(&t, false));
    run.time_s = time_s;
    run.speed_rad_per_s = NULL;
    TEST_ASSERT_FALSE(can_accelerate(&t, false));
    run.speed_rad_per_s = speed;
}

/* t(φ) = φ/ω + S sin 5φ + C cos 5φ: −t″/t′³ of each way, and nothing of one that is not there. */
static void test_acceleration_by_orders(void)
{
    const double s = 2e-2, c = -1e-2;
    make(40, 30);
    order[0][5].time_s = (hci_way_wave){s, c, 1e-6, true};
    seen[0][0] = 5;
    t.ways.way[0].count = 1;
    t.ways.way[1].any = false;
    accelerate_by_orders(&t, 7e-3);
    for (size_t k = 0; k < run.count; ++k) {
        const double phi = 5.0 * run.theta_m_rad[k], slope = 2.0 + 5.0 * (s * cos(phi) - c * sin(phi)),
                     bend = -25.0 * (s * sin(phi) + c * cos(phi));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k < 40 ? -7e-3 * bend / (slope * slope * slope) : 0.0,
                                  run.torque_Nm[k]);
    }
}

/* ---- words ---- */

/* Each way that more than a twentieth of the rows go. */
static void test_what_is_said_of_a_load(void)
{
    hci_note remark = {{0}};
    make(60, 40);
    flow(2.0, -1.25);
    say_load(&run, 0.2, &remark);
    text_has("i_q makes 0.4 N·m forward and -0.25 N·m back on the average: a load, friction", remark.text);
    for (size_t back = 5; back <= 6; ++back) {
        memset(&remark, 0, sizeof remark);
        make(100 - back, back);
        flow(2.0, -1.25);
        say_load(&run, 0.2, &remark);
        text_has(back == 5 ? "i_q makes 0.4 N·m forward on the" : "forward and -0.25 N·m back on",
                 remark.text);
    }
    memset(&remark, 0, sizeof remark);
    make(0, 50);
    flow(2.0, -1.25);
    say_load(&run, 0.2, &remark);
    text_has("i_q makes -0.25 N·m back on the average", remark.text);
}

static bool is_denied(double declared, double least, double most)
{
    options.inertia_kgm2 = declared;
    memset(&run.remark, 0, sizeof run.remark);
    judge_between(&t, least, most, "these turns tell");
    TEST_ASSERT_EQUAL_DOUBLE(least, run.least_inertia_kgm2);
    TEST_ASSERT_EQUAL_DOUBLE(most, run.most_inertia_kgm2);
    TEST_ASSERT_EQUAL(run.denies_inertia, run.remark.text[0] != '\0');
    return run.denies_inertia;
}

/* By more than half of it. */
static void test_a_declared_inertia_beside_bounds(void)
{
    make(10, 10);
    TEST_ASSERT_TRUE(is_denied(4.6e-3, 2e-3, 3e-3));
    text_has("these turns tell an inertia of 0.002 to 0.003 kg·m², and not the declared 0.0046",
             run.remark.text);
    TEST_ASSERT_FALSE(is_denied(4.4e-3, 2e-3, 3e-3));
    TEST_ASSERT_FALSE(is_denied(1.36e-3, 2e-3, 3e-3));
    TEST_ASSERT_TRUE(is_denied(1.30e-3, 2e-3, 3e-3));
}

/* A twentieth of it, and three standard errors, to both sides. */
static void test_an_inertia_by_the_current(void)
{
    make(10, 10);
    options.inertia_kgm2 = 4e-3;
    run.iq_per_acceleration = 0.02;
    run.iq_per_acceleration_error = 0.0015;
    judge_by_current(&t);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4e-3 - 2e-4 - 9e-4, run.least_inertia_kgm2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4e-3 + 2e-4 + 9e-4, run.most_inertia_kgm2);
    run.least_inertia_kgm2 = -1.0;
    run.iq_per_acceleration = -0.02;
    judge_by_current(&t);
    run.iq_per_acceleration = 0.02;
    options.torque_constant_Nm_per_A = 0.0;
    judge_by_current(&t);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, run.least_inertia_kgm2);
}

/* A shaft that comes to rest so many times on its way of `turns` electrical turns. */
static bool sticks(size_t stops, double turns)
{
    double share = 0.0;
    make(2000, 0);
    for (size_t k = 0; k < 2000; ++k) {
        const size_t part = 2000 / (stops + 1);
        run.theta_m_rad[k] = 2.0 * HCI_PI * turns / P * share;
        share += k % part >= part - 40 && k / part < stops ? 0.0 : 1.0 / (1999.0 - 40.0 * (double)stops);
    }
    judge_stops(&run);
    return run.is_unsteady;
}

/* Four times, and once in two electrical turns. */
static void test_how_often_a_shaft_sticks(void)
{
    TEST_ASSERT_FALSE(sticks(3, 4.0));
    TEST_ASSERT_TRUE(sticks(4, 4.0));
    text_has("the shaft comes to rest 4 times on its way and goes on, in 4 electrical turns",
             run.remark.text);
    TEST_ASSERT_TRUE(sticks(6, 11.5));
    TEST_ASSERT_FALSE(sticks(6, 12.5));
}

/* ---- what pulls the same way in both directions ---- */

static void take_out(double forward_A, double back_A, double error_A)
{
    make(30, 30);
    flow(forward_A, back_A);
    t.has_ways = true;
    order[0][0].iq_A = (hci_way_wave){0.0, forward_A, error_A, false};
    order[1][0].iq_A = (hci_way_wave){0.0, back_A, 0.75 * error_A, false};
    take_weight_out(&t, 0.2);
}

static void is_taken_out(double iq_A, double forward_A, double back_A)
{
    for (size_t k = 0; k < run.count; ++k) {
        double d, q;
        rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, (k < 30 ? forward_A : back_A) - iq_A, q);
    }
}

/* Half of both; its error of 0.1 and 0.075 is 0.0625 A, five of which are 0.3125. */
static void test_a_weight_is_taken_out(void)
{
    take_out(1.4, -0.76, 0.1);
    is_taken_out(0.32, 1.4, -0.76);
    text_has("i_q makes 0.064 N·m the same way in both directions: a weight on the shaft", run.remark.text);
    take_out(1.4, -0.80, 0.1);
    is_taken_out(0.0, 1.4, -0.80);
    TEST_ASSERT_EQUAL_STRING("", run.remark.text);
    take_out(-1.4, 0.7, 0.1);
    is_taken_out(-0.35, -1.4, 0.7);
    for (int d = 0; d < 2; ++d) {
        t.ways.way[d].any = false;
        take_out(1.4, -0.7, 0.1);
        is_taken_out(0.0, 1.4, -0.7);
        t.ways.way[d].any = true;
    }
}

/* ---- one inertia of several recordings ---- */

/* The mean by their errors, of those that tell it. */
static void test_the_mean_of_inertias(void)
{
    hci_run runs[4] = {{.turns_inertia_kgm2 = 2e-3, .turns_inertia_error_kgm2 = 1e-4},
                       {.turns_inertia_kgm2 = 0.0, .turns_inertia_error_kgm2 = 1e-4},
                       {.turns_inertia_kgm2 = 3e-3, .turns_inertia_error_kgm2 = 2e-4},
                       {.turns_inertia_kgm2 = 9e-3, .turns_inertia_error_kgm2 = 0.0}};
    const inertia all = told_inertia(runs, 4), none = told_inertia(runs + 3, 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (2e-3 * 4.0 + 3e-3) / 5.0, all.kgm2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-4 / sqrt(5.0), all.std_error);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, none.kgm2);
}

/* A slow turn whose inertia nothing told. */
static void test_runs_that_lack_an_inertia(void)
{
    for (int which = 0; which < 6; ++which) {
        make(1000, 1000);
        flow(1.0, -1.0);
        for (size_t k = 0; k < run.count; ++k)
            run.speed_rad_per_s[k] *= which == 1 ? 5.0 : 1.0;
        run.torque_source = which == 2 ? HCI_TORQUE_MEASURED : HCI_TORQUE_HOLDING;
        run.is_unsteady = which == 3;
        run.turns_inertia_kgm2 = which == 4 ? 1e-3 : 0.0;
        double *const torque = run.torque_Nm;
        if (which == 5) run.torque_Nm = NULL;
        TEST_ASSERT_EQUAL(which == 0, lacks_inertia(&run));
        run.torque_Nm = torque;
    }
}

/* Beside a load that is steady, and without one up to what its most current would stop within a second from
 * 20 rad/s. */
static void test_where_a_limit_is_set(void)
{
    static const struct {
        bool load, unsteady;
        double most_A, limit_kgm2;
    } c[] = {{true, false, 0.3, 1e-3}, /* a tenth of 0.2·0.5 N·m over 10 rad/s² */
             {true, true, 0.3, 0.0},
             {false, false, 0.09, 0.0},
             {false, false, 0.11, 1e-3},
             {false, true, 0.11, 0.0}};
    order[0][6].iq_A = (hci_way_wave){0.3, 0.4, 0.0, true};
    order[0][6].time_s.stands_out = true;
    order[0][6].alpha_sine = 6.0, order[0][6].alpha_cosine = 8.0;
    seen[0][0] = 6;
    t.ways.way[0].count = 1;
    for (size_t k = 0; k < sizeof c / sizeof *c; ++k) {
        make(10, 10);
        run.i_A[7] = -c[k].most_A;
        run.mean_is_unknown = c[k].load;
        run.is_unsteady = c[k].unsteady;
        set_limit(&t);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, c[k].limit_kgm2, run.inertia_limit_kgm2);
    }
    say_limits(&run, 1);
    TEST_ASSERT_EQUAL_STRING("", run.remark.text);
    run.inertia_limit_kgm2 = 1e-3;
    say_limits(&run, 1);
    text_has("the inertia is not known, and the turns do not tell it: with 0.001 kg·m² of rotor",
             run.remark.text);
    run.mean_is_unknown = true;
    say_limits(&run, 1);
    text_has("beside a load the turns do not tell it: with 0.001 kg·m² of rotor", run.remark.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_slowest_tenth);
    RUN_TEST(test_the_order_that_slopes_reach);
    RUN_TEST(test_what_can_accelerate);
    RUN_TEST(test_acceleration_by_orders);
    RUN_TEST(test_what_is_said_of_a_load);
    RUN_TEST(test_a_declared_inertia_beside_bounds);
    RUN_TEST(test_an_inertia_by_the_current);
    RUN_TEST(test_how_often_a_shaft_sticks);
    RUN_TEST(test_a_weight_is_taken_out);
    RUN_TEST(test_the_mean_of_inertias);
    RUN_TEST(test_runs_that_lack_an_inertia);
    RUN_TEST(test_where_a_limit_is_set);
    return UNITY_END();
}
