/* Two or three effects of few values before a series in the currents that describes nearly anything. */
#include "host/diagnose/search/few_values.h"

#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/forward.h"
#include "support/searching.h"

#define WEAKER    0.06   /* share of the torque per ampere */
#define SALIENT_H 0.0004 /* L_d − L_q */

enum { SAMPLES = 300, POINTS = 7 }; /* a mechanical turn */

static const double SPEED[POINTS] = {25.0, -25.0, 25.0, -150.0, 150.0, -25.0, 150.0};
static const double D_A[POINTS] = {0.0, 0.0, 0.0, -4.5, 3.0, 0.0, 0.0};
static const double Q_A[POINTS] = {0.0, 0.0, 10.0, 6.0, 8.0, -10.0, 3.0};

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Weak magnets and a salient rotor: T = 3/2 K (1 − w) i_q + 3/2 p ΔL i_d i_q. */
static void record_salient(double brake_Nm)
{
    for (int k = 0; k < POINTS; ++k) {
        const double d = D_A[k], q = Q_A[k];
        record(SAMPLES, &(point){SPEED[k], q, 0.0, SPEED[k] < 0.0 ? -brake_Nm : brake_Nm, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) { /* i_d makes no torque with a sinusoidal back-EMF */
            rec_phases(d, q, P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 1.5 * q * (P * SALIENT_H * d - K_NM_PER_A * WEAKER);
        }
    }
    search_start();
}

static void is_weak_and_salient(void)
{
    const hci_effect_term *weak = term_in(&model.candidates, "back_emf", "sine", 1.0);
    const hci_effect_term *salient = term_in(&model.candidates, "reluctance", "dd_cosine", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * weak->std_error, -WEAKER * K_NM_PER_A, weak->value);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * salient->std_error, SALIENT_H, salient->value);
    TEST_ASSERT_FALSE(model_has("saturation"));
}

/* A back-EMF out of phase, two values of one effect, describes it better than either alone. */
static void test_a_pair_of_no_more_values_competes(void)
{
    bool added = false;
    record_salient(0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_forward(&search, &model, &added, &note));
    TEST_ASSERT_TRUE(added);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
    is_weak_and_salient();
}

static void test_a_series_gives_way_to_few_values(void)
{
    bool changed = false;
    record_salient(0.05);
    model.candidates.reference_current_A = 10.0;
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_add("friction", "coulomb", "viscous", 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_few_values(&search, &model, &changed, &note));
    if (changed) model_is_renewed();
    TEST_ASSERT_TRUE(changed && model_has("friction"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    is_weak_and_salient();
}

/* Without a series nothing is looked for. */
static void test_few_values_stay(void)
{
    bool changed = false;
    record_salient(0.05);
    model_add("friction", "coulomb", "viscous", 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_few_values(&search, &model, &changed, &note));
    if (changed) model_is_renewed();
    TEST_ASSERT_FALSE(changed);
}

/* ---- a zero of the angle ---- */

#define ZERO_RAD 0.3 /* electrical, that is read too much */
#define WAVES_NM 0.05

/* Sensors read the angle too large; the machine has a sixth order of cogging torque, declared in sine (1) or
 * not at all (0), and turned by itself besides. */
static void record_turned(double zero_rad, double declared, double cosine_Nm)
{
    if (declared > 0.0) {
        files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.05,0\n");
        hci_machine_release(&machine);
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    }
    for (int k = 0; k < POINTS; ++k) {
        record(SAMPLES, &(point){SPEED[k], 0.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) {
            const double angle = P * run[k].theta_m_rad[j] - zero_rad;
            rec_phases(D_A[k], Q_A[k], angle, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 1.5 * K_NM_PER_A * Q_A[k] + declared * WAVES_NM * sin(6.0 * angle) +
                                   cosine_Nm * cos(6.0 * angle);
        }
    }
    search_start();
}

/* The waves of a zero that is off, as orders by themselves. */
static void waves_add(void)
{
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model_add("back_emf", "cosine", NULL, 1.0);
    model_fit();
}

static bool is_a_zero_of_the_angle(void)
{
    bool changed = false;
    waves_add();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note)); /* as before it in a search */
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_angle_zero(&search, &model, &changed, &note), note.text);
    if (changed) model_is_renewed();
    return changed;
}

static void zero_is_right(void)
{
    const hci_effect_term *zero = term_in(&model.candidates, "position_offset", "angle", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * zero->std_error, ZERO_RAD, zero->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, zero->std_error);
    TEST_ASSERT_FALSE(model_has("back_emf"));
}

/* 0.3 rad turn the sixth order by 1.8 rad: no small step from nothing finds that. */
static void test_turned_waves_are_a_zero_of_the_angle(void)
{
    record_turned(ZERO_RAD, 1.0, 0.0);
    TEST_ASSERT_TRUE(is_a_zero_of_the_angle());
    zero_is_right();
    TEST_ASSERT_FALSE(model_has("cogging"));
}

/* Also after the limit of the work: it is a single fit. */
static void test_it_is_seen_when_the_search_is_over(void)
{
    record_turned(ZERO_RAD, 1.0, 0.0);
    search.ended = HCI_WORK_LIMITED;
    TEST_ASSERT_TRUE(is_a_zero_of_the_angle());
    zero_is_right();
}

/* Cogging torque that the machine lacks in truth stays, in the angle as it should read. */
static void test_the_cogging_torque_of_the_machine_stays(void)
{
    record_turned(ZERO_RAD, 0.0, WAVES_NM);
    TEST_ASSERT_TRUE(is_a_zero_of_the_angle());
    zero_is_right();
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * WAVES_NM, WAVES_NM,
                              term_in(&model.candidates, "cogging", "cosine", 6.0)->value);
}

static void test_nothing_is_turned_where_the_angle_is_right(void)
{
    record_turned(0.0, 0.0, WAVES_NM);
    TEST_ASSERT_FALSE(is_a_zero_of_the_angle());
    TEST_ASSERT_TRUE(model_has("cogging"));
    TEST_ASSERT_FALSE(model_has("position_offset"));
}

/* ---- late channels ---- */

#define LATE_S 2e-4 /* 0.6 rad of the sixth order at the highest speed */

/* The torque, or the angle, is read late: both look the same but for the currents. */
static void record_late(double torque_s, double angle_s)
{
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.05,0\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    for (int k = 0; k < POINTS; ++k) {
        record(SAMPLES, &(point){SPEED[k], 0.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) {
            const double now = P * (run[k].theta_m_rad[j] + SPEED[k] * angle_s);
            rec_phases(D_A[k], Q_A[k], now, run[k].i_A + 3 * j);
            run[k].torque_Nm[j] +=
                1.5 * K_NM_PER_A * Q_A[k] + WAVES_NM * sin(6.0 * (now - P * SPEED[k] * torque_s));
        }
    }
    search_start();
    model_add("channel_delay", "current", NULL, 0.0);
    model_add("channel_delay", "angle", NULL, 0.0);
    model_fit();
}

static bool one_is_late(void)
{
    bool changed = false;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_late_channel(&search, &model, &changed, &note));
    if (changed) model_is_renewed();
    return changed;
}

static void test_all_others_early_is_one_late(void)
{
    record_late(LATE_S, 0.0);
    TEST_ASSERT_TRUE(one_is_late());
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&model.candidates));
    const hci_effect_term *late = term_in(&model.candidates, "channel_delay", "torque", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * late->std_error, LATE_S, late->value);
    TEST_ASSERT_TRUE(late->std_error < 0.1 * LATE_S);
    TEST_ASSERT_FALSE(one_is_late());
}

static void test_a_late_angle_stays(void)
{
    record_late(0.0, LATE_S);
    TEST_ASSERT_FALSE(one_is_late());
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_others_early_is_one_late);
    RUN_TEST(test_a_late_angle_stays);
    RUN_TEST(test_a_pair_of_no_more_values_competes);
    RUN_TEST(test_a_series_gives_way_to_few_values);
    RUN_TEST(test_few_values_stay);
    RUN_TEST(test_turned_waves_are_a_zero_of_the_angle);
    RUN_TEST(test_it_is_seen_when_the_search_is_over);
    RUN_TEST(test_the_cogging_torque_of_the_machine_stays);
    RUN_TEST(test_nothing_is_turned_where_the_angle_is_right);
    return UNITY_END();
}
