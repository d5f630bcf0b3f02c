/* What runs held out say of a model, from errors on both sides of each bound. */
#include "host/diagnose/held_out.c"

#include <string.h>

#include "unity.h"

enum { RUNS = 4 };

static char names[RUNS][8];
static hci_run run[RUNS];
static hci_role role[RUNS];
static hci_runs runs;
static hci_run_statistics statistics[RUNS];
static hci_segment segment[RUNS];
static bool fitted[RUNS];
static hci_run_errors errors[RUNS];
static hci_diagnosis d;
static hci_dataset b;
static hci_attribution a;

/* Two runs that were fitted, at 5 A and 100 rad/s at the most, and two held out. */
void setUp(void)
{
    static const hci_run_statistics AT[RUNS] = {{.current_A = 5.0, .pace_rad_per_s = 30.0},
                                                {.current_A = 2.0, .pace_rad_per_s = 100.0},
                                                {.current_A = 4.0, .pace_rad_per_s = 50.0},
                                                {.current_A = 3.0, .pace_rad_per_s = 60.0}};
    memset(&d, 0, sizeof d);
    memset(&b, 0, sizeof b);
    memset(&a, 0, sizeof a);
    for (size_t r = 0; r < RUNS; ++r) {
        strcpy(names[r], "r0");
        names[r][1] = (char)('0' + r);
        run[r] = (hci_run){.name = names[r], .torque_source = HCI_TORQUE_MEASURED};
        role[r] = r < 2 ? HCI_ROLE_FIT : HCI_ROLE_HOLDOUT;
        fitted[r] = r < 2;
        statistics[r] = AT[r];
        segment[r] = (hci_segment){.run = r, .first = 100 * r, .count = 100};
        errors[r] = (hci_run_errors){.file = names[r],
                                     .role = role[r],
                                     .rms_before_Nm = 1.0,
                                     .rms_after_Nm = 0.1,
                                     .noise_floor_Nm = 0.1,
                                     .ripple_before_Nm = 0.8,
                                     .ripple_after_Nm = 0.1};
    }
    runs = (hci_runs){.run = run, .role = role, .count = RUNS};
    b.samples = (hci_binned_samples){.segment = segment,
                                     .segment_count = RUNS,
                                     .statistics = statistics,
                                     .run_count = RUNS,
                                     .count = 100 * RUNS};
    b.fit = fitted;
    d.run = errors, d.runs = RUNS;
    d.noise_Nm = d.holdout_noise_Nm = 0.1;
    d.rms_after_Nm = d.holdout_after_Nm = 0.1;
    d.holdout_before_Nm = 1.0, d.holdout_ripple_before_Nm = 0.8, d.holdout_ripple_after_Nm = 0.1;
}

void tearDown(void)
{
}

/* ---- which runs are a test ---- */

static void test_runs_within_what_was_fitted(void)
{
    TEST_ASSERT_TRUE(is_within(&(hci_run_statistics){.current_A = 5.24, .pace_rad_per_s = 104.0}, &b));
    TEST_ASSERT_FALSE(is_within(&(hci_run_statistics){.current_A = 5.26, .pace_rad_per_s = 10.0}, &b));
    TEST_ASSERT_FALSE(is_within(&(hci_run_statistics){.current_A = 1.0, .pace_rad_per_s = 106.0}, &b));
    fitted[1] = false;
    TEST_ASSERT_FALSE(is_within(&(hci_run_statistics){.current_A = 1.0, .pace_rad_per_s = 32.0}, &b));
}

/* The same of a small motor that creeps, at 0.02 A and 0.1 rad/s. */
static void test_runs_of_a_small_motor(void)
{
    statistics[0] = (hci_run_statistics){.current_A = 0.02, .pace_rad_per_s = 0.1};
    statistics[1] = (hci_run_statistics){.current_A = 0.01, .pace_rad_per_s = 0.05};
    TEST_ASSERT_TRUE(is_within(&(hci_run_statistics){.current_A = 0.0209, .pace_rad_per_s = 0.104}, &b));
    TEST_ASSERT_FALSE(is_within(&(hci_run_statistics){.current_A = 0.0211, .pace_rad_per_s = 0.1}, &b));
    TEST_ASSERT_FALSE(is_within(&(hci_run_statistics){.current_A = 0.02, .pace_rad_per_s = 0.106}, &b));
}

/* Sums of squares over the runs held out within it; noise or resolution, whichever allows more. */
static void test_errors_are_summed(void)
{
    errors[2].rms_before_Nm = 0.7, errors[2].rms_after_Nm = 0.3, errors[2].noise_floor_Nm = 0.2;
    errors[3].rms_before_Nm = 0.5, errors[3].rms_after_Nm = 0.4, errors[3].noise_floor_Nm = 0.01;
    test_errors x = test_errors_of(&b, &runs, &d, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.49 + 0.25, x.before);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.09 + 0.16, x.after);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.09 + 0.0064, x.allowed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.74, x.told_before);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.04 + pow(4.0 / 1.5 * 0.02, 2.0), x.told_noise);
    run[2].torque_source = HCI_TORQUE_INERTIA;
    statistics[3].current_A = 9.0;
    x = test_errors_of(&b, &runs, &d, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.49, x.before);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.told_before);
    d.run = errors + 1, d.runs = 3; /* the first was left out */
    x = test_errors_of(&b, &runs, &d, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.49, x.before);
}

/* ---- what they say ---- */

static void test_what_is_described(void)
{
    TEST_ASSERT_TRUE(is_described(&(test_errors){.before = 2.0, .after = 1.0, .allowed = 1.0}));
    TEST_ASSERT_FALSE(is_described(&(test_errors){.before = 99.0, .after = 1.0, .allowed = 0.99}));
    TEST_ASSERT_TRUE(is_described(&(test_errors){.before = 101.0, .after = 1.0, .allowed = 0.5}));
    TEST_ASSERT_TRUE(
        is_hardly_less(&(test_errors){.told_before = 2.5, .told_after = 1.8, .told_noise = 1.0}, 0.5));
    TEST_ASSERT_FALSE(
        is_hardly_less(&(test_errors){.told_before = 2.7, .told_after = 1.8, .told_noise = 1.0}, 0.5));
    TEST_ASSERT_FALSE(
        is_hardly_less(&(test_errors){.told_before = 1.5, .told_after = 1.43, .told_noise = 1.0}, 0.5));
    TEST_ASSERT_TRUE(
        is_hardly_less(&(test_errors){.told_before = 1.5, .told_after = 1.45, .told_noise = 1.0}, 0.5));
}

static void test_what_contradicts(void)
{
    test_errors x = {.before = 4.0, .after = 1.01, .allowed = 0.5};
    TEST_ASSERT_TRUE(is_contradicted(&x, false));
    TEST_ASSERT_FALSE(is_contradicted(&x, true));
    x.after = 0.99;
    TEST_ASSERT_FALSE(is_contradicted(&x, false));
    x.after = 4.0 * 0.96 * 0.96;
    TEST_ASSERT_TRUE(is_contradicted(&x, true));
    x.after = 4.0 * 0.94 * 0.94;
    TEST_ASSERT_FALSE(is_contradicted(&x, true));
    x = (test_errors){.allowed = 9.0, .told_before = 3.0, .told_after = 2.1, .told_noise = 1.0};
    TEST_ASSERT_TRUE(is_contradicted(&x, false));
    TEST_ASSERT_FALSE(is_contradicted(&x, true));
    x.told_after = 2.85;
    TEST_ASSERT_TRUE(is_contradicted(&x, true));
}

static void test_what_fitted_runs_are_left_with(void)
{
    TEST_ASSERT_FALSE(leaves_means(&d, 1e-3) || leaves_ripple(&d, 1e-3));
    errors[1].error_mean_after_Nm = -0.099; /* a tenth of 1 N·m; half of the noise is less */
    TEST_ASSERT_FALSE(leaves_means(&d, 1e-3));
    errors[1].error_mean_after_Nm = -0.101;
    TEST_ASSERT_TRUE(leaves_means(&d, 1e-3));
    TEST_ASSERT_FALSE(leaves_means(&d, 0.026)); /* four times the resolution */
    errors[1].rms_before_Nm = 0.1, errors[1].error_mean_after_Nm = 0.051;
    TEST_ASSERT_TRUE(leaves_means(&d, 1e-3));
    errors[1].error_mean_after_Nm = 0.049;
    TEST_ASSERT_FALSE(leaves_means(&d, 1e-3));
    errors[3].error_mean_after_Nm = 9.0, errors[3].ripple_after_Nm = 9.0; /* held out */
    TEST_ASSERT_FALSE(leaves_means(&d, 1e-3) || leaves_ripple(&d, 1e-3));
    errors[0].ripple_after_Nm = 0.31;
    TEST_ASSERT_TRUE(leaves_ripple(&d, 1e-3));
    errors[0].ripple_after_Nm = 0.29;
    TEST_ASSERT_FALSE(leaves_ripple(&d, 1e-3));
    errors[1].ripple_after_Nm = 0.21; /* twice the noise, three tenths of 0.1 */
    TEST_ASSERT_TRUE(leaves_ripple(&d, 1e-3));
    errors[1].ripple_after_Nm = 0.19;
    TEST_ASSERT_FALSE(leaves_ripple(&d, 1e-3));
}

/* χ² over all samples of a run; 20 and two for each value. */
static void test_whether_errors_rise_at_all(void)
{
    hci_effect effect = {.type = hci_effect_type_find("friction"), .count = 3};
    d.effects.list = (hci_effects){&effect, 1};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 26.0, by_chance(&d));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 100.0, rows_of(&b, 2));
    segment[3].run = 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 200.0, rows_of(&b, 2));
    segment[3].run = 3;
    d.holdout_before_Nm = 0.1, d.holdout_after_Nm = 0.103;
    for (int more = 0; more < 2; ++more) {
        for (size_t r = 2; r < RUNS; ++r) {
            errors[r].rms_before_Nm = 0.1;
            errors[r].rms_after_Nm = sqrt(0.01 * (1.0 + (more ? 0.1305 : 0.1295)));
        }
        TEST_ASSERT_EQUAL(more, rises_at_all(&b, &runs, &d));
    }
    d.holdout_after_Nm = 0.1019;
    TEST_ASSERT_FALSE(rises_at_all(&b, &runs, &d));
}

static void test_whether_means_and_ripple_rise(void)
{
    for (size_t r = 2; r < RUNS; ++r) {
        errors[r].error_mean_before_Nm = 0.05, errors[r].error_mean_after_Nm = sqrt(0.0025 + 0.01 * 0.101);
        errors[r].ripple_before_Nm = 0.1, errors[r].ripple_after_Nm = sqrt(0.01 + 0.01 * 0.101);
    }
    TEST_ASSERT_TRUE(hci_held_out_rises_both(&b, &runs, &d));
    errors[2].error_mean_after_Nm = sqrt(0.0025 + 0.01 * 0.098);
    TEST_ASSERT_FALSE(hci_held_out_rises_both(&b, &runs, &d));
    errors[2].error_mean_after_Nm = 0.1, errors[3].ripple_after_Nm = sqrt(0.01 + 0.01 * 0.098);
    TEST_ASSERT_FALSE(hci_held_out_rises_both(&b, &runs, &d));
}

static bool partial(void)
{
    const test_errors x = {.before = 1.0, .after = 0.5, .allowed = 1.0};
    return is_partial(&x, &d, 1e-3);
}

static void test_what_is_partial(void)
{
    TEST_ASSERT_FALSE(partial());
    d.holdout_after_Nm = 0.151, d.holdout_before_Nm = 0.151;
    TEST_ASSERT_TRUE(partial());
    d.holdout_before_Nm = 0.152;
    TEST_ASSERT_FALSE(partial());
    d.holdout_after_Nm = 0.149, d.holdout_before_Nm = 0.1;
    TEST_ASSERT_FALSE(partial());
    d.holdout_ripple_after_Nm = 0.201, d.holdout_ripple_before_Nm = 0.201 / 0.96;
    TEST_ASSERT_TRUE(partial());
    d.holdout_ripple_before_Nm = 0.201 / 0.94;
    TEST_ASSERT_FALSE(partial());
    d.holdout_ripple_after_Nm = 0.199, d.holdout_ripple_before_Nm = 0.1;
    TEST_ASSERT_FALSE(partial());
    errors[0].error_mean_after_Nm = 0.2;
    TEST_ASSERT_TRUE(partial());
}

static void test_what_is_much(void)
{
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 1e-3));
    errors[2].rms_after_Nm = 0.41;
    TEST_ASSERT_TRUE(hci_held_out_leaves_much(&d, 1e-3));
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 0.103));
    errors[2].rms_after_Nm = 0.39;
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 1e-3));
    d.rms_after_Nm = 0.21;
    TEST_ASSERT_TRUE(hci_held_out_leaves_much(&d, 1e-3));
    d.rms_after_Nm = 0.19, d.holdout_after_Nm = 0.21;
    TEST_ASSERT_TRUE(hci_held_out_leaves_much(&d, 1e-3));
    d.holdout_after_Nm = 0.19;
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 1e-3));
}

/* All of it: the same errors judged. */
static void test_judgements(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&b, &runs, &d, 1e-3));
    errors[0].error_mean_after_Nm = 0.2;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, hci_held_out_judge(&b, &runs, &d, 1e-3));
    errors[2].rms_after_Nm = errors[3].rms_after_Nm = 0.9;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_CONTRADICTED, hci_held_out_judge(&b, &runs, &d, 1e-3));
    TEST_ASSERT_FALSE(hci_held_out_rises(&b, &runs, &d, 1e-3));
    errors[2].rms_after_Nm = errors[3].rms_after_Nm = 1.019;
    TEST_ASSERT_FALSE(hci_held_out_rises(&b, &runs, &d, 1e-3));
    errors[2].rms_after_Nm = errors[3].rms_after_Nm = 1.021;
    TEST_ASSERT_TRUE(hci_held_out_rises(&b, &runs, &d, 1e-3));
    TEST_ASSERT_FALSE(hci_held_out_rises(&b, &runs, &d, 0.26));
}

/* Effects that make a ripple beyond what was fitted: more than twice what it was, and more than noise. */
static void test_what_makes_a_ripple(void)
{
    d.holdout_ripple_before_Nm = 0.11, d.holdout_ripple_after_Nm = 0.221;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_CONTRADICTED, hci_held_out_judge(&b, &runs, &d, 1e-3));
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&b, &runs, &d, 0.056));
    d.holdout_ripple_after_Nm = 0.219;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, hci_held_out_judge(&b, &runs, &d, 1e-3));
    d.holdout_ripple_before_Nm = 0.05, d.holdout_ripple_after_Nm = 0.199;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&b, &runs, &d, 1e-3));
}

/* Where no run held out is within what was fitted, those beyond tell which effects help. */
static void test_which_runs_take_part(void)
{
    statistics[3].current_A = 9.0;
    TEST_ASSERT_TRUE(takes_part(&b, &runs, 2));
    TEST_ASSERT_FALSE(takes_part(&b, &runs, 3) || takes_part(&b, &runs, 0));
    statistics[2].pace_rad_per_s = 200.0;
    TEST_ASSERT_TRUE(takes_part(&b, &runs, 2) && takes_part(&b, &runs, 3));
    TEST_ASSERT_FALSE(takes_part(&b, &runs, 0));
}

static void test_what_an_effect_has_to_lower(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, helps(hci_effect_type_find("saturation")));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.1025, helps(hci_effect_type_find("friction")));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 200.0, samples_of(&b, &runs));
    statistics[3].current_A = 9.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 100.0, samples_of(&b, &runs));
    TEST_ASSERT_TRUE(is_never_found(&(hci_verdict){.left_out = 3}));
    TEST_ASSERT_FALSE(is_never_found(&(hci_verdict){.left_out = 3, .stays = 1}) ||
                      is_never_found(&(hci_verdict){.left_out = 0}));
}

/* ---- of a search that ended early ---- */

static void test_what_is_explained(void)
{
    TEST_ASSERT_TRUE(is_explained(1.0, 0.31, 0.0));
    TEST_ASSERT_FALSE(is_explained(1.0, 0.32, 0.0));
    TEST_ASSERT_TRUE(is_explained(1.0, 0.5, 0.5) && is_explained(0.4, 0.5, 0.5));
    TEST_ASSERT_FALSE(is_explained(0.4, 0.5, 0.49));
    TEST_ASSERT_TRUE(has_risen(1.0, 1.021) && !has_risen(1.0, 1.019));
}

/* All of it, or the means or the ripple where the other has not risen. */
static void test_what_is_much_of_runs_held_out(void)
{
    d.holdout_before_Nm = 1.0, d.holdout_after_Nm = 0.5;
    d.holdout_mean_before_Nm = 0.6, d.holdout_mean_after_Nm = 0.3;
    d.holdout_ripple_before_Nm = 0.8, d.holdout_ripple_after_Nm = 0.4;
    TEST_ASSERT_TRUE(is_much_held_out(&d));
    d.holdout_mean_after_Nm = 0.1;
    TEST_ASSERT_FALSE(is_much_held_out(&d));
    d.holdout_ripple_before_Nm = 0.39;
    TEST_ASSERT_TRUE(is_much_held_out(&d));
    d.holdout_ripple_before_Nm = 0.8, d.holdout_mean_after_Nm = 0.3, d.holdout_ripple_after_Nm = 0.25;
    TEST_ASSERT_FALSE(is_much_held_out(&d));
    d.holdout_mean_before_Nm = 0.29;
    TEST_ASSERT_TRUE(is_much_held_out(&d));
    d.holdout_after_Nm = 0.3;
    TEST_ASSERT_FALSE(is_much_held_out(&d));
    d.holdout_after_Nm = NAN;
    TEST_ASSERT_FALSE(is_much_held_out(&d));
}

static hci_verdict sure(void)
{
    return (hci_verdict){.type = hci_effect_type_find("friction"),
                         .in = true,
                         .compared = true,
                         .gain = 10.0,
                         .explained_Nm = 1.0,
                         .stays = 2,
                         .left_out = 3};
}

static void test_what_is_not_confirmed(void)
{
    a.before.score = 1000.0, a.ended = HCI_WORK_LIMITED;
    d.holdout_after_Nm = NAN;
    hci_verdict v = sure();
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    v.stays = 1;
    TEST_ASSERT_TRUE(hci_is_unconfirmed(&a, &d, &v));
    v.established = true;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    v = sure(), v.gain = 0.99; /* a thousandth of what all explain */
    TEST_ASSERT_TRUE(hci_is_unconfirmed(&a, &d, &v));
    d.holdout_after_Nm = 0.1;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    v.compared = false;
    TEST_ASSERT_TRUE(hci_is_unconfirmed(&a, &d, &v));
    v.gain = 1.01;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    a.unknown = true, a.unexplained_Nm = 0.332;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    a.unexplained_Nm = 0.334;
    TEST_ASSERT_TRUE(hci_is_unconfirmed(&a, &d, &v));
    a.unknown = false, a.unsettled = true;
    TEST_ASSERT_TRUE(hci_is_unconfirmed(&a, &d, &v));
    a.ended = HCI_WORK_COMPLETE;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
    a.ended = HCI_WORK_LIMITED, v.in = false;
    TEST_ASSERT_FALSE(hci_is_unconfirmed(&a, &d, &v));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_runs_within_what_was_fitted);
    RUN_TEST(test_runs_of_a_small_motor);
    RUN_TEST(test_errors_are_summed);
    RUN_TEST(test_what_is_described);
    RUN_TEST(test_what_contradicts);
    RUN_TEST(test_what_fitted_runs_are_left_with);
    RUN_TEST(test_whether_errors_rise_at_all);
    RUN_TEST(test_whether_means_and_ripple_rise);
    RUN_TEST(test_what_is_partial);
    RUN_TEST(test_what_is_much);
    RUN_TEST(test_judgements);
    RUN_TEST(test_what_makes_a_ripple);
    RUN_TEST(test_which_runs_take_part);
    RUN_TEST(test_what_an_effect_has_to_lower);
    RUN_TEST(test_what_is_explained);
    RUN_TEST(test_what_is_much_of_runs_held_out);
    RUN_TEST(test_what_is_not_confirmed);
    return UNITY_END();
}
