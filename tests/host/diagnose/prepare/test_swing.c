/* Torques that swing at a frequency of their own, beside what repeats with the turn. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/prepare/swing.h"

#include "support/recording.h"
#include "unity.h"

enum { P = 4, N = 6000, RUNS = 4 };

static const double RATE_HZ = 5000.0, K_NM_PER_A = 0.45, NOISE_NM = 0.02, IQ_A = 5.0;

static const hci_machine MACHINE = {
    .pole_pairs = P, .back_emf = (const hci_wave[]){{1.0, 1, 2.0 / 3.0 * 0.45, 0.0}}, .back_emf_count = 1};

static hci_run run[RUNS];
static hci_run_statistics statistics[RUNS];
static uint64_t seed = 7;

void setUp(void)
{
}

void tearDown(void)
{
    for (size_t k = 0; k < RUNS; ++k)
        rec_release(&run[k]);
    memset(statistics, 0, sizeof statistics);
}

/* A run at so many turns a second, with cogging torque. swing_Hz, swing_Nm: of the load; current_A, speed:
 * that swing with it. */
typedef struct {
    double turn_Hz, swing_Hz, swing_Nm, current_A, speed;
} point;

static void record(size_t r, const point *x)
{
    run[r] = rec_make(N);
    const double phase = ref_uniform(&seed, 0.0, 6.0);
    for (size_t k = 0; k < N; ++k) {
        const double t = (double)k / RATE_HZ, wave = sin(2.0 * REF_PI * x->swing_Hz * t + phase);
        const double theta = 2.0 * REF_PI * x->turn_Hz * t, iq = IQ_A + x->current_A * wave;
        run[r].time_s[k] = t;
        run[r].theta_m_rad[k] = theta;
        run[r].speed_rad_per_s[k] = 2.0 * REF_PI * x->turn_Hz + x->speed * wave + 0.01 * ref_normal(&seed);
        rec_phases(0.0, iq + 0.01 * ref_normal(&seed), P * theta, run[r].i_A + 3 * k);
        run[r].torque_Nm[k] = 0.9 * K_NM_PER_A * iq + 0.1 * sin(6.0 * P * theta) + x->swing_Nm * wave +
                              NOISE_NM * ref_normal(&seed);
    }
    statistics[r] = hci_run_statistics_of(&run[r], P);
}

static void find(size_t r, const hci_swing_groups *known)
{
    const hci_swing_question question = {&run[r], &statistics[r], &MACHINE};
    statistics[r].swings = hci_swings_find(&question, known, statistics[r].swing);
    TEST_ASSERT_TRUE(statistics[r].swings <= HCI_MOST_SWINGS);
}

static void find_all(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        find(r, NULL);
    const hci_swing_groups known = hci_swing_groups_find(statistics, RUNS);
    for (size_t r = 0; r < RUNS; ++r)
        find(r, &known);
}

static double left_Nm(size_t r)
{
    double square = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double x = run[r].torque_Nm[k] - 0.9 * K_NM_PER_A * IQ_A -
                         0.1 * sin(6.0 * P * run[r].theta_m_rad[k]) -
                         hci_swings_at_Nm(&statistics[r], run[r].time_s[k]);
        square += x * x / N;
    }
    return sqrt(square);
}

/* 3.3 Hz are 0.22 to 1.32 times a turn; of three turns alone it is not found, and beside the others it is. */
static void test_a_load_that_swings(void)
{
    static const double TURN_HZ[RUNS] = {2.5, 6.0, 10.0, 15.0};
    for (size_t r = 0; r < RUNS; ++r)
        record(r, &(point){TURN_HZ[r], 3.3, 0.06, 0.0, 0.0});
    find_all();
    const hci_swing_groups groups = hci_swing_groups_find(statistics, RUNS);
    TEST_ASSERT_EQUAL_UINT64(1, groups.count);
    TEST_ASSERT_FALSE(groups.group[0].of_turn);
    TEST_ASSERT_EQUAL_UINT64(RUNS, groups.group[0].runs);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * groups.group[0].error, 3.3, groups.group[0].frequency);
    TEST_ASSERT_TRUE(groups.group[0].error < 0.01);
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, left_Nm(r));
}

/* As a file of six digits has it. */
static double six_digits(double x)
{
    const double digit = fabs(x) > 0.0 ? pow(10.0, floor(log10(fabs(x))) - 5.0) : 1.0;
    return digit * round(x / digit);
}

/* Twenty turns of 1500 samples with cogging torque of order 72 of the turn, without noise, in six digits:
 * what these leave of it in the changes over a turn is no swing, and a swing beside it is one. */
static void test_rounded_angles_make_no_swing(void)
{
    enum { MANY = 30000 };
    static const double SWING_NM[2] = {0.0, 0.02};
    for (size_t r = 0; r < 2; ++r) {
        run[r] = rec_make(MANY);
        for (size_t k = 0; k < MANY; ++k) {
            const double t = (double)k / 12000.0, even = 0.3 + 2.0 * REF_PI * 8.0 * t;
            const double theta = even + 0.002 * sin(even - 0.3);
            run[r].time_s[k] = t;
            run[r].theta_m_rad[k] = six_digits(theta);
            run[r].speed_rad_per_s[k] = 2.0 * REF_PI * 8.0;
            rec_phases(0.0, 4.0, P * theta, run[r].i_A + 3 * k);
            run[r].torque_Nm[k] = six_digits(4.0 * K_NM_PER_A + 0.04 * sin(72.0 * theta + 0.8) +
                                             SWING_NM[r] * sin(2.0 * REF_PI * 47.3 * t + 1.0));
        }
        statistics[r] = hci_run_statistics_of(&run[r], P);
        find(r, NULL);
        TEST_ASSERT_EQUAL_UINT64(r, statistics[r].swings);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 47.3, statistics[1].swing[0].frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, SWING_NM[1],
                              hypot(statistics[1].swing[0].cosine_Nm, statistics[1].swing[0].sine_Nm));
}

/* 50 Hz are five times a turn of the first, where its changes over a turn do not show it. */
static void test_the_mains_at_an_order(void)
{
    static const double TURN_HZ[RUNS] = {10.0, 6.0, 7.3, 15.0};
    for (size_t r = 0; r < RUNS; ++r)
        record(r, &(point){TURN_HZ[r], 49.98, 0.03, 0.0, 0.0});
    find_all();
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, left_Nm(r));
}

/* Three times the mains, which one run shows, is looked for in the others as well. */
static void test_a_multiple_of_the_mains(void)
{
    static const double TURN_HZ[RUNS] = {10.0, 6.0, 7.3, 15.0};
    for (size_t r = 0; r < RUNS; ++r) {
        record(r, &(point){TURN_HZ[r], 49.98, 0.03, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] +=
                (r == 2 ? 0.012 : 0.009) * sin(2.0 * REF_PI * 149.94 * run[r].time_s[k] + 1.0);
    }
    find_all();
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, left_Nm(r));
}

static void test_a_belt(void)
{
    static const double TURN_HZ[RUNS] = {5.0, 10.0, 20.0, 25.0};
    for (size_t r = 0; r < RUNS; ++r)
        record(r, &(point){TURN_HZ[r], 0.3717 * TURN_HZ[r], 0.08, 0.0, 0.0});
    find_all();
    const hci_swing_groups groups = hci_swing_groups_find(statistics, RUNS);
    TEST_ASSERT_EQUAL_UINT64(1, groups.count);
    TEST_ASSERT_TRUE(groups.group[0].of_turn);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * groups.group[0].error, 0.3717, groups.group[0].frequency);
}

static void test_what_is_no_swing_of_its_own(void)
{
    record(0, &(point){6.0, 3.3, 0.0, 0.0, 0.0});  /* none */
    record(1, &(point){6.0, 3.3, 0.06, 0.2, 0.0}); /* the current swings with it */
    record(2, &(point){6.0, 3.3, 0.06, 0.0, 0.3}); /* the speed does, and an inertia makes a torque of that */
    record(3, &(point){6.0, 24.0, 0.06, 0.0, 0.0}); /* an order of the turn */
    find_all();
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_EQUAL_UINT64(0, statistics[r].swings);
}

/* What a current that swings at 300 Hz makes with a harmonic of the back-EMF swings at 300 Hz and six times
 * the electrical frequency more and less: of the machine, not of a load. */
static void test_a_harmonic_of_the_back_emf_makes_no_swing(void)
{
    const hci_wave e[] = {MACHINE.back_emf[0], {5.0, -1, 0.02, 0.0}};
    const hci_machine machine = {.pole_pairs = P, .back_emf = e, .back_emf_count = 2};
    record(0, &(point){10.3, 300.0, 0.0, 0.3, 0.0});
    for (size_t k = 0; k < N; ++k)
        run[0].torque_Nm[k] = hci_torque_at(&machine, P * run[0].theta_m_rad[k], run[0].i_A + 3 * k) +
                              0.1 * NOISE_NM * ref_normal(&seed);
    statistics[0] = hci_run_statistics_of(&run[0], P);
    const hci_swing_question question = {&run[0], &statistics[0], &machine};
    TEST_ASSERT_EQUAL_UINT64(0, hci_swings_find(&question, NULL, statistics[0].swing));
}

/* A motor of a millionth of the torque swings as the large one does. */
static void test_a_small_motor_swings_too(void)
{
    const double small = 1e-6;
    record(0, &(point){10.0, 3.3, 0.06, 0.0, 0.0});
    find(0, NULL);
    TEST_ASSERT_EQUAL_UINT64(1, statistics[0].swings);
    const hci_swing large = statistics[0].swing[0];
    for (size_t k = 0; k < N; ++k)
        run[0].torque_Nm[k] *= small;
    statistics[0] = hci_run_statistics_of(&run[0], P);
    hci_wave weak = MACHINE.back_emf[0];
    weak.sine *= small;
    const hci_machine machine = {.pole_pairs = P, .back_emf = &weak, .back_emf_count = 1};
    const hci_swing_question question = {&run[0], &statistics[0], &machine};
    statistics[0].swings = hci_swings_find(&question, NULL, statistics[0].swing);
    TEST_ASSERT_EQUAL_UINT64(1, statistics[0].swings);
    const hci_swing *x = &statistics[0].swing[0];
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * large.frequency_Hz, large.frequency_Hz, x->frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, large.cosine_Nm, x->cosine_Nm / small);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, large.sine_Nm, x->sine_Nm / small);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_load_that_swings);
    RUN_TEST(test_rounded_angles_make_no_swing);
    RUN_TEST(test_the_mains_at_an_order);
    RUN_TEST(test_a_multiple_of_the_mains);
    RUN_TEST(test_a_belt);
    RUN_TEST(test_what_is_no_swing_of_its_own);
    RUN_TEST(test_a_harmonic_of_the_back_emf_makes_no_swing);
    RUN_TEST(test_a_small_motor_swings_too);
    return UNITY_END();
}
