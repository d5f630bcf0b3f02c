/* Effects at the ends of what they are given: lists that end, currents of nothing, sensors of any speed. */
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "unity.h"

enum { MOST = 200, SAMPLES = 60 };

static hci_effect_candidate taken[MOST];
static size_t count;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
}

static void take(void *context, const hci_effect_candidate *candidate)
{
    (void)context;
    TEST_ASSERT_TRUE(count < MOST);
    taken[count++] = *candidate;
}

static const hci_effect_proposals TO = {take, NULL};

static size_t parameter_of(const hci_effect_type *type, const char *name)
{
    size_t k = 0;
    while (k < type->parameter_count && strcmp(type->parameter[k].name, name) != 0)
        ++k;
    TEST_ASSERT_TRUE(k < type->parameter_count);
    return k;
}

/* ---- what is expected of a term ---- */

/* Motors of one make differ by any cogging torque. */
static void test_cogging_of_one_make_may_be_any(void)
{
    const hci_harmonic cogging = {6.0, 0.3, 0.4};
    const hci_machine machine = {.pole_pairs = 1, .cogging = &cogging, .cogging_count = 1};
    hci_effect_type_find("cogging")->propose_alike(&machine, NAN, &TO);
    TEST_ASSERT_EQUAL_UINT64(1, count);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, taken[0].expected);
}

/* Without an i_d the inductances are expected within three times the flux at the largest current, and within
 * any where there was no current. */
static void test_what_is_expected_of_inductances(void)
{
    const hci_wave emf = {1.0, 1, 0.3, 0.4};
    const hci_machine machine = {.pole_pairs = 5, .back_emf = &emf, .back_emf_count = 1};
    hci_effect_survey survey = {.machine = &machine, .current_A = 10.0, .reference_current_A = 8.0};
    hci_effect_type_find("reluctance")->propose(&survey, &TO);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 * 0.5 / (5.0 * 8.0), taken[0].expected);
    count = 0;
    survey.reference_current_A = 0.0;
    hci_effect_type_find("reluctance")->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, taken[0].expected);
    count = 0;
    survey.reference_current_A = 8.0, survey.along_d_A = 1.0;
    hci_effect_type_find("reluctance")->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, taken[0].expected);
}

/* ---- lists that end ---- */

/* What stands behind a list is not sensed. */
static void test_what_stands_behind_a_list(void)
{
    const hci_effect_type *type = hci_effect_type_find("position_offset");
    hci_effect_term term[] = {{0, 0.0, 0.1, NAN}, {0, 0.0, 0.5, NAN}};
    hci_effect effect[] = {{type, &term[0], 1}, {type, &term[1], 1}};
    const hci_sample truth = {.theta_m_rad = 1.0};
    const hci_effects none = {effect, 0}, one = {effect, 1}, both = {effect, 2};
    const double first = hci_effects_sense(&one, 1, &truth).theta_m_rad;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_effects_sense(&none, 1, &truth).theta_m_rad);
    TEST_ASSERT_TRUE(fabs(first - 1.0) > 0.05);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0,
                              (hci_effects_sense(&both, 1, &truth).theta_m_rad - 1.0) / (first - 1.0));
}

/* ---- slow sensors ---- */

/* A sensor's answer to a step, and its derivatives, where a second is so many units of time, at times that
 * are uneven by a share of a step. */
static void answer_in(double second, double uneven, double torque[SAMPLES], double by_value[SAMPLES][2])
{
    const hci_effect_type *type = hci_effect_type_find("torque_sensor");
    const hci_effect_term term[] = {{parameter_of(type, "natural_frequency"), 0.0, 20.0 / second, NAN},
                                    {parameter_of(type, "damping"), 0.0, 0.4, NAN}};
    const hci_effect effect = {type, term, 2};
    const hci_effects effects = {&effect, 1};
    double time_s[SAMPLES];
    for (size_t k = 0; k < SAMPLES; ++k) {
        time_s[k] = 1e-3 * second * ((double)k + (k % 5 == 4 ? uneven : 0.0));
        torque[k] = k < 5 ? 0.0 : 1.0;
        by_value[k][0] = by_value[k][1] = 0.0;
    }
    hci_effects_filter(&effects, time_s, SAMPLES, torque, by_value[0]);
}

/* In units that are powers of two the answer is the same to the bit, and what a frequency does as many times
 * as much. */
static void test_a_sensor_has_no_unit_of_time(void)
{
    static double torque[2][SAMPLES], by_value[2][SAMPLES][2];
    for (double uneven = 0.0; uneven < 0.5; uneven += 0.2) {
        answer_in(1.0, uneven, torque[0], by_value[0]);
        TEST_ASSERT_TRUE(fabs(by_value[0][30][0]) > 1e-4 && fabs(by_value[0][30][1]) > 1e-4);
        for (double second = 0x1p-14; second < 0x1p15; second *= 0x1p4) {
            answer_in(second, uneven, torque[1], by_value[1]);
            for (size_t k = 0; k < SAMPLES; ++k) {
                TEST_ASSERT_EQUAL_DOUBLE(torque[0][k], torque[1][k]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, by_value[0][k][0], by_value[1][k][0] / second);
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, by_value[0][k][1], by_value[1][k][1]);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cogging_of_one_make_may_be_any);
    RUN_TEST(test_what_is_expected_of_inductances);
    RUN_TEST(test_what_stands_behind_a_list);
    RUN_TEST(test_a_sensor_has_no_unit_of_time);
    return UNITY_END();
}
