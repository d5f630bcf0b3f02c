/* A recording that has not been made: its turn, its readings of a machine of one sine, and in a holding test
 * the current that leaves no torque, in closed form. */
#include "host/diagnose/next/trial_run.h"

#include <math.h>
#include <string.h>

#include "support/recording.h"
#include "unity.h"

static const double K_NM_PER_A = 0.2, COGGING_NM = 0.05;
enum { P = 3 };

static hci_wave emf;
static hci_machine machine;
static hci_effect_term term[2];
static hci_effect cogging;
static hci_effects truth;
static hci_regression regression;
static hci_playable playable;
static hci_trial_run trial;
static hci_note note;

/* Back-EMF of 0.2 N·m/A, and a cogging torque of 0.05 sin 6·3θ. */
void setUp(void)
{
    static const hci_effects none = {NULL, 0};
    memset(&note, 0, sizeof note);
    emf = hci_wave_polar(1.0, 1, K_NM_PER_A, 0.0);
    machine = (hci_machine){.pole_pairs = P, .back_emf = &emf, .back_emf_count = 1};
    cogging = (hci_effect){hci_effect_type_find("cogging"), term, 1};
    term[0] = (hci_effect_term){0, 6.0, COGGING_NM, NAN};
    truth = (hci_effects){&cogging, 1};
    regression = (hci_regression){.machine = &machine, .declared = &none};
    playable = (hci_playable){
        .source = HCI_TORQUE_MEASURED, .volts_s = K_NM_PER_A, .noise_Nm = 0.02, .temperature_C = 33.0};
}

void tearDown(void)
{
    hci_trial_run_release(&trial);
}

static void play(double id_A, double iq_A, double speed_rad_per_s)
{
    const hci_operating_point at = {id_A, iq_A, speed_rad_per_s};
    TEST_ASSERT_EQUAL(HCI_OK, hci_trial_run_make(&regression, &playable, &trial, &note));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_trial_run_play(&trial, &playable, &at, &truth, &note), note.text);
}

/* 96 samples of an electrical period, 1024 of a turn at most. */
static void test_samples_of_a_turn(void)
{
    TEST_ASSERT_EQUAL(96, hci_trial_run_samples(1));
    TEST_ASSERT_EQUAL(960, hci_trial_run_samples(10));
    TEST_ASSERT_EQUAL(1024, hci_trial_run_samples(11));
}

/* Forward and backward: one turn in even steps, whose time ascends. */
static void test_readings_of_a_torque_sensor(void)
{
    for (int back = 0; back < 2; ++back) {
        const double speed = back ? -40.0 : 40.0, way = back ? -1.0 : 1.0;
        play(-2.0, 5.0, speed);
        TEST_ASSERT_EQUAL(96 * P, trial.samples.count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI / 40.0, trial.segment.period_s);
        for (size_t k = 0; k < trial.samples.count; ++k) {
            const hci_binned_sample *x = &trial.sample[k];
            const double theta = way * 2.0 * REF_PI * (double)k / (96 * P);
            double i[3];
            rec_phases(-2.0, 5.0, P * theta, i);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta, x->reading.theta_m_rad);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, fabs(theta) / 40.0, x->time_s);
            TEST_ASSERT_EQUAL_DOUBLE(speed, x->reading.speed_rad_per_s);
            TEST_ASSERT_EQUAL_DOUBLE(33.0, x->reading.temperature_C);
            TEST_ASSERT_TRUE(x->count == 1.0 && isnan(x->sum_A));
            for (int s = 0; s < 3; ++s) {
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, i[s], x->reading.i_abc[s]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, i[s], x->raw.i_abc[s]);
            }
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * K_NM_PER_A * 5.0 + COGGING_NM * sin(6.0 * P * theta),
                                      x->torque_Nm);
        }
        hci_trial_run_release(&trial);
    }
    play(0.0, 1.0, 10.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.02, trial.noise.rms);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, trial.run.torque_source);
}

/* k i_q = −cogging at each angle, whatever i_d is. */
static void test_the_current_that_holds(void)
{
    playable.source = HCI_TORQUE_HOLDING;
    play(-2.0, NAN, 5.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, trial.run.torque_source);
    for (size_t k = 0; k < trial.samples.count; ++k) {
        const hci_binned_sample *x = &trial.sample[k];
        const double theta = x->reading.theta_m_rad;
        double d, q;
        rec_rotor(x->reading.i_abc, P * theta, &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.0, d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -COGGING_NM * sin(6.0 * P * theta) / (1.5 * K_NM_PER_A), q);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, x->torque_Nm);
    }
    hci_trial_run_release(&trial);
    playable.source = HCI_TORQUE_INERTIA; /* is recorded with what accelerates */
    play(1.0, NAN, 5.0);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, trial.run.torque_source);
    double d, q;
    rec_rotor(trial.sample[7].reading.i_abc, P * trial.sample[7].reading.theta_m_rad, &d, &q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, d);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_samples_of_a_turn);
    RUN_TEST(test_readings_of_a_torque_sensor);
    RUN_TEST(test_the_current_that_holds);
    return UNITY_END();
}
