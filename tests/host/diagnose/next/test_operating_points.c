/* What may be played by the recordings and the ratings; the grid of points within that; and what is asked for
 * is not in the list already. */
#include <math.h>
#include <string.h>

#include "host/diagnose/next/operating_points.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_run_statistics steady(double id_A, double iq_A, double speed_rad_per_s, double turns)
{
    return (hci_run_statistics){.mean_id_A = id_A,
                                .mean_iq_A = iq_A,
                                .current_A = hypot(id_A, iq_A),
                                .mean_speed_rad_per_s = speed_rad_per_s,
                                .turns = turns};
}

static size_t points_beside(const hci_run_statistics *recorded, const bool *use, size_t count,
                            hci_operating_point point[HCI_OPERATING_POINTS])
{
    const hci_playable playable = {.source = HCI_TORQUE_MEASURED,
                                   .most_A = 8.0,
                                   .least_rad_per_s = 6.28,
                                   .most_rad_per_s = 25.0,
                                   .most_V = INFINITY,
                                   .recorded = recorded,
                                   .use = use,
                                   .recorded_count = count};
    return hci_operating_points(&playable, point);
}

static bool has(const hci_operating_point *point, size_t count, double iq_A, double speed_rad_per_s)
{
    for (size_t k = 0; k < count; ++k)
        if (point[k].id_A == 0.0 && point[k].iq_A == iq_A && point[k].speed_rad_per_s == speed_rad_per_s)
            return true;
    return false;
}

static void test_recorded_points_are_not_asked_for(void)
{
    /* two with the noise of sensors, one that is short, one held out, one whose current swings */
    hci_run_statistics run[] = {steady(0.01, -0.02, 6.3, 11.98), steady(0.0, 0.0, -6.2, 12.0),
                                steady(0.0, 2.0, 6.28, 4.0), steady(0.0, 4.0, 6.28, 20.0),
                                steady(0.0, 8.0, 6.28, 20.0)};
    const bool use[] = {true, true, true, false, true};
    run[4].current_A = 10.0;
    hci_operating_point point[HCI_OPERATING_POINTS], all[HCI_OPERATING_POINTS];
    const size_t whole = points_beside(NULL, NULL, 0, all), left = points_beside(run, use, 5, point);
    TEST_ASSERT_TRUE(has(all, whole, 0.0, 6.28) && has(all, whole, 0.0, -6.28));
    TEST_ASSERT_EQUAL_UINT64(whole - 2, left);
    TEST_ASSERT_FALSE(has(point, left, 0.0, 6.28) || has(point, left, 0.0, -6.28));
    TEST_ASSERT_TRUE(has(point, left, 0.0, 25.0) && has(point, left, 2.0, 6.28) &&
                     has(point, left, 4.0, 6.28));
    TEST_ASSERT_TRUE(has(point, left, 8.0, 6.28));
}

static void test_something_is_left_where_all_is_recorded(void)
{
    hci_operating_point all[HCI_OPERATING_POINTS], point[HCI_OPERATING_POINTS];
    hci_run_statistics run[HCI_OPERATING_POINTS];
    bool use[HCI_OPERATING_POINTS];
    const size_t whole = points_beside(NULL, NULL, 0, all);
    for (size_t k = 0; k < whole; ++k) {
        run[k] = steady(all[k].id_A, all[k].iq_A, all[k].speed_rad_per_s, 12.0);
        use[k] = true;
    }
    TEST_ASSERT_EQUAL_UINT64(whole, points_beside(run, use, whole, point));
}

/* ---- the grid ---- */

static void check_both_ways(const hci_operating_point *point, double id_A, double iq_A,
                            double speed_rad_per_s)
{
    for (int k = 0; k < 2; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, id_A, point[k].id_A);
        TEST_ASSERT_EQUAL(isnan(iq_A), isnan(point[k].iq_A));
        if (!isnan(iq_A)) TEST_ASSERT_DOUBLE_WITHIN(1e-12, iq_A, point[k].iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k ? -speed_rad_per_s : speed_rad_per_s, point[k].speed_rad_per_s);
    }
}

/* None, and a quarter, half and all of 8.123 A in q, 0.6 rad ahead and behind, and in −q: two speeds, both
 * ways, three digits that are no further from 0. sin 0.6 = 0.564642, cos 0.6 = 0.825336. */
static void test_the_grid_with_a_torque_sensor(void)
{
    static const double ID[] = {0.0, 0.0, -1.14, 1.14, 0.0, 0.0, -2.29, 2.29, 0.0, 0.0, -4.58, 4.58, 0.0},
                        IQ[] = {0.0,  2.03,  1.67, 1.67, -2.03, 4.06, 3.35,
                                3.35, -4.06, 8.12, 6.70, 6.70,  -8.12};
    const hci_playable x = {.source = HCI_TORQUE_MEASURED,
                            .most_A = 8.123,
                            .least_rad_per_s = 0.12345,
                            .most_rad_per_s = 1234.5,
                            .most_V = INFINITY};
    hci_operating_point point[HCI_OPERATING_POINTS];
    TEST_ASSERT_EQUAL(4 * 13, hci_operating_points(&x, point));
    for (int k = 0; k < 13; ++k) {
        check_both_ways(point + 4 * k, ID[k], IQ[k], 0.123);
        check_both_ways(point + 4 * k + 2, ID[k], IQ[k], 1230.0);
    }
}

/* Slow and fast are one speed where nothing slower may be asked for and no rating says that a faster one can
 * be: 0.1 rad/s; or where they differ in the fourth digit. */
static void test_no_point_stands_twice_in_the_grid(void)
{
    static const double FASTEST_RAD_PER_S[] = {0.1, 0.1004};
    for (int k = 0; k < 2; ++k) {
        const hci_playable x = {.source = HCI_TORQUE_MEASURED,
                                .most_A = 8.0,
                                .least_rad_per_s = 0.1,
                                .most_rad_per_s = FASTEST_RAD_PER_S[k],
                                .most_V = INFINITY};
        hci_operating_point point[HCI_OPERATING_POINTS];
        const size_t count = hci_operating_points(&x, point);
        TEST_ASSERT_EQUAL(2 * 13, count);
        for (size_t i = 0; i < count; ++i)
            for (size_t j = 0; j < i; ++j)
                TEST_ASSERT_FALSE(point[i].id_A == point[j].id_A && point[i].iq_A == point[j].iq_A &&
                                  point[i].speed_rad_per_s == point[j].speed_rad_per_s);
    }
}

/* A speed times 0.1 V·s and a current times 2 Ω are no more than 20 V: at 120 rad/s up to 4 A, at the slow
 * speed whatever it is. */
static void test_the_grid_within_the_voltage(void)
{
    for (int beyond = 0; beyond < 2; ++beyond) {
        const hci_playable x = {.source = HCI_TORQUE_MEASURED,
                                .most_A = 8.0,
                                .least_rad_per_s = 10.0,
                                .most_rad_per_s = 120.0,
                                .most_V = beyond ? 19.9 : 20.1,
                                .volts_s = -0.1,
                                .ohm = 2.0};
        hci_operating_point point[HCI_OPERATING_POINTS];
        const size_t count = hci_operating_points(&x, point);
        size_t fast = 0, slow = 0;
        double most_A = 0.0;
        for (size_t k = 0; k < count; ++k) {
            const bool is_fast = fabs(point[k].speed_rad_per_s) > 100.0;
            fast += is_fast;
            slow += !is_fast;
            if (is_fast) most_A = fmax(most_A, hypot(point[k].id_A, point[k].iq_A));
        }
        TEST_ASSERT_EQUAL(26, slow);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, beyond ? 2.0 : 4.0, most_A); /* digits make 4 A ahead 3.99 A */
        TEST_ASSERT_TRUE(beyond ? fast < 2 * 9 : fast == 2 * 9);
    }
}

/* i_q answers to the load; i_d is nothing, half and all, of either sign. A shaft that is held turns slowly.
 */
static void test_the_grid_without_a_torque_sensor(void)
{
    static const double ID[] = {0.0, 4.0, -4.0, 8.0, -8.0};
    hci_playable x = {.source = HCI_TORQUE_INERTIA,
                      .most_A = 8.0,
                      .least_rad_per_s = 5.0,
                      .most_rad_per_s = 50.0,
                      .most_V = INFINITY};
    hci_operating_point point[HCI_OPERATING_POINTS];
    TEST_ASSERT_EQUAL(4 * 5, hci_operating_points(&x, point));
    for (int k = 0; k < 5; ++k) {
        check_both_ways(point + 4 * k, ID[k], NAN, 5.0);
        check_both_ways(point + 4 * k + 2, ID[k], NAN, 50.0);
    }
    x.source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_EQUAL(2 * 5, hci_operating_points(&x, point));
    for (int k = 0; k < 5; ++k)
        check_both_ways(point + 2 * k, ID[k], NAN, 5.0);
    x.most_A = 0.0;
    TEST_ASSERT_EQUAL(2, hci_operating_points(&x, point));
    x.source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_EQUAL(4, hci_operating_points(&x, point));
}

/* Of 8 A: 0.4 A off, a tenth of the speed off, ten turns, and a swing of 0.4 A are near enough. */
static void test_how_near_a_recording_is(void)
{
    static const struct {
        double id_A, iq_A, speed, turns, swing_A;
        bool is_it;
    } CASE[] = {{0.0, 2.0, 6.28, 10.0, 0.0, true},  {0.0, 2.0, 6.28, 9.9, 0.0, false},
                {0.0, 2.39, 6.28, 12.0, 0.0, true}, {0.0, 2.41, 6.28, 12.0, 0.0, false},
                {0.39, 2.0, 6.28, 12.0, 0.0, true}, {-0.41, 2.0, 6.28, 12.0, 0.0, false},
                {0.0, 2.0, 6.9, 12.0, 0.0, true},   {0.0, 2.0, 6.92, 12.0, 0.0, false},
                {0.0, 2.0, 5.66, 12.0, 0.0, true},  {0.0, 2.0, 5.64, 12.0, 0.0, false},
                {0.0, 2.0, 6.28, 12.0, 0.39, true}, {0.0, 2.0, 6.28, 12.0, 0.41, false}};
    const bool use = true;
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_run_statistics run = steady(CASE[k].id_A, CASE[k].iq_A, CASE[k].speed, CASE[k].turns);
        hci_operating_point point[HCI_OPERATING_POINTS];
        run.current_A += CASE[k].swing_A;
        const size_t left = points_beside(&run, &use, 1, point);
        TEST_ASSERT_EQUAL(CASE[k].is_it, !has(point, left, 2.0, 6.28));
    }
}

/* ---- what may be played ---- */

enum { RUNS = 3 };

static hci_machine_data machine;
static hci_run run[RUNS];
static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_segment segment[RUNS];
static hci_noise noise[RUNS];
static hci_binned_sample sample[2 * RUNS];
static hci_binned_samples samples;
static hci_regression regression;

/* Each run has two samples, at 0.9 and 1.1 of its speed; backward. */
static void recorded_at(const double speed[RUNS])
{
    memset(&machine, 0, sizeof machine);
    samples = (hci_binned_samples){sample, 2 * RUNS, segment, RUNS, statistics, RUNS};
    regression = (hci_regression){.samples = &samples, .runs = run, .use = use, .noise = noise};
    for (size_t r = 0; r < RUNS; ++r) {
        run[r] = (hci_run){.torque_source = HCI_TORQUE_HOLDING};
        use[r] = true;
        statistics[r] = (hci_run_statistics){.current_A = 1.0 + (double)r, .temperature_C = 20.0 + (double)r};
        segment[r] = (hci_segment){.run = r, .first = 2 * r, .count = 2, .joined = 4.0};
        noise[r].rms = 0.1 * (double)(r + 1);
        for (size_t j = 0; j < 2; ++j)
            sample[2 * r + j].reading.speed_rad_per_s = -speed[r] * (j ? 1.1 : 0.9);
    }
}

static hci_playable playable_at(double slow, double fast, double rated)
{
    recorded_at((const double[RUNS]){0.5 * (slow + fast), fast, slow});
    machine.rated_speed_rad_per_s = rated;
    return hci_playable_of(&regression, &machine);
}

static void test_what_recordings_tell(void)
{
    hci_playable x = playable_at(10.0, 30.0, NAN);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, x.source);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, x.most_A);
    TEST_ASSERT_EQUAL_DOUBLE(22.0, x.temperature_C);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * 0.2, x.noise_Nm); /* means of four bins have half the noise */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10.0, x.least_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 30.0, x.most_rad_per_s);
    TEST_ASSERT_TRUE(isinf(x.most_V) && x.ohm == 0.0 && x.recorded_count == RUNS);
    statistics[2].temperature_C = NAN;
    machine.rated_current_A = 2.0;
    machine.dc_link_voltage_V = 48.0;
    machine.resistance_ohm = 0.7;
    hci_wave emf = {.order = 1.0, .sequence = 1, .sine = 0.3}; /* V·s/rad of a phase */
    machine.model = (hci_machine){.pole_pairs = 2, .back_emf = &emf, .back_emf_count = 1};
    use[1] = false; /* its noise is not counted, and its current and speed are */
    x = hci_playable_of(&regression, &machine);
    TEST_ASSERT_EQUAL_DOUBLE(21.0, x.temperature_C);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * 0.2, x.noise_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, x.most_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 48.0 / sqrt(3.0), x.most_V);
    TEST_ASSERT_EQUAL_DOUBLE(0.7, x.ohm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, x.volts_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 30.0, x.most_rad_per_s);
}

/* Where one in use measured the torque, else where one was a free shaft. */
static void test_where_the_torque_is_from(void)
{
    (void)playable_at(10.0, 30.0, NAN);
    run[1].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, hci_playable_of(&regression, &machine).source);
    run[2].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, hci_playable_of(&regression, &machine).source);
    use[2] = false;
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, hci_playable_of(&regression, &machine).source);
    use[1] = false;
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, hci_playable_of(&regression, &machine).source);
}

/* Two speeds that differ by a factor of two: one alone goes with a quarter of it, or with four times where
 * the machine is rated for twice at least. A shaft below 0.1 rad/s or a thousandth of the fastest stands. */
static void test_two_speeds(void)
{
    static const struct {
        double slow, fast, rated, least, most;
    } CASE[] = {
        {10.0, 20.1, NAN, 10.0, 20.1},  {10.0, 19.9, NAN, 4.975, 19.9},  {10.0, 19.9, 21.0, 10.0, 21.0},
        {10.0, 19.9, 90.0, 10.0, 40.0}, {10.0, 19.9, 19.0, 4.75, 19.0},  {10.0, 30.0, 25.0, 10.0, 25.0},
        {10.0, 30.0, 8.0, 2.0, 8.0},    {0.2, 0.3, NAN, 0.1, 0.3},       {0.02, 50.0, NAN, 12.5, 50.0},
        {0.05, 20.0, NAN, 5.0, 20.0},   {0.12, 150.0, NAN, 37.5, 150.0}, {0.16, 150.0, NAN, 0.16, 150.0},
        {0.0, 0.0, NAN, 2.5, 10.0},     {0.0, 0.0, 300.0, 10.0, 40.0},   {10.0, 30.0, 0.09, 10.0, 30.0}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        const hci_playable x = playable_at(CASE[k].slow, CASE[k].fast, CASE[k].rated);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, CASE[k].most, x.most_rad_per_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, CASE[k].least, x.least_rad_per_s);
    }
    segment[2].count = 0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_run_speed(&regression, 2));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_grid_with_a_torque_sensor);
    RUN_TEST(test_no_point_stands_twice_in_the_grid);
    RUN_TEST(test_the_grid_within_the_voltage);
    RUN_TEST(test_the_grid_without_a_torque_sensor);
    RUN_TEST(test_how_near_a_recording_is);
    RUN_TEST(test_what_recordings_tell);
    RUN_TEST(test_where_the_torque_is_from);
    RUN_TEST(test_two_speeds);
    RUN_TEST(test_recorded_points_are_not_asked_for);
    RUN_TEST(test_something_is_left_where_all_is_recorded);
    return UNITY_END();
}
