/* Means over bins of a turn and what is left beside the lines through them, by hand. */
#include "host/diagnose/prepare/repeats.c"

#include "support/recording.h"
#include "unity.h"

enum { P = 2, ROWS = 12, BINS = 4 };

static hci_run run;
static hci_run_statistics statistics;
static hci_repeats_question question;
static departures x;

/* Three turns of four samples in the bins 0, 1 and 3 (bin 2 is empty), shifted by a little in each turn. */
static const double WITHIN[ROWS] = {0.2, 1.7, 1.9, 5.0, 0.4, 1.8, 2.0, 5.4, 0.6, 1.9, 2.1, 5.8};

void setUp(void)
{
    statistics = (hci_run_statistics){.current_A = 5.0, .rms_torque_Nm = 2.0};
    run = rec_make(ROWS);
    for (size_t k = 0; k < ROWS; ++k) {
        run.time_s[k] = (double)k;
        run.theta_m_rad[k] = 2.0 * HCI_PI * (double)(k / 4) + WITHIN[k];
        rec_phases(0.5 * (double)k, 3.0 + (double)k, P * run.theta_m_rad[k], run.i_A + 3 * k);
        run.torque_Nm[k] = 1.0 + 2.0 * (double)k;
    }
    question = (hci_repeats_question){&run, &statistics, P, 0, ROWS, BINS};
    TEST_ASSERT_TRUE(departures_make(&question, &x));
    bins_fill(&x);
}

void tearDown(void)
{
    hci_memory_free(x.theta_rad);
    hci_memory_free(x.bin);
    rec_release(&run);
}

static void test_bins_and_their_angles(void)
{
    static const size_t BIN[4] = {0, 1, 1, 2};
    TEST_ASSERT_EQUAL_UINT64(3, x.mean.bins);
    for (size_t k = 0; k < ROWS; ++k) {
        TEST_ASSERT_EQUAL_UINT64(BIN[k % 4], x.bin[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, WITHIN[k], x.theta_rad[k]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(3.0, x.mean.count[0]);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, x.mean.count[1]);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, x.mean.count[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.4, x.mean.theta_rad[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.9, x.mean.theta_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.4, x.mean.theta_rad[2]);
}

/* Each channel by itself, whatever was in the bins before: rows 0, 4, 8; 1, 2, 5, 6, 9, 10; and 3, 7, 11. */
static void test_means_of_each_channel(void)
{
    static const double MEAN[3] = {4.0, 5.5, 7.0}; /* of the numbers of the rows */
    for (int again = 0; again < 2; ++again)
        for (int channel = 0; channel < 3; ++channel) {
            values_fill(&x, channel);
            for (size_t b = 0; b < 3; ++b) {
                const double of_row = channel == 0   ? 1.0 + 2.0 * MEAN[b]
                                      : channel == 1 ? 0.5 * MEAN[b]
                                                     : 3.0 + MEAN[b];
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, of_row, x.mean.value[b]);
            }
        }
}

/* On lines from mean to mean, the last one around the turn. */
static void test_lines_between_means(void)
{
    values_fill(&x, 0); /* 9, 12, 15 at 0.4, 1.9, 5.4 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10.0, between(&x, 0, 0.9));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 12.6, between(&x, 1, 2.6));
    const double round = 0.4 + 2.0 * HCI_PI - 5.4;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 15.0 - 6.0 * 0.4 / round, between(&x, 2, 5.8));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 15.0 - 6.0 * (0.2 + 2.0 * HCI_PI - 5.4) / round, between(&x, 2, 0.2));
    means_leave(&x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 - (15.0 - 6.0 * (0.2 + 2.0 * HCI_PI - 5.4) / round), x.value[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0 - 9.0, x.value[4]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 - (9.0 + 2.0 * 1.3), x.value[1]); /* at 1.7, behind 1.9 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 23.0 - (15.0 - 6.0 * 0.4 / round), x.value[11]);
}

/* Of samples that are 12 in 3 turns: less than a ten-thousandth of torque or current, rms, is nothing. */
static void test_what_is_next_to_nothing(void)
{
    for (int more = 0; more < 2; ++more) {
        for (size_t k = 0; k < ROWS; ++k)
            x.value[k] = (k % 2 ? 2e-4 : -2e-4) * (more ? 1.01 : 0.99);
        TEST_ASSERT_EQUAL(!more, is_nothing(&x, 0));
        TEST_ASSERT_TRUE(is_nothing(&x, 1));
        for (size_t k = 0; k < ROWS; ++k)
            x.value[k] = (k % 2 ? 5e-4 : -5e-4) * (more ? 1.01 : 0.99);
        TEST_ASSERT_EQUAL(!more, is_nothing(&x, 2));
    }
}

/* Neighbours with a quarter of their square in common, of either sign, go on. */
static void test_neighbours(void)
{
    for (int sign = -1; sign <= 1; sign += 2)
        for (int more = 0; more < 2; ++more) {
            for (size_t k = 0; k < ROWS; ++k)
                x.value[k] = 0.0;
            x.value[3] = 1.0;
            x.value[4] = sign * (more ? 0.269 : 0.266); /* a/(1 + a²) = 1/4 at a = 2 − √3 */
            TEST_ASSERT_EQUAL(more, goes_on(&x));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bins_and_their_angles);
    RUN_TEST(test_means_of_each_channel);
    RUN_TEST(test_lines_between_means);
    RUN_TEST(test_what_is_next_to_nothing);
    RUN_TEST(test_neighbours);
    return UNITY_END();
}
