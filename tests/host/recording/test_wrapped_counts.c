/* The counts of a turn of an encoder: whether they begin anew within a recording, and how many a speed
 * tells. */
#include "host/recording/run_columns.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* A step back over more than half of all of them, which are more than a turn in degrees. */
static void test_what_begins_anew(void)
{
    const double turn[] = {0.0, 200.0, 400.0, 600.0, 800.0, 1000.0, 100.0, 300.0};
    TEST_ASSERT_TRUE(is_wrapped_over(turn, 8, 360.0));
    TEST_ASSERT_FALSE(is_wrapped_over(turn, 8, 1000.0)); /* no more than a turn */
    TEST_ASSERT_FALSE(is_wrapped_over(turn, 6, 360.0));  /* it goes on */
}

/* Three samples of an even climb step over half of it, and do not begin anew. */
static void test_an_even_climb(void)
{
    const double up[] = {0.0, 500.0, 1000.0}, down[] = {4000.0, 2000.0, 0.0};
    TEST_ASSERT_FALSE(is_wrapped_over(up, 3, 360.0));
    TEST_ASSERT_FALSE(is_wrapped_over(down, 3, 360.0));
}

/* The nearest power of two or round decimal number, within a twentieth of it. */
static void test_counts_that_encoders_have(void)
{
    static const struct {
        double found, usual;
    } CASES[] = {{4096.0, 4096.0},   {4178.0, 4096.0},  {4000.0, 4000.0},   {4060.0, 4096.0},
                 {4040.0, 4000.0},   {4300.0, 4500.0},  {2400.0, 2500.0},   {1000.0, 1000.0},
                 {1015.0, 1024.0},   {2860.0, 3000.0},  {2840.0, 0.0},      {3140.0, 3000.0},
                 {3160.0, 0.0},      {9800.0, 10000.0}, {16384.0, 16384.0}, {16000.0, 16384.0},
                 {15200.0, 15000.0}, {360.0, 350.0},    {62.5, 64.0},       {61.9, 60.0},
                 {1.2e6, 0.0},       {1.48e6, 1.5e6}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k)
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(CASES[k].usual, hci_usual_counts(CASES[k].found), "counts of a turn");
}

enum { MOST = 1001 };

static double theta_m[MOST], counted[MOST];

/* The angle over three turns, and counts of it that begin anew after so many turns (0: never). */
static double counts_told(size_t n, double of_turn, double anew)
{
    for (size_t k = 0; k < n; ++k) {
        theta_m[k] = 6.0 * HCI_PI * (double)k / (double)(n - 1);
        const double turns = theta_m[k] / (2.0 * HCI_PI);
        counted[k] = of_turn * (anew > 0.0 ? turns - anew * floor(turns / anew) : turns);
    }
    return counts_of_turn(counted, theta_m, n);
}

/* From 101 samples on, of either direction, whether or not they begin anew with the turn. */
static void test_counts_by_a_speed(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(4096.0, counts_told(MOST, 4096.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(4096.0, counts_told(MOST, -4096.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(4096.0, counts_told(MOST, 4096.0, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, counts_told(102, 2010.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, counts_told(101, 2010.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, counts_told(100, 2010.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, counts_told(MOST, 1.0, 0.0)); /* turns, not counts */
    TEST_ASSERT_EQUAL_DOUBLE(2.0, counts_told(MOST, 2.0, 0.0));
    /* what begins anew after one and a half turns counts another shaft */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, counts_told(MOST, 4096.0, 1.5));
}

/* A shaft that stands in some parts is told by the others; one that stands in all by none. */
static void test_counts_of_a_shaft_that_stands(void)
{
    for (size_t k = 0; k < MOST; ++k) {
        theta_m[k] = k < 700 ? 0.01 * (double)k : 7.0;
        counted[k] = 500.0 * theta_m[k] / (2.0 * HCI_PI);
    }
    TEST_ASSERT_EQUAL_DOUBLE(500.0, counts_of_turn(counted, theta_m, MOST));
    memset(theta_m, 0, sizeof theta_m);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, counts_of_turn(counted, theta_m, MOST));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_begins_anew);
    RUN_TEST(test_an_even_climb);
    RUN_TEST(test_counts_that_encoders_have);
    RUN_TEST(test_counts_by_a_speed);
    RUN_TEST(test_counts_of_a_shaft_that_stands);
    return UNITY_END();
}
