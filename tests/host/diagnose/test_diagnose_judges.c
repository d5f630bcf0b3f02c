/* What a diagnosis concludes of figures by hand, on both sides of each bound. */
#include "host/diagnose/conclude.c"
#include "host/diagnose/diagnose.c"
#include "host/diagnose/fill_diagnosis.c"
#include "host/diagnose/left_open.c"
#include "host/diagnose/origin.c"

#include "unity.h"

enum { RUNS = 3 };

static hci_run run[RUNS];
static hci_role role[RUNS];
static hci_runs runs;
static hci_run_statistics statistics[RUNS];
static bool fitted[RUNS];
static hci_run_errors errors[RUNS];
static hci_residual_line lines[6];
static hci_machine_data machine;
static hci_diagnose_options options;
static hci_dataset b;
static hci_diagnosis d;
static hci_attribution a;

void setUp(void)
{
    memset(run, 0, sizeof run);
    memset(statistics, 0, sizeof statistics);
    memset(lines, 0, sizeof lines);
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&b, 0, sizeof b);
    memset(&d, 0, sizeof d);
    memset(&a, 0, sizeof a);
    for (size_t r = 0; r < RUNS; ++r) {
        role[r] = HCI_ROLE_FIT, fitted[r] = true;
        errors[r] = (hci_run_errors){.role = HCI_ROLE_FIT,
                                     .unrepeated_Nm = NAN,
                                     .rms_after_Nm = 0.5,
                                     .noise_floor_Nm = 0.3,
                                     .ripple_after_Nm = 0.5};
    }
    runs = (hci_runs){.run = run, .role = role, .count = RUNS};
    machine.model.pole_pairs = 4;
    machine.rated_torque_Nm = machine.rated_current_A = NAN;
    b.samples = (hci_binned_samples){.statistics = statistics, .run_count = RUNS};
    b.fit = fitted;
    b.regression.machine = &machine.model, b.regression.runs = run;
    b.regression.declared_constant = 0.5;
    d.run = errors, d.runs = RUNS, d.line = lines;
}

void tearDown(void)
{
}

/* ---- what was taken out ---- */

static void test_swings_are_told(void)
{
    for (size_t r = 0; r < 2; ++r) {
        statistics[r].swings = 1;
        statistics[r].swing[0] = (hci_swing){17.0, 0.01, 5.0 + 3.0 * (double)r, 0.3, 0.4};
    }
    d.swings = 7;
    swings_fill(&b.samples, &d);
    TEST_ASSERT_EQUAL_UINT64(1, d.swings);
    TEST_ASSERT_FALSE(d.swing[0].of_turn);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 17.0, d.swing[0].frequency);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, d.swing[0].amplitude_Nm);
    TEST_ASSERT_EQUAL_UINT64(2, d.swing[0].runs);
}

static void test_drifts_are_told(void)
{
    d.drifts = 5, d.drift_Nm = 9.0;
    drifts_fill(&b.samples, &d);
    TEST_ASSERT_TRUE(d.drifts == 0 && d.drift_Nm == 0.0);
    statistics[0].drift = (hci_drift){.degree = 1, .half_s = 1.0, .coefficient_Nm = {0.02}};
    statistics[2].drift = (hci_drift){.degree = 1, .half_s = 1.0, .coefficient_Nm = {-0.05}};
    drifts_fill(&b.samples, &d);
    TEST_ASSERT_EQUAL_UINT64(2, d.drifts);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1, d.drift_Nm);
}

static void test_zeros_are_told(void)
{
    d.zeros_read = 4;
    zeros_fill(&b.samples, &d);
    TEST_ASSERT_TRUE(d.zeros_read == 0 && d.zeros_read_A == 0.0);
    statistics[1] = (hci_run_statistics){.zeros_read = true, .standing_A = {0.1, -0.03, 0.02}};
    statistics[2] = (hci_run_statistics){.zeros_read = true, .standing_A = {0.0, 0.02, -0.2}};
    statistics[0].standing_A[1] = 7.0;
    zeros_fill(&b.samples, &d);
    TEST_ASSERT_EQUAL_UINT64(2, d.zeros_read);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, d.zeros_read_A);
}

/* A tenth of the square of what is left beside the noise. */
static void test_what_does_not_repeat(void)
{
    TEST_ASSERT_TRUE(is_unrepeated(&d)); /* nothing is known */
    errors[0].unrepeated_Nm = 0.0;
    errors[1].unrepeated_Nm = sqrt(0.1005 * 0.32 / 0.9);
    TEST_ASSERT_TRUE(is_unrepeated(&d));
    errors[1].unrepeated_Nm = sqrt(0.0995 * 0.32 / 0.9);
    TEST_ASSERT_FALSE(is_unrepeated(&d));
    errors[2].role = HCI_ROLE_HOLDOUT, errors[2].unrepeated_Nm = 9.0;
    TEST_ASSERT_FALSE(is_unrepeated(&d));
}

static void test_whether_anything_turns(void)
{
    TEST_ASSERT_FALSE(hci_any_turns(&b, &runs));
    statistics[1].turns = 0.0051; /* of four pole pairs */
    TEST_ASSERT_TRUE(hci_any_turns(&b, &runs));
    statistics[1].turns = 0.0049;
    TEST_ASSERT_FALSE(hci_any_turns(&b, &runs));
    run[2].only_mean = true;
    TEST_ASSERT_TRUE(hci_any_turns(&b, &runs));
    fitted[2] = false;
    TEST_ASSERT_FALSE(hci_any_turns(&b, &runs));
}

/* ---- what is in ---- */

static hci_verdict *verdict(const hci_effect_type *type, bool in, bool established)
{
    hci_verdict *v = &a.verdict[a.types++];
    *v = (hci_verdict){.type = type, .in = in, .established = established};
    return v;
}

static void test_what_runs_without_a_current_show_alone(void)
{
    TEST_ASSERT_FALSE(is_established(&a) || has_more(&a));
    verdict(&hci_empirical_type, true, false); /* a description is no effect */
    TEST_ASSERT_FALSE(is_established(&a) || has_more(&a));
    verdict(hci_effect_type_find("cogging"), true, true);
    TEST_ASSERT_TRUE(is_established(&a) && !has_more(&a));
    hci_verdict *v = verdict(hci_effect_type_find("friction"), false, false);
    TEST_ASSERT_TRUE(is_established(&a) && !has_more(&a));
    v->in = true;
    TEST_ASSERT_TRUE(!is_established(&a) && has_more(&a));
}

static void test_machines_of_other_effects(void)
{
    static hci_candidate one;
    hci_verdict *v = verdict(hci_effect_type_find("cogging"), true, false);
    v->alternative.candidates = (hci_candidates){.candidate = &one, .count = 1};
    TEST_ASSERT_EQUAL_UINT64(0, alternatives_of(&a).count);
    v->ambiguous = true;
    const hci_alternatives x = alternatives_of(&a);
    TEST_ASSERT_EQUAL_UINT64(1, x.count);
    TEST_ASSERT_EQUAL_PTR(&v->alternative.candidates, x.machine[0]);
    v->alternative.candidates.candidate = NULL;
    TEST_ASSERT_EQUAL_UINT64(0, alternatives_of(&a).count);
}

/* ---- verdicts ---- */

/* A quarter of the torque that is rated. */
static void test_noise_that_drowns(void)
{
    machine.rated_torque_Nm = 2.0;
    d.noise_Nm = 0.49;
    drowned_judge(&b, &machine, &d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, d.verdict);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, d.drowned_Nm);
    d.noise_Nm = 0.51;
    drowned_judge(&b, &machine, &d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, d.verdict);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, d.drowned_Nm);
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    drowned_judge(&b, &machine, &d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, d.verdict);
}

static hci_diagnosis_verdict with_swing(hci_diagnosis_verdict before, bool of_turn, size_t in_runs)
{
    d.verdict = before, d.swings = 1;
    d.swing[0] = (hci_free_swing){of_turn, 3.4, 0.01, 0.1, in_runs};
    loose_swings_judge(&d);
    return d.verdict;
}

static void test_swings_of_the_rotor(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, with_swing(HCI_DIAGNOSIS_COMPLETE, true, 2));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, with_swing(HCI_DIAGNOSIS_EXPLAINED, true, 2));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, with_swing(HCI_DIAGNOSIS_AMBIGUOUS, true, 2));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, with_swing(HCI_DIAGNOSIS_COMPLETE, true, 1));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, with_swing(HCI_DIAGNOSIS_COMPLETE, false, 2));
}

static void test_a_drift_beside_nothing_else(void)
{
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    drifts_judge(&d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, d.verdict);
    d.drifts = 1, d.drift_Nm = 0.12, d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    drifts_judge(&d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_EXPLAINED, d.verdict);
    d.verdict = HCI_DIAGNOSIS_COMPLETE, d.rms_before_Nm = 0.1;
    d.findings = 2, d.finding[0].effect = "friction", d.finding[1].effect = hci_empirical_type.name;
    drifts_judge(&d);
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, d.verdict);
    TEST_ASSERT_EQUAL_STRING(hci_empirical_type.name,
                             d.finding[0].effect); /* a line has its range over √12 as rms */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.12, d.finding[0].residual_share);
}

/* ---- what is left ---- */

/* The mean over the recordings of what is above the noise. */
static void test_ripple_that_is_not_explained(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.4, unexplained_ripple_Nm(&d));
    errors[0].ripple_after_Nm = 0.1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(0.32 / 3.0), unexplained_ripple_Nm(&d));
    errors[1].ripple_after_Nm = NAN;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(0.16 / 2.0), unexplained_ripple_Nm(&d));
    d.runs = 0;
    TEST_ASSERT_TRUE(isnan(unexplained_ripple_Nm(&d)));
}

static void line(size_t k, size_t of_run, double order, double after_Nm, double noise_Nm)
{
    lines[k].run = of_run, lines[k].order = order, lines[k].after_Nm = after_Nm, lines[k].noise_Nm = noise_Nm;
    d.lines = k + 1;
}

/* Fifteen hundredths of the largest torque, where a tenth of a current is along d. */
static void test_means_beside_a_direct_current(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        statistics[r].rms_torque_Nm = 2.0, statistics[r].current_A = 10.0;
    statistics[1].rms_id_A = 1.01;
    a.means_alone = true, a.unexplained_Nm = 0.31;
    TEST_ASSERT_TRUE(means_are_of_iron(&b, &a));
    a.unexplained_Nm = 0.29;
    TEST_ASSERT_FALSE(means_are_of_iron(&b, &a));
    a.unexplained_Nm = 0.31, statistics[1].rms_id_A = 0.99;
    TEST_ASSERT_FALSE(means_are_of_iron(&b, &a));
    statistics[1].rms_id_A = 1.01, fitted[1] = false;
    TEST_ASSERT_FALSE(means_are_of_iron(&b, &a));
    fitted[1] = true, a.means_alone = false;
    TEST_ASSERT_FALSE(means_are_of_iron(&b, &a));
}

/* Peak to peak, of lines above twice the noise; 1.9 times the root of the sum of the squares at the most. */
static void test_orders_that_are_left(void)
{
    double left_Nm;
    hci_note note = {{0}};
    line(0, 1, 6.0, 0.3, 0.149);
    line(1, 1, 0.0, 9.0, 0.1);
    line(2, 1, 12.0, 0.1, 0.051);
    line(3, 2, 6.0, 0.7, 0.1);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, left_of_run_Nm(&d, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.6, left_of_run_Nm(&d, 1));
    line(2, 1, 12.0, 0.1, 0.049);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, fmin(0.8, 1.9 * sqrt(0.36 + 0.04)), left_of_run_Nm(&d, 1));
    for (size_t k = 0; k < 6; ++k)
        line(k, 2, 6.0 + (double)k, 0.1, 0.01);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.9 * sqrt(6.0 * 0.04), left_of_run_Nm(&d, 2));
    TEST_ASSERT_EQUAL_INT(HCI_OK, left_orders_find(&d, &left_Nm, &note));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, left_Nm); /* the median of three */
    line(0, 1, 6.0, 0.3, 0.149);
    d.lines = 6;
    TEST_ASSERT_EQUAL_INT(HCI_OK, left_orders_find(&d, &left_Nm, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.6, left_Nm);
}

/* ---- which recordings ---- */

static void test_which_runs_are_of_use(void)
{
    static double numbers[3];
    TEST_ASSERT_FALSE(is_usable(&runs, 0) || any_usable(&runs));
    run[0] = (hci_run){.torque_Nm = numbers, .theta_m_rad = numbers, .i_A = numbers, .count = 1};
    TEST_ASSERT_TRUE(is_usable(&runs, 0) && any_usable(&runs));
    role[0] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_FALSE(is_usable(&runs, 0));
    role[0] = HCI_ROLE_FIT, run[0].theta_m_rad = NULL;
    TEST_ASSERT_FALSE(is_usable(&runs, 0));
    run[0].only_mean = true;
    TEST_ASSERT_TRUE(is_usable(&runs, 0));
    run[0].i_A = NULL;
    TEST_ASSERT_FALSE(is_usable(&runs, 0));
    run[0].i_A = numbers, run[0].count = 0;
    TEST_ASSERT_FALSE(is_usable(&runs, 0));
    run[0].count = 1, run[0].torque_Nm = NULL;
    TEST_ASSERT_FALSE(is_usable(&runs, 0));
}

static void test_torques_that_were_measured(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        run[r].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_TRUE(are_measured(&runs));
    run[2].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(are_measured(&runs));
    TEST_ASSERT_EQUAL_UINT64(0, unknown_loads_of(&runs));
    run[2].mean_is_unknown = run[1].mean_is_unknown = true;
    TEST_ASSERT_EQUAL_UINT64(1, unknown_loads_of(&runs));
    role[2] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_UINT64(0, unknown_loads_of(&runs));
}

static void test_runs_without_one(void)
{
    hci_runs rest;
    size_t index = 9;
    hci_note note = {{0}};
    static char name[RUNS][4] = {"a", "b", "c"};
    for (size_t r = 0; r < RUNS; ++r)
        run[r].name = name[r];
    role[2] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_OK, take_out(&runs, name[1], &rest, &index, &note));
    TEST_ASSERT_EQUAL_UINT64(1, index);
    TEST_ASSERT_EQUAL_UINT64(2, rest.count);
    TEST_ASSERT_TRUE(rest.run[0].name == name[0] && rest.run[1].name == name[2]);
    TEST_ASSERT_TRUE(rest.role[0] == HCI_ROLE_FIT && rest.role[1] == HCI_ROLE_HOLDOUT);
    hci_memory_free(rest.run);
    hci_memory_free(rest.role);
}

/* An answer with the torque per ampere that voltages show, beside one that contradicts them: of no worse
 * verdict, and where both leave something unknown less than half of it. */
static void test_which_answer_says_more(void)
{
    const hci_diagnosis than = {
        .verdict = HCI_DIAGNOSIS_UNKNOWN, .against_voltages = true, .rms_after_Nm = 1.0};
    d = (hci_diagnosis){.verdict = HCI_DIAGNOSIS_UNKNOWN, .rms_after_Nm = 0.49};
    TEST_ASSERT_TRUE(says_more(&d, &than));
    d.against_voltages = true;
    TEST_ASSERT_FALSE(says_more(&d, &than));
    d.against_voltages = false, d.search = HCI_WORK_LIMITED;
    TEST_ASSERT_FALSE(says_more(&d, &than));
    d.search = HCI_WORK_COMPLETE, d.rms_after_Nm = 0.51;
    TEST_ASSERT_FALSE(says_more(&d, &than));
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    TEST_ASSERT_FALSE(says_more(&d, &than));
    d.verdict = HCI_DIAGNOSIS_AMBIGUOUS;
    TEST_ASSERT_TRUE(says_more(&d, &than));
    const hci_diagnosis explained = {.verdict = HCI_DIAGNOSIS_EXPLAINED, .rms_after_Nm = 9.0};
    TEST_ASSERT_FALSE(says_more(&d, &explained));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_swings_are_told);
    RUN_TEST(test_drifts_are_told);
    RUN_TEST(test_zeros_are_told);
    RUN_TEST(test_what_does_not_repeat);
    RUN_TEST(test_whether_anything_turns);
    RUN_TEST(test_what_runs_without_a_current_show_alone);
    RUN_TEST(test_machines_of_other_effects);
    RUN_TEST(test_noise_that_drowns);
    RUN_TEST(test_swings_of_the_rotor);
    RUN_TEST(test_a_drift_beside_nothing_else);
    RUN_TEST(test_ripple_that_is_not_explained);
    RUN_TEST(test_means_beside_a_direct_current);
    RUN_TEST(test_orders_that_are_left);
    RUN_TEST(test_which_runs_are_of_use);
    RUN_TEST(test_torques_that_were_measured);
    RUN_TEST(test_runs_without_one);
    RUN_TEST(test_which_answer_says_more);
    return UNITY_END();
}
