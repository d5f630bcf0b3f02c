/* One recording that disagrees with all others is named first and taken out, and the others are answered for;
 * a recording that alone shows something is none. */
#include "host/diagnose/odd_run.h"
#include "support/diagnosing.h"

static const hci_effects none = {NULL, 0};

enum { SAMPLES = 450, RUNS = 8, ODD = 5 };

static char text[2048];

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* There and back at 2, 5 and 8 A. */
static void record_all(double brake_Nm)
{
    for (size_t k = 0; k < RUNS; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0;
        record(SAMPLES, &(point){sign * (60.0 + 15.0 * (double)(k % 5)), 2.0 + 3.0 * (double)(k % 3), 0.0,
                                 sign * brake_Nm, 0.0});
    }
}

static void swap_b_and_c(hci_run *r)
{
    for (size_t k = 0; k < r->count; ++k) {
        const double b = r->i_A[3 * k + 1];
        r->i_A[3 * k + 1] = r->i_A[3 * k + 2];
        r->i_A[3 * k + 2] = b;
    }
}

static void scale(hci_run *r, double of_current, double of_torque)
{
    for (size_t k = 0; k < r->count; ++k) {
        r->torque_Nm[k] *= of_torque;
        for (size_t s = 0; s < 3; ++s)
            r->i_A[3 * k + s] *= of_current;
    }
}

static void turn(hci_run *r, double angle_rad)
{
    for (size_t k = 0; k < r->count; ++k)
        r->theta_m_rad[k] += angle_rad;
}

/* That it is the odd one, and its slip in words; the others are as declared. */
static void is_odd(size_t k, const char *slip)
{
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_STRING(run[k].name, diagnosis.odd.file);
    hci_diagnosis_words(&diagnosis, text, sizeof text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, slip), text);
    TEST_ASSERT_EQUAL_PTR(text, strstr(text, "Only run_"));
    TEST_ASSERT_EQUAL_UINT64(RUNS - 1, diagnosis.runs);
}

static void test_swapped_phases(void)
{
    record_all(0.0);
    swap_b_and_c(&run[ODD]);
    is_odd(ODD, "phases b and c are swapped");
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_TRUE(diagnosis.odd.mended);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, NOISE_NM, diagnosis.odd.mended_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, NOISE_NM, diagnosis.odd.others_Nm);
}

static void test_units_and_signs(void)
{
    record_all(0.0);
    scale(&run[ODD], 1.0, 100.0);
    is_odd(ODD, "100 times too large");
    hci_diagnosis_release(&diagnosis);
    scale(&run[ODD], 1.0, -0.01);
    is_odd(ODD, "other sign");
    hci_diagnosis_release(&diagnosis);
    scale(&run[ODD], sqrt(0.5), -1.0);
    is_odd(ODD, "rms values");
}

/* A ripple that is declared tells an angle. */
static void record_with_cogging(void)
{
    hci_note note = {{0}};
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.1,0\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    record_all(0.0);
    for (size_t k = 0; k < RUNS; ++k)
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] += 0.1 * sin(6.0 * P * run[k].theta_m_rad[j]);
}

static void test_another_index(void)
{
    record_with_cogging();
    turn(&run[ODD], 0.06);
    is_odd(ODD, "its angle is ahead by");
    TEST_ASSERT_TRUE(diagnosis.odd.mended);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.06, diagnosis.odd.angle_rad);
}

/* Without one the only run that has an i_d, as it stands, may as well show a saliency. */
static void test_an_index_that_iron_may_be(void)
{
    record_all(0.0);
    turn(&run[ODD], 0.2);
    diagnose(NULL);
    TEST_ASSERT_NULL(diagnosis.odd.file);
}

/* What no slip makes is said without one. */
static void test_anything_else(void)
{
    record_all(0.0);
    for (size_t k = 0; k < SAMPLES; ++k)
        run[ODD].torque_Nm[k] += 0.3 * sin(2.0 * run[ODD].theta_m_rad[k]);
    is_odd(ODD, "would do it");
    TEST_ASSERT_FALSE(diagnosis.odd.mended);
}

static void test_a_run_held_out(void)
{
    record_all(0.0);
    role[ODD] = HCI_ROLE_HOLDOUT;
    swap_b_and_c(&run[ODD]);
    is_odd(ODD, "phases b and c are swapped");
}

/* Effects of the others are found without it. */
static void test_beside_an_effect(void)
{
    record_all(0.05);
    swap_b_and_c(&run[ODD]);
    is_odd(ODD, "phases b and c are swapped");
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.05, term("friction", "coulomb", 0.0)->value);
}

static void is_not_odd(void)
{
    diagnose(NULL);
    TEST_ASSERT_NULL(diagnosis.odd.file);
    TEST_ASSERT_EQUAL_UINT64(runs.count, diagnosis.runs);
}

/* Iron that saturates, at the only large current. */
static void test_the_only_load_is_not_odd(void)
{
    record_all(0.0);
    record(SAMPLES, &(point){60.0, 20.0, 0.0, 0.5, 0.0});
    is_not_odd();
}

/* One operating point of iron with the co-energy c d q² and e d² q²: the second is nothing where d or q is 0.
 */
static void record_iron(double d, double q, double speed)
{
    record(SAMPLES, &(point){speed, q, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    const double c = -3e-4, e = 1e-3;
    for (size_t k = 0; k < r->count; ++k) {
        rec_phases(d, q, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] +=
            P * (c * (q * q * q - 2.0 * d * d * q) + 2.0 * e * (d * q * q * q - d * d * d * q));
    }
}

/* Iron that saturates, between currents along d and along q that the others have. */
static void test_iron_beyond_the_others_is_not_odd(void)
{
    static const double POINT_A[][2] = {{0.0, 2.0}, {0.0, -5.0}, {0.0, 8.0}, {-8.0, 0.0},
                                        {0.0, 5.0}, {0.0, -8.0}, {0.0, 0.0}, {-5.0, 6.0}};
    for (size_t k = 0; k < sizeof POINT_A / sizeof *POINT_A; ++k)
        record_iron(POINT_A[k][0], POINT_A[k][1], k % 2 ? -60.0 : 60.0);
    is_not_odd();
}

/* A drag at the only high speed, and in the only direction. */
static void test_the_only_speed_is_not_odd(void)
{
    record_all(0.0);
    record(SAMPLES, &(point){400.0, 5.0, 0.0, 0.3, 0.0});
    is_not_odd();
}

static void test_the_only_direction_is_not_odd(void)
{
    for (size_t k = 0; k < 6; ++k)
        record(SAMPLES, &(point){60.0 + 10.0 * (double)k, 5.0, 0.0, 0.0, 0.0});
    record(SAMPLES, &(point){-70.0, 5.0, 0.0, -0.3, 0.0});
    is_not_odd();
}

static void test_the_only_warm_run_is_not_odd(void)
{
    record_all(0.0);
    for (size_t k = 0; k < RUNS; ++k) {
        run[k].temperature_C = calloc(SAMPLES, sizeof(double));
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].temperature_C[j] = k == ODD ? 80.0 : 20.0;
    }
    scale(&run[ODD], 1.0, 0.9);
    is_not_odd();
}

/* What no effect makes, in a state that others have, and no larger than what their friction makes: it takes
 * nothing away from what they say. */
static void test_one_run_more_takes_no_answer_away(void)
{
    record_all(0.05);
    record(SAMPLES, &(point){70.0, 5.0, 0.0, 0.05, 0.18});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_STRING(run[RUNS].name, diagnosis.odd.file);
    TEST_ASSERT_TRUE(diagnosis.odd.is_aside);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.05, term("friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.18 * sqrt(0.5), diagnosis.odd.rms_Nm);
    hci_diagnosis_words(&diagnosis, text, sizeof text);
    TEST_ASSERT_EQUAL_PTR(text, strstr(text, "With run_8.csv the recordings are not explained"));
}

/* A torque of the other sign in the only two runs with a current is a slip of all. */
static void test_a_sign_that_no_other_run_tells(void)
{
    for (size_t k = 0; k < 6; ++k)
        record(SAMPLES, &(point){60.0 + 10.0 * (double)k, k == 3 ? 8.0 : 0.0, 0.0, 0.0, 0.0});
    scale(&run[3], 1.0, -1.0);
    is_not_odd();
}

static void test_recordings_that_agree(void)
{
    record_all(0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_NULL(diagnosis.odd.file);
}

/* What the effects of the others make of it. */
static hci_status ask(size_t k, const hci_effects *effects)
{
    hci_suspect suspect;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_suspect_make(&machine, &none, &runs, run[k].name, &suspect, &note));
    const hci_status status = hci_suspect_ask(&suspect, effects, &note);
    hci_suspect_release(&suspect);
    return status;
}

static void test_a_suspicion_falls_once_the_others_explain_it(void)
{
    const hci_effect_type *type = hci_effect_type_find("friction");
    hci_effect_term coulomb = {0, 0.0, 0.05, NAN};
    const hci_effect friction = {type, &coulomb, 1};
    const hci_effects brake = {&friction, 1};
    record_all(0.05);
    TEST_ASSERT_EQUAL_STRING("coulomb", type->parameter[0].name);
    TEST_ASSERT_EQUAL_INT(HCI_OK, ask(ODD, &none));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_STOPPED, ask(ODD, &brake));
    swap_b_and_c(&run[ODD]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, ask(ODD, &brake));
}

/* What the others show may not hold where one of them is not. */
static void test_a_suspicion_falls_where_the_others_tell_nothing(void)
{
    const hci_effect_type *type = hci_effect_type_find("friction");
    hci_effect_term viscous = {1, 0.0, 0.01, NAN};
    const hci_effect friction = {type, &viscous, 1};
    const hci_effects brake = {&friction, 1};
    record_all(0.0);
    swap_b_and_c(&run[ODD]);
    TEST_ASSERT_EQUAL_STRING("viscous", type->parameter[1].name);
    TEST_ASSERT_EQUAL_INT(HCI_OK, ask(ODD, &brake));
    viscous.value = 0.2;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_STOPPED, ask(ODD, &brake));
}

/* ---- whose mean is off ---- */

static void add(hci_run *r, double constant_Nm)
{
    for (size_t k = 0; k < r->count; ++k)
        r->torque_Nm[k] += constant_Nm;
}

/* And four more forward, so that each state is told by several. */
static void record_more(double brake_Nm)
{
    record_all(brake_Nm);
    for (int k = 0; k < 4; ++k)
        record(SAMPLES, &(point){60.0 + 15.0 * k, k % 2 ? 8.0 : 2.0, 0.0, brake_Nm, 0.0});
}

/* Within four times the noise, so that it does not stand out by itself. */
static void test_a_zero_that_is_another_one(void)
{
    record_more(0.1);
    add(&run[6], 0.03);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_STRING(run[6].name, diagnosis.odd.file);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * hypot(diagnosis.odd.mean_error_Nm, diagnosis.odd.mean_open_Nm), 0.03,
                              diagnosis.odd.mean_Nm);
    TEST_ASSERT_TRUE(hypot(diagnosis.odd.mean_error_Nm, diagnosis.odd.mean_open_Nm) < 0.005);
    TEST_ASSERT_FALSE(diagnosis.odd.mean_is_untold);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(RUNS + 4 - 1, diagnosis.runs);
    hci_diagnosis_words(&diagnosis, text, sizeof text);
    TEST_ASSERT_NOT_NULL_MESSAGE(
        strstr(text,
               "Only the mean torque of run_6.csv disagrees with the others: it is 0.0297 ± 0.0003 N·m "),
        text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "above that of the machine that explains all of them"), text);
}

/* Of two runs at the largest current either one may be off, or the iron there saturates. */
static void test_a_zero_that_is_one_of_two(void)
{
    record_all(0.1);
    add(&run[ODD], 0.03);
    (void)diagnose(NULL);
    TEST_ASSERT_NULL(diagnosis.odd.file);
}

/* Without either of two no machine explains the others. */
static void test_two_zeros_that_are_others(void)
{
    record_more(0.1);
    add(&run[6], 0.03);
    add(&run[1], -0.025);
    (void)diagnose(NULL);
    TEST_ASSERT_NULL(diagnosis.odd.file);
}

/* At a speed of its own what drives is no friction, and what brakes may be one. */
static void test_a_zero_at_a_speed_of_its_own(void)
{
    for (int drives = 0; drives < 2; ++drives) {
        runs.count = 0;
        hci_diagnosis_release(&diagnosis);
        for (size_t k = 0; k < MOST_RUNS; ++k)
            rec_release(&run[k]);
        record_more(0.1);
        rec_release(&run[--runs.count]);
        record(SAMPLES, &(point){140.0, 5.0, 0.0, drives ? 0.07 : 0.13, 0.0});
        (void)diagnose(NULL);
        TEST_ASSERT_EQUAL_MESSAGE(drives, diagnosis.odd.file == run[MOST_RUNS - 1].name,
                                  drives ? "drives" : "brakes");
        if (!drives) continue;
        TEST_ASSERT_TRUE(diagnosis.odd.mean_is_untold);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * hypot(diagnosis.odd.mean_error_Nm, diagnosis.odd.mean_open_Nm), 0.03,
                                  diagnosis.odd.mean_Nm);
        hci_diagnosis_words(&diagnosis, text, sizeof text);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "which no other recording has"), text);
    }
}

static void test_memory(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    record_all(0.0);
    swap_b_and_c(&run[ODD]);
    for (int k = 0; k < 400 && status == HCI_ERROR_MEMORY; k = k < 100 ? k + 1 : k + 7) {
        hci_note note = {{0}};
        hci_memory_fail_after(k);
        status = hci_diagnose(&machine, &none, &runs, &options, &diagnosis, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status != HCI_ERROR_MEMORY || !diagnosis.run);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_swapped_phases);
    RUN_TEST(test_units_and_signs);
    RUN_TEST(test_another_index);
    RUN_TEST(test_an_index_that_iron_may_be);
    RUN_TEST(test_anything_else);
    RUN_TEST(test_a_run_held_out);
    RUN_TEST(test_beside_an_effect);
    RUN_TEST(test_the_only_load_is_not_odd);
    RUN_TEST(test_iron_beyond_the_others_is_not_odd);
    RUN_TEST(test_the_only_speed_is_not_odd);
    RUN_TEST(test_the_only_direction_is_not_odd);
    RUN_TEST(test_the_only_warm_run_is_not_odd);
    RUN_TEST(test_one_run_more_takes_no_answer_away);
    RUN_TEST(test_a_sign_that_no_other_run_tells);
    RUN_TEST(test_recordings_that_agree);
    RUN_TEST(test_a_suspicion_falls_once_the_others_explain_it);
    RUN_TEST(test_a_suspicion_falls_where_the_others_tell_nothing);
    RUN_TEST(test_a_zero_that_is_another_one);
    RUN_TEST(test_a_zero_that_is_one_of_two);
    RUN_TEST(test_two_zeros_that_are_others);
    RUN_TEST(test_a_zero_at_a_speed_of_its_own);
    RUN_TEST(test_memory);
    return UNITY_END();
}
