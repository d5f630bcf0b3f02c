/* The steps by which points are chosen where laws of growth differ, by hand. */
#include "host/diagnose/next/unknown_points.c"

#include "unity.h"

enum { POINTS = 3, LENGTH = 2 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* One that is further by more than rounding; of two that are as far the first. */
static void test_the_largest(void)
{
    double departure[POINTS * LENGTH] = {0.6, 0.8, 1.0, 0.0, 0.0, -0.99}, square;
    const spread s = {departure, 1, LENGTH};
    TEST_ASSERT_EQUAL_UINT(0, largest(&s, POINTS, &square));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, square);
    departure[2] = 1.05;
    TEST_ASSERT_EQUAL_UINT(1, largest(&s, POINTS, &square));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.1025, square);
    departure[5] = -1.06;
    TEST_ASSERT_EQUAL_UINT(2, largest(&s, POINTS, &square));
    TEST_ASSERT_EQUAL_UINT(1, largest(&s, 2, &square));
    departure[2] = 1.0 + 1e-12;
    TEST_ASSERT_EQUAL_UINT(0, largest(&s, 2, &square));
    for (int k = 0; k < POINTS * LENGTH; ++k)
        departure[k] = 0.0;
    TEST_ASSERT_EQUAL_UINT(0, largest(&s, POINTS, &square));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, square);
}

/* Of y = (1, 2) a known x = (3, 1) takes x·y/(x·x + 1) = 5/11 of x. */
static void test_what_is_known_is_taken(void)
{
    double departure[POINTS * LENGTH] = {1.0, 2.0, 3.0, 1.0, -1.0, 3.0};
    spread s = {departure, 1, LENGTH};
    known_take(&s, POINTS, 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 - 15.0 / 11.0, departure[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 - 5.0 / 11.0, departure[1]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, departure[2]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, departure[3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, departure[4]); /* across x */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, departure[5]);
}

/* Two runs of weights 4 and 1 and a law that is 1 for both: the weighted mean, and what is beside it. */
static void test_a_law_that_does_not_grow(void)
{
    const amplitude a[2] = {{0.1, 0.3, 4.0, 2.0, 10.0}, {0.6, -0.2, 1.0, 4.0, 40.0}};
    size_t g = 0;
    double sine_Nm, cosine_Nm;
    while (hci_growth_law_of(g).current != 0.0 || hci_growth_law_of(g).speed != 0.0 ||
           hci_growth_law_of(g).turns_sign)
        ++g;
    const double square = law_fit(a, 2, g, &sine_Nm, &cosine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, sine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, cosine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 * (0.01 + 0.01) + (0.16 + 0.16), square);
    const amplitude none[1] = {{0.1, 0.3, 0.0, 2.0, 10.0}};
    TEST_ASSERT_EQUAL_DOUBLE(0.0, law_fit(none, 1, g, &sine_Nm, &cosine_Nm));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, sine_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, cosine_Nm);
}

/* Beliefs sum to 1; of one run all laws fit, and are believed alike. */
static void test_what_is_believed(void)
{
    const amplitude a[3] = {
        {0.1, 0.0, 1e4, 1.0, 10.0}, {0.2, 0.0, 1e4, 2.0, 10.0}, {0.4, 0.0, 1e4, 4.0, 20.0}};
    growth laws;
    double sum = 0.0;
    laws_weigh(a, 1, &laws);
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / HCI_GROWTH_LAWS, laws.belief[g]);
    laws_weigh(a, 3, &laws);
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        const hci_growth_law law = hci_growth_law_of(g);
        sum += laws.belief[g];
        if (law.current == 1.0 && law.speed == 0.0 && !law.turns_sign)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1, laws.sine_Nm[g]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, sum);
}

/* In units of the largest current and of the logarithm of the range of speeds. */
static void test_places(void)
{
    const hci_playable p = {.most_A = 4.0, .least_rad_per_s = 1.0, .most_rad_per_s = 100.0};
    const place at = place_of(&p, -2.0, 3.0, -10.0, -1.0), slow = place_of(&p, 0.0, 0.0, 0.01, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(-0.5, at.x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, at.x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, at.x[2]);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, at.x[3]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, slow.x[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(0.25 + 0.5625 + 0.25 + 4.0), distance(&at, &slow));
    const hci_playable one = {.most_A = 0.0, .least_rad_per_s = 5.0, .most_rad_per_s = 5.0};
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, place_of(&one, -2.0, 3.0, 50.0, 1.0).x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, place_of(&one, -2.0, 3.0, 50.0, 1.0).x[2]);
    const hci_playable small = {.most_A = 0.1, .least_rad_per_s = 0.1, .most_rad_per_s = 0.12};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, place_of(&small, 0.05, 0.0, 0.12, 1.0).x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, place_of(&small, 0.05, 0.0, 0.12, 1.0).x[2]);
}

/* One that stands is neither forward nor backward: as far from both. */
static void test_ways(void)
{
    const hci_playable p = {.most_A = 4.0, .least_rad_per_s = 1.0, .most_rad_per_s = 100.0};
    static const double SPEED[] = {-0.1, 0.0, 0.1};
    for (int k = 0; k < 3; ++k) {
        const hci_operating_point x = {.iq_A = 1.0, .speed_rad_per_s = SPEED[k]};
        TEST_ASSERT_EQUAL_DOUBLE(k - 1.0, place_at(&p, &x).x[3]);
    }
}

static void test_which_runs_tell_an_angle(void)
{
    for (int bits = 0; bits < 4; ++bits) {
        const hci_run run = {.only_mean = bits & 1, .zero_is_unknown = bits & 2};
        TEST_ASSERT_EQUAL(bits == 0, has_angle(&run));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest);
    RUN_TEST(test_what_is_known_is_taken);
    RUN_TEST(test_a_law_that_does_not_grow);
    RUN_TEST(test_what_is_believed);
    RUN_TEST(test_places);
    RUN_TEST(test_ways);
    RUN_TEST(test_which_runs_tell_an_angle);
    return UNITY_END();
}
