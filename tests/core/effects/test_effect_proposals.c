/* Which terms effects name for recordings, and for motors of one make. */
#include <string.h>

#include "hci/effects/effect.h"
#include "hci/status.h"
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
    TEST_ASSERT_EQUAL_PTR(&count, context);
    TEST_ASSERT_TRUE(count < MOST);
    taken[count++] = *candidate;
}

static const hci_effect_proposals TO = {take, &count};

/* The three largest; of two that are equal the first; none that is a mean. */
static void test_cogging_of_one_make(void)
{
    const hci_harmonic cogging[] = {
        {6.0, 0.3, 0.4}, {12.0, 0.5, 0.0}, {18.0, 0.1, 0.0}, {24.0, 0.0, 2.0}, {30.0, 0.7, 0.0}};
    const hci_harmonic mean[] = {{0.0, 0.0, 1.0}, {6.0, 0.3, 0.4}};
    const hci_machine machine = {.pole_pairs = 1, .cogging = cogging, .cogging_count = 5};
    const hci_machine with_mean = {.pole_pairs = 1, .cogging = mean, .cogging_count = 2};
    static const double EXPECTED[] = {6.0, 24.0, 30.0, 6.0};
    hci_effect_type_find("cogging")->propose_alike(&machine, &TO);
    hci_effect_type_find("cogging")->propose_alike(&with_mean, &TO);
    TEST_ASSERT_EQUAL_UINT64(4, count);
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_EQUAL_UINT64(2, taken[k].count);
        TEST_ASSERT_EQUAL_DOUBLE(EXPECTED[k], taken[k].order);
    }
}

static void test_magnets_of_one_make(void)
{
    const hci_machine one = {.pole_pairs = 1}, three = {.pole_pairs = 3}, many = {.pole_pairs = 40};
    const hci_effect_type *magnets = hci_effect_type_find("unequal_magnets");
    magnets->propose_alike(&one, &TO);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    magnets->propose_alike(&three, &TO);
    TEST_ASSERT_EQUAL_UINT64(2, count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 / 3.0, taken[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 / 3.0, taken[1].order);
    magnets->propose_alike(&many, &TO);
    TEST_ASSERT_TRUE(count > 2 && count < 2 + 39);
}

/* Orders in which load and cogging vary alike; a drift where a run is long enough to tell; a gain where both
 * are off alike. */
static void test_what_recordings_ask_for(void)
{
    const double flux_order[2] = {1.0 / 3.0, 2.0 / 3.0};
    const hci_machine machine = {.pole_pairs = 3};
    hci_effect_survey survey = {.machine = &machine, .torque_Nm = 4.0, .flux_order = flux_order};
    static const char *const NAME[] = {"unequal_magnets", "torque_drift", "torque_gain"};
    for (int k = 0; k < 3; ++k)
        hci_effect_type_find(NAME[k])->propose(&survey, &TO);
    survey.creeps = true;
    hci_effect_type_find("torque_drift")->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    survey.flux_orders = 2;
    survey.one_gain = true;
    survey.duration_s = 10.0;
    for (int k = 0; k < 3; ++k)
        hci_effect_type_find(NAME[k])->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_UINT64(4, count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 / 3.0, taken[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 / 3.0, taken[1].order);
    TEST_ASSERT_TRUE(taken[2].expected > 0.0 && taken[2].expected < 0.4 && taken[3].expected > 0.0);
}

static void test_words_of_a_status(void)
{
    TEST_ASSERT_EQUAL(0, hci_status_exit_code(HCI_OK));
    TEST_ASSERT_TRUE(strlen(hci_status_text(HCI_ERROR_MEMORY)) > 0);
    TEST_ASSERT_EQUAL_STRING("unknown status", hci_status_text((hci_status)99));
    TEST_ASSERT_EQUAL(4, hci_status_exit_code((hci_status)99));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cogging_of_one_make);
    RUN_TEST(test_magnets_of_one_make);
    RUN_TEST(test_what_recordings_ask_for);
    RUN_TEST(test_words_of_a_status);
    return UNITY_END();
}
