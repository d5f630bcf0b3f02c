/* The torque sensor: what a model predicts that it reads against the closed form of its response, and the
 * grid that looks for its resonance. */
#include "host/diagnose/fit/resonance.h"

#include <complex.h>

#include "host/diagnose/reading/predicted_reading.h"
#include "support/searching.h"

#define J ((double complex)I)

enum { N = 2000 };

static const double SPEED = 50.0;

/* One steady turn of a machine without current, as a mean over turns. */
void setUp(void)
{
    dataset_start();
    record(4 * N, &(point){SPEED, 0.0, 0.0, 0.0, 0.0});
    for (size_t k = 0; k < 4 * N; ++k) {
        run[0].theta_m_rad[k] = 2.0 * REF_PI * ((double)k + 0.5) / N;
        run[0].time_s[k] = run[0].theta_m_rad[k] / SPEED;
        run[0].torque_Nm[k] = 0.0;
    }
    search_start();
    TEST_ASSERT_EQUAL_UINT64(1, dataset.samples.segment_count);
    TEST_ASSERT_TRUE(dataset.samples.segment[0].turns > 0 && dataset.samples.segment[0].smooth);
    dataset.regression.noise[0] = hci_noise_white(NOISE_NM);
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* 1/(1 + jωτ) or 1/(1 − (f/f₀)² + 2jζ f/f₀) */
static double complex response_at(double frequency_Hz, double lag_s, double natural_Hz, double damping)
{
    const double x = natural_Hz > 0.0 ? frequency_Hz / natural_Hz : 0.0;
    return natural_Hz > 0.0 ? 1.0 / (1.0 - x * x + 2.0 * J * damping * x)
                            : 1.0 / (1.0 + 2.0 * J * REF_PI * frequency_Hz * lag_s);
}

/* Torque waves of many orders of the turn, and behind the sensor. */
static double wave(double theta_m, int order, double complex response)
{
    return 0.1 * cimag(response * cexp(J * (order * theta_m + 0.3 * order)));
}

/* ---- what is predicted ---- */

/* A lag of 1 ms behind cogging of electrical order 6, once the sensor has settled. */
static void test_a_lag_is_predicted(void)
{
    const double frequency_Hz = 6.0 * P * SPEED / (2.0 * REF_PI), lag_s = 1e-3;
    const hci_effect_term sensor_term = {0, 0.0, lag_s, NAN}, cogging_term = {0, 6.0, 0.1, NAN};
    const hci_effect effect[] = {{hci_effect_type_find("cogging"), &cogging_term, 1},
                                 {hci_effect_type_find("torque_sensor"), &sensor_term, 1}};
    const hci_effects effects = {effect, 2};
    const double complex response = response_at(frequency_Hz, lag_s, 0.0, 0.0);
    const hci_segment *s = dataset.samples.segment;
    hci_predicted_reading reading;
    TEST_ASSERT_TRUE(hci_predicted_reading_make(&dataset.regression, &effects, false, &reading));
    hci_predicted_reading_fill(&dataset.regression, &effects, s, &reading);
    double worst = 0.0;
    for (size_t k = 0; k < s->count; ++k) {
        const double theta = 6.0 * P * dataset.samples.sample[k].reading.theta_m_rad;
        worst = ref_worse(worst, reading.torque_Nm[k] - 0.1 * cimag(response * cexp(J * theta)));
    }
    hci_predicted_reading_release(&reading);
    TEST_ASSERT_TRUE(worst < 1e-4); /* trapezoids of 1/111 of a period: (2π/111)²/12 of 0.1 */
}

/* A resonance beside an order of cogging, 13 samples in its period, in a recording that begins while it
 * swings. Without what was before, at samples alone, the response would be off by all of it at the beginning,
 * and by a third all along: trapezoids swing 2 % too slowly, and lines between samples are 2 % too low. */
static void test_a_resonance_is_predicted(void)
{
    const double natural_Hz = 150.0, damping = 0.03, frequency_Hz = 6.0 * P * SPEED / (2.0 * REF_PI);
    const double complex response = response_at(frequency_Hz, 0.0, natural_Hz, damping);
    const hci_effect_term sensor_term[] = {{1, 0.0, natural_Hz, NAN}, {2, 0.0, damping, NAN}};
    const hci_effect_term cogging_term = {0, 6.0, 0.1, NAN};
    const hci_effect effect[] = {{hci_effect_type_find("cogging"), &cogging_term, 1},
                                 {hci_effect_type_find("torque_sensor"), sensor_term, 2}};
    const hci_effects effects = {effect, 2};
    hci_predicted_reading reading;
    search_end();
    for (size_t k = 0; k < 4 * N; ++k) {
        run[0].time_s[k] = (double)k / 13.0 / natural_Hz;
        run[0].theta_m_rad[k] = SPEED * run[0].time_s[k];
    }
    run[0].count = 3000;
    search_start();
    TEST_ASSERT_TRUE(dataset.samples.segment[0].turns == 0 && dataset.samples.segment[0].smooth);
    TEST_ASSERT_TRUE(hci_predicted_reading_make(&dataset.regression, &effects, false, &reading));
    hci_predicted_reading_fill(&dataset.regression, &effects, dataset.samples.segment, &reading);
    double worst = 0.0;
    for (size_t k = 0; k < run[0].count; ++k) {
        const double theta = 6.0 * P * run[0].theta_m_rad[k];
        worst = ref_worse(worst, reading.torque_Nm[k] - 0.1 * cimag(response * cexp(J * theta)));
    }
    hci_predicted_reading_release(&reading);
    TEST_ASSERT_TRUE(worst < 0.03 * 0.1 * cabs(response));
}

/* ---- the grid ---- */

static hci_resonance find(double natural_Hz, double damping)
{
    hci_resonance found;
    for (size_t k = 0; k < dataset.samples.count; ++k) {
        hci_binned_sample *x = &dataset.samples.sample[k];
        double air_gap_Nm = 0.0;
        x->torque_Nm = NOISE_NM * ref_normal(&seed);
        for (int n = 1; n <= 40; ++n) {
            const double complex h = response_at(n * SPEED / (2.0 * REF_PI), 0.0, natural_Hz, damping);
            x->torque_Nm += wave(x->reading.theta_m_rad, n, h);
            air_gap_Nm += wave(x->reading.theta_m_rad, n, 1.0);
        }
        search.residual_Nm[k] = x->torque_Nm - air_gap_Nm;
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_resonance_find(&dataset.regression, hci_effect_type_find("torque_sensor"),
                                             search.residual_Nm, &found, &note));
    return found;
}

/* The grid goes from the speed of the turn, 8 Hz, to a third of the sampling rate, 5 kHz, in 48 steps: 14.8 %
 * each, so that half a step is 7.2 %. */
static void test_a_resonance_is_found(void)
{
    static const double NATURAL_Hz[] = {60.0, 150.0, 230.0}, DAMPING[] = {0.3, 0.1, 0.1};
    for (size_t k = 0; k < 3; ++k) {
        const hci_resonance found = find(NATURAL_Hz[k], DAMPING[k]);
        TEST_ASSERT_DOUBLE_WITHIN(0.08 * NATURAL_Hz[k], NATURAL_Hz[k], found.natural_frequency_Hz);
        TEST_ASSERT_EQUAL_DOUBLE(DAMPING[k], found.damping);
        TEST_ASSERT_TRUE(found.gain > 1000.0);
    }
}

/* Where there is none, a high frequency may describe a little noise, and no more than noise has. */
static void test_no_resonance_is_found_in_noise(void)
{
    TEST_ASSERT_TRUE(find(0.0, 0.0).gain < 22.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_lag_is_predicted);
    RUN_TEST(test_a_resonance_is_predicted);
    RUN_TEST(test_a_resonance_is_found);
    RUN_TEST(test_no_resonance_is_found_in_noise);
    return UNITY_END();
}
