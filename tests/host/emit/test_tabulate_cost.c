/* How often a table of many waves asks for their sum, and for the amplitude of one: most of its time. What it
 * can be told by samples of the waves it does not add up. */
#include "hci/math/harmonic.h"

static size_t sums, amplitudes;

static void counted_waves_at(const hci_wave *waves, size_t count, double theta_rad, double abc[3])
{
    sums += count > 0;
    hci_waves_at(waves, count, theta_rad, abc);
}

static double counted_amplitude(double sine, double cosine)
{
    ++amplitudes;
    return hci_amplitude(sine, cosine);
}

#define hci_waves_at  counted_waves_at
#define hci_amplitude counted_amplitude
#include "host/emit/tabulate.c"

#include "unity.h"

enum { WAVES = 64, MOST = 2048 };

static hci_wave waves[WAVES];
static hci_tabulation t;
static float rows[(MOST + 1) * 3];
static hci_table_f32 table;

/* Orders 1 … 64 whose amplitudes fall as one over the order. */
void setUp(void)
{
    for (size_t k = 0; k < WAVES; ++k)
        waves[k] = (hci_wave){(double)(k + 1), 1, 1.0 / (double)(k + 1), 0.0};
    t = (hci_tabulation){
        .constant = waves, .constant_count = WAVES, .columns = 3, .parts = 1, .period_turns = 1};
    TEST_ASSERT_TRUE(hci_wave_samples_make(waves, WAVES, 1, &t.constant_samples));
    TEST_ASSERT_TRUE(t.constant_samples.count > 0);
    sums = amplitudes = 0;
}

void tearDown(void)
{
    hci_wave_samples_release(&t.constant_samples);
}

/* Each row once, and the guard. */
static void test_each_row_is_added_up_once(void)
{
    hci_tabulate(&t, 300, rows, &table);
    TEST_ASSERT_EQUAL(301, sums);
}

static void test_nothing_is_added_up_for_a_refusal(void)
{
    TEST_ASSERT_FALSE(hci_tabulate_within(&t, 1e-4, 200, rows, &table));
    TEST_ASSERT_EQUAL(0, sums);
    TEST_ASSERT_EQUAL(2 * WAVES, amplitudes); /* for the bend and the bound */
    hci_tabulate_roughly(&t, 200, rows, &table);
    TEST_ASSERT_EQUAL(0, sums);
}

/* The rough error is that of the table, and the fewest points are those of the tables themselves. */
static void test_both_say_the_same(void)
{
    const double error_A = 0.02;
    size_t points = 1;
    while (hci_tabulate(&t, points, rows, &table), (double)table.max_error_A > error_A)
        ++points;
    const hci_table_f32 exact = table;
    hci_tabulate_roughly(&t, points, rows, &table);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, exact.max_error_A, table.max_error_A);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, exact.peak_A, table.peak_A);
    sums = 0;
    TEST_ASSERT_TRUE(hci_tabulate_within(&t, error_A, MOST, rows, &table));
    TEST_ASSERT_EQUAL(points, table.points);
    TEST_ASSERT_TRUE(exact.max_error_A == table.max_error_A);
    TEST_ASSERT_EQUAL(points + 2, sums); /* the row that it begins at is the last one too */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_row_is_added_up_once);
    RUN_TEST(test_nothing_is_added_up_for_a_refusal);
    RUN_TEST(test_both_say_the_same);
    return UNITY_END();
}
