/* What may be said of recordings: what runs held out and means of runs contradict is not explained, what is
 * certain is kept, and what looks alike is not told apart. */
#include "host/diagnose/held_out.h"

#include "host/machine/torque_constant.h"
#include "support/searching.h"

enum { SAMPLES = 450 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Runs there and back at three currents; friction in all of them. */
static void record_with_friction(size_t count, double brake_Nm)
{
    for (size_t k = 0; k < count; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0;
        record(SAMPLES, &(point){sign * (60.0 + 15.0 * (double)k), 2.0 + 3.0 * (double)(k % 3), 0.0,
                                 sign * brake_Nm, 0.0});
    }
}

static void add_cogging(size_t r, double amplitude_Nm)
{
    for (size_t j = 0; j < SAMPLES; ++j)
        run[r].torque_Nm[j] += amplitude_Nm * sin(6.0 * P * run[r].theta_m_rad[j]);
}

/* Cogging that the run held out does not show, and friction that it does. */
static void test_what_is_certain_is_kept(void)
{
    record_with_friction(8, 0.03);
    role[2] = role[3] = HCI_ROLE_HOLDOUT;
    for (size_t k = 0; k < 8; ++k)
        add_cogging(k, role[k] == HCI_ROLE_FIT ? 0.06 : -0.06);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
    TEST_ASSERT_TRUE(diagnosis.contradicted);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("cogging")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.003, 0.03, term("friction", "coulomb", 0.0)->value);
}

/* Beside friction a hundredth of it, by χ², of cogging that the runs held out do not show: it is left out,
 * and what is left is too little to be said unknown. */
static void test_small_effects_that_mislead_are_left_out(void)
{
    record_with_friction(8, 0.03);
    role[2] = role[3] = HCI_ROLE_HOLDOUT;
    for (size_t k = 0; k < 8; ++k)
        add_cogging(k, role[k] == HCI_ROLE_FIT ? 0.004 : -0.004);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found("cogging")->verdict);
}

/* And what they show stays, however small. */
static void test_small_effects_that_predict_stay(void)
{
    record_with_friction(8, 0.03);
    role[2] = role[3] = HCI_ROLE_HOLDOUT;
    for (size_t k = 0; k < 8; ++k)
        add_cogging(k, 0.004);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
}

/* The mean error of a run is known better than a sample: half of the noise of one is not noise. */
static void test_means_of_runs_are_judged(void)
{
    hci_run_errors error = {.role = HCI_ROLE_FIT, .rms_before_Nm = 0.2, .noise_floor_Nm = 0.02};
    const hci_diagnosis of_one = {
        .run = &error, .runs = 1, .holdout_after_Nm = NAN, .holdout_ripple_after_Nm = NAN};
    const hci_dataset none = {0};
    error.error_mean_after_Nm = -0.009;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
    error.error_mean_after_Nm = -0.021;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
    error.rms_before_Nm = 0.5; /* next to nothing beside what it was */
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
}

/* Two recordings at one current, of which the second is held out. */
static void hold_one_out(void)
{
    record(SAMPLES, &(point){60.0, 9.0, 0.0, 0.0, 0.0});
    record(SAMPLES, &(point){60.0, 9.0, 0.0, 0.0, 0.0});
    role[1] = HCI_ROLE_HOLDOUT;
    search_start();
}

/* An error held out that is larger for the effects, unless it is the noise. */
static void test_a_rise_is_seen(void)
{
    hci_run_errors error = {
        .role = HCI_ROLE_HOLDOUT, .rms_before_Nm = 0.048, .rms_after_Nm = 0.193, .noise_floor_Nm = 0.01};
    const hci_diagnosis of_one = {.run = &error, .runs = 1};
    hold_one_out();
    error.file = run[1].name;
    TEST_ASSERT_TRUE(hci_held_out_rises(&dataset, &runs, &of_one, 1e-4));
    error.rms_after_Nm = 0.047;
    TEST_ASSERT_FALSE(hci_held_out_rises(&dataset, &runs, &of_one, 1e-4));
    error.rms_after_Nm = 0.014;
    error.rms_before_Nm = 0.012;
    TEST_ASSERT_FALSE(hci_held_out_rises(&dataset, &runs, &of_one, 1e-4));
    search_end();
}

/* An error that stands out of a noise that is known well, by less than half of it, and of which three
 * quarters are left. A slope is not known that well. */
static void test_a_small_error_that_hardly_falls_is_seen(void)
{
    hci_run_errors error = {
        .role = HCI_ROLE_HOLDOUT, .rms_before_Nm = 0.0143, .rms_after_Nm = 0.0133, .noise_floor_Nm = 0.01};
    const hci_diagnosis of_one = {.run = &error, .runs = 1};
    hold_one_out();
    error.file = run[1].name;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_CONTRADICTED, hci_held_out_judge(&dataset, &runs, &of_one, 1e-4));
    error.rms_after_Nm = 0.0119; /* as noise is by chance */
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&dataset, &runs, &of_one, 1e-4));
    error.rms_after_Nm = 0.0133;
    error.rms_before_Nm = 0.03;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&dataset, &runs, &of_one, 1e-4));
    error.rms_before_Nm = 0.0143;
    run[1].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&dataset, &runs, &of_one, 1e-4));
    search_end();
}

/* Below what noise and resolution allow a rise is seen too, where it is no chance: then it is not all. */
static void test_a_rise_near_the_noise_is_not_explained(void)
{
    hci_run_errors error = {.role = HCI_ROLE_HOLDOUT, .noise_floor_Nm = 0.01, .rms_before_Nm = 0.0105};
    hci_diagnosis of_one = {.run = &error, .runs = 1, .holdout_before_Nm = 0.0105, .holdout_noise_Nm = 0.01};
    hold_one_out();
    error.file = run[1].name;
    error.rms_after_Nm = of_one.holdout_after_Nm = 0.0118;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, hci_held_out_judge(&dataset, &runs, &of_one, 1e-5));
    error.rms_after_Nm = of_one.holdout_after_Nm = 0.0106;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&dataset, &runs, &of_one, 1e-5));
    search_end();
}

/* What is left of all runs, or of one of them, well above the noise. */
static void test_much_that_is_left(void)
{
    hci_run_errors error = {.rms_after_Nm = 0.03, .noise_floor_Nm = 0.01};
    hci_diagnosis d = {
        .run = &error, .runs = 1, .rms_after_Nm = 0.015, .noise_Nm = 0.01, .holdout_after_Nm = NAN};
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 1e-4));
    d.rms_after_Nm = 0.025;
    TEST_ASSERT_TRUE(hci_held_out_leaves_much(&d, 1e-4));
    TEST_ASSERT_FALSE(hci_held_out_leaves_much(&d, 1e-2));
    d.rms_after_Nm = 0.015;
    error.rms_after_Nm = 0.05;
    TEST_ASSERT_TRUE(hci_held_out_leaves_much(&d, 1e-4));
}

/* Mean and ripple of 450 samples that are off by three tenths of their noise are χ² of 40 more each; where
 * one of them alone rises, the other speaks for the effects. */
static void test_a_rise_of_both_is_seen(void)
{
    hci_run_errors error = {.role = HCI_ROLE_HOLDOUT, .noise_floor_Nm = 0.01};
    const hci_diagnosis of_one = {.run = &error, .runs = 1};
    hold_one_out();
    error.file = run[1].name;
    error.error_mean_after_Nm = error.ripple_after_Nm = 0.003;
    TEST_ASSERT_TRUE(hci_held_out_rises_both(&dataset, &runs, &of_one));
    error.ripple_before_Nm = 0.003;
    TEST_ASSERT_FALSE(hci_held_out_rises_both(&dataset, &runs, &of_one));
    error.ripple_before_Nm = 0.0;
    error.error_mean_before_Nm = 0.0029;
    TEST_ASSERT_FALSE(hci_held_out_rises_both(&dataset, &runs, &of_one));
    search_end();
}

/* Nor is a ripple that is three times the noise of a run and most of what it was, such as of a lag in place
 * of a delay; noise of slopes is known by half. */
static void test_ripple_of_fitted_runs_is_judged(void)
{
    hci_run_errors error = {.role = HCI_ROLE_FIT, .rms_before_Nm = 0.15, .noise_floor_Nm = 0.02};
    const hci_diagnosis of_one = {
        .run = &error, .runs = 1, .holdout_after_Nm = NAN, .holdout_ripple_after_Nm = NAN};
    const hci_dataset none = {0};
    error.ripple_after_Nm = 0.039;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
    error.ripple_after_Nm = 0.06;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
    error.rms_before_Nm = 0.25; /* less than a third of it is left */
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, hci_held_out_judge(&none, &runs, &of_one, 1e-4));
}

/* In one direction friction is not told from the zero of the sensor; so little of either beside much cogging
 * is neither, and no one asks which. */
static void test_faint_effects_leave_as_a_pair(void)
{
    for (size_t k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){60.0, 2.0 + 3.0 * (double)(k % 3), 0.0, 0.0013, 0.0});
        add_cogging(k, 0.5);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_UINT64(0, count_of(HCI_FINDING_AMBIGUOUS));
}

/* Whether an effect is kept that takes two fifths of the error of a run held out, order 6 at 4 A. */
static bool is_kept(const char *effect, const char *parameter, double by_value_Nm)
{
    record_with_friction(4, 0.0);
    record(SAMPLES, &(point){60.0, 4.0, 0.0, 0.0, 0.0});
    role[4] = HCI_ROLE_HOLDOUT;
    add_cogging(4, 0.2);
    search_start();
    model_add(effect, parameter, NULL, 6.0);
    model.candidates.reference_current_A = 4.0;
    model.candidates.candidate[0].term[0].value = 0.4 * 0.2 / by_value_Nm;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_held_out_keep(&dataset, &runs, &model.candidates, &note));
    const bool kept = model_has(effect);
    search_end();
    return kept;
}

/* Where the runs held out speak against the whole, what helps is kept; a series helps with anything, and has
 * to halve the error. */
static void test_what_helps_is_kept(void)
{
    TEST_ASSERT_TRUE(is_kept("cogging", "sine", 1.0));
    tearDown();
    setUp();
    TEST_ASSERT_FALSE(is_kept("saturation", "d0q3_cosine", -6.0 * P));
}

/* The series in the currents that does not describe a run held out, whose ripple is given: of a saturation
 * that describes 0.2 N·m in the runs that were fitted. */
static const hci_effect_type *idle_series(double held_out_Nm)
{
    hci_attribution a = {.types = hci_candidate_types()};
    const hci_effect_type *type = NULL;
    for (size_t k = 0; k < 5; ++k) {
        record(SAMPLES, &(point){60.0, 4.0, 0.0, 0.0, 0.0});
        add_cogging(k, k < 4 ? 0.2 : held_out_Nm);
    }
    role[4] = HCI_ROLE_HOLDOUT;
    search_start();
    model_add("saturation", "d0q3_cosine", NULL, 6.0);
    model.candidates.reference_current_A = 4.0;
    model_fit();
    for (size_t r = 0; r < a.types; ++r) {
        a.verdict[r].type = hci_candidate_type(r);
        a.verdict[r].in = hci_candidates_have(&model.candidates, hci_candidate_type(r));
    }
    a.model = model;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_held_out_idle_series(&dataset, &runs, &a, &type, &note));
    search_end();
    return type;
}

/* Twice as large without it, or more, the error has to be. */
static void test_a_series_has_to_describe_what_is_held_out(void)
{
    TEST_ASSERT_NULL(idle_series(0.2));
    tearDown();
    setUp();
    const hci_effect_type *idle = idle_series(0.11);
    TEST_ASSERT_TRUE(idle && strcmp(idle->name, "saturation") == 0);
}

static hci_held_out_result judged(hci_diagnosis d)
{
    const hci_dataset none = {0};
    d.holdout_noise_Nm = 0.02;
    return hci_held_out_judge(&none, &runs, &d, 1e-4);
}

/* Beyond the currents that were fitted nothing is contradicted, but what rises there is not explained; nor is
 * a ripple that stays while the mean alone falls. */
static void test_what_rises_is_not_explained(void)
{
    hci_diagnosis d = {.holdout_before_Nm = 0.06, .holdout_after_Nm = 0.05, .holdout_ripple_after_Nm = NAN};
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, judged(d));
    d.holdout_before_Nm = 0.04;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, judged(d));
    d = (hci_diagnosis){.holdout_before_Nm = 0.5, .holdout_after_Nm = 0.05, .holdout_ripple_after_Nm = 0.05};
    d.holdout_ripple_before_Nm = 0.051;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_PARTLY, judged(d));
    d.holdout_ripple_before_Nm = 0.06;
    TEST_ASSERT_EQUAL_INT(HCI_HELD_OUT_DESCRIBED, judged(d));
}

/* All three sensors wrong alike, or magnets that are weaker: not told apart. */
static void test_equal_gains_are_not_told_from_magnets(void)
{
    record_with_friction(6, 0.0);
    for (size_t r = 0; r < 6; ++r)
        for (size_t j = 0; j < 3 * SAMPLES; ++j)
            run[r].i_A[j] *= 1.1;
    diagnose(NULL);
    TEST_ASSERT_FALSE(found("current_gain")->verdict == HCI_FINDING_ADDED);
    TEST_ASSERT_FALSE(found("phase_imbalance")->verdict == HCI_FINDING_ADDED);
    TEST_ASSERT_FALSE(found("back_emf")->verdict == HCI_FINDING_REJECTED);
}

/* Torques over i_d and i_q without an angle: 3/2 p (L_d − L_q) i_d i_q more than the magnets make. */
static void test_a_torque_map_tells_reluctance(void)
{
    static const double SALIENCY_H = -2e-3;
    enum { ROWS = 49 };
    hci_run *r = add_run(ROWS);
    free(r->theta_m_rad);
    free(r->time_s);
    r->theta_m_rad = r->time_s = NULL;
    r->only_mean = true;
    for (size_t k = 0; k < ROWS; ++k) {
        const double id = -6.0 + 2.0 * (double)(k % 7), iq = -6.0 + 2.0 * (double)(k / 7);
        rec_phases(id, iq, 0.0, r->i_A + 3 * k);
        r->speed_rad_per_s[k] = 50.0;
        r->torque_Nm[k] =
            1.5 * K_NM_PER_A * iq + 1.5 * P * SALIENCY_H * id * iq + NOISE_NM * ref_normal(&seed);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_UINT64(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("reluctance")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.06 * NOISE_NM + 2e-3, NOISE_NM, diagnosis.rms_after_Nm);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.lines); /* orders are not in it */
}

/* Current ripple of an order that smoothing cannot hold: known to the model as it was read, it is no unknown
 * torque. */
static void test_ripple_of_high_orders_is_no_torque(void)
{
    for (size_t k = 0; k < 4; ++k) {
        record(1800, &(point){k % 2 ? -60.0 : 60.0, 4.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 1800; ++j) {
            double more[3];
            const double theta = P * run[k].theta_m_rad[j];
            rec_phases(0.0, 1.5 * sin(37.0 * theta), theta, more);
            for (size_t s = 0; s < 3; ++s)
                run[k].i_A[3 * j + s] += more[s];
            run[k].torque_Nm[j] += 1.5 * K_NM_PER_A * 1.5 * sin(37.0 * theta);
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_certain_is_kept);
    RUN_TEST(test_small_effects_that_mislead_are_left_out);
    RUN_TEST(test_small_effects_that_predict_stay);
    RUN_TEST(test_means_of_runs_are_judged);
    RUN_TEST(test_a_rise_is_seen);
    RUN_TEST(test_a_small_error_that_hardly_falls_is_seen);
    RUN_TEST(test_a_rise_near_the_noise_is_not_explained);
    RUN_TEST(test_much_that_is_left);
    RUN_TEST(test_a_rise_of_both_is_seen);
    RUN_TEST(test_ripple_of_fitted_runs_is_judged);
    RUN_TEST(test_faint_effects_leave_as_a_pair);
    RUN_TEST(test_what_helps_is_kept);
    RUN_TEST(test_a_series_has_to_describe_what_is_held_out);
    RUN_TEST(test_what_rises_is_not_explained);
    RUN_TEST(test_equal_gains_are_not_told_from_magnets);
    RUN_TEST(test_a_torque_map_tells_reluctance);
    RUN_TEST(test_ripple_of_high_orders_is_no_torque);
    return UNITY_END();
}
