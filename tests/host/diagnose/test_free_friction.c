/* Shafts without a torque sensor at constant speed: their mean currents are friction, by the declared torque
 * per ampere. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/free_friction.h"
#include "host/recording/free_shaft.h"

#include "support/diagnosing.h"
#include "support/texts.h"

enum { N = 600 };

static const double COULOMB_NM = 0.3, VISCOUS = 1e-3;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* The current of a shaft that friction alone brakes, with a load; its acceleration is noise. per_turn:
 * samples. */
static void record_free(double speed, double load_Nm, double per_turn)
{
    const double drag = (speed > 0.0 ? COULOMB_NM : -COULOMB_NM) + VISCOUS * speed + load_Nm;
    record(N, &(point){speed, drag / (1.5 * K_NM_PER_A), 0.0, drag, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < N; ++k) {
        r->theta_m_rad[k] *= 300.0 / per_turn;
        r->time_s[k] = r->theta_m_rad[k] / speed;
        const double noise_A = 0.002 * ref_normal(&seed),
                     iq_A = drag / (1.5 * K_NM_PER_A) + 0.002 * ref_normal(&seed);
        rec_phases(noise_A, iq_A, P * r->theta_m_rad[k], r->i_A + 3 * k);
    }
}

static void record_all(double load_Nm, double per_turn)
{
    static const double SPEED[] = {20.0, -20.0, 150.0, -150.0};
    for (int k = 0; k < 4; ++k)
        record_free(SPEED[k], load_Nm, per_turn);
    role[3] = HCI_ROLE_HOLDOUT;
}

static void test_friction_of_mean_currents(void)
{
    char words[2048];
    record_all(0.0, 300.0);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_DIAGNOSIS_EXPLAINED, diagnosis.verdict);
    TEST_ASSERT_EQUAL(1, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("friction")->verdict);
    text_has("times the declared torque per ampere", found("friction")->detail);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, COULOMB_NM, term("friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(2e-4, VISCOUS, term("friction", "viscous", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.45, diagnosis.holdout_mean_before_Nm);
    TEST_ASSERT_TRUE(diagnosis.holdout_mean_after_Nm < 0.01);
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    text_has("The mean currents of 4 of them, at constant speed, are friction.", words);
    text_has("times the declared 0.3 N·m/A", words);
}

/* A weight pulls one way: what its runs ask for on average is not known. */
static void test_a_weight_is_no_friction(void)
{
    record_all(0.2, 300.0);
    diagnose(NULL);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("friction")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("back_emf")->verdict);
    TEST_ASSERT_EQUAL(0, diagnosis.of_mean_currents);
}

/* A holding test shows cogging torque, and goes on showing it beside shafts whose samples are too far apart
 * for it. */
static void test_more_recordings_tell_no_less(void)
{
    record_holding(800, COULOMB_NM, 0.1, 0.0);
    record_all(0.0, 40.0);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1, term("cogging", "sine", 6.0)->value);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_EQUAL(5, diagnosis.runs);
    TEST_ASSERT_EQUAL_STRING("run_0.csv", diagnosis.run[0].file);
    TEST_ASSERT_EQUAL_STRING("run_4.csv", diagnosis.run[4].file);
    TEST_ASSERT_TRUE(diagnosis.held_constant_Nm_per_A > 0.29);
}

enum { STEPS = 20 }; /* of the equation in a sample */

/* A drum with a weight on one side, held at a speed by a weak control: the weight swings the speed, so that
 * the drum is where it is slow for longer, J dω/dt = T − T_c sign ω + W cos θ. */
static void record_drum(double speed, double seconds)
{
    const double inertia = 0.02, weight_Nm = 0.25, step_s = 5e-4, sign = speed < 0.0 ? -1.0 : 1.0;
    double theta = 0.3, w = speed;
    record((size_t)(seconds / step_s / STEPS), &(point){speed, 0.0, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < r->count * STEPS; ++k) {
        const double made = sign * COULOMB_NM + 0.1 * (speed - w);
        const double rest = made - sign * COULOMB_NM + weight_Nm * cos(theta);
        if (k % STEPS == 0) {
            const size_t j = k / STEPS;
            r->time_s[j] = step_s * (double)k;
            r->theta_m_rad[j] = theta;
            r->speed_rad_per_s[j] = w;
            r->torque_Nm[j] = rest + 1e-4 * ref_normal(&seed);
            rec_phases(0.0, made / (1.5 * K_NM_PER_A) + 0.002 * ref_normal(&seed), P * theta, r->i_A + 3 * j);
        }
        w += step_s * rest / inertia;
        theta += step_s * w;
    }
}

/* What a weight does over a turn is nothing, though its torque has a mean over time: its friction is that of
 * the bearings, whatever part of a turn the recording ends in. */
static void test_a_weight_that_swings_the_speed_brakes_nothing(void)
{
    static const double SPEED[] = {6.0, -6.0, 7.0, -9.0};
    const hci_effects none = {NULL, 0};
    hci_drag drag[4];
    hci_note note = {{0}};
    for (int k = 0; k < 4; ++k)
        record_drum(SPEED[k], 20.0 + 0.3 * k);
    TEST_ASSERT_EQUAL(HCI_OK, hci_free_shafts_find(&machine, &none, run, 4, drag, &note));
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * COULOMB_NM, COULOMB_NM, drag[k].drag_Nm * drag[k].sign);
}

/* A log at 10 Hz of a vehicle: the current goes into inertia × acceleration, friction and the road. */
static void record_ride(double road_Nm, double from)
{
    const double inertia = 0.5, step_s = 0.1;
    record(900, &(point){20.0, 0.0, 0.0, 0.0, 0.0});
    hci_run *r = &run[runs.count - 1];
    r->torque_source = HCI_TORQUE_INERTIA;
    r->pole_pairs = P;
    for (size_t k = 0; k < r->count; ++k) {
        const double t = step_s * (double)k, speed = 20.0 + 4.0 * sin(t / 9.0 + from);
        r->time_s[k] = t;
        r->speed_rad_per_s[k] = speed;
        r->theta_m_rad[k] = 20.0 * t - 36.0 * cos(t / 9.0 + from);
        r->torque_Nm[k] = inertia * 4.0 / 9.0 * cos(t / 9.0 + from) + 0.01 * ref_normal(&seed);
        const double made = r->torque_Nm[k] + 0.05 + 0.002 * speed + road_Nm * sin(t / 23.0 + 2.0 * from);
        rec_phases(0.02 * ref_normal(&seed), made / (1.5 * K_NM_PER_A), P * r->theta_m_rad[k],
                   r->i_A + 3 * k);
    }
}

static void diagnose_rides(double road_Nm)
{
    machine.rated_torque_Nm = 3.0;
    for (int k = 0; k < 3; ++k)
        record_ride(road_Nm, 1.7 * k);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
}

/* What nobody has recorded is no iron and no sensor: the torque is not known. */
static void test_a_road_is_none_of_the_motor(void)
{
    diagnose_rides(1.2);
    TEST_ASSERT_TRUE(diagnosis.nothing_measured);
    TEST_ASSERT_EQUAL(0, count_of(HCI_FINDING_ADDED));
    text_has("that load is not known", run[0].remark.text);
}

static void test_friction_is_no_road(void)
{
    diagnose_rides(0.0);
    TEST_ASSERT_FALSE(diagnosis.nothing_measured);
}

/* ---- what is told, of numbers that are written down here */

enum { DRAGS = 5 };

static const double DRAG_NM[DRAGS] = {0.32, -0.33, 0.41, -0.345, 0.1};

/* Five runs: the second and the fourth apart, the third without errors, and no mean of the last. */
static hci_status tell(hci_diagnosis_verdict before, double coulomb_Nm, hci_diagnosis *d)
{
    static hci_effect_term of_friction = {HCI_DRAG_COULOMB, 0.0, 0.0, NAN};
    static hci_effect friction;
    static hci_residual_line line[2];
    static const double SPEED[DRAGS] = {20.0, -20.0, 30.0, -50.0, 70.0};
    bool apart[DRAGS] = {false, true, false, true, false};
    hci_drag drag[DRAGS];
    hci_note note = {{0}};
    for (size_t k = 0; k < DRAGS; ++k) {
        record(40, &(point){SPEED[k], 0.0, 0.0, -0.2 * (double)k, 0.0});
        run[k].torque_source = HCI_TORQUE_INERTIA;
        drag[k] = (hci_drag){.drag_Nm = k == 4 ? (double)NAN : DRAG_NM[k],
                             .sign = SPEED[k] < 0.0 ? -1.0 : 1.0,
                             .speed_rad_per_s = SPEED[k],
                             .square = SPEED[k] * fabs(SPEED[k])};
    }
    role[3] = HCI_ROLE_HOLDOUT;
    const hci_free_friction f = {
        .drag = drag, .is_apart = apart, .law = {.terms = 1, .gain = 42.0}, .declared = {0.1, 0.0, 0.0}};
    of_friction.value = 0.1 + coulomb_Nm;
    friction = (hci_effect){hci_effect_type_find("friction"), &of_friction, 1};
    *d = (hci_diagnosis){.verdict = before, .runs = 2, .line = line, .lines = 2, .findings = 3};
    d->effects.list = (hci_effects){&friction, 1};
    d->run = hci_memory_new(2, sizeof *d->run);
    d->run[0] = (hci_run_errors){.file = run[0].name,
                                 .role = HCI_ROLE_FIT,
                                 .rms_after_Nm = 0.08,
                                 .ripple_before_Nm = 0.4,
                                 .ripple_after_Nm = 0.03,
                                 .after_low_Nm = 0.04,
                                 .after_high_Nm = 0.07};
    d->run[1] = (hci_run_errors){.file = run[4].name, .role = HCI_ROLE_FIT, .error_mean_after_Nm = 7.0};
    line[0].run = 1;
    line[1].run = 0;
    d->finding[0].effect = "unknown";
    d->finding[1].effect = "cogging";
    d->finding[2].effect = "friction";
    d->finding[2].verdict = HCI_FINDING_REJECTED;
    return hci_free_friction_tell(&f, &runs, d, &note);
}

/* In the order of the list, with what the lines have of it; what of a run apart varies is as it was. */
static void test_the_errors_of_all_runs(void)
{
    hci_diagnosis d;
    TEST_ASSERT_EQUAL(HCI_OK, tell(HCI_DIAGNOSIS_COMPLETE, 0.36, &d));
    TEST_ASSERT_EQUAL_UINT64(4, d.runs);
    TEST_ASSERT_EQUAL_UINT64(3, d.of_mean_currents);
    static const size_t IS[4] = {0, 1, 3, 4};
    for (size_t k = 0; k < 4; ++k)
        TEST_ASSERT_EQUAL_PTR(run[IS[k]].name, d.run[k].file);
    TEST_ASSERT_EQUAL_UINT64(3, d.line[0].run);
    TEST_ASSERT_EQUAL_UINT64(0, d.line[1].run);
    TEST_ASSERT_EQUAL(HCI_ROLE_HOLDOUT, d.run[2].role);
    TEST_ASSERT_EQUAL(HCI_ROLE_FIT, d.run[1].role);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, d.run[1].source);
    for (size_t k = 0; k < 3; ++k) {
        const double after = (IS[k] % 2 ? -0.36 : 0.36) - DRAG_NM[IS[k]];
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, -DRAG_NM[IS[k]], d.run[k].error_mean_before_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, after, d.run[k].error_mean_after_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, hypot(d.run[k].ripple_before_Nm, DRAG_NM[IS[k]]),
                                  d.run[k].rms_before_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, hypot(d.run[k].ripple_after_Nm, after), d.run[k].rms_after_Nm);
    }
    const double share = hypot(0.03, 0.04) / 0.08;
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.04 * share, d.run[0].after_low_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.07 * share, d.run[0].after_high_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, d.run[3].error_mean_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.2, d.run[1].mean_torque_Nm);
    double square = 0.0;
    for (size_t k = 0; k < 40; ++k)
        square += pow(run[1].torque_Nm[k] - d.run[1].mean_torque_Nm, 2.0) / 40.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square), d.run[1].ripple_before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square), d.run[1].ripple_after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square), d.run[1].noise_floor_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.015, d.holdout_mean_after_Nm);
    hci_memory_free(d.run);
}

/* Behind what is not known, with what it was found by. */
static void test_it_is_a_finding(void)
{
    hci_diagnosis d;
    TEST_ASSERT_EQUAL(HCI_OK, tell(HCI_DIAGNOSIS_COMPLETE, 0.36, &d));
    TEST_ASSERT_EQUAL_UINT64(3, d.findings);
    TEST_ASSERT_EQUAL_STRING("unknown", d.finding[0].effect);
    TEST_ASSERT_EQUAL_STRING("friction", d.finding[1].effect);
    TEST_ASSERT_EQUAL_STRING("cogging", d.finding[2].effect);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, d.finding[1].verdict);
    TEST_ASSERT_EQUAL_DOUBLE(42.0, d.finding[1].delta_bic);
    TEST_ASSERT_TRUE(isnan(d.finding[1].residual_share));
    hci_memory_free(d.run);
}

/* Of a Coulomb's friction x the means 0.32, −0.33 and −0.345 leave 3 (x − mean)² and their squares about
 * their mean: up to a hundredth of all of it, as a tenth of the rms. */
static void test_how_much_the_friction_of_the_machine_leaves(void)
{
    static const hci_diagnosis_verdict BEFORE[] = {HCI_DIAGNOSIS_COMPLETE, HCI_DIAGNOSIS_EXPLAINED,
                                                   HCI_DIAGNOSIS_UNKNOWN, HCI_DIAGNOSIS_PARTLY},
                                       WELL[] = {HCI_DIAGNOSIS_EXPLAINED, HCI_DIAGNOSIS_EXPLAINED,
                                                 HCI_DIAGNOSIS_PARTLY, HCI_DIAGNOSIS_PARTLY};
    const double mean = (0.32 + 0.33 + 0.345) / 3.0, whole = 0.32 * 0.32 + 0.33 * 0.33 + 0.345 * 0.345;
    const double far = sqrt((0.01 * whole - (whole - 3.0 * mean * mean)) / 3.0);
    for (size_t k = 0; k < 4; ++k)
        for (int side = -1; side <= 1; side += 2)
            for (int over = 0; over < 2; ++over) {
                hci_diagnosis d;
                tearDown();
                setUp();
                TEST_ASSERT_EQUAL(HCI_OK, tell(BEFORE[k], mean + side * far * (over ? 1.02 : 0.98), &d));
                TEST_ASSERT_EQUAL(over ? HCI_DIAGNOSIS_PARTLY : WELL[k], d.verdict);
                hci_memory_free(d.run);
            }
}

static void test_memory(void)
{
    record_free(20.0, 0.0, 300.0);
    record_free(-20.0, 0.0, 300.0);
    for (long k = 0; k < 40; ++k)
        diagnose_with(k);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_friction_of_mean_currents);
    RUN_TEST(test_a_weight_is_no_friction);
    RUN_TEST(test_more_recordings_tell_no_less);
    RUN_TEST(test_a_weight_that_swings_the_speed_brakes_nothing);
    RUN_TEST(test_a_road_is_none_of_the_motor);
    RUN_TEST(test_friction_is_no_road);
    RUN_TEST(test_the_errors_of_all_runs);
    RUN_TEST(test_it_is_a_finding);
    RUN_TEST(test_how_much_the_friction_of_the_machine_leaves);
    RUN_TEST(test_memory);
    return UNITY_END();
}
