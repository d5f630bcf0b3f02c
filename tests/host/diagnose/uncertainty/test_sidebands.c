/* Where magnets that differ show at the one order of the mechanical turn that stands out, the orders beside
 * all others have as much of it, and the bound allows for them though noise hides them. Some tenths of a
 * second. */
#include <math.h>

#include "support/expecting.h"

enum { SAMPLES = 240, TURNS = 4 };

static const double FIFTH = 0.02, SEVENTH = 0.012, COGGING_NM = 0.06;
static double uneven; /* share by which the flux varies over the turn */

void setUp(void)
{
    hci_note note = {{0}};
    dataset_start();
    hci_machine_release(&machine);
    files_write(files_path("back_emf.csv"),
                "order,amplitude_Nm_per_A,phase_rad\n1,0.2,0\n5,0.02,0\n7,0.012,0\n");
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.06,0\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
}

void tearDown(void)
{
    dataset_end();
}

/* Each phase lies in a third of the stator and sees the magnets that are there. */
static double torque_of(double theta, double d, double q)
{
    double i[3], sum_Nm = COGGING_NM * sin(6.0 * theta) * (1.0 + uneven * cos(theta / P));
    rec_phases(d, q, theta, i);
    for (int s = 0; s < 3; ++s) {
        const double third = 2.0 * REF_PI * s / 3.0, x = theta - third;
        const double emf = K_NM_PER_A * sin(x) + FIFTH * sin(5.0 * x) + SEVENTH * sin(7.0 * x);
        sum_Nm += i[s] * emf * (1.0 + uneven * cos(theta / P - third));
    }
    return sum_Nm;
}

static void measure_at(double d, double q)
{
    hci_run *r = add_run(P * SAMPLES * TURNS);
    for (size_t k = 0; k < r->count; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES;
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = 2.0 * REF_PI / P / SAMPLES / 1e-3;
        rec_phases(d, q, theta, r->i_A + 3 * k);
        r->torque_Nm[k] = torque_of(theta, d, q) + NOISE_NM * ref_normal(&seed);
    }
}

static void measure(void)
{
    measure_at(0.0, 0.0);
    measure_at(0.0, 8.0);
    measure_at(-5.0, 8.0);
    measure_at(0.0, -8.0);
    measure_at(4.0, 6.0);
}

static void test_what_is_hidden_beside_what_was_found(void)
{
    char text[96];
    uneven = 0.005;
    measure();
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_TRUE(found("mechanical_order")->verdict == HCI_FINDING_ADDED);
    for (int k = 0; k < 3; ++k) {
        const double error_Nm = expected_error_Nm(&(current){0.0, 4.0 + 2.0 * k, 0.3}, torque_of);
        snprintf(text, sizeof text, "error %g N·m, bound %g N·m", error_Nm, expected.error_peak_to_peak_Nm);
        TEST_ASSERT_TRUE_MESSAGE(error_Nm <= expected.error_peak_to_peak_Nm, text);
        TEST_ASSERT_TRUE_MESSAGE(expected.error_peak_to_peak_Nm < 4.0 * error_Nm, text);
    }
}

/* Nothing comes with what is not there. */
static void test_equal_magnets_have_none(void)
{
    uneven = 0.0;
    measure();
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    for (size_t k = 0; k < diagnosis.uncertainty.effects.list.count; ++k)
        TEST_ASSERT_FALSE(
            strcmp(diagnosis.uncertainty.effects.list.effect[k].type->name, "mechanical_order") == 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_hidden_beside_what_was_found);
    RUN_TEST(test_equal_magnets_have_none);
    return UNITY_END();
}
