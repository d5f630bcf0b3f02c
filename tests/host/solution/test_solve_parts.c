/* What of an answer flows: components of a chosen set that carry current, all of a given one, and the one
 * that is held, of motors of any size. */
#include "host/solution/solve.c"

#include "unity.h"

enum { SET = 3 };

static hci_component component[SET] = {{1.0, 1}, {5.0, -1}, {7.0, 1}};
static hci_set set_of[SET] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS};
static double x[4 * SET];
static hci_answer answer;
static hci_solution s;
static hci_target_order mean;
static hci_target target;
static hci_note note;

void setUp(void)
{
    memset(&s, 0, sizeof s);
    memset(x, 0, sizeof x);
    answer = (hci_answer){.set = {.component = component, .set = set_of, .count = SET}, .x = x};
    mean = (hci_target_order){{0.0, 0.0, 0.0}, 1.0};
    target = (hci_target){&mean, 1};
}

void tearDown(void)
{
    release_currents(&s);
}

static void fill(const hci_component_set *given, const hci_wave *held, bool has_parts)
{
    const hci_solve_options options = {.target = &target, .set = given, .held = held};
    release_currents(&s);
    memset(&s, 0, sizeof s);
    TEST_ASSERT_EQUAL_INT(HCI_OK, fill_currents(&answer, &options, has_parts, &s, &note));
}

/* Of a current per N·m and a rest: mean × first + second, and the two beside it. */
static void test_parts_of_a_component(void)
{
    for (size_t k = 0; k < 4 * SET; ++k)
        x[k] = 1.0 + (double)k;
    mean.torque_Nm.cosine = -0.5;
    fill(NULL, NULL, true);
    TEST_ASSERT_EQUAL_UINT64(SET, s.current.count);
    for (size_t k = 0; k < SET; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(component[k].order, s.current.wave[k].order);
        TEST_ASSERT_EQUAL_INT(component[k].sequence, s.current.wave[k].sequence);
        TEST_ASSERT_EQUAL_INT(set_of[k], s.current.set[k]);
        TEST_ASSERT_EQUAL_DOUBLE(x[2 * k], s.per_Nm[k].sine);
        TEST_ASSERT_EQUAL_DOUBLE(x[2 * k + 1], s.per_Nm[k].cosine);
        TEST_ASSERT_EQUAL_DOUBLE(x[2 * SET + 2 * k], s.constant[k].sine);
        TEST_ASSERT_EQUAL_DOUBLE(x[2 * SET + 2 * k + 1], s.constant[k].cosine);
        TEST_ASSERT_EQUAL_DOUBLE(-0.5 * x[2 * k] + x[2 * SET + 2 * k], s.current.wave[k].sine);
        TEST_ASSERT_EQUAL_DOUBLE(-0.5 * x[2 * k + 1] + x[2 * SET + 2 * k + 1], s.current.wave[k].cosine);
    }
    fill(NULL, NULL, false);
    TEST_ASSERT_NULL(s.per_Nm);
    TEST_ASSERT_EQUAL_UINT64(SET, s.current.count);
}

/* Less than 10⁻¹² of the largest is rounding, of a part for each N·m times the mean; of a given set it stays.
 */
static void test_what_is_rounding(void)
{
    static const double MEAN_NM[] = {1e-3, -1e-3, 2.0, 5e3};
    for (size_t m = 0; m < 4; ++m)
        for (int more = 0; more < 2; ++more) {
            mean.torque_Nm.cosine = MEAN_NM[m];
            memset(x, 0, sizeof x);
            x[1] = -3.0 / fabs(MEAN_NM[m]);                         /* 3 A, the largest */
            x[2] = 3e-12 / fabs(MEAN_NM[m]) * (more ? 1.01 : 0.99); /* by the mean */
            x[2 * SET + 5] = -3e-12 * (more ? 1.01 : 0.99);         /* by itself */
            fill(NULL, NULL, false);
            TEST_ASSERT_EQUAL_UINT64(more ? 3 : 1, s.current.count);
            fill(&answer.set, NULL, false);
            TEST_ASSERT_EQUAL_UINT64(3, s.current.count);
        }
}

/* Without a mean a part for each N·m counts as for one. */
static void test_without_a_mean(void)
{
    x[2 * SET] = 4.0;
    x[2] = 5e-12;
    x[4] = 3e-12;
    fill(NULL, NULL, true);
    TEST_ASSERT_EQUAL_UINT64(2, s.current.count);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, s.current.wave[1].order);
}

/* What is held goes before all others. */
static void test_a_wave_that_is_held(void)
{
    static const hci_wave HELD = {1.0, 1, 7.0, -2.0};
    x[2 * SET + 2] = 4.0;
    fill(NULL, &HELD, false);
    TEST_ASSERT_EQUAL_UINT64(2, s.current.count);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, s.current.wave[0].sine);
    TEST_ASSERT_EQUAL_INT(HCI_SET_POS, s.current.set[0]);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, s.current.wave[1].sine);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_parts_of_a_component);
    RUN_TEST(test_what_is_rounding);
    RUN_TEST(test_without_a_mean);
    RUN_TEST(test_a_wave_that_is_held);
    return UNITY_END();
}
