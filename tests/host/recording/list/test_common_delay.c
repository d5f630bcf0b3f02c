/* The delay that waves at several speeds have in common, from waves that were turned by hand. */
#include "host/recording/list/common_delay.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "unity.h"

static const double complex j = I; /* I is of type float */

enum { RECORDS = 4 };

static hci_delay_record record[RECORDS];
static hci_common_delay found;

static const double SPEED_RAD_PER_S[RECORDS] = {3.1, 3.1, -3.1, 9.4}, LOAD[RECORDS] = {0.0, 2.0, 1.5, -3.0};

/* C cos nφ + S sin nφ is the real part of (C − jS) e^jnφ; read late by a delay it is turned by −nω of it. */
static void set(size_t r, size_t n, double complex wave, double delay_s)
{
    const double complex read = wave * cexp(-j * (double)n * record[r].speed_rad_per_s * delay_s);
    record[r].wave[n] = (hci_delay_wave){-cimag(read), creal(read)};
}

/* Cogging torque and one in proportion to the load. */
static void make(double delay_s)
{
    memset(record, 0, sizeof record);
    for (size_t r = 0; r < RECORDS; ++r) {
        record[r].speed_rad_per_s = SPEED_RAD_PER_S[r];
        record[r].load = LOAD[r];
        record[r].std_error = 1e-3;
        set(r, 10, 0.2 + 0.1 * j, delay_s);
        set(r, 12, 0.1 * j, delay_s);
        set(r, 30, 0.4 * cexp(0.7 * j) + 0.1 * LOAD[r] * cexp(2.0 * j), delay_s);
        set(r, 60, 0.8 * cexp(-1.7 * j) - 0.04 * LOAD[r] * j, delay_s);
        set(r, 99, 0.004, 3.0 * delay_s); /* does not stand out */
    }
}

void setUp(void)
{
    make(0.0503);
}

void tearDown(void)
{
}

static void test_a_delay_of_many_radians(void)
{
    for (double delay_s = -0.3; delay_s < 0.31; delay_s += 0.0501) {
        make(delay_s);
        TEST_ASSERT_TRUE(hci_common_delay_find(record, RECORDS, 0.5, &found));
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, delay_s, found.delay_s);
        TEST_ASSERT_TRUE(found.left < 1e-4 * found.before && found.other > 100.0 * found.left);
        TEST_ASSERT_EQUAL_DOUBLE(2.0 * 4 * (RECORDS - 2), found.freedom);
    }
}

/* Of the four waves, weighted by their squares. */
static void test_by_how_much_the_waves_are_turned(void)
{
    double sum = 0.0, weight = 0.0;
    static const size_t ORDER[] = {10, 12, 30, 60};
    for (size_t k = 0; k < 4; ++k)
        for (size_t r = 0; r < RECORDS; ++r) {
            const hci_delay_wave *w = &record[r].wave[ORDER[k]];
            const double square = w->sine * w->sine + w->cosine * w->cosine;
            sum += square * pow((double)ORDER[k] * 9.4 * 0.0503, 2.0);
            weight += square;
        }
    TEST_ASSERT_TRUE(hci_common_delay_find(record, RECORDS, 0.5, &found));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, sqrt(sum / weight), found.turned_rad);
}

/* χ² of one order by hand: of two recordings with one load each coordinate leaves half of its difference. */
static void test_what_is_left(void)
{
    memset(record, 0, sizeof record);
    for (size_t r = 0; r < 2; ++r)
        record[r] = (hci_delay_record){.speed_rad_per_s = r ? -2.0 : 2.0, .load = 1.0, .std_error = 0.01};
    record[0].wave[3] = (hci_delay_wave){0.3, 0.1};
    record[1].wave[3] = (hci_delay_wave){0.1, 0.2};
    TEST_ASSERT_TRUE(hci_common_delay_find(record, 2, 0.2, &found));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * (0.2 * 0.2 + 0.1 * 0.1) / 1e-4, found.before);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, found.freedom);
}

/* Waves of multiples of one order come back after some delay, and another one is as good. */
static void test_another_delay_as_good(void)
{
    for (size_t r = 0; r < RECORDS; ++r) {
        record[r].speed_rad_per_s = r % 2 ? -3.0 : 3.0;
        for (size_t n = 0; n <= HCI_DELAY_ORDERS; ++n)
            if (n != 30 && n != 60) record[r].wave[n] = (hci_delay_wave){0.0, 0.0};
        set(r, 30, 0.4, 0.02);
        set(r, 60, 0.8, 0.02);
    }
    TEST_ASSERT_TRUE(hci_common_delay_find(record, RECORDS, 0.5, &found));
    TEST_ASSERT_TRUE(found.other < 1e-2 * found.before);
}

static void test_nothing_to_compare(void)
{
    TEST_ASSERT_FALSE(hci_common_delay_find(record, 2, 0.5, &found)); /* loads that differ */
    for (size_t r = 0; r < RECORDS; ++r)
        record[r].speed_rad_per_s = 3.0 + 0.2 * (double)r;
    TEST_ASSERT_FALSE(hci_common_delay_find(record, RECORDS, 0.5, &found));
    record[3].speed_rad_per_s = 6.0;
    TEST_ASSERT_TRUE(hci_common_delay_find(record, RECORDS, 0.5, &found));
    for (size_t r = 0; r < RECORDS; ++r)
        record[r].std_error = 1.0;
    TEST_ASSERT_FALSE(hci_common_delay_find(record, RECORDS, 0.5, &found));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_delay_of_many_radians);
    RUN_TEST(test_by_how_much_the_waves_are_turned);
    RUN_TEST(test_what_is_left);
    RUN_TEST(test_another_delay_as_good);
    RUN_TEST(test_nothing_to_compare);
    return UNITY_END();
}
