/* Effects that go through lists: each entry counts, the first and the last. */
#include "core/effects/stribeck_friction.c"

#include "core/effects/coenergy.h"
#include "hci/learn.h"
#include "unity.h"

enum { MOST = 64 };

static hci_effect_candidate taken[MOST];
static size_t count;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
}

static void take(void *context, const hci_effect_candidate *candidate)
{
    (void)context;
    TEST_ASSERT_TRUE(count < MOST);
    taken[count++] = *candidate;
}

/* Orders that stand out with the current alone: two pairs each, with i_q and with i_d. */
static void test_each_order_of_a_load(void)
{
    const hci_effect_proposals to = {take, NULL};
    const double order[] = {1.0 / 3.0, 2.0 / 3.0, 4.0 / 3.0};
    const hci_machine machine = {.pole_pairs = 3};
    const hci_effect_survey survey = {.machine = &machine, .load_order = order, .load_orders = 3};
    hci_effect_type_find("mechanical_order")->propose(&survey, &to);
    TEST_ASSERT_EQUAL_UINT64(6, count);
    for (size_t k = 0; k < count; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(order[k / 2], taken[k].order);
}

/* Sums over all speeds by hand: the constant alone. */
static void test_each_speed_of_a_friction(void)
{
    const hci_effect_speed_mean mean[] = {{.speed_rad_per_s = 1.0, .residual_Nm = 0.5, .weight = 2.0},
                                          {.speed_rad_per_s = -4.0, .residual_Nm = 0.25, .weight = 3.0},
                                          {.speed_rad_per_s = 9.0, .residual_Nm = -1.0, .weight = 5.0}};
    const hci_effect_survey survey = {.of_speed = mean, .of_speeds = 3};
    double gram[LAWS * LAWS], b[LAWS];
    sums_fill(&survey, 2.0, gram, b);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, gram[0]);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 * 0.5 + 3.0 * 0.25 - 5.0, b[0]);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0 * 0.5 + 3.0 * 0.25 + 5.0, b[1]);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0 * 1.0 * 0.5 + 3.0 * 4.0 * 0.25 + 5.0 * 9.0, b[2]);
}

/* An order that is there is not made anew. */
static void test_waves_of_a_coenergy_are_kept(void)
{
    static hci_coenergy w;
    memset(&w, 0, sizeof w);
    w.pole_pairs = 2, w.theta_m_rad = 0.3;
    w.turning.c = 1.0;
    for (int pass = 0; pass < 3; ++pass)
        for (size_t n = 0; n < 3; ++n)
            TEST_ASSERT_EQUAL_UINT64(n, hci_coenergy_wave_at(&w, 6.0 * (double)(n + 1)));
    TEST_ASSERT_EQUAL_UINT64(3, w.waves);
}

/* Whatever was in memory before. */
static void test_learning_begins_anew(void)
{
    const uint16_t order[] = {1, 6};
    hci_learn_sums sums[3];
    hci_learn learn;
    memset(&learn, 0x55, sizeof learn);
    memset(sums, 0x55, sizeof sums);
    hci_learn_start(&learn, order, 2, sums, 4096);
    TEST_ASSERT_EQUAL_INT(0, learn.direction);
    TEST_ASSERT_EQUAL_UINT64(0, learn.turns_forward + learn.turns_backward + learn.has_begun + learn.way);
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_TRUE(sums[k].turn[0] == 0.0f && sums[k].turn[1] == 0.0f && sums[k].square == 0.0f);
}

/* Waves far below 1 are joined, and dropped, beside the largest of them. */
static void test_waves_of_any_size_are_joined(void)
{
    for (double size = 1e-30; size < 1e31; size *= 1e15) {
        hci_wave wave[] = {{5.0, -1, 0.2 * size, 0.0},
                           {1.0, 1, size, 0.0},
                           {7.0, 1, 0.0, 1e-4 * size},
                           {5.0, -1, 0.1 * size, 0.0}};
        TEST_ASSERT_EQUAL_UINT64(2, hci_waves_join(wave, 4, 1e-3));
        TEST_ASSERT_EQUAL_DOUBLE(1.0, wave[0].order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * size, 0.3 * size, wave[1].sine);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_order_of_a_load);
    RUN_TEST(test_each_speed_of_a_friction);
    RUN_TEST(test_waves_of_a_coenergy_are_kept);
    RUN_TEST(test_learning_begins_anew);
    RUN_TEST(test_waves_of_any_size_are_joined);
    return UNITY_END();
}
