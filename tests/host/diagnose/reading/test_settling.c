/* The mean of a steady turn behind a slow sensor is that of a sensor that has settled, from its first sample
 * on: closed form of a lag and of a resonance at one order. */
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/reading/predicted_reading.h"

#include "support/searching.h"

enum { N = 23772 };

static double samples_of_turn;
static const double SPEED = 60.0, ORDER = 6.0, SINE_NM = 0.5;

void setUp(void)
{
    samples_of_turn = 377.318;
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* What a sensor makes of sin x: so much of it, so much later. */
typedef struct {
    double gain, phase_rad;
} answer;

static answer answer_of(double tau_s, double natural_Hz, double damping)
{
    const double w = ORDER * P * SPEED, lag = w * tau_s,
                 share = natural_Hz > 0.0 ? w / (2.0 * REF_PI * natural_Hz) : 0.0;
    const double re = 1.0 - share * share, im = 2.0 * damping * share;
    return (answer){1.0 / sqrt((1.0 + lag * lag) * (re * re + im * im)), atan(lag) + atan2(im, re)};
}

static void record_settled(double direction, answer x)
{
    hci_run *r = add_run(N);
    for (size_t k = 0; k < N; ++k) {
        const double turned = 2.0 * REF_PI * (double)k / samples_of_turn;
        r->theta_m_rad[k] = direction * turned;
        r->time_s[k] = turned / SPEED;
        r->speed_rad_per_s[k] = direction * SPEED;
        rec_phases(0.0, 0.0, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] = direction * SINE_NM * x.gain * sin(ORDER * P * turned - x.phase_rad);
    }
}

/* Largest residual of the model at the values that the recording was made with, as a share of the torque. */
static double worst_share(double tau_s, double natural_Hz, double damping)
{
    const answer x = answer_of(tau_s, natural_Hz, damping);
    double worst = 0.0;
    record_settled(1.0, x);
    record_settled(-1.0, x);
    search_start();
    model_add("cogging", "sine", "cosine", ORDER);
    model.candidates.candidate[0].term[0].value = SINE_NM;
    model_add("torque_sensor", "time_constant", NULL, 0.0);
    model.candidates.candidate[1].term[0].value = tau_s;
    model_add("torque_sensor", "natural_frequency", "damping", 0.0);
    model.candidates.candidate[2].term[0].value = natural_Hz;
    model.candidates.candidate[2].term[1].value = damping;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_residual(&search, &model.candidates, &note));
    TEST_ASSERT_TRUE(dataset.samples.segment[0].turns > 0);
    for (size_t k = 0; k < dataset.samples.count; ++k)
        worst = fmax(worst, fabs(search.residual_Nm[k]) / SINE_NM);
    return worst;
}

/* A turn takes 0.1 s: the sensor settles within it, or in three of them. */
static void test_it_has_settled(void)
{
    static const struct {
        double tau_s, natural_Hz, damping;
    } SENSOR[] = {
        {2e-4, 0.0, 0.05}, {2e-3, 0.0, 0.05}, {0.015, 0.0, 0.05}, {0.0, 600.0, 0.1}, {5e-4, 300.0, 2.0}};
    for (size_t k = 0; k < sizeof SENSOR / sizeof *SENSOR; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0,
                                  worst_share(SENSOR[k].tau_s, SENSOR[k].natural_Hz, SENSOR[k].damping));
        tearDown();
        setUp();
    }
}

/* What linearising the model takes, in multiplications. */
static double work_of(double tau_s)
{
    hci_normal_equations normal;
    record_settled(1.0, answer_of(tau_s, 0.0, 0.05));
    search_start();
    model_add("cogging", "sine", "cosine", ORDER);
    model_add("torque_sensor", "time_constant", NULL, 0.0);
    model.candidates.candidate[1].term[0].value = tau_s;
    const double before = dataset.work;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_regression_normal(search.regression, &model.candidates, true, &normal, &note));
    hci_normal_equations_release(&normal);
    return dataset.work - before;
}

/* Three turns before the one that is read go through it too, and both it and its derivative in parts. */
static void test_a_slow_sensor_is_work(void)
{
    const double quick = work_of(0.0);
    tearDown();
    setUp();
    const double slow = work_of(0.015);
    TEST_ASSERT_TRUE(slow > quick + 4.0 * (double)dataset.samples.count * 3000.0);
}

/* A declared lag acts where the samples of a turn are too few to smooth its currents: 200 of them. */
static void test_a_declared_lag_acts_everywhere(void)
{
    const hci_effect_type *type = hci_effect_type_find("torque_sensor");
    hci_effect_term tau = {parameter_of(type, "time_constant"), 0.0, 4e-4, NAN};
    const hci_effect sensor = {type, &tau, 1};
    const hci_effects declared = {&sensor, 1};
    samples_of_turn = 200.0;
    record_settled(1.0, answer_of(tau.value, 0.0, 0.05));
    search_start();
    dataset.regression.declared = &declared;
    model_add("cogging", "sine", "cosine", ORDER);
    model.candidates.candidate[0].term[0].value = SINE_NM;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_residual(&search, &model.candidates, &note));
    TEST_ASSERT_TRUE(dataset.samples.segment[0].turns > 0 && dataset.samples.count < 240);
    TEST_ASSERT_FALSE(dataset.samples.segment[0].smooth);
    for (size_t k = 0; k < dataset.samples.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * SINE_NM, 0.0, search.residual_Nm[k]); /* without it: 0.4 */
}

/* One turn and a half, whose samples are one step and a half apart, then half a step: what the sensor read
 * before is the turn that follows, at its own time. */
static void test_uneven_samples_have_settled(void)
{
    const hci_effect_type *type = hci_effect_type_find("torque_sensor");
    hci_effect_term tau = {parameter_of(type, "time_constant"), 0.0, 4e-3, NAN};
    const hci_effect sensor = {type, &tau, 1};
    const hci_effects declared = {&sensor, 1};
    const answer x = answer_of(tau.value, 0.0, 0.05);
    hci_run *r = add_run(600);
    for (size_t k = 0; k < r->count; ++k) {
        const double turned = 2.0 * REF_PI * ((double)k + (k % 2 ? 0.5 : 0.0)) / 400.3;
        r->theta_m_rad[k] = turned;
        r->time_s[k] = turned / SPEED;
        r->speed_rad_per_s[k] = SPEED;
        rec_phases(0.0, 0.0, P * turned, r->i_A + 3 * k);
        r->torque_Nm[k] = SINE_NM * x.gain * sin(ORDER * P * turned - x.phase_rad);
    }
    search_start();
    dataset.regression.declared = &declared;
    model_add("cogging", "sine", "cosine", ORDER);
    model.candidates.candidate[0].term[0].value = SINE_NM;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_residual(&search, &model.candidates, &note));
    TEST_ASSERT_EQUAL_UINT64(0, dataset.samples.segment[0].turns);
    for (size_t k = 0; k < dataset.samples.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * SINE_NM, 0.0, search.residual_Nm[k]);
}

/* Sixteen time constants, of each stage; without any there is nothing to wait for, and without damping no
 * end. */
static void test_how_long_it_takes(void)
{
    const hci_effect_type *type = hci_effect_type_find("torque_sensor");
    hci_effect_term term[3] = {{parameter_of(type, "time_constant"), 0.0, 1e-3, NAN},
                               {parameter_of(type, "natural_frequency"), 0.0, 50.0, NAN},
                               {parameter_of(type, "damping"), 0.0, 0.1, NAN}};
    const hci_effect sensor = {type, term, 3};
    const hci_effects list = {&sensor, 1};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 16.0 * (1e-3 + 1.0 / (0.1 * 100.0 * REF_PI)), hci_settling_s(&list));
    term[2].value = 1.25; /* poles at half and at twice the frequency */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 16.0 * (1e-3 + 2.0 / (100.0 * REF_PI)), hci_settling_s(&list));
    term[2].value = 0.0;
    TEST_ASSERT_TRUE(hci_settling_s(&list) > 1e300);
    term[0].value = term[1].value = 0.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_settling_s(&list));
}

/* The samples of the last so many seconds before a turn of 100 samples a second, and four that inputs between
 * samples are told from; three turns at most. */
static void test_samples_of_that_time(void)
{
    static const struct {
        double settling_s;
        size_t samples;
    } CASE[] = {{0.0, 4},     {0.005, 4},   {0.015, 5},   {0.255, 29},    {0.995, 103},
                {1.255, 129}, {2.255, 229}, {2.945, 298}, {2.965, 300},   {2.995, 300},
                {3.0, 300},   {17.0, 300},  {1e300, 300}, {INFINITY, 300}};
    hci_binned_sample sample[100];
    const hci_segment of_a_second = {.count = 100, .turns = 9, .period_s = 1.0};
    for (size_t k = 0; k < 100; ++k)
        sample[k] = (hci_binned_sample){.time_s = 7.0 + 0.01 * (double)k};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        TEST_ASSERT_EQUAL(CASE[k].samples, hci_settling_samples(sample, &of_a_second, CASE[k].settling_s));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_samples_of_that_time);
    RUN_TEST(test_it_has_settled);
    RUN_TEST(test_a_slow_sensor_is_work);
    RUN_TEST(test_a_declared_lag_acts_everywhere);
    RUN_TEST(test_uneven_samples_have_settled);
    RUN_TEST(test_how_long_it_takes);
    return UNITY_END();
}
