/* The quadratic model of a machine with effects, and the torque above it that is sampled along a current:
 * both against the torque of the effects at single angles, and differences of it. */
#include "host/machine/quadratic_model.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/machine/sampled_torque.h"
#include "support/effect_list.h"
#include "support/reference.h"
#include "unity.h"

enum { P = 3, ANGLES = 24 };

static hci_wave emf[2];
static hci_harmonic cogging[1];
static hci_machine declared;
static el_list effects;
static hci_quadratic_model model;

static void make(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        HCI_OK, hci_quadratic_model_make(&declared, &effects.list, NAN, &model, &note), note.text);
}

void setUp(void)
{
    emf[0] = (hci_wave){1.0, 1, 1.0, 0.1};
    emf[1] = (hci_wave){5.0, -1, 0.05, -0.03};
    cogging[0] = (hci_harmonic){6.0, 0.1, 0.02};
    declared = (hci_machine){P, emf, 2, cogging, 1, NULL, 0};
    memset(&effects, 0, sizeof effects);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_quadratic_model_release(&model);
}

static void add_lower(void)
{
    el_add(&effects, "reluctance", "dq_cosine", 0.0, 0.02);
    el_add(&effects, "reluctance", "qq_sine", 6.0, 0.003);
    el_add(&effects, "reluctance", "dd_cosine", 6.0, -0.002);
    el_add(&effects, "back_emf", "pos_sine", 7.0, 0.04);
    el_add(&effects, "cogging", "cosine", 12.0, 0.05);
}

static void add_higher(void)
{
    el_add(&effects, "saturation", "d1q2_cosine", 0.0, -0.4);
    el_add(&effects, "saturation", "d0q4_sine", 6.0, 0.05);
    el_add(&effects, "saturation", "reference_current", 0.0, 8.0);
}

/* Declared torque and that of all effects, at one angle. */
static double true_torque(double theta, const double i[3], const hci_effects *of)
{
    hci_sample x = {.theta_m_rad = theta / P, .temperature_C = NAN};
    memcpy(x.i_abc, i, sizeof x.i_abc);
    return hci_effects_torque(&declared, of, &x, NULL).torque_Nm;
}

static void draw_star(uint64_t *seed, double size_A, double i[3])
{
    i[0] = ref_uniform(seed, -size_A, size_A);
    i[1] = ref_uniform(seed, -size_A, size_A);
    i[2] = -i[0] - i[1];
}

/* e·i + ½iᵀL'i + T_cog of the model is the declared torque and that of the effects, at any angle and current.
 * 1e-10: three transforms of numbers up to 10. */
static void test_effects_up_to_the_second_degree_are_written_into_the_machine(void)
{
    uint64_t seed = 40;
    add_lower();
    make();
    TEST_ASSERT_NULL(model.higher.effects);
    TEST_ASSERT_TRUE(model.machine.slope_count > 0);
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = ref_uniform(&seed, -7.0, 7.0);
        double i[3];
        draw_star(&seed, 5.0, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10,
                                  hci_torque_at(&declared, theta, i) + true_torque(theta, i, &effects.list),
                                  hci_torque_at(&model.machine, theta, i));
    }
}

/* The model's gradient against a central difference, which is exact for a quadratic. */
static void test_gradient_of_the_model_is_the_difference_of_the_torque(void)
{
    uint64_t seed = 41;
    add_lower();
    make();
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = ref_uniform(&seed, -7.0, 7.0);
        double i[3], gradient[3];
        draw_star(&seed, 5.0, i);
        hci_torque_gradient_at(&model.machine, theta, i, gradient);
        const double up[3] = {i[0] + 0.5, i[1] - 0.5, i[2]}, down[3] = {i[0] - 0.5, i[1] + 0.5, i[2]};
        const double change = hci_torque_at(&declared, theta, up) + true_torque(theta, up, &effects.list) -
                              hci_torque_at(&declared, theta, down) - true_torque(theta, down, &effects.list);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, change, gradient[0] - gradient[1]);
    }
}

static void test_higher_degrees_stay_effects_and_sensors_are_left_out(void)
{
    add_lower();
    add_higher();
    el_add(&effects, "current_offset", "a", 0.0, 0.2);
    make();
    TEST_ASSERT_EQUAL_UINT(1, model.left_out);
    TEST_ASSERT_EQUAL_UINT(3, model.lower_list.count);
    TEST_ASSERT_EQUAL_UINT(1, model.higher_list.count);
    TEST_ASSERT_EQUAL_STRING("saturation", model.higher.effects->effect[0].type->name);
}

static void test_without_effects_the_machine_is_as_declared(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_quadratic_model_make(&declared, NULL, NAN, &model, NULL));
    TEST_ASSERT_EQUAL_PTR(emf, model.machine.back_emf);
    TEST_ASSERT_NULL(model.higher.effects);
}

/* ---- torque above it ---- */

static const hci_wave CURRENT[] = {{1.0, 1, 4.0, -1.0}, {5.0, -1, 0.5, 0.2}, {7.0, 1, -0.1, 0.3}};
enum { WAVES = sizeof CURRENT / sizeof *CURRENT };

static hci_torque_path make_path(void)
{
    add_higher();
    make();
    return (hci_torque_path){&model.higher, 1, CURRENT, WAVES};
}

static void test_sampled_torque_is_that_of_the_effects_at_each_angle(void)
{
    const hci_torque_path path = make_path();
    hci_harmonic_list torque;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_sampled_torque(&path, &torque, NULL));
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = 0.05 + 2.0 * REF_PI * k / ANGLES;
        double i[3];
        hci_waves_at(CURRENT, WAVES, theta, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, true_torque(theta, i, &effects.list),
                                  hci_harmonics_at(torque.harmonic, torque.count, theta));
    }
    hci_memory_free(torque.harmonic);
}

/* gradient·δi against a central difference over ±1e-4 A, whose error is of the third derivative: 1e-8 of it.
 * And gradient·i − offset is the torque itself where it was made linear. */
static void test_sampled_torque_made_linear(void)
{
    const hci_torque_path path = make_path();
    hci_linear_torque linear;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_sampled_torque_linearise(&path, &linear, NULL));
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = 0.05 + 2.0 * REF_PI * k / ANGLES, step_A = 1e-4;
        double i[3], g[3];
        hci_waves_at(CURRENT, WAVES, theta, i);
        hci_waves_at(linear.gradient.wave, linear.gradient.count, theta, g);
        const double offset = hci_harmonics_at(linear.offset.harmonic, linear.offset.count, theta);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, true_torque(theta, i, &effects.list),
                                  g[0] * i[0] + g[1] * i[1] + g[2] * i[2] - offset);
        for (int s = 0; s < 2; ++s) {
            double up[3] = {i[0], i[1], i[2]}, down[3] = {i[0], i[1], i[2]};
            up[s] += step_A;
            up[2] -= step_A;
            down[s] -= step_A;
            down[2] += step_A;
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-8,
                (true_torque(theta, up, &effects.list) - true_torque(theta, down, &effects.list)) /
                    (2.0 * step_A),
                g[s] - g[2]);
        }
    }
    hci_linear_torque_release(&linear);
}

static void test_memory_that_runs_out(void)
{
    const hci_torque_path path = make_path();
    hci_status status = HCI_ERROR_MEMORY;
    for (long n = 0; n < 20 && status == HCI_ERROR_MEMORY; ++n) {
        hci_linear_torque linear;
        hci_memory_fail_after(n);
        status = hci_sampled_torque_linearise(&path, &linear, NULL);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(!status || (!linear.gradient.wave && !linear.offset.harmonic));
        hci_linear_torque_release(&linear);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_effects_up_to_the_second_degree_are_written_into_the_machine);
    RUN_TEST(test_gradient_of_the_model_is_the_difference_of_the_torque);
    RUN_TEST(test_higher_degrees_stay_effects_and_sensors_are_left_out);
    RUN_TEST(test_without_effects_the_machine_is_as_declared);
    RUN_TEST(test_sampled_torque_is_that_of_the_effects_at_each_angle);
    RUN_TEST(test_sampled_torque_made_linear);
    RUN_TEST(test_memory_that_runs_out);
    return UNITY_END();
}
