/* Whether all loads have an i_q of one sign, or both directions like loads, and whether recordings have an
 * angle at all. */
#include "host/diagnose/candidates/make_candidates.c"

#include "unity.h"

enum { RUNS = 3 };

static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_binned_samples samples;

void setUp(void)
{
    samples = (hci_binned_samples){.run_count = RUNS, .statistics = statistics};
}

void tearDown(void)
{
}

static void set(const double iq_A[RUNS])
{
    for (size_t r = 0; r < RUNS; ++r) {
        use[r] = true;
        statistics[r] = (hci_run_statistics){.mean_iq_A = iq_A[r], .current_A = fabs(iq_A[r])};
    }
}

/* The largest current is that of the recordings in use, wherever it is. */
static void test_the_largest_current(void)
{
    for (size_t largest = 0; largest < RUNS; ++largest) {
        double iq_A[RUNS] = {1.0, 1.0, 1.0};
        iq_A[largest] = -7.0;
        set(iq_A);
        TEST_ASSERT_EQUAL_DOUBLE(7.0, largest_current_A(&samples, use));
        use[largest] = false;
        TEST_ASSERT_EQUAL_DOUBLE(1.0, largest_current_A(&samples, use));
    }
}

/* One of the other sign, wherever it is, if it is in use and no next to nothing beside the largest. */
static void test_loads_of_one_sign(void)
{
    for (int sign = -1; sign <= 1; sign += 2)
        for (size_t other = 0; other < RUNS; ++other) {
            double iq_A[RUNS] = {sign * 5.0, sign * 6.0, sign * 7.0};
            set(iq_A);
            TEST_ASSERT_TRUE(are_one_sided(&samples, use));
            iq_A[other] = sign * -5.0;
            set(iq_A);
            TEST_ASSERT_FALSE(are_one_sided(&samples, use));
            use[other] = false;
            TEST_ASSERT_TRUE(are_one_sided(&samples, use));
            iq_A[other] = sign * -1e-3;
            set(iq_A);
            TEST_ASSERT_TRUE(are_one_sided(&samples, use));
        }
}

/* Both directions at the same current, or two currents in each: at one current here and another there what
 * the direction turns is not told from what is curved over the current. */
static void test_loads_of_both_directions(void)
{
    static const struct {
        double current_A[4], speed_rad_per_s[4];
        bool both;
    } c[] = {{{5.0, 10.0, 8.0, 0.0}, {6.0, 6.0, -6.0, -6.0}, false},
             {{5.0, 10.0, 9.0, 0.0}, {6.0, 6.0, -6.0, -6.0}, true},
             {{5.0, 10.0, 9.0, 0.0}, {6.0, 6.0, 6.0, -6.0}, false},
             {{5.0, 7.0, 10.0, 10.0}, {6.0, 6.0, 6.0, -6.0}, true},
             {{5.0, 10.0, 8.0, 7.0}, {6.0, 6.0, -6.0, -6.0}, false}, /* 8 and 7 are alike */
             {{5.0, 10.0, 8.0, 6.5}, {6.0, 6.0, -6.0, -6.0}, true},
             {{5.0, 5.5, 8.0, 6.5}, {6.0, 6.0, -6.0, -6.0}, false},
             {{10.0, 0.9, 0.9, 0.0}, {6.0, 6.0, -6.0, -6.0}, false}}; /* next to none */
    hci_run_statistics of[4];
    hci_binned_samples four = {.run_count = 4, .statistics = of};
    bool used[4] = {true, true, true, true};
    for (size_t k = 0; k < sizeof c / sizeof *c; ++k) {
        for (size_t r = 0; r < 4; ++r)
            of[r] = (hci_run_statistics){.current_A = c[k].current_A[r],
                                         .mean_speed_rad_per_s = c[k].speed_rad_per_s[r]};
        TEST_ASSERT_EQUAL(c[k].both, are_loaded_both_ways(&four, used));
    }
    of[0].both_ways = true;
    TEST_ASSERT_TRUE(are_loaded_both_ways(&four, used));
    of[1].current_A = of[2].current_A = 0.0;
    used[0] = false;
    TEST_ASSERT_FALSE(are_loaded_both_ways(&four, used));
}

/* Means over a turn alone have none; one recording in use with an angle is enough. */
static void test_recordings_without_an_angle(void)
{
    for (size_t with = 0; with < RUNS; ++with) {
        hci_run runs[RUNS] = {{.only_mean = true}, {.only_mean = true}, {.only_mean = true}};
        bool used[RUNS] = {true, true, true};
        TEST_ASSERT_TRUE(hci_candidates_lack_angle(runs, used, RUNS));
        runs[with].only_mean = false;
        TEST_ASSERT_FALSE(hci_candidates_lack_angle(runs, used, RUNS));
        used[with] = false;
        TEST_ASSERT_TRUE(hci_candidates_lack_angle(runs, used, RUNS));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_current);
    RUN_TEST(test_loads_of_one_sign);
    RUN_TEST(test_loads_of_both_directions);
    RUN_TEST(test_recordings_without_an_angle);
    return UNITY_END();
}
