/* labels: slow */
/* What is found in recordings of thousands of samples, and every allocation failing: half a second each,
 * which sanitizers make ten. test_diagnose has the same in small. */
#include "hci/host/diagnose/diagnose.h"

#include "host/machine/torque_constant.h"
#include "support/diagnosing.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* An angle that is a quarter of a period off would make no torque of any current: no explanation. */
static void test_holding_map_says_nothing_of_the_angle(void)
{
    record_holding(2400, 0.0, 0.0, 0.1);
    diagnose(NULL);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
}

/* A wave that is odd in time, the same in each run: a growth that no effect has and Coulomb friction each
 * take a part, and what stands in the machine has to stand among the findings (diagnose() looks). */
static void test_machine_and_findings_agree(void)
{
    static const double SPEED[] = {60.0, -150.0}, CURRENT[] = {0.0, 4.0};
    for (int k = 0; k < 4; ++k) {
        record(800, &(point){SPEED[k / 2], CURRENT[k % 2], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 800; ++j) {
            const double x = 0.75 * run[k].theta_m_rad[j];
            run[k].torque_Nm[j] += 0.2 * sin(0.37 * x + 5.0 * sin(0.211 * x));
        }
    }
    diagnose(NULL);
}

static void test_what_does_not_repeat(void)
{
    for (int k = 0; k < 2; ++k)
        record(900, &(point){k == 1 ? -150.0 : 60.0, 4.0 * k, 0.0, 0.0, 0.2});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_STRING("unknown", diagnosis.finding[0].effect);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_EQUAL_DOUBLE(diagnosis.rms_before_Nm, diagnosis.rms_after_Nm);
}

/* ---- what is not believed ---- */

/* The model that takes the magnets away is left out by name, and what the machine gets makes as much torque
 * per ampere as before, or nearly. */
static void left_out(const char *effect)
{
    char words[2048];
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    TEST_ASSERT_EQUAL_STRING(effect, diagnosis.disbelieved);
    TEST_ASSERT_TRUE(diagnosis.disbelieved_share < 0.5);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "not plausible"), words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "`check`"), words);
    TEST_ASSERT_TRUE(hci_torque_constant(&machine.model, &diagnosis.effects.list) > 0.5 * 0.3);
    TEST_ASSERT_NOT_NULL(diagnosis.run);
}

/* A log at constant speed: the load was not recorded, and inertia × acceleration is next to nothing. */
static void record_loaded(void)
{
    for (int k = 0; k < 2; ++k) {
        record(450, &(point){k == 0 ? 60.0 : 90.0, 2.0 + k, 0.0, 0.0, 0.0});
        run[k].torque_source = HCI_TORQUE_INERTIA;
        for (size_t j = 0; j < 450; ++j)
            run[k].torque_Nm[j] = 1e-6 * ref_normal(&seed);
    }
}

/* In a large machine the same torque could be its drag, which is a better answer than magnets that are
 * cancelled. */
static void test_magnets_are_not_cancelled(void)
{
    record_loaded();
    machine.rated_current_A = 40.0;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("friction")->verdict);
    TEST_ASSERT_TRUE(hci_torque_constant(&machine.model, &diagnosis.effects.list) > 0.5 * 0.3);
}

/* Amperes where N·m were wanted, that is a sensor's factor of a tenth, for one. */
static void test_a_tenth_of_the_magnets_is_not_believed(void)
{
    record_map(0.0, 0.0);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k)
            run[r].torque_Nm[k] *= 0.1;
    left_out("back_emf");
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1, diagnosis.disbelieved_share);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
}

/* A quarter less is what weak magnets do. */
static void test_weak_magnets_are_believed(void)
{
    record_map(0.0, 0.0);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k)
            run[r].torque_Nm[k] *= 0.75;
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, -0.05, term("back_emf", "sine", 1.0)->value);
}

/* i_q that swings, and a speed that follows it against a small friction. */
static void test_words_tell_a_torque_of_inertia(void)
{
    static const double TORQUE_Nm = 0.3, FRICTION_Nm = 0.05;
    char words[2048];
    record(3000, &(point){60.0, 1.0, 0.0, 0.0, 0.0});
    run[0].torque_source = HCI_TORQUE_INERTIA;
    for (size_t k = 0; k < 3000; ++k) {
        const double iq = sin(0.011 * (double)k);
        rec_phases(0.0, iq, P * run[0].theta_m_rad[k], run[0].i_A + 3 * k);
        run[0].torque_Nm[k] = TORQUE_Nm * iq - FRICTION_Nm + 0.01 * ref_normal(&seed);
    }
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, "The torque of 1 of 1 runs is inertia x acceleration"), words);
}

/* ---- memory ---- */

/* The first and the last allocations fail one by one, those between in larger steps. */
static void test_memory_is_out(void)
{
    long n = 0;
    record(140, &(point){60.0, 2.0, 0.3, 0.0, 0.0});
    record(140, &(point){-60.0, 6.0, 0.3, 0.0, 0.0});
    while (diagnose_with(n) == HCI_ERROR_MEMORY)
        n += n < 40 ? 1 : n / 15;
    for (long k = n - n / 15; diagnose_with(k) == HCI_ERROR_MEMORY; ++k)
        TEST_ASSERT_TRUE(k < n);
    TEST_ASSERT_TRUE(n > 150);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_holding_map_says_nothing_of_the_angle);
    RUN_TEST(test_machine_and_findings_agree);
    RUN_TEST(test_what_does_not_repeat);
    RUN_TEST(test_magnets_are_not_cancelled);
    RUN_TEST(test_a_tenth_of_the_magnets_is_not_believed);
    RUN_TEST(test_weak_magnets_are_believed);
    RUN_TEST(test_words_tell_a_torque_of_inertia);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
