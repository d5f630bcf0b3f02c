/* What a finding says of its values. */
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/findings.h"
#include "host/diagnose/search/search.h"
#include "support/effect_list.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Friction of three terms, as three speeds tell it. */
static const char *words_of_friction(double viscous, double std_error)
{
    static hci_diagnosis d;
    static hci_attribution a;
    hci_candidate friction = {.type = hci_effect_type_find("friction"), .count = 3, .in = true};
    const double value[] = {0.1021, viscous, 2.6e-4};
    for (size_t k = 0; k < 3; ++k)
        friction.term[k] = (hci_effect_term){.parameter = k, .value = value[k], .std_error = std_error};
    memset(&d, 0, sizeof d);
    memset(&a, 0, sizeof a);
    a.types = 1;
    a.verdict[0].type = friction.type;
    a.verdict[0].in = true;
    a.model.candidates = (hci_candidates){.candidate = &friction, .count = 1};
    hci_findings_fill(&a, &d);
    TEST_ASSERT_EQUAL_UINT(1, d.findings);
    return d.finding[0].detail;
}

static void test_a_friction_below_0_is_said_to_be_none(void)
{
    TEST_ASSERT_NOT_NULL(
        strstr(words_of_friction(-0.0079, 0.0005), "only their sum at the recorded speeds is told"));
    TEST_ASSERT_NULL(strstr(words_of_friction(-0.0008, 0.0005), "their sum"));
    TEST_ASSERT_NULL(strstr(words_of_friction(4e-4, 1e-5), "their sum"));
}

/* 0.5 N·m at 1 A that grows with a power of the current; 9 A are the most that was recorded. */
static void test_what_is_not_explained(void)
{
    static hci_diagnosis d;
    static hci_attribution a;
    static hci_run run;
    static hci_run_statistics statistics;
    static hci_dataset dataset;
    size_t g = 0;
    while (hci_growth_law_of(g).current != 0.5 || hci_growth_law_of(g).speed != 0.0)
        ++g;
    hci_candidate described[3] = {{.type = &hci_empirical_type, .count = 2, .in = true},
                                  {.type = &hci_empirical_type, .count = 2},
                                  {.type = hci_effect_type_find("cogging"), .count = 2, .in = true}};
    described[0].term[0] = (hci_effect_term){.order = 6.0, .parameter = 2 * g, .value = 0.3};
    described[0].term[1] = (hci_effect_term){.order = 6.0, .parameter = 2 * g + 1, .value = -0.4};
    statistics.current_A = 9.0;
    dataset.samples.statistics = &statistics;
    dataset.samples.run_count = 1;
    dataset.regression.runs = &run;
    a.unknown = true;
    a.model.candidates = (hci_candidates){.candidate = described, .count = 3};
    hci_unexplained_fill(&dataset, &a, &d);
    TEST_ASSERT_EQUAL_UINT(1, d.unexplained_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, d.unexplained[0].sine_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(-0.4, d.unexplained[0].cosine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * 3.0, d.unexplained[0].amplitude_Nm);
}

/* ---- all findings ---- */

static hci_diagnosis told;
static hci_attribution found;
static hci_candidate in_model[4];

/* A verdict of the next type; rms 2 N·m were there before. */
static hci_verdict *judged(const char *effect, double gain, double explained_Nm)
{
    hci_verdict *v = &found.verdict[found.types++];
    v->type = strcmp(effect, "unknown") == 0 ? &hci_empirical_type : hci_effect_type_find(effect);
    TEST_ASSERT_NOT_NULL(v->type);
    v->gain = gain;
    v->explained_Nm = explained_Nm;
    v->stays = 3;
    v->left_out = 4;
    return v;
}

static void begin(void)
{
    memset(&told, 0, sizeof told);
    memset(&found, 0, sizeof found);
    memset(in_model, 0, sizeof in_model);
    told.rms_before_Nm = 2.0;
    found.model.candidates = (hci_candidates){.candidate = in_model, .count = 4};
}

static void model_has(size_t at, const char *effect, const char *parameter, double order, double value,
                      double std_error)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    in_model[at] = (hci_candidate){.type = type, .count = 1, .in = true};
    in_model[at].term[0] = (hci_effect_term){el_parameter(type, parameter), order, value, std_error};
}

/* Added before ambiguous before rejected, the larger gain first; the share is (explained/2 N·m)², at most 1.
 */
static void test_the_order_of_findings(void)
{
    begin();
    judged("friction", 5.0, 0.0);
    judged("cogging", 30.0, 0.2)->in = true;
    judged("reluctance", 70.0, 0.0);
    judged("back_emf", 90.0, 3.0)->in = true;
    hci_verdict *v = judged("current_gain", 12.0, 0.1);
    v->ambiguous = v->in = true;
    v = judged("position_offset", 20.0, 0.0);
    v->ambiguous = true;
    v->rival_of = hci_effect_type_find("current_gain");
    model_has(0, "cogging", "sine", 6.0, 0.25, 0.01);
    model_has(1, "cogging", "cosine", 12.5, -3.0, 0.0);
    model_has(2, "cogging", "cosine", 6.0, 0.0, 0.0); /* nothing was fitted to it */
    model_has(3, "current_gain", "b", 0.0, 1e-14, 1e-3);
    hci_findings_fill(&found, &told);
    static const struct {
        const char *effect;
        hci_finding_verdict verdict;
        double gain, share;
        const char *detail;
    } WANTED[] = {
        {"back_emf", HCI_FINDING_ADDED, 90.0, 1.0, ""},
        {"cogging", HCI_FINDING_ADDED, 30.0, 0.01,
         "sine_6 = 0.25 ± 0.01 Nm; cosine_12.5 = -3 Nm, not told by itself"},
        {"position_offset", HCI_FINDING_AMBIGUOUS, 20.0, NAN,
         "looks the same as a part of current_gain in all these runs"},
        {"current_gain", HCI_FINDING_AMBIGUOUS, 12.0, 0.0025, "b = 0 ± 0.001 "},
        {"reluctance", HCI_FINDING_REJECTED, 70.0, NAN, ""},
        {"friction", HCI_FINDING_REJECTED, 5.0, NAN, ""},
    };
    TEST_ASSERT_EQUAL_UINT(6, told.findings);
    for (size_t k = 0; k < 6; ++k) {
        const hci_finding *f = &told.finding[k];
        TEST_ASSERT_EQUAL_STRING(WANTED[k].effect, f->effect);
        TEST_ASSERT_EQUAL_INT(WANTED[k].verdict, f->verdict);
        TEST_ASSERT_EQUAL_DOUBLE(WANTED[k].gain, f->delta_bic);
        TEST_ASSERT_EQUAL_UINT(3, f->stays);
        TEST_ASSERT_EQUAL_UINT(4, f->left_out);
        TEST_ASSERT_EQUAL_STRING(WANTED[k].detail, f->detail);
        TEST_ASSERT_EQUAL(isnan(WANTED[k].share), isnan(f->residual_share));
        TEST_ASSERT_TRUE(isnan(f->residual_share) || fabs(f->residual_share - WANTED[k].share) < 1e-12);
    }
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_AMBIGUOUS, told.verdict);
}

static void test_what_is_said_of_the_whole(void)
{
    for (int bits = 0; bits < 8; ++bits) {
        begin();
        judged("cogging", 30.0, 0.2)->in = bits % 2;
        found.inertia_as_well = bits & 1;
        found.sensors_as_well = bits & 2;
        found.magnetic_only = bits & 4;
        hci_findings_fill(&found, &told);
        TEST_ASSERT_EQUAL(bits & 1, told.inertia_as_well);
        TEST_ASSERT_EQUAL((bits & 2) != 0, told.sensors_as_well);
        TEST_ASSERT_EQUAL((bits & 4) != 0, told.magnetic_only);
        TEST_ASSERT_EQUAL_INT(bits % 2 ? HCI_DIAGNOSIS_EXPLAINED : HCI_DIAGNOSIS_COMPLETE, told.verdict);
    }
}

/* Of nothing there is no share. */
static void test_no_share_of_nothing(void)
{
    begin();
    told.rms_before_Nm = 0.0;
    judged("cogging", 30.0, 0.0)->in = true;
    judged("unknown", 2.0, 0.0);
    found.unknown = true;
    found.unexplained_Nm = 0.5;
    hci_findings_fill(&found, &told);
    TEST_ASSERT_EQUAL_UINT(2, told.findings);
    TEST_ASSERT_TRUE(isnan(told.finding[0].residual_share));
    TEST_ASSERT_TRUE(isnan(told.finding[1].residual_share));
}

/* One term of friction below 0, by more than two standard errors or by less. */
static void test_one_term_below_0(void)
{
    for (int surely = 0; surely < 2; ++surely) {
        begin();
        judged("friction", 30.0, 0.1)->in = true;
        model_has(0, "friction", "coulomb", 0.0, surely ? -0.021 : -0.019, 0.01);
        hci_findings_fill(&found, &told);
        TEST_ASSERT_EQUAL(surely, strstr(told.finding[0].detail, "only their sum") != NULL);
    }
}

/* What is unknown stands first, whatever was gained by it: (0.5/2)² of what there was. */
static void test_what_is_unknown_stands_first(void)
{
    static const struct {
        bool not_searched, means_open, means_alone;
        hci_work_end ended;
        const char *words;
    } CASES[] = {
        {false, false, false, HCI_WORK_COMPLETE, "rms 0.5 N·m that no known effect explains"},
        {false, true, false, HCI_WORK_COMPLETE, "rms 0.5 N·m that no known effect explains"},
        {false, false, true, HCI_WORK_COMPLETE, "rms 0.5 N·m that no known effect explains"},
        {false, true, true, HCI_WORK_COMPLETE,
         "rms 0.5 N·m in the means of the runs, that no known effect explains"},
        {false, true, true, HCI_WORK_LIMITED, "rms 0.5 N·m that no effect explains which was compared"},
        {true, true, true, HCI_WORK_INTERRUPTED, "rms 0.5 N·m that was not looked into"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        begin();
        judged("cogging", 30.0, 0.2)->in = k % 2;
        judged("unknown", 2.0, 0.0)->in = true;
        judged("friction", 50.0, 0.0);
        found.unknown = true;
        found.unexplained_Nm = 0.5;
        found.not_searched = CASES[k].not_searched;
        found.means_open = CASES[k].means_open;
        found.means_alone = CASES[k].means_alone;
        found.ended = CASES[k].ended;
        hci_findings_fill(&found, &told);
        TEST_ASSERT_EQUAL_UINT(3, told.findings);
        TEST_ASSERT_EQUAL_STRING(hci_empirical_type.name, told.finding[0].effect);
        TEST_ASSERT_EQUAL_STRING(CASES[k].words, told.finding[0].detail);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0625, told.finding[0].residual_share);
        TEST_ASSERT_TRUE(isnan(told.finding[0].delta_bic));
        TEST_ASSERT_EQUAL_UINT(3, told.finding[0].stays);
        TEST_ASSERT_EQUAL_UINT(4, told.finding[0].left_out);
        TEST_ASSERT_EQUAL_STRING(k % 2 ? "cogging" : "friction", told.finding[1].effect);
        TEST_ASSERT_EQUAL_INT(k % 2 ? HCI_DIAGNOSIS_PARTLY : HCI_DIAGNOSIS_UNKNOWN, told.verdict);
    }
}

/* Of an effect that is found in less than two of three cases with a run left out, and of little gain, only
 * beside one that stands by itself. */
static void test_what_is_a_part(void)
{
    const hci_finding weak = {"friction", HCI_FINDING_ADDED, 1e9, 1, 3, NAN, ""},
                      told_well = {"cogging", HCI_FINDING_ADDED, 1e9, 2, 3, NAN, ""},
                      unknown = {hci_empirical_type.name, HCI_FINDING_ADDED, 1e9, 3, 3, NAN, ""},
                      rejected = {"reluctance", HCI_FINDING_REJECTED, 1e9, 3, 3, NAN, ""};
    const hci_finding *beside[] = {&told_well, &unknown, &rejected, &weak};
    for (int k = 0; k < 4; ++k) {
        memset(&told, 0, sizeof told);
        told.finding[0] = weak;
        told.finding[0].delta_bic = 1.0;
        told.finding[1] = *beside[k];
        if (k == 3) told.finding[1].delta_bic = 1.0;
        told.findings = 2;
        TEST_ASSERT_EQUAL(k == 0, hci_finding_is_part(&told, &told.finding[0]));
        TEST_ASSERT_FALSE(hci_finding_is_part(&told, &told_well));
    }
    told.finding[1] = told_well;
    told.finding[0].delta_bic = HCI_DECISIVE;
    TEST_ASSERT_FALSE(hci_finding_is_part(&told, &told.finding[0]));
    told.finding[0].delta_bic = 1.0;
    told.finding[0].verdict = HCI_FINDING_AMBIGUOUS;
    TEST_ASSERT_FALSE(hci_finding_is_part(&told, &told.finding[0]));
}

static void test_a_gain_that_was_not_looked_for(void)
{
    hci_finding f = {"friction", HCI_FINDING_REJECTED, 0.0, 0, 0, NAN, ""};
    TEST_ASSERT_TRUE(isnan(hci_finding_delta_bic(&f)));
    f.delta_bic = 1e-9;
    TEST_ASSERT_EQUAL_DOUBLE(1e-9, hci_finding_delta_bic(&f));
    f.delta_bic = 0.0;
    f.verdict = HCI_FINDING_ADDED;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_finding_delta_bic(&f));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_friction_below_0_is_said_to_be_none);
    RUN_TEST(test_what_is_not_explained);
    RUN_TEST(test_the_order_of_findings);
    RUN_TEST(test_what_is_said_of_the_whole);
    RUN_TEST(test_what_is_unknown_stands_first);
    RUN_TEST(test_what_is_a_part);
    RUN_TEST(test_no_share_of_nothing);
    RUN_TEST(test_one_term_below_0);
    RUN_TEST(test_a_gain_that_was_not_looked_for);
    return UNITY_END();
}
