/* What is found in recordings in which one thing is hidden that the tables of the machine do not say, or
 * nothing. */
#include "hci/host/report/write.h"
#include "host/base/memory.h"

#include "support/diagnosing.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Within three standard errors, and those are what so many samples of so much noise allow, or not much more.
 */
static void is_value(double expected, double deviation, const hci_effect_term *t)
{
    TEST_ASSERT_TRUE(t->std_error > 0.7 * deviation && t->std_error < 1.6 * deviation);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, expected, t->value);
}

static void test_nothing_is_missing(void)
{
    record_map(0.0, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(diagnosis.findings, count_of(HCI_FINDING_REJECTED));
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_EQUAL_UINT64(4, diagnosis.runs);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm); /* 1800 samples: ± 1.7 % */
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM, diagnosis.noise_Nm);
    TEST_ASSERT_TRUE(isnan(diagnosis.holdout_after_Nm));
}

/* What is wrong in a run that is held out shows in its error and nowhere else. */
static void test_a_run_held_out_takes_no_part(void)
{
    record_map(0.0, 0.0);
    record(450, &(point){60.0, 2.0, 0.0, 0.05, 0.0});
    role[4] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * 0.05, sqrt(0.0025 + NOISE_NM * NOISE_NM), diagnosis.holdout_after_Nm);
}

/* One run is held out: it takes no part, and gets better all the same. */
static void test_current_offset(void)
{
    record_map(0.3, 0.0);
    record(450, &(point){-40.0, 5.0, 0.3, 0.0, 0.0});
    role[4] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("current_offset")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
    TEST_ASSERT_EQUAL_STRING("current_offset", diagnosis.finding[0].effect);
    is_value(0.3, NOISE_NM / (K_NM_PER_A * sqrt(1800.0 / 2.0)), term("current_offset", "a", 0.0));
    const double wave = 0.3 * K_NM_PER_A / sqrt(2.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, sqrt(wave * wave + NOISE_NM * NOISE_NM),
                              diagnosis.rms_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * NOISE_NM, NOISE_NM, diagnosis.holdout_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, wave * wave / (wave * wave + NOISE_NM * NOISE_NM),
                              found("current_offset")->residual_share);
    TEST_ASSERT_TRUE(diagnosis.run[4].role == HCI_ROLE_HOLDOUT && diagnosis.run[4].rms_before_Nm > wave);
}

/* Noisy currents make a noisy torque of the model, and a slow sensor in the model would smooth that: it is no
 * finding. */
static void test_noise_of_currents_is_no_sensor(void)
{
    for (int k = 0; k < 2; ++k) {
        record(600, &(point){k == 0 ? 60.0 : -150.0, 2.0 + 5.0 * k, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 1800; ++j)
            run[k].i_A[j] += 0.02 * ref_normal(&seed);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
}

/* The current that holds a shaft against a torque, turned slowly there and back twice round; none is
 * measured. */
static void hold(double coulomb_Nm, double cogging_Nm, double irregular_Nm)
{
    hci_run *r = add_run(2400);
    r->torque_source = HCI_TORQUE_HOLDING;
    for (size_t k = 0; k < r->count; ++k) {
        const bool back = k >= r->count / 2;
        const double x = (double)(back ? r->count - 1 - k : k) / 600.0, theta_m = 2.0 * REF_PI * x;
        const double torque = (back ? -coulomb_Nm : coulomb_Nm) - cogging_Nm * sin(6.0 * P * theta_m) -
                              0.5 * cogging_Nm * cos(2.0 * P * theta_m) +
                              irregular_Nm * sin(0.002 * (double)k + 9.0 * sin(0.0007 * (double)k));
        r->time_s[k] = 0.02 * (double)k;
        r->theta_m_rad[k] = theta_m;
        r->speed_rad_per_s[k] = (back ? -2.0 : 2.0) * REF_PI / 600.0 / 0.02;
        rec_phases(0.0, torque / (1.5 * K_NM_PER_A) + 0.01 * ref_normal(&seed), P * theta_m, r->i_A + 3 * k);
    }
}

static void test_holding_map(void)
{
    hold(0.08, 0.1, 0.0);
    diagnose(NULL);
    const double deviation = 1.5 * K_NM_PER_A * 0.01 / sqrt(2400.0); /* of a mean */
    is_value(0.1, sqrt(2.0) * deviation, term("cogging", "sine", 6.0));
    is_value(0.05, sqrt(2.0) * deviation, term("cogging", "cosine", 2.0));
    is_value(0.08, deviation, term("friction", "coulomb", 0.0));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, diagnosis.effects.list.count);
}

/* An angle that is a quarter of a period off would make no torque of any current: no explanation. */
static void test_holding_map_says_nothing_of_the_angle(void)
{
    hold(0.0, 0.0, 0.1);
    diagnose(NULL);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
}

/* At one speed and in one direction friction and a wrong zero of the torque sensor are one and the same. */
static void test_friction_or_zero_of_the_sensor(void)
{
    for (int k = 0; k < 3; ++k)
        record(450, &(point){60.0, 3.0 * k, 0.0, 0.05, 0.0});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("torque_sensor")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, count_of(HCI_FINDING_AMBIGUOUS));
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.effects.list.count);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
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

/* ---- what is not believed ---- */

static void refused(const char *why)
{
    const hci_effects none = {NULL, 0};
    hci_note said = {{0}};
    hci_diagnosis_release(&diagnosis);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_diagnose(&machine, &none, &runs, &options, &diagnosis, &said));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(said.text, why), said.text);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count);
    TEST_ASSERT_NULL(diagnosis.run);
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

static void test_a_shaft_with_a_load_is_not_free(void)
{
    record_loaded();
    refused("run_1.csv: found no torque_Nm and no free shaft: by the model the current makes 0.9 N·m");
}

/* In a large machine the same torque could be its drag; then magnets that are cancelled are still no answer.
 */
static void test_magnets_are_not_cancelled(void)
{
    record_loaded();
    machine.rated_current_A = 40.0;
    refused("not believable; run `check`");
    refused("drives a load");
}

/* Amperes where N·m were wanted, that is a sensor's factor of a tenth, for one. */
static void test_a_tenth_of_the_magnets_is_not_believed(void)
{
    record_map(0.0, 0.0);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k)
            run[r].torque_Nm[k] *= 0.1;
    refused("found recordings of 0.03 N·m per ampere of i_q, expected about 0.3");
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_missing);
    RUN_TEST(test_a_run_held_out_takes_no_part);
    RUN_TEST(test_current_offset);
    RUN_TEST(test_noise_of_currents_is_no_sensor);
    RUN_TEST(test_holding_map);
    RUN_TEST(test_holding_map_says_nothing_of_the_angle);
    RUN_TEST(test_friction_or_zero_of_the_sensor);
    RUN_TEST(test_what_does_not_repeat);
    RUN_TEST(test_machine_and_findings_agree);
    RUN_TEST(test_a_shaft_with_a_load_is_not_free);
    RUN_TEST(test_magnets_are_not_cancelled);
    RUN_TEST(test_a_tenth_of_the_magnets_is_not_believed);
    RUN_TEST(test_weak_magnets_are_believed);
    RUN_TEST(test_words_tell_a_torque_of_inertia);
    return UNITY_END();
}
