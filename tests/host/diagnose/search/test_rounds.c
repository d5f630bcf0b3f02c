/* Several known effects at once, which three orders that grow as nothing known does describe sooner than any
 * one of them: in the end it is the known ones. What is really unknown stays so. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/search/rounds.h"

#include "host/diagnose/candidates/empirical_term.h"
#include "support/searching.h"

enum { N = 900 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* There and back at two speeds each: cogging of orders 2 and 6, 1 and 4 a turn, friction. growing: of how the
 * torque of 4 a turn goes with the root of the speed. */
static void record_all(bool growing)
{
    static const double SPEED[] = {20.0, -20.0, 150.0, -150.0}, CURRENT_A[] = {2.0, 9.0, 9.0, 2.0};
    for (size_t r = 0; r < 4; ++r) {
        const double growth = growing ? sqrt(fabs(SPEED[r]) / 150.0) : 1.0;
        record(N, &(point){SPEED[r], CURRENT_A[r], 0.0, SPEED[r] > 0.0 ? 0.04 : -0.04, 0.0});
        for (size_t k = 0; k < N; ++k) {
            const double x = run[r].theta_m_rad[k];
            run[r].torque_Nm[k] += 0.05 * sin(2.0 * P * x) + 0.04 * cos(6.0 * P * x) + 0.06 * sin(x + 0.4) +
                                   0.05 * growth * cos(4.0 * x);
        }
    }
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_rounds(&search, &model, &note));
    model_is_renewed();
}

static void test_known_effects_at_once(void)
{
    record_all(false);
    TEST_ASSERT_TRUE(model_has("cogging") && model_has("mechanical_order") && model_has("friction"));
    TEST_ASSERT_FALSE(hci_candidates_have(&model.candidates, &hci_empirical_type));
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_types_in(&model.candidates));
}

static void test_what_is_unknown_stays(void)
{
    record_all(true);
    TEST_ASSERT_TRUE(hci_candidates_have(&model.candidates, &hci_empirical_type));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_known_effects_at_once);
    RUN_TEST(test_what_is_unknown_stays);
    return UNITY_END();
}
