/* A free shaft whose torque swings within the window of its acceleration: the model is averaged over the same
 * window, and what it leaves is next to nothing. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/reading/within_slope.h"
#include "host/numeric/derivative.h"

#include "support/searching.h"

enum { N = 900, WINDOW = 5 };

static const double J_KGM2 = 1e-4, STEP_S = 1e-3, SWING = 0.5 /* rad from sample to sample */;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* i_q = cos(SWING·k) A makes 1.5·0.2 N·m/A of it; the speed is its integral over the inertia, on top of
 * 100 rad/s, and the angle that of the speed. */
static void record_swing(void)
{
    hci_run *r = add_run(N);
    const double omega = SWING / STEP_S, torque_Nm = 1.5 * K_NM_PER_A, speed = torque_Nm / J_KGM2 / omega;
    r->torque_source = HCI_TORQUE_INERTIA;
    r->torque_window = WINDOW;
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k;
        r->time_s[k] = t;
        r->speed_rad_per_s[k] = 100.0 + speed * sin(omega * t);
        r->theta_m_rad[k] = 100.0 * t - speed / omega * cos(omega * t);
        rec_phases(0.0, cos(omega * t), P * r->theta_m_rad[k], r->i_A + 3 * k);
    }
    hci_derivative_over(r->time_s, r->speed_rad_per_s, N, WINDOW, r->torque_Nm);
    for (size_t k = 0; k < N; ++k)
        r->torque_Nm[k] *= J_KGM2;
}

/* The slope over 5 samples is 0.865 of the torque at 0.5 rad a sample: at each sample by itself the model is
 * off by 29 mN·m rms. */
static void test_averaged_over_the_same_window(void)
{
    double within_Nm = 0.0;
    record_swing();
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_residual(&dataset.regression, dataset.regression.declared,
                                                          search.residual_Nm, &note));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0, hci_search_residual_rms(&search));
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_within_slope_find(&dataset.regression, dataset.regression.declared, &within_Nm, &note));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.4826 * 0.135 * 1.5 * K_NM_PER_A / sqrt(2.0), within_Nm); /* median */
}

/* Of samples with |cos| above 1/√2 alone the median of |cos| is cos(π/8). */
static void test_within_a_slope_of_samples_that_tell(void)
{
    double within_Nm = 0.0;
    record_swing();
    search_start();
    for (size_t k = 0; k < N; ++k)
        if (fabs(cos(SWING * (double)k)) < sqrt(0.5)) dataset.samples.sample[k].count = 0.0;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_within_slope_find(&dataset.regression, dataset.regression.declared, &within_Nm, &note));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.4826 * 0.135 * 1.5 * K_NM_PER_A * cos(REF_PI / 8.0), within_Nm);
}

/* A coast from 140 to 10 rad/s by a current of −B/(1.5·0.2 N·m/A), over a cogging torque of order 12, 36
 * periods in a turn, that turns by 5 rad from sample to sample when it begins. The motion is that of the
 * torque, in hundredths of a sample. */
static void record_coast(double cogging_Nm)
{
    enum { PARTS = 100 };
    hci_run *r = add_run(N);
    const double part_s = STEP_S / PARTS, brake_Nm = 130.0 * J_KGM2 / (N * STEP_S);
    double theta = 0.3, omega = 140.0;
    r->torque_source = HCI_TORQUE_INERTIA;
    r->torque_window = WINDOW;
    for (size_t k = 0; k < N; ++k) {
        r->time_s[k] = STEP_S * (double)k;
        r->speed_rad_per_s[k] = omega;
        r->theta_m_rad[k] = theta;
        rec_phases(0.0, -brake_Nm / (1.5 * K_NM_PER_A), P * theta, r->i_A + 3 * k);
        for (int j = 0; j < PARTS; ++j) {
            const double half = theta + 0.5 * part_s * omega;
            omega += part_s * (cogging_Nm * cos(12.0 * P * half) - brake_Nm) / J_KGM2;
            theta = half + 0.5 * part_s * omega;
        }
    }
    hci_derivative_over(r->time_s, r->speed_rad_per_s, N, WINDOW, r->torque_Nm);
    for (size_t k = 0; k < N; ++k)
        r->torque_Nm[k] *= J_KGM2;
}

/* Where an order turns by more than half a period between samples, its torques at them say nothing of their
 * mean over a slope. */
static void test_faster_than_sampled(void)
{
    const hci_harmonic cogging = {.order = 12.0, .cosine = 0.01, .sine = 0.0};
    record_coast(cogging.cosine);
    machine.model.cogging = &cogging;
    machine.model.cogging_count = 1;
    search_start();
    const hci_status status =
        hci_regression_residual(&dataset.regression, dataset.regression.declared, search.residual_Nm, &note);
    machine.model.cogging = NULL;
    machine.model.cogging_count = 0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, hci_search_residual_rms(&search));
}

/* Of a model that is asked between samples too, each place is work. */
static void test_work_of_a_coast(void)
{
    const hci_harmonic cogging = {.order = 12.0, .cosine = 0.01, .sine = 0.0};
    const hci_regression *e = &dataset.regression;
    record_coast(cogging.cosine);
    search_start();
    dataset.work = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_residual(e, e->declared, search.residual_Nm, &note));
    const double at_samples = dataset.work;
    machine.model.cogging = &cogging;
    machine.model.cogging_count = 1;
    const hci_status status = hci_regression_residual(e, e->declared, search.residual_Nm, &note);
    machine.model.cogging = NULL;
    machine.model.cogging_count = 0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_TRUE(at_samples > 0.0);
    TEST_ASSERT_TRUE(dataset.work - at_samples > 2.0 * at_samples);
}

/* Samples that tell no torque have no residual, and the noise is that of the others. */
static void test_samples_that_tell_nothing(void)
{
    record_swing();
    for (size_t k = 0; k < N; ++k)
        run[0].torque_Nm[k] += NOISE_NM * ref_normal(&seed);
    search_start();
    for (size_t k = 0; k < N / 2; ++k) {
        dataset.samples.sample[k].count = 0.0;
        dataset.samples.sample[k].torque_Nm = 7.0;
    }
    TEST_ASSERT_EQUAL_UINT64(N - N / 2, hci_segment_telling(&dataset.samples, dataset.samples.segment));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_noise(&search, &model.candidates, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM, hci_search_residual_rms(&search));
    const double expected_Nm = hypot(NOISE_NM, search.resolution_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, expected_Nm, hci_search_noise_rms(&search));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_averaged_over_the_same_window);
    RUN_TEST(test_within_a_slope_of_samples_that_tell);
    RUN_TEST(test_faster_than_sampled);
    RUN_TEST(test_work_of_a_coast);
    RUN_TEST(test_samples_that_tell_nothing);
    return UNITY_END();
}
