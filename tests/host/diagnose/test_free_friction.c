/* Shafts without a torque sensor at constant speed: their mean currents are friction, by the declared torque
 * per ampere. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/free_friction.h"
#include "host/recording/free_shaft.h"

#include "support/diagnosing.h"
#include "support/texts.h"

enum { N = 600 };

static const double COULOMB_NM = 0.3, VISCOUS = 1e-3;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* The current of a shaft that friction alone brakes, with a load; its acceleration is noise. per_turn:
 * samples. */
static void record_free(double speed, double load_Nm, double per_turn)
{
    const double drag = (speed > 0.0 ? COULOMB_NM : -COULOMB_NM) + VISCOUS * speed + load_Nm;
    record(N, &(point){speed, drag / (1.5 * K_NM_PER_A), 0.0, drag, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < N; ++k) {
        r->theta_m_rad[k] *= 300.0 / per_turn;
        r->time_s[k] = r->theta_m_rad[k] / speed;
        const double noise_A = 0.002 * ref_normal(&seed),
                     iq_A = drag / (1.5 * K_NM_PER_A) + 0.002 * ref_normal(&seed);
        rec_phases(noise_A, iq_A, P * r->theta_m_rad[k], r->i_A + 3 * k);
    }
}

static void record_all(double load_Nm, double per_turn)
{
    static const double SPEED[] = {20.0, -20.0, 150.0, -150.0};
    for (int k = 0; k < 4; ++k)
        record_free(SPEED[k], load_Nm, per_turn);
    role[3] = HCI_ROLE_HOLDOUT;
}

static void test_friction_of_mean_currents(void)
{
    char words[2048];
    record_all(0.0, 300.0);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("friction")->verdict);
    text_has("times the declared torque per ampere", found("friction")->detail);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, COULOMB_NM, term("friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(2e-4, VISCOUS, term("friction", "viscous", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.45, diagnosis.holdout_mean_before_Nm);
    TEST_ASSERT_TRUE(diagnosis.holdout_mean_after_Nm < 0.01);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    text_has("The mean currents of 4 of them, at constant speed, are friction.", words);
    text_has("times the declared 0.3 N·m/A", words);
}

/* A weight pulls one way: what its runs ask for on average is not known. */
static void test_a_weight_is_no_friction(void)
{
    record_all(0.2, 300.0);
    diagnose(NULL);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("friction")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL(0, diagnosis.of_mean_currents);
}

/* A holding test shows cogging torque, and goes on showing it beside shafts whose samples are too far apart
 * for it. */
static void test_more_recordings_tell_no_less(void)
{
    record_holding(800, COULOMB_NM, 0.1, 0.0);
    record_all(0.0, 40.0);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1, term("cogging", "sine", 6.0)->value);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL(5, diagnosis.runs);
    TEST_ASSERT_EQUAL_STRING("run_0.csv", diagnosis.run[0].file);
    TEST_ASSERT_EQUAL_STRING("run_4.csv", diagnosis.run[4].file);
    TEST_ASSERT_TRUE(diagnosis.held_constant_Nm_per_A > 0.29);
}

enum { STEPS = 20 }; /* of the equation in a sample */

/* A drum with a weight on one side, held at a speed by a weak control: the weight swings the speed, so that
 * the drum is where it is slow for longer, J dω/dt = T − T_c sign ω + W cos θ. */
static void record_drum(double speed, double seconds)
{
    const double inertia = 0.02, weight_Nm = 0.25, step_s = 5e-4, sign = speed < 0.0 ? -1.0 : 1.0;
    double theta = 0.3, w = speed;
    record((size_t)(seconds / step_s / STEPS), &(point){speed, 0.0, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < r->count * STEPS; ++k) {
        const double made = sign * COULOMB_NM + 0.1 * (speed - w);
        const double rest = made - sign * COULOMB_NM + weight_Nm * cos(theta);
        if (k % STEPS == 0) {
            const size_t j = k / STEPS;
            r->time_s[j] = step_s * (double)k;
            r->theta_m_rad[j] = theta;
            r->speed_rad_per_s[j] = w;
            r->torque_Nm[j] = rest + 1e-4 * ref_normal(&seed);
            rec_phases(0.0, made / (1.5 * K_NM_PER_A) + 0.002 * ref_normal(&seed), P * theta, r->i_A + 3 * j);
        }
        w += step_s * rest / inertia;
        theta += step_s * w;
    }
}

/* What a weight does over a turn is nothing, though its torque has a mean over time: its friction is that of
 * the bearings, whatever part of a turn the recording ends in. */
static void test_a_weight_that_swings_the_speed_brakes_nothing(void)
{
    static const double SPEED[] = {6.0, -6.0, 7.0, -9.0};
    const hci_effects none = {NULL, 0};
    hci_drag drag[4];
    hci_note note = {{0}};
    for (int k = 0; k < 4; ++k)
        record_drum(SPEED[k], 20.0 + 0.3 * k);
    TEST_ASSERT_EQUAL(HCI_OK, hci_free_shafts_find(&machine, &none, run, 4, drag, &note));
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * COULOMB_NM, COULOMB_NM, drag[k].drag_Nm * drag[k].sign);
}

/* A log at 10 Hz of a vehicle: the current goes into inertia × acceleration, friction and the road. */
static void record_ride(double road_Nm, double from)
{
    const double inertia = 0.5, step_s = 0.1;
    record(900, &(point){20.0, 0.0, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < r->count; ++k) {
        const double t = step_s * (double)k, speed = 20.0 + 4.0 * sin(t / 9.0 + from);
        r->time_s[k] = t;
        r->speed_rad_per_s[k] = speed;
        r->theta_m_rad[k] = 20.0 * t - 36.0 * cos(t / 9.0 + from);
        r->torque_Nm[k] = inertia * 4.0 / 9.0 * cos(t / 9.0 + from) + 0.01 * ref_normal(&seed);
        const double made = r->torque_Nm[k] + 0.05 + 0.002 * speed + road_Nm * sin(t / 23.0 + 2.0 * from);
        rec_phases(0.02 * ref_normal(&seed), made / (1.5 * K_NM_PER_A), P * r->theta_m_rad[k],
                   r->i_A + 3 * k);
    }
}

static void diagnose_rides(double road_Nm)
{
    machine.rated_torque_Nm = 3.0;
    for (int k = 0; k < 3; ++k)
        record_ride(road_Nm, 1.7 * k);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
}

/* What nobody has recorded is no iron and no sensor: the torque is not known. */
static void test_a_road_is_none_of_the_motor(void)
{
    diagnose_rides(1.2);
    TEST_ASSERT_TRUE(diagnosis.nothing_measured);
    TEST_ASSERT_EQUAL(0, count_of(HCI_FINDING_ADDED));
    text_has("that load is not known", run[0].remark.text);
}

static void test_friction_is_no_road(void)
{
    diagnose_rides(0.0);
    TEST_ASSERT_FALSE(diagnosis.nothing_measured);
}

static void test_memory(void)
{
    record_free(20.0, 0.0, 300.0);
    record_free(-20.0, 0.0, 300.0);
    for (long k = 0; k < 40; ++k)
        diagnose_with(k);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_friction_of_mean_currents);
    RUN_TEST(test_a_weight_is_no_friction);
    RUN_TEST(test_more_recordings_tell_no_less);
    RUN_TEST(test_a_weight_that_swings_the_speed_brakes_nothing);
    RUN_TEST(test_a_road_is_none_of_the_motor);
    RUN_TEST(test_friction_is_no_road);
    RUN_TEST(test_memory);
    return UNITY_END();
}
