/* Whether what a model adds to the cogging torque is the declared one by a factor, of waves that are written
 * down here. */
#include "host/diagnose/candidates/modelled_gain.h"

#include <math.h>

#include "unity.h"

enum { SINE, COSINE, CANDIDATES = 4 };

static hci_harmonic cogging[2] = {{6.0, 0.3, 0.4}, {12.0, -0.02, 0.07}};
static const hci_machine MACHINE = {.pole_pairs = 2, .cogging = cogging, .cogging_count = 2};

static hci_candidate candidate[CANDIDATES];
static hci_candidates model;

static hci_candidate wave(const char *effect, double order, double sine, double cosine)
{
    hci_candidate x = {.type = hci_effect_type_find(effect), .count = 2, .in = true};
    x.term[0] = (hci_effect_term){SINE, order, sine, NAN};
    x.term[1] = (hci_effect_term){COSINE, order, cosine, NAN};
    return x;
}

/* A tenth of order 6 is in, the rest is of other orders, not in, or no cogging torque. */
void setUp(void)
{
    candidate[0] = wave("cogging", 7.0, 0.5, 0.2);
    candidate[1] = wave("back_emf", 6.0, 0.4, 0.3);
    candidate[2] = wave("cogging", 6.0, 0.2, 0.2);
    candidate[2].in = false;
    candidate[3] = wave("cogging", 6.0, 0.03, 0.04);
    model = (hci_candidates){.candidate = candidate, .count = CANDIDATES};
}

void tearDown(void)
{
}

static bool shows(double gain)
{
    return hci_modelled_gain(&MACHINE, &model, gain);
}

/* A share of HCI_SAME_GAIN of it either way, along the declared wave and across. */
static void test_how_alike_a_gain_is(void)
{
    const double off = 0.1 * HCI_SAME_GAIN;
    TEST_ASSERT_TRUE(shows(0.1));
    TEST_ASSERT_FALSE(shows(-0.1));
    for (int k = 0; k < 8; ++k) {
        const double x = (k % 2 ? 1.01 : 0.99) * off, angle = 1.5707963267948966 * (double)(k / 2);
        const double along = 0.1 + x * cos(angle), across = x * sin(angle);
        candidate[3] = wave("cogging", 6.0, 0.3 * along - 0.4 * across, 0.4 * along + 0.3 * across);
        TEST_ASSERT_EQUAL(k % 2 == 0, shows(0.1));
    }
}

/* Less than a thousandth is none. */
static void test_a_gain_that_is_none(void)
{
    candidate[3] = wave("cogging", 6.0, 0.3 * 1.01e-3, 0.4 * 1.01e-3);
    TEST_ASSERT_TRUE(shows(1.01e-3));
    candidate[3] = wave("cogging", 6.0, 0.3 * 0.99e-3, 0.4 * 0.99e-3);
    TEST_ASSERT_FALSE(shows(0.99e-3));
}

/* The second declared order, in two candidates together; an order that is declared as nothing tells nothing.
 */
static void test_waves_of_several_candidates_add_up(void)
{
    candidate[0] = wave("cogging", 12.0, 0.0, 0.004);
    candidate[3] = wave("cogging", 12.0, -0.002, 0.003);
    TEST_ASSERT_TRUE(shows(0.1));
    candidate[0].in = false;
    TEST_ASSERT_FALSE(shows(0.1));
    cogging[1].sine = cogging[1].cosine = 0.0;
    TEST_ASSERT_FALSE(shows(0.1));
    cogging[1] = (hci_harmonic){12.0, -0.02, 0.07};
}

static void test_which_candidate_it_is(void)
{
    for (size_t k = 0; k < CANDIDATES; ++k)
        TEST_ASSERT_EQUAL(k == 3, hci_modelled_gain_has(&MACHINE, &model, 0.1, k));
    candidate[0] = wave("cogging", 12.0, -0.002, 0.007);
    TEST_ASSERT_TRUE(hci_modelled_gain_has(&MACHINE, &model, 0.1, 0));
    TEST_ASSERT_FALSE(hci_modelled_gain_has(&MACHINE, &model, 0.2, 0));
    candidate[0].term[0].order = 13.0; /* the second of its terms tells it as well */
    candidate[0].term[1] = (hci_effect_term){COSINE, 6.0, 0.0, NAN};
    TEST_ASSERT_TRUE(hci_modelled_gain_has(&MACHINE, &model, 0.1, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_how_alike_a_gain_is);
    RUN_TEST(test_a_gain_that_is_none);
    RUN_TEST(test_waves_of_several_candidates_add_up);
    RUN_TEST(test_which_candidate_it_is);
    return UNITY_END();
}
