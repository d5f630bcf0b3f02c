/* What of a search that ended early stands all the same. */
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/held_out.h"
#include "unity.h"

static hci_attribution a;
static hci_diagnosis d;
static hci_verdict v;

/* A back-EMF that is found without each of seven runs and was compared; no run is held out. */
void setUp(void)
{
    memset(&a, 0, sizeof a);
    memset(&d, 0, sizeof d);
    a.ended = HCI_WORK_LIMITED;
    a.before.score = 1e6; /* what all effects explain */
    d.holdout_before_Nm = d.holdout_after_Nm = d.holdout_noise_Nm = NAN;
    d.holdout_mean_before_Nm = d.holdout_mean_after_Nm = NAN;
    d.holdout_ripple_before_Nm = d.holdout_ripple_after_Nm = NAN;
    v = (hci_verdict){.type = hci_effect_type_find("back_emf"),
                      .in = true,
                      .compared = true,
                      .gain = 5e5,
                      .explained_Nm = 0.3,
                      .stays = 7,
                      .left_out = 7};
}

void tearDown(void)
{
}

static bool is_unconfirmed(void)
{
    return hci_is_unconfirmed(&a, &d, &v);
}

/* Or makes a plain part of all. */
static void test_what_was_compared_is_confirmed(void)
{
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.compared = false;
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.gain = 900.0;
    TEST_ASSERT_TRUE(is_unconfirmed());
    v.established = true; /* by the runs without a current alone */
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.established = false;
    v.in = false; /* there is nothing to be confirmed */
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.in = true;
    v.type = &hci_empirical_type;
    TEST_ASSERT_FALSE(is_unconfirmed());
}

/* Others are at their end, and where the user wanted it, that is said. */
static void test_only_where_the_work_was_the_limit(void)
{
    v.compared = false;
    a.ended = HCI_WORK_COMPLETE;
    TEST_ASSERT_FALSE(is_unconfirmed());
    a.ended = HCI_WORK_INTERRUPTED;
    TEST_ASSERT_FALSE(is_unconfirmed());
}

static void test_two_thirds_of_the_runs_left_out(void)
{
    v.stays = 5;
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.stays = 4;
    TEST_ASSERT_TRUE(is_unconfirmed());
}

/* What comes of the others once another stands in its place is not known. */
static void test_not_beside_a_better_one(void)
{
    a.unsettled = true;
    TEST_ASSERT_TRUE(is_unconfirmed());
    v.established = true;
    TEST_ASSERT_FALSE(is_unconfirmed());
}

/* A third of what it explains, whether it was compared or not. */
static void test_beside_something_unknown(void)
{
    a.unknown = true;
    v.compared = false;
    a.unexplained_Nm = 0.09;
    TEST_ASSERT_FALSE(is_unconfirmed());
    a.unexplained_Nm = 0.11;
    TEST_ASSERT_TRUE(is_unconfirmed());
}

/* The same of the runs held out, their noise aside. */
static void test_runs_held_out(void)
{
    d.holdout_before_Nm = 0.3;
    d.holdout_noise_Nm = 0.02;
    d.holdout_after_Nm = 0.08;
    TEST_ASSERT_FALSE(is_unconfirmed());
    d.holdout_after_Nm = 0.11;
    TEST_ASSERT_TRUE(is_unconfirmed());
    d.holdout_after_Nm = 0.31; /* they are worse */
    TEST_ASSERT_TRUE(is_unconfirmed());
}

/* A friction that describes their means and leaves the ripple as it was; not where that is larger for it. */
static void test_means_of_runs_held_out(void)
{
    d.holdout_before_Nm = 0.177;
    d.holdout_after_Nm = 0.0647;
    d.holdout_noise_Nm = 0.0261;
    TEST_ASSERT_TRUE(is_unconfirmed());
    d.holdout_mean_before_Nm = 0.165;
    d.holdout_mean_after_Nm = 0.001;
    d.holdout_ripple_before_Nm = d.holdout_ripple_after_Nm = 0.0647;
    TEST_ASSERT_FALSE(is_unconfirmed());
    d.holdout_ripple_before_Nm = 0.06;
    TEST_ASSERT_TRUE(is_unconfirmed());
}

/* What is next to nothing beside the others, of recordings of which none was held out. */
static void test_small_ones_need_runs_held_out(void)
{
    v.gain = 900.0;
    TEST_ASSERT_TRUE(is_unconfirmed());
    v.gain = 1100.0;
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.gain = 900.0;
    d.holdout_before_Nm = 0.3;
    d.holdout_after_Nm = d.holdout_noise_Nm = 0.02;
    TEST_ASSERT_FALSE(is_unconfirmed());
    v.compared = false;
    TEST_ASSERT_TRUE(is_unconfirmed());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_was_compared_is_confirmed);
    RUN_TEST(test_only_where_the_work_was_the_limit);
    RUN_TEST(test_two_thirds_of_the_runs_left_out);
    RUN_TEST(test_not_beside_a_better_one);
    RUN_TEST(test_beside_something_unknown);
    RUN_TEST(test_runs_held_out);
    RUN_TEST(test_means_of_runs_held_out);
    RUN_TEST(test_small_ones_need_runs_held_out);
    return UNITY_END();
}
