/* What is found in recordings in which one thing is hidden that the tables of the machine do not say, or
 * nothing. */
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

static const char *phases_are_swapped(void *asked)
{
    ++*(int *)asked;
    return "phases b and c are swapped";
}

/* Whether something is wrong with the files is asked where the machine is far off, and no effect is looked
 * for then. */
static void test_a_slip_is_not_searched(void)
{
    int asked = 0;
    char words[2048];
    options.slip = phases_are_swapped;
    options.slip_context = &asked;
    record_map(0.3, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(0, asked);
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < run[r].count; ++k) {
            double *i = run[r].i_A + 3 * k;
            const double b = i[1];
            i[1] = i[2];
            i[2] = b;
        }
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(1, asked);
    TEST_ASSERT_TRUE(diagnosis.not_searched);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.effects.list.count + diagnosis.next_points);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    TEST_ASSERT_NOT_NULL(strstr(words, "No effect was looked for"));
    TEST_ASSERT_NOT_NULL(strstr(words, "phases b and c are swapped"));
}

/* What is wrong in a run that is held out is said of that run, and shows in nothing else. */
static void test_a_run_held_out_takes_no_part(void)
{
    record_map(0.0, 0.0);
    record(450, &(point){60.0, 2.0, 0.0, 0.05, 0.0});
    role[4] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_EQUAL_STRING(run[4].name, diagnosis.odd.file);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * 0.05, sqrt(0.0025 + NOISE_NM * NOISE_NM), diagnosis.odd.rms_Nm);
}

/* Beside a noise that is half of the rated torque nothing is called complete. */
static void test_noise_as_large_as_the_rated_torque(void)
{
    record_map(0.0, 0.0);
    machine.rated_torque_Nm = 2.0 * NOISE_NM;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * NOISE_NM, diagnosis.drowned_Nm);
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

static void test_holding_map(void)
{
    record_holding(1200, 0.08, 0.1, 0.0);
    diagnose(NULL);
    const double deviation = 1.5 * K_NM_PER_A * 0.01 / sqrt(1200.0); /* of a mean */
    is_value(0.1, sqrt(2.0) * deviation, term("cogging", "sine", 6.0));
    is_value(0.05, sqrt(2.0) * deviation, term("cogging", "cosine", 2.0));
    is_value(0.08, deviation, term("friction", "coulomb", 0.0));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_UINT64(2, diagnosis.effects.list.count);
}

/* Twice the pole pairs: what is declared stands at half its orders, and no cogging torque is made of it. */
static void test_holding_map_of_other_pole_pairs(void)
{
    static const hci_harmonic DECLARED[] = {{4.0, 0.0, 0.05}, {12.0, 0.1, 0.0}};
    record_holding(1200, 0.08, 0.1, 0.0);
    machine.model.cogging = DECLARED;
    machine.model.cogging_count = 2;
    const hci_status status = diagnose(NULL);
    machine.model.cogging_count = 0;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, status);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("cogging")->verdict);
    TEST_ASSERT_NOT_NULL(diagnosis.slip);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.slip, "pole pairs"), diagnosis.slip);
}

/* The current that turns a shaft slowly against a brake; the back-EMF is cosine_Nm_per_A of order 6 stronger.
 */
static void record_brake(bool back, double brake_Nm, double cosine_Nm_per_A, double cogging_Nm)
{
    enum { SAMPLES = 1200 };
    hci_run *r = add_run(SAMPLES);
    r->torque_source = HCI_TORQUE_HOLDING;
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double x = 2.0 * REF_PI * (double)k / (0.5 * SAMPLES), theta_m = back ? -x : x;
        const double torque_Nm = (back ? -brake_Nm : brake_Nm) - cogging_Nm * sin(6.0 * P * theta_m);
        const double Nm_per_A = 1.5 * K_NM_PER_A + cosine_Nm_per_A * cos(6.0 * P * theta_m);
        r->time_s[k] = 0.02 * (double)k;
        r->theta_m_rad[k] = theta_m;
        r->speed_rad_per_s[k] = (back ? -2.0 : 2.0) * REF_PI / (0.5 * SAMPLES) / 0.02;
        rec_phases(0.0, torque_Nm / Nm_per_A + 0.01 * ref_normal(&seed), P * theta_m, r->i_A + 3 * k);
    }
}

/* With the load the ripple of the back-EMF turns its sign, and cogging torque does not. */
static void test_back_emf_against_a_brake(void)
{
    const double Nm_per_A = 0.02 * 1.5 * K_NM_PER_A;
    record_brake(false, 2.0, Nm_per_A, 0.02);
    record_brake(true, 2.0, Nm_per_A, 0.02);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    const double deviation = sqrt(2.0) * 1.5 * K_NM_PER_A * 0.01 / sqrt(2400.0);
    is_value(0.02, deviation, term("cogging", "sine", 6.0));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("back_emf")->verdict);
    const hci_effect_term *t = term("back_emf", "sine", 5.0); /* or 7, which i_q alone does not tell */
    TEST_ASSERT_DOUBLE_WITHIN(4.5 * t->std_error, Nm_per_A, 1.5 * fabs(t->value));
    TEST_ASSERT_TRUE(t->std_error < 0.01 * Nm_per_A);
}

/* Friction explains no ripple, so that a large one beside it is not small for the friction's size. */
static void test_ripple_beside_friction(void)
{
    record_holding(2400, 2.0, 0.0, 0.1);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 2.0, term("friction", "coulomb", 0.0)->value);
}

/* A drag with the square of the current, there and back. */
static void test_iron_drag(void)
{
    for (int k = 0; k < 6; ++k) {
        const double speed = k < 3 ? 60.0 : -150.0, iq = 1.0 + 4.0 * (k % 3);
        record(450, &(point){speed, iq, 0.0, (speed < 0.0 ? -1.0 : 1.0) * 8e-4 * iq * iq, 0.0});
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("iron_drag")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    const hci_effect_term *t = term("iron_drag", "hysteresis", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, 8e-4, t->value);
    TEST_ASSERT_TRUE(t->std_error < 0.05 * 8e-4);
}

/* In one direction it could be reluctance or saturation, which keep their sign: it is not said then. */
static void test_iron_drag_takes_both_directions(void)
{
    for (int k = 0; k < 3; ++k) {
        const double iq = 1.0 + 4.0 * k;
        record(450, &(point){60.0, iq, 0.0, 8e-4 * iq * iq, 0.0});
    }
    diagnose(NULL);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("iron_drag")->verdict);
}

/* And a load in each of them: one without current the other way round says nothing of it. */
static void test_iron_drag_takes_loads_in_both_directions(void)
{
    for (int k = 0; k < 4; ++k) {
        const double iq = k < 3 ? 1.0 + 4.0 * k : 0.0;
        record(450, &(point){k < 3 ? 60.0 : -60.0, iq, 0.0, 8e-4 * iq * iq, 0.0});
    }
    diagnose(NULL);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("iron_drag")->verdict);
}

/* A resolver whose sine and cosine are not of one size: its angle is wrong twice in an electrical period. */
static void test_position_harmonics(void)
{
    for (int k = 0; k < 4; ++k) {
        record(450, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < run[k].count; ++j) {
            const double theta_m = run[k].theta_m_rad[j];
            rec_phases(6.0, k % 2 ? 9.0 : 2.0, P * theta_m,
                       run[k].i_A + 3 * j); /* i_d makes no torque here */
            run[k].theta_m_rad[j] += 0.04 * sin(2.0 * P * theta_m) / P;
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("position_harmonics")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    const hci_effect_term *t = term("position_harmonics", "sine", 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * t->std_error, 0.04, t->value);
    TEST_ASSERT_TRUE(t->std_error < 0.05 * 0.04);
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

/* ---- a load that nobody knows ---- */

/* Logs at constant speed: the load was not recorded, and inertia × acceleration is what cogging torque makes
 * of the speed, and noise. */
static void record_loaded(double cogging_Nm)
{
    for (int k = 0; k < 4; ++k) {
        record(900, &(point){k < 2 ? 60.0 : -90.0, 2.0 + k, 0.0, 0.0, 0.0});
        run[k].torque_source = HCI_TORQUE_INERTIA;
        for (size_t j = 0; j < 900; ++j)
            run[k].torque_Nm[j] =
                cogging_Nm * sin(6.0 * P * run[k].theta_m_rad[j] + 0.4) + NOISE_NM * ref_normal(&seed);
    }
}

static void test_the_mean_of_a_shaft_with_a_load_is_not_used(void)
{
    record_loaded(0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_TRUE(run[k].mean_is_unknown);
    TEST_ASSERT_NOT_NULL(strstr(run[3].remark.text, "the current makes 1.5 N·m on average"));
    TEST_ASSERT_NOT_NULL(strstr(run[0].remark.text, "another run drives a load"));
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_before_Nm);
}

static void test_the_ripple_of_a_shaft_with_a_load_is_used(void)
{
    record_loaded(0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    is_value(0.05 * cos(0.4), NOISE_NM / sqrt(3600.0 / 2.0), term("cogging", "sine", 6.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM, NOISE_NM, diagnosis.rms_after_Nm);
}

/* A free shaft: inertia × acceleration of a motor whose torque per ampere, or inertia, is off by a quarter.
 * sensor: the last run has a torque sensor. */
static void record_free(bool sensor)
{
    for (int k = 0; k < 4; ++k) {
        record(900, &(point){k % 2 ? 60.0 : -90.0, k < 2 ? 4.0 : -2.5, 0.0, 0.0, 0.0});
        run[k].torque_source = sensor && k == 3 ? HCI_TORQUE_MEASURED : HCI_TORQUE_INERTIA;
        for (size_t j = 0; j < 900; ++j)
            run[k].torque_Nm[j] -= 0.25 * 1.5 * K_NM_PER_A * (k < 2 ? 4.0 : -2.5);
    }
}

static void test_torque_per_ampere_or_inertia(void)
{
    char words[2000];
    record_free(false);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("back_emf")->verdict);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    TEST_ASSERT_NOT_NULL(strstr(words, "back-EMF and a wrong inertia apart"));
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.advice, "the voltages of the open terminals would tell"));
}

/* A ripple is none of the ratio: it is beside it and certain. */
static void test_a_ripple_is_no_wrong_inertia(void)
{
    record_free(false);
    for (int k = 0; k < 4; ++k)
        for (size_t j = 0; j < 900; ++j)
            run[k].torque_Nm[j] += 0.05 * sin(6.0 * P * run[k].theta_m_rad[j]);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
}

static void test_a_torque_sensor_tells_them(void)
{
    record_free(true);
    diagnose(NULL);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("back_emf")->verdict);
    TEST_ASSERT_FALSE(diagnosis.inertia_as_well);
}

/* One current: order 6 may be cogging torque, of which it is a usual order among very many, or back-EMF. */
static void test_cogging_at_one_current(void)
{
    record(6000, &(point){60.0, 9.0, 0.0, 0.0, 0.0});
    for (size_t j = 0; j < run[0].count; ++j) {
        const double theta_m = run[0].theta_m_rad[j] * 0.1; /* two turns */
        run[0].theta_m_rad[j] = theta_m;
        run[0].time_s[j] = theta_m / 60.0;
        rec_phases(0.0, 9.0, P * theta_m, run[0].i_A + 3 * j);
        run[0].torque_Nm[j] += 0.05 * sin(6.0 * P * theta_m + 0.4);
    }
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("cogging")->verdict);
    TEST_ASSERT_TRUE(diagnosis.next_points > 0);
}

/* Harmonics of the back-EMF beside the fundamental of 0.2 N·m/A, sin(nθ − nσ2πs/3), all of them a share
 * larger than declared, phase by phase. */
static void record_strong(const double share[3])
{
    static const double AMPLITUDE[] = {K_NM_PER_A, 0.02, 0.012, 0.008}, ORDER[] = {1.0, 5.0, 7.0, 11.0};
    hci_note note = {{0}};
    hci_machine_release(&machine);
    files_write(files_path("back_emf.csv"),
                "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n5,0.02,0\n7,0.012,0\n"
                "11,0.008,0\n");
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_read(files_root, &machine, &note));
    record_map(0.0, 0.0);
    for (size_t k = 0; k < runs.count; ++k)
        for (size_t j = 0; j < run[k].count; ++j) {
            run[k].torque_Nm[j] = NOISE_NM * ref_normal(&seed);
            for (size_t s = 0; s < 3; ++s)
                for (size_t h = 0; h < 4; ++h)
                    run[k].torque_Nm[j] +=
                        (1.0 + share[s]) * AMPLITUDE[h] * run[k].i_A[3 * j + s] *
                        sin(ORDER[h] * (P * run[k].theta_m_rad[j] - 2.0 * REF_PI * (double)s / 3.0));
        }
}

/* Stronger magnets, not three gains that are wrong alike: both are said, the back-EMF with its own values. */
static void test_equal_phases_are_a_back_emf(void)
{
    record_strong((double[]){0.25, 0.25, 0.25});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("phase_imbalance")->verdict);
    const char *value = strstr(found("back_emf")->detail, "in place of phase_imbalance: sine_1 = ");
    TEST_ASSERT_NOT_NULL(value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.25 * K_NM_PER_A, strtod(strchr(value, '=') + 1, NULL)); /* ± 2.4e-5 */
}

static void test_unequal_phases_are_not(void)
{
    record_strong((double[]){0.25, 0.15, 0.05});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          diagnose(NULL)); /* the gains of the current sensors look the same */
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found("phase_imbalance")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("back_emf")->verdict);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cogging_at_one_current);
    RUN_TEST(test_torque_per_ampere_or_inertia);
    RUN_TEST(test_a_ripple_is_no_wrong_inertia);
    RUN_TEST(test_a_torque_sensor_tells_them);
    RUN_TEST(test_equal_phases_are_a_back_emf);
    RUN_TEST(test_unequal_phases_are_not);
    RUN_TEST(test_nothing_is_missing);
    RUN_TEST(test_a_slip_is_not_searched);
    RUN_TEST(test_a_run_held_out_takes_no_part);
    RUN_TEST(test_noise_as_large_as_the_rated_torque);
    RUN_TEST(test_current_offset);
    RUN_TEST(test_noise_of_currents_is_no_sensor);
    RUN_TEST(test_holding_map);
    RUN_TEST(test_holding_map_of_other_pole_pairs);
    RUN_TEST(test_back_emf_against_a_brake);
    RUN_TEST(test_ripple_beside_friction);
    RUN_TEST(test_iron_drag);
    RUN_TEST(test_iron_drag_takes_both_directions);
    RUN_TEST(test_iron_drag_takes_loads_in_both_directions);
    RUN_TEST(test_position_harmonics);
    RUN_TEST(test_friction_or_zero_of_the_sensor);
    RUN_TEST(test_the_mean_of_a_shaft_with_a_load_is_not_used);
    RUN_TEST(test_the_ripple_of_a_shaft_with_a_load_is_used);
    return UNITY_END();
}
