/* The next torque that the search for the largest with little ripple tries: on lines through what is known,
 * by halves where these do not come on, and always inside the bracket. */
#include "host/sweep/envelope.c"

#include "unity.h"

static search s;

void setUp(void)
{
    s = (search){.allowed_percent = 2.0, .bad_Nm = 10.0, .bad_percent = 5.0, .worse_percent = (double)NAN};
}

void tearDown(void)
{
}

static void test_the_first_cut(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, next_Nm(&s, false));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, next_Nm(&s, true));
}

/* Ripple of 1.995 is looked for: on the line from (4 N·m, 1 %) to (10 N·m, 5 %). */
static void test_between_a_good_and_a_bad_one(void)
{
    s.good_Nm = 4.0, s.good_percent = 1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 + 0.995 * 6.0 / 4.0, next_Nm(&s, false));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, next_Nm(&s, true));
    s.worse_Nm = 12.0, s.worse_percent = 9.0; /* one that is farther away is not asked then */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 + 0.995 * 6.0 / 4.0, next_Nm(&s, false));
}

/* One with next to no ripple, below a twentieth of what is allowed, tells no slope: the two bad ones do. */
static void test_on_the_line_of_two_bad_ones(void)
{
    s.good_Nm = 4.0;
    s.worse_Nm = 12.0, s.worse_percent = 9.0;
    for (int more = 0; more < 2; ++more) {
        s.good_percent = more ? 0.101 : 0.099;
        const double good = 4.0 + (1.995 - 0.101) * 6.0 / (5.0 - 0.101), bad = 10.0 - 3.005 * 2.0 / 4.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, more ? good : bad, next_Nm(&s, false));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, next_Nm(&s, true));
    }
    s.good_percent = 0.0;
    s.worse_percent = 5.0; /* no slope */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, next_Nm(&s, false));
    s.worse_percent = 4.0; /* the wrong one */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, next_Nm(&s, false));
    s.good_Nm = 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, next_Nm(&s, false));
}

/* At least a twenty-fifth of the bracket from both ends. */
static void test_inside_the_bracket(void)
{
    s.good_Nm = 4.0, s.good_percent = 1.99;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.24, next_Nm(&s, false));
    s.good_percent = 0.0, s.worse_Nm = 10.1, s.worse_percent = 50.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.76, next_Nm(&s, false));
    s.good_percent = 5.0; /* as much as the bad one: no line */
    TEST_ASSERT_TRUE(isfinite(next_Nm(&s, false)) && next_Nm(&s, false) >= 4.24 &&
                     next_Nm(&s, false) <= 9.76);
}

/* The least of peak, effective value and copper of a sine; the loosest phase counts. */
static void test_a_sine_within_the_limits(void)
{
    hci_bounds b;
    memset(&b, 0, sizeof b);
    for (int k = 0; k < 3; ++k)
        b.current_A[k] = b.rms_A[k] = HUGE_VAL;
    b.mean_square_A2 = HUGE_VAL;
    TEST_ASSERT_TRUE(isinf(amplitude_within(&b)));
    for (int k = 0; k < 3; ++k)
        b.current_A[k] = 7.0 + k;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, amplitude_within(&b));
    b.rms_A[2] = 5.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8.0, amplitude_within(&b));
    b.rms_A[1] = 3.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 * sqrt(2.0), amplitude_within(&b));
    b.mean_square_A2 = 37.5; /* of three phases of 5 A */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, amplitude_within(&b));
}

/* Where no set is given all may be used. */
static void test_whether_the_sine_may_be_used(void)
{
    static hci_component component[] = {{5.0, -1}, {1.0, 1}, {1.0, -1}, {1.0, 0}};
    hci_component_set set = {.component = component, .count = 2};
    const hci_solve_options all = {0}, of_set = {.set = &set};
    TEST_ASSERT_TRUE(has_sine(&all));
    TEST_ASSERT_TRUE(has_sine(&of_set));
    component[1].order = 7.0;
    set.count = 4;
    TEST_ASSERT_FALSE(has_sine(&of_set));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_cut);
    RUN_TEST(test_between_a_good_and_a_bad_one);
    RUN_TEST(test_on_the_line_of_two_bad_ones);
    RUN_TEST(test_inside_the_bracket);
    RUN_TEST(test_a_sine_within_the_limits);
    RUN_TEST(test_whether_the_sine_may_be_used);
    return UNITY_END();
}
