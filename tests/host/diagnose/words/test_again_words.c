/* What new recordings say of the last diagnosis: every sentence, and when it is said. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/diagnose/again.h"
#include "unity.h"

enum { MOST_RUNS = 12 };

static hci_again a;
static hci_again_run run[MOST_RUNS];
static char path[MOST_RUNS][32];
static char text[HCI_AGAIN_WORDS];

/* Two new recordings; of nothing else a word is said. */
void setUp(void)
{
    memset(&a, 0, sizeof a);
    memset(run, 0, sizeof run);
    a.run = run;
    a.runs = 2;
    a.declared_Nm = 0.5;
    a.last_Nm = 0.2;
    a.now_Nm = 0.1;
    a.noise_Nm = 0.05;
    a.bound_Nm = 0.3;
    strcpy(a.solved.why, "no file");
}

void tearDown(void)
{
}

static const char *words(void)
{
    hci_again_words(&a, text, sizeof text);
    return text;
}

static bool says(const char *part)
{
    return strstr(words(), part) != NULL;
}

/* ---- the prediction ---- */

static void test_the_prediction(void)
{
    TEST_ASSERT_EQUAL_STRING("On 2 new recordings the machine of last time was off by 0.2 N·m rms before any "
                             "fit to them; the declared "
                             "machine is off by 0.5 N·m there, and 0.05 N·m are noise. No bound was stated "
                             "last time of that error. Fitted "
                             "to all recordings, the machine is off by 0.1 N·m there: better. What was "
                             "promised of currents was not "
                             "judged: no solution for the machine of last time is known (no file).",
                             words());
    a.runs = 1;
    TEST_ASSERT_TRUE(says("On 1 new recording the machine"));
}

static void test_the_bound(void)
{
    a.bounded = 2;
    a.kept = 1;
    TEST_ASSERT_TRUE(
        says(" It was within what had been stated of the torque, mean and ripple together, whatever current "
             "flows (0.3 N·m, 95 %) in 1 of 2: what was stated of the model does not hold."));
    run[1].played.promise = HCI_PROMISE_KEPT;
    TEST_ASSERT_TRUE(says("does not hold."));
    strcpy(a.solved.folder, "out");
    TEST_ASSERT_TRUE(says("does not hold; the promise of the ripple is another one, and was kept."));
    run[1].played.promise = HCI_PROMISE_NOT_KEPT;
    TEST_ASSERT_TRUE(says("does not hold."));
    a.kept = 2;
    TEST_ASSERT_TRUE(says("in 2 of 2: what was stated of the model holds."));
}

/* A fiftieth of the last error is no change. */
static void test_better_or_worse(void)
{
    static const double NOW_NM[4] = {0.2 * 0.979, 0.2 * 0.981, 0.2 * 1.019, 0.2 * 1.021};
    static const char *const SAID[4] = {"there: better.", "there: no change.", "there: no change.",
                                        "there: worse."};
    for (int k = 0; k < 4; ++k) {
        a.now_Nm = NOW_NM[k];
        TEST_ASSERT_TRUE_MESSAGE(says(SAID[k]), SAID[k]);
    }
}

/* ---- effects ---- */

static const char *of_effect(hci_again_change change, bool was_ambiguous, bool is_ambiguous)
{
    a.runs = 0;
    a.effects = 1;
    a.effect[0] = (hci_again_effect){.effect = "cogging",
                                     .change = change,
                                     .was_ambiguous = was_ambiguous,
                                     .is_ambiguous = is_ambiguous,
                                     .deviations = 4.25,
                                     .words = "0.1 then, 0.2 now"};
    return words();
}

static void test_what_became_of_an_effect(void)
{
    TEST_ASSERT_EQUAL_STRING(" cogging was ambiguous and is now rejected.",
                             of_effect(HCI_AGAIN_LEFT, true, false));
    TEST_ASSERT_EQUAL_STRING(" cogging was ambiguous and is now added.",
                             of_effect(HCI_AGAIN_STAYS, true, false));
    TEST_ASSERT_EQUAL_STRING(" cogging is ambiguous now.", of_effect(HCI_AGAIN_LEFT, false, true));
    TEST_ASSERT_EQUAL_STRING(" cogging is ambiguous now. 1 effect stays within its error.",
                             of_effect(HCI_AGAIN_STAYS, false, true));
    TEST_ASSERT_EQUAL_STRING(" cogging is not in the machine of all recordings; the new ones by themselves "
                             "speak neither for nor against it.",
                             of_effect(HCI_AGAIN_LEFT, false, false));
    TEST_ASSERT_EQUAL_STRING("", of_effect(HCI_AGAIN_LEFT, true, true));
    TEST_ASSERT_EQUAL_STRING(" cogging came.", of_effect(HCI_AGAIN_CAME, false, false));
    TEST_ASSERT_EQUAL_STRING(" cogging came.", of_effect(HCI_AGAIN_CAME, true, true));
    TEST_ASSERT_EQUAL_STRING(" cogging has changed by 4.25 standard errors: 0.1 then, 0.2 now.",
                             of_effect(HCI_AGAIN_CHANGED, false, false));
    TEST_ASSERT_EQUAL_STRING(
        " cogging was ambiguous and is now added. cogging has changed by 4.25 standard errors: "
        "0.1 then, 0.2 now.",
        of_effect(HCI_AGAIN_CHANGED, true, false));
    TEST_ASSERT_EQUAL_STRING("", of_effect(HCI_AGAIN_STAYS, true, true));
}

/* Only what the new recordings alone speak against is contradicted. */
static void test_what_left(void)
{
    (void)of_effect(HCI_AGAIN_LEFT, false, false);
    a.effect[0].speaks = HCI_AGAIN_AGAINST;
    TEST_ASSERT_EQUAL_STRING(" cogging is contradicted and left.", words());
    a.effect[0].speaks = HCI_AGAIN_FOR;
    TEST_ASSERT_TRUE(says("describes the new ones better with it: it is not contradicted."));
    TEST_ASSERT_EQUAL_STRING("against", hci_again_speaks_name(HCI_AGAIN_AGAINST));
    TEST_ASSERT_EQUAL_STRING("for", hci_again_speaks_name(HCI_AGAIN_FOR));
    TEST_ASSERT_EQUAL_STRING("silent", hci_again_speaks_name(HCI_AGAIN_SILENT));
}

/* Of values that describe the new recordings no better. */
static void test_another_description(void)
{
    (void)of_effect(HCI_AGAIN_CHANGED, false, false);
    a.runs = 1;
    a.now_Nm = 0.199;
    TEST_ASSERT_TRUE(says("has changed by 4.25") && says("another description of the same."));
    a.now_Nm = 0.1;
    TEST_ASSERT_FALSE(says("another description"));
    a.now_Nm = 0.199;
    a.effect[0].change = HCI_AGAIN_STAYS;
    TEST_ASSERT_FALSE(says("another description"));
}

static void test_cogging_that_is_found_afresh(void)
{
    TEST_ASSERT_FALSE(says("not compared"));
    a.without_cogging = true;
    TEST_ASSERT_TRUE(says("found by all recordings together, and not compared with that of last time."));
}

static void test_effects_that_stay(void)
{
    a.runs = 0;
    a.effects = 3;
    for (int k = 0; k < 3; ++k)
        a.effect[k] =
            (hci_again_effect){.effect = "friction", .change = k == 1 ? HCI_AGAIN_CAME : HCI_AGAIN_STAYS};
    TEST_ASSERT_EQUAL_STRING(" friction came. 2 effects stay within their errors.", words());
}

static void test_names_of_changes(void)
{
    static const hci_again_change CHANGE[] = {HCI_AGAIN_STAYS, HCI_AGAIN_CHANGED, HCI_AGAIN_LEFT,
                                              HCI_AGAIN_CAME};
    static const char *const NAME[] = {"stays", "changed", "left", "came"};
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_EQUAL_STRING(NAME[k], hci_again_change_name(CHANGE[k]));
}

/* ---- currents that were played ---- */

static void play(size_t runs, size_t first_other, size_t last_other)
{
    a.runs = runs;
    strcpy(a.solved.folder, "out");
    for (size_t k = 0; k < runs; ++k) {
        snprintf(path[k], sizeof path[k], "r%zu.csv", k);
        run[k].path = path[k];
        run[k].played.currents =
            k >= first_other && k <= last_other ? HCI_PLAYED_OTHERS : HCI_PLAYED_AS_SOLVED;
    }
}

static bool says_run(size_t k)
{
    char part[64];
    snprintf(part, sizeof part, " In r%zu.csv the currents", k);
    return says(part);
}

/* Of those with other currents the first alone is said, and how many there are. */
static void test_runs_with_other_currents(void)
{
    play(5, 1, 3);
    for (size_t k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL(k < 2 || k == 4, says_run(k));
    TEST_ASSERT_TRUE(says(" In 3 new recordings altogether the currents are not those that were solved."));
    TEST_ASSERT_FALSE(says("was not judged"));
    play(5, 1, 1);
    TEST_ASSERT_FALSE(says("altogether"));
}

/* Six are said. */
static void test_many_runs(void)
{
    play(9, 20, 20);
    for (size_t k = 0; k < 9; ++k)
        TEST_ASSERT_EQUAL(k < 6, says_run(k));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_prediction);
    RUN_TEST(test_the_bound);
    RUN_TEST(test_better_or_worse);
    RUN_TEST(test_what_became_of_an_effect);
    RUN_TEST(test_what_left);
    RUN_TEST(test_another_description);
    RUN_TEST(test_cogging_that_is_found_afresh);
    RUN_TEST(test_effects_that_stay);
    RUN_TEST(test_names_of_changes);
    RUN_TEST(test_runs_with_other_currents);
    RUN_TEST(test_many_runs);
    return UNITY_END();
}
