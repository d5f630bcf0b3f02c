/* Laws of what brakes, at speeds that are written down here: friction T_c + B ω + Q ω². */
#include "host/diagnose/search/brakes.h"

#include <math.h>
#include <string.h>

#include "support/effect_list.h"
#include "unity.h"

enum { RUNS = 4 };

static hci_run_statistics statistics[RUNS];
static bool use[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_candidates model;
static el_list declared;
static hci_note note;

void setUp(void)
{
    static const double SPEED[RUNS] = {-150.0, 40.0, 100.0, 300.0};
    memset(statistics, 0, sizeof statistics);
    memset(&declared, 0, sizeof declared);
    for (size_t r = 0; r < RUNS; ++r) {
        statistics[r].mean_speed_rad_per_s = SPEED[r];
        use[r] = r < 3;
    }
    samples = (hci_binned_samples){.statistics = statistics, .run_count = RUNS};
    regression = (hci_regression){.declared = &declared.list, .samples = &samples, .use = use};
}

void tearDown(void)
{
    hci_candidates_release(&model);
}

static void add(const char *effect, const char *parameter, double value)
{
    hci_candidate x = {.type = hci_effect_type_find(effect), .count = 1, .in = true};
    x.term[0] = (hci_effect_term){el_parameter(x.type, parameter), 0.0, value, NAN};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&model, &x, &note));
}

static const hci_effect_type *driving(void)
{
    const hci_effect_type *type = hci_effect_type_find("cogging");
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_brakes_find_driving(&regression, &model, &type, &note));
    return type;
}

static void expect_friction(bool drives)
{
    TEST_ASSERT_EQUAL_PTR(drives ? hci_effect_type_find("friction") : NULL, driving());
    hci_candidates_release(&model);
}

/* 0.1 N·m at the slowest speed, 40 rad/s, and less by so much at 150: a fifth is the border. The run at 300
 * rad/s is not in use. */
static void test_a_friction_that_falls_with_the_speed(void)
{
    for (int falls = 0; falls < 2; ++falls) {
        const double slope = (falls ? 0.0201 : 0.0199) / 110.0;
        add("friction", "coulomb", 0.1 + 40.0 * slope);
        add("friction", "viscous", -slope);
        expect_friction(falls);
    }
}

/* The same of a run that turns back and forth about a standstill, whose speed is its deviation. */
static void test_a_shaft_that_turns_back_and_forth(void)
{
    statistics[2].mean_speed_rad_per_s = 1.0;
    statistics[2].speed_deviation = 250.0;
    for (int falls = 0; falls < 2; ++falls) {
        const double slope = (falls ? 0.0201 : 0.0199) / 210.0;
        add("friction", "coulomb", 0.1 + 40.0 * slope);
        add("friction", "viscous", -slope);
        expect_friction(falls);
    }
}

/* One that grows between two speeds and falls beyond the larger brakes less than at the slowest one nowhere.
 */
static void test_a_friction_that_grows(void)
{
    add("friction", "coulomb", 0.1);
    add("friction", "viscous", 2e-3);
    add("friction", "quadratic", -1e-5);
    expect_friction(false);
    use[3] = true; /* 0.1 + 0.6 − 0.9 N·m */
    add("friction", "coulomb", 0.1);
    add("friction", "viscous", 2e-3);
    add("friction", "quadratic", -1e-5);
    expect_friction(true);
}

/* What is declared brakes with what is found. */
static void test_the_declared_friction_counts(void)
{
    add("friction", "coulomb", -0.01);
    expect_friction(true);
    el_add(&declared, "friction", "viscous", 0.0, 1e-3);
    add("friction", "coulomb", -0.01);
    expect_friction(false);
}

/* A declared friction that drives is nobody's finding. */
static void test_a_friction_that_was_not_found(void)
{
    el_add(&declared, "friction", "coulomb", 0.0, -0.1);
    add("cogging", "sine", 0.02);
    TEST_ASSERT_NULL(driving());
}

/* A drag by the currents: 2/3·i², i the vector of the plane, so i_q² of the mean currents. */
static void test_a_drag_of_the_iron_that_drives(void)
{
    for (size_t r = 0; r < RUNS; ++r) {
        statistics[r].mean_id_A = -2.0;
        statistics[r].mean_iq_A = 3.0;
    }
    add("friction", "coulomb", 0.1);
    add("iron_drag", "eddy", 1e-5);
    TEST_ASSERT_NULL(driving());
    model.candidate[1].term[0].value = -1e-5;
    TEST_ASSERT_EQUAL_PTR(hci_effect_type_find("iron_drag"), driving());
}

/* (H − E ω) i² of three runs: at 150 rad/s and √13 A it brakes by 110·13 E less than at 40 rad/s, and most,
 * 16 (H − 40 E), where 4 A flow. The slowest run is the first of the list, or the second. */
static void test_a_drag_of_the_iron_that_falls(void)
{
    for (int k = 0; k < 4; ++k) {
        const size_t slow = k < 2 ? 1 : 0, fast = 1 - slow;
        const double e = 1e-6, border = 40.0 + 110.0 * 13.0 / (0.2 * 16.0) * (k % 2 ? 0.99 : 1.01);
        statistics[slow] = (hci_run_statistics){.mean_speed_rad_per_s = 40.0, .mean_iq_A = 1.0};
        statistics[fast] =
            (hci_run_statistics){.mean_speed_rad_per_s = -150.0, .mean_id_A = -2.0, .mean_iq_A = 3.0};
        statistics[2] = (hci_run_statistics){.mean_speed_rad_per_s = 100.0, .mean_id_A = 4.0};
        add("iron_drag", "hysteresis", border * e);
        add("iron_drag", "eddy", -e);
        TEST_ASSERT_EQUAL(k % 2, driving() != NULL);
        hci_candidates_release(&model);
    }
}

static void test_nothing_turns(void)
{
    memset(statistics, 0, sizeof statistics);
    add("friction", "coulomb", -0.1);
    TEST_ASSERT_NULL(driving());
}

/* ---- which laws there are ---- */

static void test_another_law_beside_a_friction(void)
{
    const hci_effect_type *friction = hci_effect_type_find("friction"),
                          *stribeck = hci_effect_type_find("stribeck_friction");
    add("friction", "coulomb", 0.1);
    add("iron_drag", "eddy", 1e-5);
    TEST_ASSERT_FALSE(hci_brakes_have_other(&model, friction));
    TEST_ASSERT_TRUE(hci_brakes_have_other(&model, stribeck));
    add("stribeck_friction", "excess", 0.1);
    TEST_ASSERT_TRUE(hci_brakes_have_other(&model, friction));
    model.candidate[2].in = false;
    TEST_ASSERT_FALSE(hci_brakes_have_other(&model, friction));
}

/* Powers of the speed may go alone, the last first; what is not linear in its values, or no friction, may
 * not. */
static void test_a_further_power_of_the_speed(void)
{
    hci_candidate x = {.type = hci_effect_type_find("friction"), .count = 2};
    x.term[1].parameter = 1;
    TEST_ASSERT_TRUE(hci_brakes_has_further_power(&x));
    x.count = 1;
    TEST_ASSERT_FALSE(hci_brakes_has_further_power(&x));
    x = (hci_candidate){.type = hci_effect_type_find("stribeck_friction"), .count = 2};
    x.term[1].parameter = el_parameter(x.type, "speed");
    TEST_ASSERT_FALSE(hci_brakes_has_further_power(&x));
    x = (hci_candidate){.type = hci_effect_type_find("cogging"), .count = 2};
    x.term[1].parameter = 1;
    TEST_ASSERT_FALSE(hci_brakes_has_further_power(&x));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_friction_that_falls_with_the_speed);
    RUN_TEST(test_a_shaft_that_turns_back_and_forth);
    RUN_TEST(test_a_friction_that_grows);
    RUN_TEST(test_the_declared_friction_counts);
    RUN_TEST(test_a_friction_that_was_not_found);
    RUN_TEST(test_a_drag_of_the_iron_that_drives);
    RUN_TEST(test_a_drag_of_the_iron_that_falls);
    RUN_TEST(test_nothing_turns);
    RUN_TEST(test_another_law_beside_a_friction);
    RUN_TEST(test_a_further_power_of_the_speed);
    return UNITY_END();
}
