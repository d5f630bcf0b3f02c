/* What runs without a current show by themselves, beside runs that nothing explains. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/search/no_load.h"

#include "host/diagnose/attribute/attribute.h"
#include "support/searching.h"

enum { N = 300 };

void setUp(void)
{
    dataset_start();
}

static hci_attribution a;
static bool idle[MOST_RUNS];

void tearDown(void)
{
    hci_attribution_release(&a);
    search_end();
    dataset_end();
}

/* There and back at two speeds with friction and cogging. odd_Nm: of what is another torque each time. */
static void record_idle(double odd_Nm)
{
    static const double SPEED[] = {60.0, -60.0, 150.0, -150.0};
    for (size_t r = 0; r < 4; ++r) {
        record(N, &(point){SPEED[r], 0.0, 0.0, SPEED[r] > 0.0 ? 0.04 : -0.04, odd_Nm});
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * P * run[r].theta_m_rad[k]);
    }
}

static void record_loads(size_t count)
{
    for (size_t r = 0; r < count; ++r)
        record(N, &(point){60.0, 3.0 + 2.0 * (double)r, 0.0, r % 2 ? 0.3 : -0.2, 0.5});
}

static void find(void)
{
    search_start();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_no_load(&search, idle, &a, &note), note.text);
}

static bool has(const char *effect)
{
    return hci_candidates_have(&a.model.candidates, hci_effect_type_find(effect));
}

static void test_they_show_their_effects(void)
{
    record_idle(0.0);
    record_loads(3);
    find();
    TEST_ASSERT_TRUE(has("friction") && has("cogging"));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&a.model.candidates));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&a.no_load.candidates));
    TEST_ASSERT_EQUAL_UINT64(7, hci_regression_runs_in_use(&dataset.regression)); /* all of them again */
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.04, term_in(&a.model.candidates, "friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, term_in(&a.model.candidates, "cogging", "sine", 6.0)->value);
}

/* All that may still be done is not spent on them: what was not looked at to the end is forgotten. */
static void test_something_is_left_for_all_runs(void)
{
    record_idle(0.0);
    record_loads(3);
    search_start();
    const double before = dataset.work;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_no_load(&search, idle, &a, &note));
    const double taken = dataset.work - before;
    hci_attribution_release(&a);
    dataset.work = HCI_MOST_WORK - 0.85 * taken;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_no_load(&search, idle, &a, &note));
    TEST_ASSERT_FALSE(hci_search_is_over(&search));
    TEST_ASSERT_EQUAL_INT(HCI_WORK_COMPLETE, search.ended);
    TEST_ASSERT_TRUE(dataset.work < HCI_MOST_WORK - 0.15 * taken);
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_types_in(&a.no_load.candidates));
}

/* A second from 5 to 65 rad/s, there and back, against friction: the torque that accelerates an inertia is
 * the same. */
static void record_ramps(void)
{
    for (int back = 0; back < 2; ++back) {
        hci_run *r = add_run(N);
        const double sign = back ? -1.0 : 1.0;
        for (size_t k = 0; k < N; ++k) {
            const double t = (double)k / N;
            r->time_s[k] = t;
            r->speed_rad_per_s[k] = sign * (5.0 + 60.0 * t);
            r->theta_m_rad[k] = sign * (5.0 * t + 30.0 * t * t);
            r->torque_Nm[k] =
                0.05 * sin(6.0 * P * r->theta_m_rad[k]) - sign * 0.04 + NOISE_NM * ref_normal(&seed);
        }
    }
}

static void test_what_they_do_not_tell_is_left_to_all(void)
{
    record_ramps();
    record_loads(3);
    find();
    TEST_ASSERT_TRUE(has("cogging"));
    TEST_ASSERT_FALSE(has("friction") || has("rotor_inertia"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&a.no_load.candidates));
}

/* Something in them that no effect explains. */
static void test_what_is_no_noise_shows_nothing(void)
{
    record_idle(0.05);
    record_loads(3);
    find();
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&a.model.candidates));
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&a.no_load.candidates));
}

/* Two runs with zeros of their own: a friction and an offset say nothing that is not just as well chance. */
static void test_as_many_values_as_runs_prove_nothing(void)
{
    record(N, &(point){60.0, 0.0, 0.0, 0.05, 0.0});
    record(N, &(point){-60.0, 0.0, 0.0, -0.08, 0.0});
    for (size_t r = 0; r < 2; ++r)
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * P * run[r].theta_m_rad[k]);
    record_loads(3);
    find();
    TEST_ASSERT_FALSE(has("friction"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&a.no_load.candidates));
    TEST_ASSERT_TRUE(hci_candidates_have(&a.no_load.candidates, hci_effect_type_find("cogging")));
}

/* Where the rest is not understood, they are all that is kept, with their own values. */
static void test_what_they_show_stays(void)
{
    record_idle(0.0);
    record_loads(3);
    find();
    hci_candidates_remove_type(&a.model.candidates, hci_effect_type_find("friction"));
    a.model.candidates.candidate[0].term[0].value = 7.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_no_load_stays(&search, &a, &note));
    TEST_ASSERT_TRUE(a.no_load_alone && has("friction") && has("cogging"));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, term_in(&a.model.candidates, "cogging", "sine", 6.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.04, 0.5 * sqrt(0.5 * 3.0 / 7.0), a.unexplained_Nm); /* of three runs */
}

/* Read through a sensor that swings only the means are certain: it may be what is not understood that swings.
 */
static void test_what_swings_is_not_certain(void)
{
    const hci_candidate sensor = candidate_of("torque_sensor", "natural_frequency", "damping", 0.0);
    record_idle(0.0);
    record_loads(3);
    find();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&a.no_load.candidates, &sensor, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_no_load_stays(&search, &a, &note));
    TEST_ASSERT_TRUE(has("friction") && !has("cogging") && !has("torque_sensor"));
}

/* Beside effects that are certain by other runs, what has left comes back. */
static void test_what_has_left_comes_back(void)
{
    const hci_candidate gain = candidate_of("torque_gain", "gain", NULL, 0.0);
    record_idle(0.0);
    record_loads(3);
    find();
    hci_candidates_remove_type(&a.model.candidates, hci_effect_type_find("friction"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&a.model.candidates, &gain, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_no_load_stays(&search, &a, &note));
    TEST_ASSERT_TRUE(!a.no_load_alone && has("friction") && has("cogging") && has("torque_gain"));
}

/* All of it: something under load that no effect is, and friction and cogging beyond doubt. */
static void test_whatever_is_wrong_under_load(void)
{
    record_idle(0.0);
    record_loads(4);
    for (size_t r = 4; r < 8; ++r)
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * P * run[r].theta_m_rad[k]);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.003, 0.05, term("cogging", "sine", 6.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.003, 0.04, term("friction", "coulomb", 0.0)->value);
}

/* Of the same runs, every torque with the opposite sign. */
static void reverse(void)
{
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k)
            run[r].torque_Nm[k] = -run[r].torque_Nm[k];
}

/* A sensor that counts the other way: nothing is made of it, and what it looks like is said. */
static void test_the_opposite_sign_under_load(void)
{
    char text[2048];
    record(N, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    record(N, &(point){60.0, 3.0, 0.0, 0.0, 0.0});
    record(N, &(point){-60.0, 6.0, 0.0, 0.0, 0.0});
    record(N, &(point){120.0, -5.0, 0.0, 0.0, 0.0});
    reverse();
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    hci_diagnosis_words(&diagnosis, text, sizeof text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "with the opposite sign: see with `check`"), text);
}

/* ---- the opposite sign */

/* Three currents; the torque that is read is so much times that of the machine, and another torque. */
static void record_times(double gain, double other_Nm)
{
    static const double IQ_A[] = {2.0, 9.0, -4.0};
    for (size_t r = 0; r < 3; ++r) {
        record(N, &(point){60.0 + 20.0 * (double)r, IQ_A[r], 0.0, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] = gain * run[r].torque_Nm[k] + other_Nm;
    }
}

static bool is_opposite(void)
{
    bool opposite = false;
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_opposite(&search, &opposite, &note));
    return opposite;
}

static bool is_opposite_times(double gain, double other_Nm)
{
    tearDown();
    setUp();
    record_times(gain, other_Nm);
    return is_opposite();
}

/* Effects may change it by half, whatever the zero of the sensor is. */
static void test_how_opposite_a_torque_is(void)
{
    static const double GAIN[] = {-1.52, -1.48, -1.0, -0.52, -0.48, 0.5, 1.0};
    for (size_t k = 0; k < 7; ++k) {
        TEST_ASSERT_EQUAL(k >= 1 && k <= 3, is_opposite_times(GAIN[k], 0.0));
        TEST_ASSERT_EQUAL(k >= 1 && k <= 3, is_opposite_times(GAIN[k], 3.0));
        TEST_ASSERT_EQUAL(k >= 1 && k <= 3, is_opposite_times(GAIN[k], -4.0));
    }
}

/* What is along it of the torque must be nearly all of that: 0.94 and 0.96, with waves along the turn that
 * have nothing to do with the currents. */
static void test_a_torque_of_something_else(void)
{
    for (int most = 0; most < 2; ++most) {
        const double along = most ? 0.96 : 0.94;
        double sum = 0.0, square = 0.0;
        tearDown();
        setUp();
        record_times(-1.0, 0.0);
        for (size_t r = 0; r < 3; ++r)
            for (size_t k = 0; k < N; ++k) {
                sum += run[r].torque_Nm[k] / (3.0 * N);
                square += run[r].torque_Nm[k] * run[r].torque_Nm[k] / (3.0 * N);
            }
        const double wave_Nm = sqrt(2.0 * (square - sum * sum) * (1.0 / (along * along) - 1.0));
        for (size_t r = 0; r < 3; ++r)
            for (size_t k = 0; k < N; ++k)
                run[r].torque_Nm[k] += wave_Nm * sin(run[r].theta_m_rad[k]);
        TEST_ASSERT_EQUAL(most, is_opposite());
    }
}

/* Runs of less than a hundredth of the largest current in use say nothing of it, whatever their torque is. */
static void test_of_runs_with_a_current(void)
{
    for (int more = 0; more < 2; ++more) {
        tearDown();
        setUp();
        record_times(-1.0, 0.0);
        record(N, &(point){60.0, more ? 0.0902 : 0.0898, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k)
            run[3].torque_Nm[k] += 50.0;
        TEST_ASSERT_EQUAL(!more, is_opposite());
    }
}

static void test_without_runs_nothing_is_opposite(void)
{
    static const bool NONE[MOST_RUNS] = {false}, ONE[MOST_RUNS] = {false, true};
    bool opposite = true;
    record_times(-1.0, 0.0);
    search_start();
    const bool *use = search.regression->use;
    search.regression->use = NONE;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_opposite(&search, &opposite, &note));
    TEST_ASSERT_FALSE(opposite);
    search.regression->use = ONE; /* of one torque all of the time nothing rises with another */
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_opposite(&search, &opposite, &note));
    TEST_ASSERT_FALSE(opposite);
    search.regression->use = use;
}

/* The declared cogging torque turned about is no cogging torque, where under load most is not understood
 * either; the friction of these runs is one whatever the angle is. */
static void test_a_slip_is_no_cogging(void)
{
    const hci_harmonic declared = {6.0, -0.05, 0.0};
    record_idle(0.0);
    for (size_t r = 0; r < 3; ++r)
        record(N, &(point){60.0, 3.0 + 2.0 * (double)r, 0.0, r % 2 ? 5.0 : -4.0, 0.5});
    machine.model.cogging = &declared;
    machine.model.cogging_count = 1;
    const hci_status status = diagnose(NULL);
    machine.model.cogging_count = 0;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, status);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("cogging")->verdict);
    TEST_ASSERT_NOT_NULL(diagnosis.slip);
}

static void test_without_such_runs(void)
{
    record_loads(3);
    find();
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&a.model.candidates));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_they_show_their_effects);
    RUN_TEST(test_something_is_left_for_all_runs);
    RUN_TEST(test_what_they_do_not_tell_is_left_to_all);
    RUN_TEST(test_what_is_no_noise_shows_nothing);
    RUN_TEST(test_as_many_values_as_runs_prove_nothing);
    RUN_TEST(test_what_they_show_stays);
    RUN_TEST(test_what_swings_is_not_certain);
    RUN_TEST(test_what_has_left_comes_back);
    RUN_TEST(test_whatever_is_wrong_under_load);
    RUN_TEST(test_the_opposite_sign_under_load);
    RUN_TEST(test_how_opposite_a_torque_is);
    RUN_TEST(test_a_torque_of_something_else);
    RUN_TEST(test_of_runs_with_a_current);
    RUN_TEST(test_without_runs_nothing_is_opposite);
    RUN_TEST(test_a_slip_is_no_cogging);
    RUN_TEST(test_without_such_runs);
    return UNITY_END();
}
