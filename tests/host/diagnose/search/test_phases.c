/* Which machines look alike where current sensors and phases have gains, of models that are written down
 * here. */
#include "host/diagnose/search/phases.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

static hci_attribution a;
static hci_note note;
static const hci_effect_type *sensors, *phases, *magnets;

void setUp(void)
{
    memset(&a, 0, sizeof a);
    for (a.types = 0; hci_candidate_type(a.types); ++a.types)
        a.verdict[a.types].type = hci_candidate_type(a.types);
    sensors = hci_effect_type_find("current_gain");
    phases = hci_effect_type_find("phase_imbalance");
    magnets = hci_effect_type_find("back_emf");
}

void tearDown(void)
{
    hci_candidates_release(&a.model.candidates);
    for (size_t k = 0; k < a.types; ++k)
        hci_candidates_release(&a.verdict[k].alternative.candidates);
}

static hci_verdict *verdict(const hci_effect_type *type)
{
    size_t k = 0;
    while (a.verdict[k].type != type)
        ++k;
    return &a.verdict[k];
}

static void add(const hci_effect_type *type, size_t parameter, double order, double value, double std_error)
{
    hci_candidate x = {.type = type, .count = 1, .in = true};
    x.term[0] = (hci_effect_term){parameter, order, value, std_error};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&a.model.candidates, &x, &note));
    verdict(type)->in = true;
}

static void add_gains(double g_a, double g_b, double g_c)
{
    const double gain[3] = {g_a, g_b, g_c};
    for (size_t s = 0; s < 3; ++s)
        if (gain[s] != 0.0) add(sensors, s, 0.0, gain[s], 0.001 * (double)(s + 1));
}

static void mark(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_phases_mark(&a, &note));
}

static size_t count_ambiguous(void)
{
    size_t count = 0;
    for (size_t k = 0; k < a.types; ++k)
        count += a.verdict[k].ambiguous;
    return count;
}

/* The term of an alternative machine that is in; NAN where it is not. */
static double value_in(const hci_candidates *list, const hci_effect_type *type, size_t parameter)
{
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; list->candidate[k].in && j < list->candidate[k].count; ++j)
            if (list->candidate[k].type == type && list->candidate[k].term[j].parameter == parameter)
                return list->candidate[k].term[j].value;
    return (double)NAN;
}

/* ---- sensors and phases at once ---- */

static void test_nothing_is_open_without_gains_of_sensors(void)
{
    add(phases, 0, 0.0, 0.1, 0.001);
    add(magnets, 2, 1.0, 0.05, 0.001);
    mark();
    TEST_ASSERT_EQUAL_UINT64(0, count_ambiguous());
    TEST_ASSERT_FALSE(a.sensors_as_well);
}

/* The other machine has its sensors alone: neither the phases nor the back-EMF of order 1, but that of
 * order 5. */
static void test_gains_of_sensors_and_phases(void)
{
    add(magnets, 0, 1.0, 0.05, 0.001);
    add(magnets, 1, 5.0, 0.02, 0.001);
    add(sensors, 1, 0.0, 0.07, 0.001);
    add(phases, 0, 0.0, 0.1, 0.001);
    mark();
    mark();
    const hci_candidates *other = &verdict(sensors)->alternative.candidates;
    TEST_ASSERT_TRUE(a.sensors_as_well && verdict(sensors)->ambiguous && verdict(phases)->ambiguous &&
                     verdict(magnets)->ambiguous);
    TEST_ASSERT_EQUAL_UINT64(3, count_ambiguous());
    TEST_ASSERT_EQUAL_DOUBLE(0.07, value_in(other, sensors, 1));
    TEST_ASSERT_EQUAL_DOUBLE(0.02, value_in(other, magnets, 1));
    TEST_ASSERT_TRUE(isnan(value_in(other, phases, 0)) && isnan(value_in(other, magnets, 0)));
}

/* Magnets of another strength in phases that are alike stay out of it, where no order 1 is in. */
static void test_magnets_of_other_orders_are_sure(void)
{
    add(sensors, 1, 0.0, 0.07, 0.001);
    add(phases, 0, 0.0, 0.1, 0.001);
    add(magnets, 1, 5.0, 0.02, 0.001);
    mark();
    TEST_ASSERT_FALSE(verdict(magnets)->ambiguous);
    TEST_ASSERT_EQUAL_UINT64(2, count_ambiguous());
}

/* A back-EMF of order 1 with a sequence of its own is one of phases that differ, where no phase has a gain;
 * one of another order, and one that is not in, are not. */
static void test_a_negative_sequence_is_one_of_phases(void)
{
    add_gains(0.05, 0.0, 0.2);
    add(magnets, 4, 3.0, 0.02, 0.001);
    mark();
    TEST_ASSERT_FALSE(a.sensors_as_well);
    add(magnets, 4, 1.0, 0.05, 0.001);
    a.model.candidates.candidate[a.model.candidates.count - 1].in = false;
    mark();
    TEST_ASSERT_FALSE(a.sensors_as_well);
    a.model.candidates.candidate[a.model.candidates.count - 1].in = true;
    mark();
    TEST_ASSERT_TRUE(a.sensors_as_well && verdict(magnets)->ambiguous);
    TEST_ASSERT_FALSE(verdict(phases)->ambiguous);
    TEST_ASSERT_TRUE(value_in(&verdict(sensors)->alternative.candidates, magnets, 4) == 0.02);
}

/* ---- a common part of the sensors ---- */

/* Two of three sensors read too much by 0.10 and 0.12, the third by 0.02: 0.11 may be the magnets'. */
static void test_the_common_part_of_two_sensors(void)
{
    for (size_t odd = 0; odd < 3; ++odd) {
        double gain[3];
        gain[odd] = 0.02;
        gain[(odd + 1) % 3] = 0.10;
        gain[(odd + 2) % 3] = 0.12;
        tearDown();
        setUp();
        add_gains(gain[0], gain[1], gain[2]);
        verdict(sensors)->gain = 77.0;
        mark();
        const hci_candidates *other = &verdict(sensors)->alternative.candidates;
        TEST_ASSERT_TRUE(verdict(sensors)->ambiguous && verdict(magnets)->ambiguous);
        TEST_ASSERT_EQUAL_UINT64(2, count_ambiguous());
        TEST_ASSERT_EQUAL_PTR(sensors, verdict(magnets)->rival_of);
        TEST_ASSERT_EQUAL_DOUBLE(77.0, verdict(magnets)->gain);
        for (size_t s = 0; s < 3; ++s) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-15, (1.0 + gain[s]) / 1.11 - 1.0, value_in(other, sensors, s));
            TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0 / 1.11 - 1.0, value_in(other, phases, s));
            TEST_ASSERT_EQUAL_DOUBLE(gain[s], value_in(&a.model.candidates, sensors, s));
        }
    }
}

/* What the machine declares of its phases is in it: (1 + 0.04·s)/(1 + common) − 1. */
static void test_the_common_part_beside_declared_phases(void)
{
    add_gains(0.10, 0.12, 0.02);
    for (size_t s = 0; s < 3; ++s) {
        add(phases, s, 0.0, 0.0, NAN);
        hci_candidate *x = &a.model.candidates.candidate[a.model.candidates.count - 1];
        x->declared[0] = 0.04 * (double)s;
        x->in = false;
    }
    mark();
    for (size_t s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, (1.0 + 0.04 * (double)s) / 1.11 - 1.0,
                                  value_in(&verdict(sensors)->alternative.candidates, phases, s));
}

/* Candidates of one phase each, in another order than the phases, behind sensors of which values are
 * declared, too: each phase has what is declared of itself. */
static void test_declared_phases_in_any_order(void)
{
    add_gains(0.10, 0.12, 0.02);
    for (size_t s = 0; s < 3; ++s)
        a.model.candidates.candidate[s].declared[0] = a.model.candidates.candidate[s].declared[1] = 0.5;
    for (size_t s = 3; s-- > 0;) {
        add(phases, s, 0.0, 0.0, NAN);
        hci_candidate *x = &a.model.candidates.candidate[a.model.candidates.count - 1];
        x->declared[0] = 0.03 + 0.04 * (double)s;
        x->in = false;
    }
    mark();
    for (size_t s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, (1.03 + 0.04 * (double)s) / 1.11 - 1.0,
                                  value_in(&verdict(sensors)->alternative.candidates, phases, s));
}

/* The same where they are one candidate before the sensors; of the phases as they were nothing is left. */
static void test_declared_phases_in_one_candidate(void)
{
    hci_candidate x = {.type = phases, .count = 3};
    for (size_t s = 0; s < 3; ++s) {
        x.term[s] = (hci_effect_term){s, 0.0, 0.0, NAN};
        x.declared[s] = 0.03 + 0.04 * (double)s;
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&a.model.candidates, &x, &note));
    add_gains(0.10, 0.12, 0.02);
    mark();
    const hci_candidates *other = &verdict(sensors)->alternative.candidates;
    for (size_t s = 0; s < 3; ++s) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, (1.03 + 0.04 * (double)s) / 1.11 - 1.0, value_in(other, phases, s));
        for (size_t k = 0; k < other->count; ++k)
            if (other->candidate[k].in && other->candidate[k].type == phases)
                TEST_ASSERT_EQUAL_DOUBLE(0.03 + 0.04 * (double)s, other->candidate[k].declared[s]);
    }
}

/* A sensor that has left has no gain any more. */
static void test_a_sensor_that_leaves(void)
{
    for (size_t left = 0; left < 3; ++left) {
        tearDown();
        setUp();
        add_gains(0.10, 0.11, 0.10);
        mark();
        TEST_ASSERT_TRUE(verdict(sensors)->ambiguous);
        verdict(sensors)->ambiguous = verdict(magnets)->ambiguous = false;
        for (size_t s = 0; s < 3; ++s)
            a.model.candidates.candidate[s].in = s == left;
        mark();
        TEST_ASSERT_EQUAL_UINT64(0, count_ambiguous());
    }
}

/* Gains that differ by less than a fifth of their mean are alike. */
static void test_how_alike_two_sensors_are(void)
{
    for (int alike = 0; alike < 2; ++alike) {
        const double apart = 0.1 * (alike ? 0.19 : 0.21);
        tearDown();
        setUp();
        add_gains(-0.1 - 0.5 * apart, 0.3, -0.1 + 0.5 * apart);
        mark();
        TEST_ASSERT_EQUAL(alike, verdict(sensors)->ambiguous);
        TEST_ASSERT_EQUAL(alike, verdict(magnets)->ambiguous);
        TEST_ASSERT_EQUAL_UINT64(alike ? 2 * 3 - 2 : 0, verdict(sensors)->alternative.candidates.count);
    }
}

/* A common part is there from five times the largest standard error of the three. */
static void test_a_common_part_beside_its_error(void)
{
    for (int sure = 0; sure < 2; ++sure) {
        tearDown();
        setUp();
        add(sensors, 0, 0.0, 0.10, 0.001);
        add(sensors, 1, 0.0, 0.02, 0.1 / (sure ? 5.1 : 4.9));
        add(sensors, 2, 0.0, 0.10, 0.002);
        mark();
        TEST_ASSERT_EQUAL(sure, verdict(sensors)->ambiguous);
    }
}

/* Of two sensors without an error and one with, nothing is common. */
static void test_a_single_sensor_has_nothing_in_common(void)
{
    add_gains(0.0, 0.2, 0.0);
    mark();
    TEST_ASSERT_EQUAL_UINT64(0, count_ambiguous());
    TEST_ASSERT_NULL(verdict(magnets)->rival_of);
}

/* What is open already stays with the rival that it has; magnets that are in are no rival. */
static void test_what_is_known_of_rivals_stays(void)
{
    add_gains(0.10, 0.12, 0.02);
    verdict(sensors)->ambiguous = true;
    mark();
    TEST_ASSERT_FALSE(verdict(magnets)->ambiguous);
    verdict(sensors)->ambiguous = false;
    verdict(magnets)->rival_of = phases;
    mark();
    TEST_ASSERT_EQUAL_PTR(phases, verdict(magnets)->rival_of);
    verdict(magnets)->rival_of = NULL;
    verdict(magnets)->in = true;
    mark();
    TEST_ASSERT_NULL(verdict(magnets)->rival_of);
    TEST_ASSERT_TRUE(verdict(magnets)->ambiguous);
}

/* ---- wherever they stand ---- */

/* Verdicts in an order in which one of them is the first. */
static void first_is(const hci_effect_type *type)
{
    hci_verdict *v = verdict(type);
    const hci_effect_type *before = a.verdict[0].type;
    a.verdict[0].type = type;
    v->type = v == &a.verdict[0] ? type : before;
}

static void test_verdicts_in_any_order(void)
{
    for (int k = 0; k < 3; ++k) {
        tearDown();
        setUp();
        first_is(k == 0 ? sensors : k == 1 ? phases : magnets);
        add(magnets, 0, 1.0, 0.05, 0.001);
        add(sensors, 1, 0.0, 0.07, 0.001);
        add(phases, 0, 0.0, 0.1, 0.001);
        mark();
        TEST_ASSERT_TRUE(verdict(sensors)->ambiguous && verdict(phases)->ambiguous &&
                         verdict(magnets)->ambiguous);
        TEST_ASSERT_EQUAL_UINT64(3, count_ambiguous());
        tearDown();
        setUp();
        first_is(k == 0 ? sensors : magnets);
        add_gains(0.10, 0.12, 0.02);
        mark();
        TEST_ASSERT_TRUE(verdict(sensors)->ambiguous && verdict(magnets)->ambiguous);
        TEST_ASSERT_EQUAL_UINT64(2, count_ambiguous());
    }
}

/* Gains of sensors that are not in count for nothing, whatever they and their errors are; those of one
 * candidate of three terms count as those of three of one. */
static void test_gains_in_one_candidate(void)
{
    hci_candidate x = {.type = sensors, .count = 3, .in = true};
    const double gain[3] = {0.03, -0.22, -0.20};
    for (size_t s = 0; s < 3; ++s)
        x.term[s] = (hci_effect_term){s, 0.0, gain[s], 0.21 / 5.2};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&a.model.candidates, &x, &note));
    add(sensors, 1, 0.0, 5.0, 7.0);
    a.model.candidates.candidate[a.model.candidates.count - 1].in = false;
    verdict(sensors)->in = true;
    mark();
    TEST_ASSERT_TRUE(verdict(sensors)->ambiguous);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.03 / 0.79 - 1.0,
                              value_in(&verdict(sensors)->alternative.candidates, sensors, 0));
    const hci_candidates *other = &verdict(sensors)->alternative.candidates;
    for (size_t k = 0; k < other->count; ++k)
        if (other->candidate[k].type == phases) {
            TEST_ASSERT_EQUAL_UINT64(3, other->candidate[k].count);
            for (size_t s = 0; s < 3; ++s) {
                TEST_ASSERT_EQUAL_UINT64(s, other->candidate[k].term[s].parameter);
                TEST_ASSERT_EQUAL_DOUBLE(0.0, other->candidate[k].term[s].order);
                TEST_ASSERT_TRUE(isnan(other->candidate[k].term[s].std_error));
            }
        }
}

/* A back-EMF of about order 1, within the tolerance of orders, is of order 1. */
static void test_what_is_of_order_one(void)
{
    static const double OFF[] = {0.5, -0.5, 1.5, -1.5};
    for (int k = 0; k < 4; ++k) {
        tearDown();
        setUp();
        add(sensors, 1, 0.0, 0.07, 0.001);
        add(phases, 0, 0.0, 0.1, 0.001);
        add(magnets, 0, 1.0 + OFF[k] * HCI_ORDER_TOLERANCE, 0.05, 0.001);
        mark();
        TEST_ASSERT_EQUAL(k < 2, verdict(magnets)->ambiguous);
        TEST_ASSERT_EQUAL(k < 2, isnan(value_in(&verdict(sensors)->alternative.candidates, magnets, 0)));
    }
}

/* Memory that fails leaves everything sure. */
static void test_memory(void)
{
    for (int both = 0; both < 2; ++both)
        for (long k = 0; k < 8; ++k) {
            tearDown();
            setUp();
            add_gains(0.10, 0.12, 0.02);
            if (both) add(phases, 0, 0.0, 0.1, 0.001);
            hci_memory_fail_after(k);
            const hci_status status = hci_search_phases_mark(&a, &note);
            hci_memory_fail_after(-1);
            (void)hci_memory_was_short();
            TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
            TEST_ASSERT_TRUE(k > 0 || status == HCI_ERROR_MEMORY);
            TEST_ASSERT_EQUAL(status == HCI_OK, verdict(sensors)->ambiguous);
            TEST_ASSERT_EQUAL_UINT64(status ? 0 : 2, count_ambiguous());
            TEST_ASSERT_EQUAL(both && !status, a.sensors_as_well);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_open_without_gains_of_sensors);
    RUN_TEST(test_gains_of_sensors_and_phases);
    RUN_TEST(test_magnets_of_other_orders_are_sure);
    RUN_TEST(test_a_negative_sequence_is_one_of_phases);
    RUN_TEST(test_the_common_part_of_two_sensors);
    RUN_TEST(test_the_common_part_beside_declared_phases);
    RUN_TEST(test_declared_phases_in_any_order);
    RUN_TEST(test_declared_phases_in_one_candidate);
    RUN_TEST(test_a_sensor_that_leaves);
    RUN_TEST(test_how_alike_two_sensors_are);
    RUN_TEST(test_a_common_part_beside_its_error);
    RUN_TEST(test_a_single_sensor_has_nothing_in_common);
    RUN_TEST(test_what_is_known_of_rivals_stays);
    RUN_TEST(test_verdicts_in_any_order);
    RUN_TEST(test_gains_in_one_candidate);
    RUN_TEST(test_what_is_of_order_one);
    RUN_TEST(test_memory);
    return UNITY_END();
}
