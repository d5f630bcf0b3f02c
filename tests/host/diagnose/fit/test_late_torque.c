/* The delay of a torque on a grid, against torques that were shifted by it in closed form. */
#include "host/diagnose/fit/late_torque.h"

#include "support/searching.h"

enum { N = 3000, PER_TURN = 300 };

static const double SPEED = 50.0;

void setUp(void)
{
    dataset_start();
    record(N, &(point){SPEED, 0.0, 0.0, 0.0, 0.0});
    search_start();
    dataset.regression.noise[0] = hci_noise_white(NOISE_NM);
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Orders 1 to 40 of the turn, that is up to 7.5 samples in a period. */
static double wave(double time_s)
{
    double sum = 0.0;
    for (int n = 1; n <= 40; ++n)
        sum += 0.1 * sin(n * SPEED * time_s + 0.3 * n * n);
    return sum;
}

static hci_late_torque find(double delay_s, double size)
{
    hci_late_torque found;
    for (size_t k = 0; k < dataset.samples.count; ++k) {
        hci_binned_sample *x = &dataset.samples.sample[k];
        x->torque_Nm = size * wave(x->time_s - delay_s) + NOISE_NM * ref_normal(&seed);
        search.residual_Nm[k] = x->torque_Nm - size * wave(x->time_s);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_late_torque_find(&dataset.regression, search.residual_Nm, &found, &note));
    return found;
}

/* 4 ms are 8 radians of the highest order. */
static void test_a_delay_is_found(void)
{
    static const double DELAY_S[] = {4e-3, -2.5e-3, 0.37e-3};
    const double step_s = 2.0 * REF_PI / PER_TURN / SPEED;
    for (size_t k = 0; k < 3; ++k) {
        const hci_late_torque found = find(DELAY_S[k], 1.0);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * step_s, DELAY_S[k], found.delay_s);
        TEST_ASSERT_TRUE(found.gain > 1e4);
    }
}

/* Bins of a mean over turns lie closer together than samples do: steps are those of the clock, of which few
 * reach 5 ms. */
static void test_bins_make_no_smaller_steps(void)
{
    for (size_t k = 0; k < dataset.samples.count; ++k)
        dataset.samples.sample[k].time_s /= 12.0;
    TEST_ASSERT_DOUBLE_WITHIN(2e-5, 4.5e-3, find(4.5e-3, 1.0).delay_s);
}

/* Two runs, one with half the torque, each fiftieth sample a hole that tells nothing, whatever stands there:
 * χ² falls by what the delay makes of the others. */
static void test_all_runs_count_and_holes_do_not(void)
{
    const double delay_s = 8.0 * 2.0 * REF_PI / PER_TURN / SPEED;
    double fall = 0.0;
    hci_late_torque found;
    search_end();
    record(N, &(point){SPEED, 0.0, 0.0, 0.0, 0.0});
    search_start();
    TEST_ASSERT_EQUAL_UINT64(2 * N, dataset.samples.count);
    for (size_t k = 0; k < 2 * N; ++k) {
        hci_binned_sample *x = &dataset.samples.sample[k];
        const double noise_Nm = NOISE_NM * ref_normal(&seed), size = k < N ? 1.0 : 0.5;
        const double wrong_Nm = k % 50 == 7 ? 50.0 : 0.0,
                     late_Nm = size * wave(x->time_s - delay_s) + noise_Nm;
        dataset.regression.noise[k < N ? 0 : 1] = hci_noise_white(NOISE_NM);
        search.residual_Nm[k] = late_Nm - size * wave(x->time_s) + wrong_Nm;
        x->torque_Nm = late_Nm + wrong_Nm;
        if (k % 50 == 7)
            x->count = 0.0;
        else
            fall +=
                (search.residual_Nm[k] * search.residual_Nm[k] - noise_Nm * noise_Nm) / (NOISE_NM * NOISE_NM);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_late_torque_find(&dataset.regression, search.residual_Nm, &found, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, delay_s, found.delay_s);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * fall, fall,
                              found.gain); /* eight samples before each run stay as they are */
}

/* Of 46 delays the best one lowers χ² by little. */
static void test_no_delay_is_found_in_noise(void)
{
    TEST_ASSERT_TRUE(find(0.0, 0.1).gain < 12.0);
}

/* A residual of nothing: there is no gain, and no delay. */
static void test_nothing_left_has_no_delay(void)
{
    hci_late_torque found;
    memset(search.residual_Nm, 0, dataset.samples.count * sizeof *search.residual_Nm);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_late_torque_find(&dataset.regression, search.residual_Nm, &found, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.gain);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.delay_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_delay_is_found);
    RUN_TEST(test_bins_make_no_smaller_steps);
    RUN_TEST(test_all_runs_count_and_holes_do_not);
    RUN_TEST(test_no_delay_is_found_in_noise);
    RUN_TEST(test_nothing_left_has_no_delay);
    return UNITY_END();
}
