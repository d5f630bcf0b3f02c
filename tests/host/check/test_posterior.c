/* How probable each interpretation is, on the made-up motor: laws that hold whatever the relations say. */
#include "host/check/posterior.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/error_place.h"
#include "host/check/relations/relations.h"
#include "support/made_up_motor.h"
#include "unity.h"

static check_data data;
static check_posterior p;
static hci_note note;

void setUp(void)
{
    data = motor_data();
    memset(&p, 0, sizeof p);
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_check_posterior_release(&p);
}

static void weigh(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_check_posterior(&data, &p, &note), note.text);
}

/* ---- what is asked */

static bool has(const check_error_set *set, const char *name)
{
    for (int k = 0; k < CHECK_MOST_ERRORS; ++k)
        if (set->error[k] >= 0 && strcmp(HCI_CHECK_ERRORS[set->error[k]].name, name) == 0) return true;
    return false;
}

static int size_of(const check_error_set *set)
{
    return (set->error[0] >= 0) + (set->error[1] >= 0) + (set->error[2] >= 0);
}

/* Of the combination that has these errors and no other; "": none. */
static double probability_of(const char *one, const char *two)
{
    const int size = (*one != '\0') + (*two != '\0');
    for (size_t k = 0; k < p.count; ++k)
        if (size_of(&p.list[k]) == size && (*one == '\0' || has(&p.list[k], one)) &&
            (*two == '\0' || has(&p.list[k], two)))
            return p.list[k].probability;
    TEST_FAIL_MESSAGE(one);
    return NAN;
}

/* Of all combinations with an error. */
static double share_of(const char *name)
{
    double sum = 0.0;
    for (size_t k = 0; k < p.count; ++k)
        if (has(&p.list[k], name)) sum += p.list[k].probability;
    return sum;
}

static const check_relation *relation_of(const char *name)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (strcmp(hci_check_relation(k)->name, name) == 0) return hci_check_relation(k);
    TEST_FAIL_MESSAGE(name);
    return NULL;
}

/* ---- laws */

static void test_probabilities_sum_to_one(void)
{
    double sum = 0.0;
    motor_record(&data, MOTOR_i_d, MOTOR_i_q, true);
    weigh();
    for (size_t k = 0; k < p.count; ++k) {
        TEST_ASSERT_TRUE(p.list[k].probability >= 0.0);
        sum += p.list[k].probability;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, sum);
}

/* Each once, none twice about the same thing, and only what can stand in these files. */
static void test_the_combinations(void)
{
    weigh();
    TEST_ASSERT_EQUAL(0, size_of(&p.list[0]));
    for (size_t k = 1; k < p.count; ++k) {
        const int *e = p.list[k].error;
        TEST_ASSERT_TRUE(e[0] >= 0 && (e[1] < 0 || e[1] > e[0]) && (e[2] < 0 || e[2] > e[1]));
        for (int a = 0; a < size_of(&p.list[k]); ++a) {
            TEST_ASSERT_TRUE(hci_check_error_applies(&HCI_CHECK_ERRORS[e[a]], &data));
            for (int b = 0; b < a; ++b)
                TEST_ASSERT_TRUE(HCI_CHECK_ERRORS[e[a]].aspect != HCI_CHECK_ERRORS[e[b]].aspect);
        }
    }
    TEST_ASSERT_TRUE(share_of("resistance_line") > 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, share_of("current_sign")); /* there is no recording */
}

/* With one pole pair an electrical order is a mechanical one. */
static void test_one_pole_pair_has_no_orders_of_its_own(void)
{
    static const char *const NAMES[] = {"emf_orders_mechanical", "cogging_orders_mechanical",
                                        "inductance_per_electrical_radian"};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k) {
        const check_error *e = HCI_CHECK_ERRORS;
        while (strcmp(e->name, NAMES[k]) != 0)
            ++e;
        data.value[CHECK_pole_pairs] = 4.0;
        TEST_ASSERT_TRUE_MESSAGE(hci_check_error_applies(e, &data), NAMES[k]);
        data.value[CHECK_pole_pairs] = 1.0;
        TEST_ASSERT_FALSE_MESSAGE(hci_check_error_applies(e, &data), NAMES[k]);
    }
}

static void test_a_correct_motor_is_most_probably_correct(void)
{
    motor_record(&data, MOTOR_i_d, MOTOR_i_q, true);
    motor_record(&data, 0.0, 0.0, true);
    weigh();
    TEST_ASSERT_EQUAL(0, p.best);
    TEST_ASSERT_TRUE(p.list[0].probability > 0.8);
}

/* No relation looks at a resistance without recordings, so that one between terminals is as probable as it
 * was before: one in a hundred; and a second one like it costs as much again. */
static void test_an_error_that_nothing_sees_costs_its_prior(void)
{
    weigh();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, probability_of("resistance_line", "") / probability_of("", ""));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01,
                              probability_of("resistance_line", "cogging_orders_mechanical") /
                                  probability_of("cogging_orders_mechanical", ""));
}

/* Torque against the current: either is counted the other way, and no voltage says which. Both errors have
 * the same prior, so that they come out alike, and each near one half. */
static void test_errors_that_look_alike_share_the_probability(void)
{
    data.inductance.given = false; /* without reluctance −i is the same as −T */
    data.value[CHECK_inductance_d_H] = data.value[CHECK_inductance_q_H] = NAN;
    motor_record(&data, 0.0, MOTOR_i_q, true);
    data.run[0].has_voltage = data.run[0].has_phase_voltage = false;
    data.run[0].voltage_order = NAN;
    data.run[0].torque_mean = -data.run[0].torque_mean;
    weigh();
    const double of_current = probability_of("current_sign", ""),
                 of_torque = probability_of("torque_sign", "");
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * of_torque, of_torque, of_current);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, share_of("torque_sign"), share_of("current_sign"));
    /* One relation, torque_size, is missed by far: e^−9 is its cap; and met by the other, however wide it is.
     */
    const check_relation *r = relation_of("torque_size");
    check_interpretation generator = hci_check_as_declared();
    generator.torque = -1.0;
    const check_value met = hci_check_relation_value(&data, r, &generator);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, met.found);
    const double odds = exp(-9.0) / exp(-hci_check_loss_beside_magnets(r, met, 1.0)) / 0.01;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * odds, odds, probability_of("", "") / of_torque);
}

/* The back-EMF is at its trough at angle 0: a sign, or the magnet axis; the latter is twice as frequent. */
static void test_of_two_that_look_alike_the_more_frequent_leads(void)
{
    static double phase_rad = REF_PI;
    data.emf.phase_rad = &phase_rad;
    data.cogging.count = 0;
    weigh();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0,
                              probability_of("angle_zero_d_axis", "") / probability_of("emf_sign", ""));
}

/* Whoever counted the tables' angle from the magnet axis is likely to have counted that of the recordings
 * from it: 0.3 and not 0.01, where the recordings themselves say nothing of it. */
static void test_one_bench_has_one_zero(void)
{
    motor_record(&data, 0.0, 0.0, true);
    data.run[0].has_voltage = data.run[0].has_phase_voltage = data.run[0].has_torque = false;
    data.run[0].voltage_order = NAN;
    weigh();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3,
                              probability_of("angle_zero_d_axis", "run_angle_zero_d_axis") /
                                  probability_of("angle_zero_d_axis", ""));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.01,
                              probability_of("run_angle_zero_d_axis", "") / probability_of("", ""));
}

/* Volts at a frequency that is given are seldom volts at another. */
static void test_the_prior_of_a_unit_knows_the_column(void)
{
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT; ++k) {
        const check_error *e = &HCI_CHECK_ERRORS[k];
        const bool of_unit = strncmp(e->name, "emf_volt_per", 12) == 0 || strcmp(e->name, "emf_kv") == 0 ||
                             strncmp(e->name, "emf_taken_per", 13) == 0 ||
                             strcmp(e->name, "emf_flux_linkage") == 0;
        data.emf_in_volts = false;
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-15, e->prior, hci_check_error_prior(e, &data), e->name);
        data.emf_in_volts = true;
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-15, of_unit ? 0.1 * e->prior : e->prior,
                                          hci_check_error_prior(e, &data), e->name);
    }
}

static void test_an_error_of_the_files_is_the_most_probable(void)
{
    static double k_e = 0.1732050807568877; /* line to line */
    data.emf.amplitude = &k_e;
    motor_record(&data, MOTOR_i_d, MOTOR_i_q, true);
    motor_record(&data, 0.0, 0.0, true);
    weigh();
    TEST_ASSERT_EQUAL(1, size_of(&p.list[p.best]));
    TEST_ASSERT_TRUE(has(&p.list[p.best], "emf_line"));
    TEST_ASSERT_TRUE(share_of("emf_line") > 0.95);
}

static void test_out_of_memory(void)
{
    hci_memory_fail_after(3);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_check_posterior(&data, &p, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_probabilities_sum_to_one);
    RUN_TEST(test_the_combinations);
    RUN_TEST(test_one_pole_pair_has_no_orders_of_its_own);
    RUN_TEST(test_a_correct_motor_is_most_probably_correct);
    RUN_TEST(test_an_error_that_nothing_sees_costs_its_prior);
    RUN_TEST(test_errors_that_look_alike_share_the_probability);
    RUN_TEST(test_of_two_that_look_alike_the_more_frequent_leads);
    RUN_TEST(test_one_bench_has_one_zero);
    RUN_TEST(test_the_prior_of_a_unit_knows_the_column);
    RUN_TEST(test_an_error_of_the_files_is_the_most_probable);
    RUN_TEST(test_out_of_memory);
    return UNITY_END();
}
