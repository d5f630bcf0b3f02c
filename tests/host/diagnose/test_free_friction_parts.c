/* The steps from drags of runs to a finding, by hand: which runs tell what, what is denied, where the finding
 * stands, and what an error becomes. */
#include "host/diagnose/free_friction.c"

#include "unity.h"

enum { RUNS = 4, ROWS = 49 };

static double time_s[ROWS], theta_rad[ROWS], speed[ROWS], torque[ROWS], current[3 * ROWS];
static hci_run run[RUNS];
static hci_role role[RUNS];
static hci_runs runs;
static hci_drag drag[RUNS];
static hci_free_friction f;

/* Free shafts of two pole pairs, 48 steps of a millisecond. */
void setUp(void)
{
    memset(&f, 0, sizeof f);
    for (size_t k = 0; k < ROWS; ++k)
        time_s[k] = 0.001 * (double)k;
    for (size_t r = 0; r < RUNS; ++r) {
        run[r] = (hci_run){.name = "r",
                           .time_s = time_s,
                           .theta_m_rad = theta_rad,
                           .speed_rad_per_s = speed,
                           .torque_Nm = torque,
                           .i_A = current,
                           .count = ROWS,
                           .pole_pairs = 2,
                           .torque_source = HCI_TORQUE_INERTIA};
        role[r] = HCI_ROLE_FIT;
        drag[r] = (hci_drag){.drag_Nm = 0.1, .sign = 1.0, .speed_rad_per_s = 10.0};
    }
    runs = (hci_runs){.run = run, .role = role, .count = RUNS};
    f.drag = drag;
}

void tearDown(void)
{
}

/* A turn at so many rad/s in all. */
static void turn(double rad_per_s)
{
    for (size_t k = 0; k < ROWS; ++k)
        theta_rad[k] = rad_per_s * time_s[k];
}

/* 24 samples in an electrical period: 2 · 130.9 rad/s · 1 ms. */
static void test_too_few_samples_in_a_period(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_FALSE(is_coarse_at(&run[0], sign * 130.0));
        TEST_ASSERT_TRUE(is_coarse_at(&run[0], sign * 132.0));
    }
    drag[0].speed_rad_per_s = 132.0;
    TEST_ASSERT_TRUE(is_coarse(&run[0], &drag[0]));
}

static void test_which_runs_may_be_loaded(void)
{
    turn(132.0);
    TEST_ASSERT_TRUE(may_be_loaded(&run[0]));
    turn(-132.0);
    TEST_ASSERT_TRUE(may_be_loaded(&run[0]));
    turn(130.0);
    TEST_ASSERT_FALSE(may_be_loaded(&run[0]));
    turn(132.0);
    for (int which = 0; which < 6; ++which) {
        hci_run one = run[0];
        if (which == 0) one.theta_m_rad = NULL;
        if (which == 1) one.time_s = NULL;
        if (which == 2) one.speed_rad_per_s = NULL;
        if (which == 3) one.i_A = NULL;
        if (which == 4) one.torque_source = HCI_TORQUE_MEASURED;
        if (which == 5) one.count = 2;
        TEST_ASSERT_FALSE(may_be_loaded(&one));
    }
    /* in microseconds any angle would be much */
    for (size_t k = 0; k < ROWS; ++k)
        time_s[k] = 1e-6 * (double)k;
    run[0].theta_m_rad = NULL;
    TEST_ASSERT_FALSE(may_be_loaded(&run[0]));
}

static void test_whose_constant_is_held(void)
{
    TEST_ASSERT_FALSE(hci_constant_is_held(&runs));
    for (size_t r = 0; r < RUNS; ++r)
        run[r].hardly_accelerates = true;
    TEST_ASSERT_TRUE(hci_constant_is_held(&runs));
    run[2].hardly_accelerates = false;
    TEST_ASSERT_FALSE(hci_constant_is_held(&runs));
    role[2] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_TRUE(hci_constant_is_held(&runs));
    role[2] = HCI_ROLE_FIT;
    run[2].torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_TRUE(hci_constant_is_held(&runs));
    run[2].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_FALSE(hci_constant_is_held(&runs));
    TEST_ASSERT_TRUE(any_measured(&runs));
    role[2] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_FALSE(any_measured(&runs));
    for (size_t r = 0; r < RUNS; ++r)
        run[r].torque_source = HCI_TORQUE_NONE;
    TEST_ASSERT_FALSE(hci_constant_is_held(&runs));
}

/* Runs held out of 0.1 and 0.2 N·m: Coulomb's friction of 0.15 N·m describes them, of 0.35 does not. */
static void test_what_is_denied(void)
{
    f.law.terms = 1;
    for (int much = 0; much < 2; ++much) {
        f.law.value[0] = much ? 0.35 : 0.15;
        role[1] = role[3] = HCI_ROLE_HOLDOUT;
        drag[3].drag_Nm = 0.2;
        drag[0].drag_Nm = drag[2].drag_Nm = NAN;
        TEST_ASSERT_EQUAL(much, is_denied(&runs, &f));
    }
    drag[1].drag_Nm = drag[3].drag_Nm = NAN;
    TEST_ASSERT_FALSE(is_denied(&runs, &f));
    drag[1].drag_Nm = 0.01; /* of a small motor: 1e-4 N²m² */
    TEST_ASSERT_TRUE(is_denied(&runs, &f));
    f.law.value[0] = 0.012;
    TEST_ASSERT_FALSE(is_denied(&runs, &f));
}

/* Runs that are too coarse are apart, unless nothing would be left. */
static void test_what_is_apart(void)
{
    static bool is_apart[RUNS];
    f.is_apart = is_apart;
    drag[1].speed_rad_per_s = -200.0;
    drag[2].speed_rad_per_s = 200.0;
    drag[2].drag_Nm = NAN;
    set_apart(&runs, &f);
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_EQUAL(r == 1, is_apart[r]);
    for (int which = 0; which < 4; ++which) {
        for (size_t r = 0; r < RUNS; ++r) {
            drag[r] = (hci_drag){.drag_Nm = 0.1, .speed_rad_per_s = r < 3 ? 200.0 : 10.0};
            role[r] = HCI_ROLE_FIT;
        }
        if (which == 1) role[3] = HCI_ROLE_HOLDOUT;
        if (which == 2) run[3].theta_m_rad = NULL;
        if (which == 3) run[3].only_mean = true;
        set_apart(&runs, &f);
        for (size_t r = 0; r < RUNS; ++r)
            TEST_ASSERT_EQUAL((which == 0 || which == 3) && r < 3, is_apart[r]);
    }
}

/* Means of 0.3 N·m before and 0.4 after, of ripples of 0.4 and 0.3: 0.5 N·m in all. */
static void test_errors_of_a_mean(void)
{
    hci_run_errors e = {.ripple_before_Nm = 0.4,
                        .ripple_after_Nm = 0.3,
                        .rms_after_Nm = 0.2,
                        .after_low_Nm = 0.1,
                        .after_high_Nm = 0.25};
    put_mean(0.3, -0.4, &e);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, e.rms_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, e.rms_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25, e.after_low_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.625, e.after_high_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, e.error_mean_before_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(-0.4, e.error_mean_after_Nm);
    e = (hci_run_errors){.after_low_Nm = 0.1, .after_high_Nm = 0.25};
    put_mean(0.0, 0.4, &e);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, e.after_low_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, e.after_high_Nm);
}

/* Takes the place of what was rejected, in front of all but what is unknown. */
static void test_where_the_finding_stands(void)
{
    static hci_diagnosis d;
    for (int unknown = 0; unknown < 2; ++unknown)
        for (int verdict = HCI_FINDING_ADDED; verdict <= HCI_FINDING_REJECTED; ++verdict) {
            const bool is_put = verdict == HCI_FINDING_REJECTED;
            memset(&d, 0, sizeof d);
            d.finding[0].effect = unknown ? "unknown" : "cogging";
            d.finding[1].effect = "back_emf";
            d.finding[2] = (hci_finding){.effect = "friction", .verdict = (hci_finding_verdict)verdict};
            d.finding[3].effect = "reluctance";
            d.findings = 4;
            f.law =
                (hci_drag_law){.terms = 2, .value = {0.25, 1e-3}, .std_error = {0.01, 2e-4}, .gain = 33.0};
            put_finding(&f, &d);
            TEST_ASSERT_EQUAL_UINT(4, d.findings);
            TEST_ASSERT_EQUAL_STRING("reluctance", d.finding[3].effect);
            TEST_ASSERT_EQUAL_STRING(is_put ? "back_emf" : "friction", d.finding[2].effect);
            if (!is_put) continue;
            const hci_finding *x = &d.finding[unknown];
            TEST_ASSERT_EQUAL_STRING("friction", x->effect);
            TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, x->verdict);
            TEST_ASSERT_EQUAL_DOUBLE(33.0, x->delta_bic);
            TEST_ASSERT_TRUE(isnan(x->residual_share));
            TEST_ASSERT_EQUAL_STRING(
                "coulomb = 0.25 ± 0.01 Nm; viscous = 0.001 ± 0.0002 Nms_per_rad, times the "
                "declared torque per ampere",
                x->detail);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_too_few_samples_in_a_period);
    RUN_TEST(test_which_runs_may_be_loaded);
    RUN_TEST(test_whose_constant_is_held);
    RUN_TEST(test_what_is_denied);
    RUN_TEST(test_what_is_apart);
    RUN_TEST(test_errors_of_a_mean);
    RUN_TEST(test_where_the_finding_stands);
    return UNITY_END();
}
