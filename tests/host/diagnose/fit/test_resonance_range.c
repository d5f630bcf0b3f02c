/* In which range of frequencies a resonance is looked for. */
#include "host/diagnose/fit/resonance.c"

#include "support/reference.h"
#include "unity.h"

enum { N = 100 };

static hci_binned_sample sample[2 * N];
static hci_segment segment[2];
static hci_binned_samples samples;
static hci_run run[2];
static bool use[2] = {true, true};
static const hci_effects none = {NULL, 0};
static hci_regression regression;

/* Turns of 0.1 s, by their mean samples; the second one of so many samples one after the other. */
void setUp(void)
{
    memset(sample, 0, sizeof sample);
    for (size_t k = 0; k < 2 * N; ++k) {
        sample[k].time_s = k < N ? 5.0 + 1e-4 * (double)k : 7.0 + 2e-3 * (double)(k - N);
        sample[k].reading.speed_rad_per_s = k < N ? 2.0 * REF_PI * 10.0 : -2.0 * REF_PI * 3.0;
    }
    segment[0] =
        (hci_segment){.run = 0, .count = N, .turns = 1, .period_s = 0.1, .timed = true, .smooth = true};
    segment[1] = (hci_segment){.run = 1, .first = N, .count = N, .timed = true, .smooth = true};
    samples = (hci_binned_samples){
        .sample = sample, .count = 2 * N, .segment = segment, .segment_count = 2, .run_count = 2};
    run[0] = run[1] = (hci_run){.torque_source = HCI_TORQUE_MEASURED};
    regression = (hci_regression){.samples = &samples, .runs = run, .use = use, .declared = &none};
}

void tearDown(void)
{
}

/* From the slowest turn to a third of the highest sampling rate, that of a mean turn by its length. */
static void test_from_the_slowest_turn_to_a_third_of_the_rate(void)
{
    double low_Hz, high_Hz;
    for (size_t turns = 1; turns < 4; ++turns) {
        segment[0].turns = turns;
        frequency_range(&regression, &low_Hz, &high_Hz);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, low_Hz);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.33 * 1000.0, high_Hz);
    }
    run[0].torque_source = HCI_TORQUE_INERTIA;
    frequency_range(&regression, &low_Hz, &high_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.33 * N / (2e-3 * (N - 1)), high_Hz);
    run[0].torque_source = HCI_TORQUE_MEASURED, use[1] = false;
    frequency_range(&regression, &low_Hz, &high_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, low_Hz);
    use[1] = true;
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_from_the_slowest_turn_to_a_third_of_the_rate);
    return UNITY_END();
}
