/* Runs that are left out in turn: what predicts them stays, what one run alone asks for does not. */
#include "host/diagnose/search/stability.h"

#include "support/searching.h"

enum { SAMPLES = 100, RUNS = 6 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Friction in all runs; cogging in the first one, and the reverse of it in the second. */
static void record_runs(size_t count, double brake_Nm, double cogging_Nm)
{
    for (size_t k = 0; k < count; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0;
        record(SAMPLES,
               &(point){sign * (60.0 + 10.0 * (double)k), k % 3 ? 9.0 : 2.0, 0.0, sign * brake_Nm, 0.0});
        for (size_t j = 0; j < SAMPLES && k < 2; ++j)
            run[k].torque_Nm[j] += (k == 0 ? 1.0 : -0.4) * cogging_Nm * sin(6.0 * P * run[k].theta_m_rad[j]);
    }
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
}

static void keep(void)
{
    model_fit();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_keep_predictive(&search, &model, &note), note.text);
}

static void test_what_all_runs_show_stays(void)
{
    record_runs(RUNS, 0.05, 0.0);
    keep();
    TEST_ASSERT_TRUE(model_has("friction"));
}

static void test_what_one_run_asks_for_leaves(void)
{
    record_runs(RUNS, 0.05, 0.05);
    model_add("cogging", "sine", "cosine", 6.0);
    keep();
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_FALSE(model_has("cogging"));
}

/* Cogging in the samples of one run from one to another. */
static void record_one(size_t from, size_t until)
{
    record(6 * SAMPLES, &(point){60.0, 9.0, 0.0, 0.05, 0.0});
    for (size_t j = from; j < until; ++j)
        run[0].torque_Nm[j] += 0.02 * sin(6.0 * P * run[0].theta_m_rad[j]);
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("cogging", "sine", "cosine", 6.0);
}

/* One run is cut into parts, which are left out in turn. */
static void test_what_all_parts_of_a_run_show_stays(void)
{
    record_one(0, 6 * SAMPLES);
    keep();
    TEST_ASSERT_TRUE(model_has("friction") && model_has("cogging"));
}

static void test_what_one_part_asks_for_leaves(void)
{
    record_one(0, SAMPLES);
    keep();
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_FALSE(model_has("cogging"));
}

/* The true model describes runs left out better than one without the effect; by hand: the mean square with
 * the other runs' mean friction is the noise's. */
static void test_misfit_of_runs_left_out(void)
{
    double with = 0.0, without = 0.0;
    record_runs(RUNS, 0.05, 0.0);
    model_fit();
    model_fit(); /* with the noise that is left */
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_left_out(&search, &model.candidates, &with, &note));
    hci_candidates none = {0};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_left_out(&search, &none, &without, &note));
    const double rows = SAMPLES * RUNS;
    TEST_ASSERT_DOUBLE_WITHIN(0.15 * rows, rows * log(1.0 + 0.05), with);
    TEST_ASSERT_DOUBLE_WITHIN(0.2 * rows, rows * log(1.0 + 25.0 + 0.05), without);
}

/* A torque per ampere that is a tenth more, and one run alone that has a current. */
static void record_one_load(void)
{
    for (size_t k = 0; k < RUNS; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0, iq_A = k == 2 ? 9.0 : 0.0;
        record(SAMPLES, &(point){sign * (60.0 + 10.0 * (double)k), iq_A, 0.0,
                                 sign * 0.05 - 0.1 * 1.5 * K_NM_PER_A * iq_A, 0.0});
    }
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    model_fit();
}

/* What the others do not tell is not held against the model: of six runs one is missed by all of its load. */
static void test_what_others_do_not_tell_is_not_missed(void)
{
    double share = 1.0;
    record_one_load();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_unpredicted(&search, &model.candidates, &share, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, share);
}

/* Five slow runs under load, of which the torque per ampere is a little less, and a faster one without a
 * current: friction that grows with the speed, which that one alone tells. */
static void record_one_fast(double fast, double brake_Nm)
{
    static const double CURRENT_A[] = {9.0, 2.0, 5.0, 2.0, 7.2, 0.0};
    for (size_t k = 0; k < RUNS; ++k) {
        const double speed = k < 5 ? 60.0 + 0.2 * (double)k : fast;
        record(SAMPLES, &(point){speed, CURRENT_A[k], 0.0,
                                 brake_Nm + 1e-4 * speed + 0.003 * 1.5 * K_NM_PER_A * CURRENT_A[k], 0.0});
    }
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("friction", "viscous", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    model_fit();
}

static void forget_all(void)
{
    search_end();
    memset(&model, 0, sizeof model);
    for (size_t r = 0; r < runs.count; ++r)
        rec_release(&run[r]);
    runs.count = 0;
}

/* Left out it is missed with that back-EMF or without it, by chance more with it. */
static void test_what_one_run_alone_tells_is_not_held_against_others(void)
{
    for (uint64_t k = 0; k < 8; ++k) {
        seed = 99 + k;
        record_one_fast(600.0, 0.05);
        keep();
        TEST_ASSERT_TRUE(model_has("friction") && model_has("back_emf"));
        forget_all();
    }
}

/* Nor is it missed, where the others tell it a little: what they tell it by is as uncertain as that. */
static void test_what_one_run_tells_nearly_alone_is_not_missed(void)
{
    for (uint64_t k = 0; k < 8; ++k) {
        double share = 1.0;
        seed = 99 + k;
        record_one_fast(75.0, 0.01);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_unpredicted(&search, &model.candidates, &share, &note));
        TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.0, share);
        forget_all();
    }
}

/* Without a current no run shows anything of a back-EMF: nothing is taken, and nothing is missed. */
static void test_what_explains_nothing_misses_nothing(void)
{
    double share = 1.0;
    for (size_t k = 0; k < RUNS; ++k)
        record(SAMPLES, &(point){60.0 + 10.0 * (double)k, 0.0, 0.0, 0.0, 0.0});
    search_start();
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_unpredicted(&search, &model.candidates, &share, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, share);
}

/* A torque per ampere of five small currents that one large current contradicts: they would be better off
 * without the effect, of which nothing is taken then. */
static void test_what_makes_others_worse_takes_nothing(void)
{
    double share = 1.0;
    for (size_t k = 0; k < RUNS; ++k) {
        const double iq_A = k == 2 ? 20.0 : 0.1, less = k == 2 ? 0.1 : -1.0;
        record(SAMPLES, &(point){60.0 + 10.0 * (double)k, iq_A, 0.0, less * 1.5 * K_NM_PER_A * iq_A, 0.0});
    }
    search_start();
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_unpredicted(&search, &model.candidates, &share, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, share);
}

static void test_stays_are_counted(void)
{
    hci_attribution a;
    memset(&a, 0, sizeof a);
    record_runs(RUNS, 0.05, 0.0);
    model_fit();
    a.model = model;
    a.types = hci_candidate_types();
    for (size_t r = 0; r < a.types; ++r)
        a.verdict[r].type = hci_candidate_type(r);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_stability(&search, &a, &note));
    for (size_t r = 0; r < a.types; ++r) {
        const bool in = strcmp(a.verdict[r].type->name, "friction") == 0;
        TEST_ASSERT_EQUAL_UINT64(in ? RUNS : 0, a.verdict[r].stays);
        TEST_ASSERT_EQUAL_UINT64(in ? RUNS : 0, a.verdict[r].left_out);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_all_runs_show_stays);
    RUN_TEST(test_what_one_run_asks_for_leaves);
    RUN_TEST(test_what_all_parts_of_a_run_show_stays);
    RUN_TEST(test_what_one_part_asks_for_leaves);
    RUN_TEST(test_misfit_of_runs_left_out);
    RUN_TEST(test_what_others_do_not_tell_is_not_missed);
    RUN_TEST(test_what_one_run_alone_tells_is_not_held_against_others);
    RUN_TEST(test_what_one_run_tells_nearly_alone_is_not_missed);
    RUN_TEST(test_what_explains_nothing_misses_nothing);
    RUN_TEST(test_what_makes_others_worse_takes_nothing);
    RUN_TEST(test_stays_are_counted);
    return UNITY_END();
}
