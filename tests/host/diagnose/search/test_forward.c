/* One step forward: what comes into the model, and that nothing does on noise. */
#include "host/diagnose/search/forward.h"

#include "support/searching.h"

enum { SAMPLES = 100, LONG = 1500 }; /* of a run: one electrical period, and five turns */

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Two currents in each direction. */
static void record_small(double offset_A, double brake_Nm)
{
    for (int k = 0; k < 4; ++k)
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, offset_A,
                                 k < 2 ? brake_Nm : -brake_Nm, 0.0});
}

static bool step_forward(void)
{
    bool added = false;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_forward(&search, &model, &added, &note), note.text);
    return added;
}

/* The score must fall by 10: for noise that is once in thousands. */
static void test_nothing_comes_in_on_noise(void)
{
    for (int k = 0; k < 3; ++k) {
        seed = 1000 + (uint64_t)k;
        record_small(0.0, 0.0);
        search_start();
        model_fit();
        TEST_ASSERT_FALSE(step_forward());
        TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&model.candidates));
        tearDown();
        setUp();
    }
}

static void test_the_true_effect_comes_in_alone(void)
{
    record_small(0.3, 0.0);
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("current_offset"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *a = term_in(&model.candidates, "current_offset", "a", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * a->std_error, 0.3, a->value);
    for (size_t r = 0; r < hci_candidate_types(); ++r) { /* it is remembered by how much that was better */
        const bool is_it = hci_candidate_type(r) == hci_effect_type_find("current_offset");
        TEST_ASSERT_TRUE(is_it ? search.came_with[r] > 100.0 : search.came_with[r] == 0.0);
    }
    TEST_ASSERT_FALSE(step_forward()); /* and nothing beside it */
}

/* With one effect in the model the other comes in, and the first keeps its terms. */
static void test_a_second_effect(void)
{
    record_small(0.3, 0.05);
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("current_offset") && model_has("friction"));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *coulomb = term_in(&model.candidates, "friction", "coulomb", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * coulomb->std_error, 0.05, coulomb->value);
}

/* Friction of which runs at one speed told the constant alone is large beside an offset: that comes in beside
 * the friction, of which more is looked for at two speeds, and not in its place. */
static void test_a_second_effect_beside_a_law_of_fewer_terms(void)
{
    record_small(0.3, 0.1);
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("current_offset") && model_has("friction"));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&model.candidates));
}

/* And where nothing else is missing, the rest of the law itself comes in. */
static void test_a_law_of_fewer_terms_grows(void)
{
    for (int k = 0; k < 4; ++k)
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, k < 2 ? 0.05 : -0.09, 0.0});
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *viscous = term_in(&model.candidates, "friction", "viscous", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * viscous->std_error, 0.04 / 90.0, viscous->value);
    TEST_ASSERT_FALSE(step_forward());
}

/* A torque that a slow bus brings 4 radians of the current's ripple later: no small step from nothing finds
 * it. At one speed alone it could be early by 2.3 as well. */
static void test_a_torque_that_is_late_by_radians(void)
{
    const double delay_s = 4.0 / (6.0 * P * 60.0);
    for (int k = 0; k < 2; ++k) {
        const double speed = k ? 60.0 : 45.0;
        record(3000, &(point){speed, 0.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 3000; ++j) {
            const double theta = P * run[k].theta_m_rad[j], late = theta - P * speed * delay_s;
            rec_phases(0.0, 5.0 + 0.5 * sin(6.0 * theta), theta, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 1.5 * K_NM_PER_A * (5.0 + 0.5 * sin(6.0 * late));
        }
    }
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("channel_delay"));
    const hci_effect_term *late = term_in(&model.candidates, "channel_delay", "torque", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * late->std_error, delay_s, late->value);
    TEST_ASSERT_FALSE(step_forward());
}

#define SWINGS_HZ 400.0
#define DAMPED    0.1

/* sin x with x' = ω behind that sensor: the imaginary part of e^jx / (1 - u² + 2jζu), u = ω/ω_n. */
static double behind_sensor(double omega, double x)
{
    const double u = omega / (2.0 * REF_PI * SWINGS_HZ), re = 1.0 - u * u, im = 2.0 * DAMPED * u;
    return (re * sin(x) - im * cos(x)) / (re * re + im * im);
}

/* A ripple of the current, and its second harmonic, behind a sensor that swings near both, at one speed or
 * another, and whose zero is off. */
static void record_swinging(double offset_Nm)
{
    static const double SPEED[] = {45.0, 60.0, 120.0};
    for (int k = 0; k < 3; ++k) {
        record(3000, &(point){SPEED[k], 0.0, 0.0, -offset_Nm, 0.0});
        for (size_t j = 0; j < 3000; ++j) {
            const double theta = P * run[k].theta_m_rad[j];
            double iq_A = 5.0, read_A = 5.0;
            for (int n = 6; n <= 12; n += 6) {
                iq_A += 0.5 * sin(n * theta);
                read_A += 0.5 * behind_sensor(n * P * SPEED[k], n * theta);
            }
            rec_phases(0.0, iq_A, theta, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 1.5 * K_NM_PER_A * read_A;
        }
    }
    search_start();
}

/* The zero of the sensor is of the same type, and in already: its resonance is looked for all the same. */
static void test_a_resonance_beside_a_zero_of_the_sensor(void)
{
    record_swinging(0.1);
    model_add("torque_sensor", "offset", NULL, 0.0);
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *at = term_in(&model.candidates, "torque_sensor", "natural_frequency", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * at->std_error, SWINGS_HZ, at->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1, term_in(&model.candidates, "torque_sensor", "offset", 0.0)->value);
    TEST_ASSERT_FALSE(step_forward()); /* and nothing beside it */
}

/* Currents that are read 1 ms late, which turns i_d into i_q, beside a ripple that grows with the square of
 * the current: a series in the currents describes both at seven operating points, with many values. The delay
 * comes first, since the ripple can still be added. */
static void test_few_values_before_a_series(void)
{
    static const double SPEED[] = {25.0, -25.0, 40.0, -60.0, 50.0, -30.0, 60.0}, DELAY_S = 1e-3;
    static const double D_A[] = {0.0, -6.0, 5.0, -4.5, 3.0, 7.0, -8.0},
                        Q_A[] = {4.0, 2.0, 10.0, 6.0, 8.0, -10.0, 3.0};
    for (size_t k = 0; k < 7; ++k) {
        const double lag = P * SPEED[k] * DELAY_S;
        record(300, &(point){SPEED[k], Q_A[k], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 300; ++j) {
            const double theta = P * run[k].theta_m_rad[j];
            rec_phases(D_A[k], Q_A[k], theta - lag, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 2e-4 * Q_A[k] * Q_A[k] * sin(6.0 * theta);
        }
    }
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("channel_delay"));
    TEST_ASSERT_FALSE(model_has("saturation"));
}

/* The torque of a saliency at five operating points, with means that are off by a third of the noise of a
 * sample: a back-EMF and a friction of three powers have a value for each point, and describe them better.
 * One value does as well but for that. */
static void test_one_effect_before_two_with_a_value_for_each_point(void)
{
    static const double SPEED[] = {10.0, -10.0, 20.0, 15.0, 12.0}, OFF_Nm[] = {1.0, -1.0, 1.0, 1.0, -1.0};
    static const double D_A[] = {0.0, -6.0, -10.0, -4.0, 4.0}, Q_A[] = {10.0, 10.0, 6.0, -8.0, 5.0};
    for (size_t k = 0; k < 5; ++k) {
        record(LONG, &(point){SPEED[k], Q_A[k], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < LONG; ++j) {
            rec_phases(D_A[k], Q_A[k], P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
            run[k].torque_Nm[j] -= 0.003 * D_A[k] * Q_A[k] - 0.2 * NOISE_NM * OFF_Nm[k];
        }
    }
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("reluctance"));
    TEST_ASSERT_FALSE(model_has("friction") || model_has("back_emf"));
}

/* A tenth of the torque is there at currents of both signs, which magnets and sensors describe best: of these
 * nobody believes any, and what brakes comes in from behind them. */
static void test_what_is_not_believed_makes_room(void)
{
    for (int k = 0; k < 4; ++k) {
        const double brake_Nm = k < 2 ? 0.05 : -0.05;
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : -6.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] = 0.1 * run[k].torque_Nm[j] - brake_Nm;
    }
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_EQUAL_STRING("back_emf", search.disbelieved.type->name);
    TEST_ASSERT_TRUE(model_has("friction"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_comes_in_on_noise);
    RUN_TEST(test_the_true_effect_comes_in_alone);
    RUN_TEST(test_a_second_effect);
    RUN_TEST(test_a_second_effect_beside_a_law_of_fewer_terms);
    RUN_TEST(test_a_law_of_fewer_terms_grows);
    RUN_TEST(test_a_torque_that_is_late_by_radians);
    RUN_TEST(test_a_resonance_beside_a_zero_of_the_sensor);
    RUN_TEST(test_few_values_before_a_series);
    RUN_TEST(test_one_effect_before_two_with_a_value_for_each_point);
    RUN_TEST(test_what_is_not_believed_makes_room);
    return UNITY_END();
}
