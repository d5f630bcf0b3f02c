/* What tells noise from what is none: its sums by hand, and each bound from both sides. */
#include "host/diagnose/search/noise_left.c"

#include "support/one_segment.h"
#include "unity.h"

static uint64_t seed;
static double whitened[N];

void setUp(void)
{
    seed = 3;
    for (size_t k = 0; k < N; ++k)
        whitened[k] = ref_normal(&seed);
    one_segment_start(&seed);
}

void tearDown(void)
{
}

/* ---- sums ---- */

/* Whole blocks behind what the noise remembers, two segments one after the other. */
static void test_sums_over_blocks(void)
{
    goodness g = {0};
    double sum = 0.0, square = 0.0;
    const size_t blocks = (N - HCI_NOISE_MEMORY) / 24;
    blocks_add(whitened, N, &g);
    blocks_add(whitened, HCI_NOISE_MEMORY + 24, &g);
    blocks_add(whitened, HCI_NOISE_MEMORY + 23, &g); /* none */
    for (size_t b = 0; b <= blocks; ++b) {
        double of_block = 0.0;
        for (size_t k = 0; k < 24; ++k)
            of_block += pow(whitened[HCI_NOISE_MEMORY + 24 * (b % blocks) + k], 2.0);
        sum += of_block;
        square += of_block * of_block;
    }
    TEST_ASSERT_EQUAL_DOUBLE((double)(blocks + 1), g.blocks);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum, g.block);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, square, g.block_square);
}

/* Two sizes of blocks, m ± d: their variance is d², and that of noise of the mean m is 2 m²/24. */
static void test_how_uneven_blocks_are(void)
{
    goodness g = {.blocks = 50.0, .block = 50.0 * 24.0, .block_square = 50.0 * (24.0 * 24.0 + 36.0)};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 36.0 / (2.0 * 24.0), clumps_of(&g));
    g.blocks = 49.0;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, clumps_of(&g));
}

/* Errors of half the size that was taken for their noise are as even as those of its size; larger ones stay. */
static void test_less_than_the_noise(void)
{
    const hci_segment x = {.count = N};
    double square = 0.0;
    for (size_t k = 0; k < N; ++k) {
        whitened[k] *= 0.5;
        square += whitened[k] * whitened[k] / N;
    }
    const double first = whitened[0];
    noise_even(&x, whitened);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, first / sqrt(square), whitened[0]);
    whitened[0] = 2.0 * N;
    noise_even(&x, whitened);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 * N, whitened[0]);
    memset(whitened, 0, sizeof whitened);
    noise_even(&x, whitened);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, whitened[1]);
}

static void spikes(size_t count, double size)
{
    setUp();
    for (size_t k = 0; k < count; ++k)
        whitened[100 * k + 5] = k % 2 ? -size : size;
}

/* One in two thousand and one more: of 400 one. */
static void test_single_samples_are_left_out(void)
{
    spikes(1, 6.1);
    outliers_drop(whitened, residual, N, OUTLYING);
    TEST_ASSERT_TRUE(whitened[5] == 0.0 && residual[5] == 0.0 && whitened[6] != 0.0);
    spikes(1, 5.9);
    outliers_drop(whitened, residual, N, OUTLYING);
    TEST_ASSERT_TRUE(whitened[5] == 5.9 && residual[5] != 0.0);
    spikes(2, 9.0);
    outliers_drop(whitened, residual, N, OUTLYING);
    TEST_ASSERT_TRUE(whitened[5] == 9.0 && whitened[105] == -9.0);
    static double many[2][2000];
    for (int count = 2; count <= 3; ++count) {
        memset(many, 0, sizeof many);
        for (int k = 0; k < count; ++k)
            many[0][300 * k] = 20.0;
        outliers_drop(many[0], many[1], 2000, OUTLYING);
        TEST_ASSERT_EQUAL(count == 3, many[0][0] == 20.0);
    }
}

/* Rates are differences over two samples of what the model makes: torque less residual. */
static void test_how_a_residual_follows_a_rate(void)
{
    goodness g = {0};
    double left = 0.0, follows = 0.0, rate = 0.0, time_s = 0.0;
    for (size_t k = 0; k < N; ++k) {
        sample[k].time_s = 0.01 * (double)k + 0.003 * sin((double)k);
        sample[k].torque_Nm = residual[k] + sin(0.1 * (double)k);
    }
    following_add(&search, &segment, residual, &g);
    for (size_t k = 1; k + 1 < N; ++k) {
        const double s = sample[k + 1].time_s - sample[k - 1].time_s;
        const double r = (sin(0.1 * (double)(k + 1)) - sin(0.1 * (double)(k - 1))) / s;
        left += residual[k] * residual[k], follows += residual[k] * r, rate += r * r, time_s += s / 2.0;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, left, g.left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, follows, g.follows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, rate, g.rate);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, time_s, g.time_s);
    TEST_ASSERT_EQUAL_DOUBLE(N - 2.0, g.steps);
}

/* A tenth of the residual, and a delay of more than a sample: 0.01 s here. */
static void test_a_residual_that_is_late(void)
{
    const double steps = 100.0, rate = 4.0;
    for (int sign = -1; sign <= 1; sign += 2) {
        goodness g = {
            .follows = sign * rate * 0.0102, .rate = rate, .left = 1e-5, .steps = steps, .time_s = 1.0};
        TEST_ASSERT_TRUE(is_late(&g));
        g.follows = sign * rate * 0.0098;
        TEST_ASSERT_FALSE(is_late(&g));
        g.follows = sign * rate * 0.02;
        g.left = g.follows * g.follows / rate / 0.102;
        TEST_ASSERT_TRUE(is_late(&g));
        g.left = g.follows * g.follows / rate / 0.098;
        TEST_ASSERT_FALSE(is_late(&g));
    }
}

/* In a mean over turns a sample of n readings counts as if all had as many, their harmonic mean; one that
 * tells nothing is none, and samples as they are stay. */
static void test_counts_that_differ(void)
{
    double before[N];
    for (size_t k = 0; k < N; ++k)
        sample[k].count = (double)(k % 3);
    memcpy(before, whitened, sizeof before);
    counts_even(&search, &segment, whitened);
    TEST_ASSERT_EQUAL_MEMORY(before, whitened, sizeof before);
    segment.turns = 7;
    counts_even(&search, &segment, whitened);
    double ones = 0.0, twos = 0.0;
    for (size_t k = 0; k < N; ++k)
        ones += k % 3 == 1, twos += k % 3 == 2;
    const double mean = (ones + twos) / (ones + 0.5 * twos);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, before[k] * sqrt((double)(k % 3) / mean), whitened[k]);
}

/* Of a few samples the square of the noise is that of neighbours, and no less than the resolution. */
static void test_few_samples_by_hand(void)
{
    goodness g = {0};
    segment.count = 30;
    search.resolution_Nm = 0.7;
    few_add(&search, &segment, &g);
    double square = 0.0;
    for (size_t k = 0; k < 30; ++k)
        square += residual[k] * residual[k];
    const double own = hci_noise_of_neighbours(residual, 30);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, square, g.few_square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 30.0 * (own * own + 0.49), g.few_noise);
    TEST_ASSERT_EQUAL_DOUBLE(30.0, g.few_rows);
    segment.turns = 2;
    few_add(&search, &segment, &g);
    TEST_ASSERT_EQUAL_DOUBLE(30.0, g.few_rows);
}

/* ---- bounds ---- */

static goodness even(double square, double clumps, double blocks)
{
    return (goodness){.square = square,
                      .noise = 1.0,
                      .rows = 100.0,
                      .blocks = blocks,
                      .block = blocks,
                      .block_square = blocks * (1.0 + clumps / 12.0)};
}

static bool is_long(double square, double clumps, double blocks)
{
    const goodness g = even(square, clumps, blocks);
    return is_long_noise(&g);
}

/* A tenth more variance; 1.35 of many blocks, and of 100 four deviations of √(2.5/100). */
static void test_bounds_of_noise(void)
{
    TEST_ASSERT_TRUE(is_long(1.09, 1.0, 1e4));
    TEST_ASSERT_FALSE(is_long(1.11, 1.0, 1e4));
    TEST_ASSERT_TRUE(is_long(1.0, 1.34, 1e4));
    TEST_ASSERT_FALSE(is_long(1.0, 1.36, 1e4));
    TEST_ASSERT_TRUE(is_long(1.0, 0.99 + 4.0 * sqrt(0.025), 100.0));
    TEST_ASSERT_FALSE(is_long(1.0, 1.01 + 4.0 * sqrt(0.025), 100.0));
    goodness g = even(1.0, 1.0, 1e4);
    g.follows = g.rate = g.steps = 1.0;
    TEST_ASSERT_FALSE(is_long_noise(&g));
    g.rows = 0.0; /* nothing tells */
    TEST_ASSERT_TRUE(is_long_noise(&g));
}

/* Four deviations of √(3/n). */
static void test_bounds_of_few_samples(void)
{
    goodness g = {.few_rows = 300.0, .few_noise = 2.0, .few_square = 2.0 * 1.39};
    TEST_ASSERT_TRUE(is_few_noise(&g) && is_noise(&g));
    g.few_square = 2.0 * 1.41;
    TEST_ASSERT_FALSE(is_few_noise(&g) || is_noise(&g));
    g.few_rows = 0.0;
    TEST_ASSERT_TRUE(is_few_noise(&g));
}

/* Errors of a slope are not of one size along a run. */
static void test_which_noise_is_even(void)
{
    TEST_ASSERT_TRUE(has_even_noise(&search, &segment));
    run.torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(has_even_noise(&search, &segment));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sums_over_blocks);
    RUN_TEST(test_how_uneven_blocks_are);
    RUN_TEST(test_less_than_the_noise);
    RUN_TEST(test_single_samples_are_left_out);
    RUN_TEST(test_how_a_residual_follows_a_rate);
    RUN_TEST(test_a_residual_that_is_late);
    RUN_TEST(test_counts_that_differ);
    RUN_TEST(test_few_samples_by_hand);
    RUN_TEST(test_bounds_of_noise);
    RUN_TEST(test_bounds_of_few_samples);
    RUN_TEST(test_which_noise_is_even);
    return UNITY_END();
}
