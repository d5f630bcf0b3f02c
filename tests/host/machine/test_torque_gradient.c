/* e + L'i and e + ½L'i as waves, against differences of the torque e·i + ½iᵀL'i that is written here once
 * more. */
#include "host/machine/torque_gradient.h"

#include <math.h>

#include "hci/machine/system.h"
#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { EMF = 3, SLOPES = 3, WAVES = 4, ANGLES = 40 };

static hci_wave emf[EMF], current[WAVES];
static hci_inductance_slope slope[SLOPES];
static hci_machine machine;

void setUp(void)
{
    static const double EMF_ORDER[EMF] = {1, 5, 7}, SLOPE_ORDER[SLOPES] = {0, 2, 4};
    static const hci_component WAVE[WAVES] = {{1, 1}, {5, -1}, {7, 1}, {2, -1}};
    uint64_t seed = 30;
    for (int k = 0; k < EMF; ++k)
        emf[k] =
            (hci_wave){EMF_ORDER[k], k % 2 ? -1 : 1, ref_uniform(&seed, -1, 1), ref_uniform(&seed, -1, 1)};
    for (int k = 0; k < SLOPES; ++k) {
        slope[k].order = SLOPE_ORDER[k];
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
            slope[k].sine[q] = k == 0 ? 0.0 : ref_uniform(&seed, -0.1, 0.1);
            slope[k].cosine[q] = ref_uniform(&seed, -0.1, 0.1);
        }
    }
    for (int k = 0; k < WAVES; ++k)
        current[k] =
            (hci_wave){WAVE[k].order, WAVE[k].sequence, ref_uniform(&seed, -3, 3), ref_uniform(&seed, -3, 3)};
    machine = (hci_machine){3, emf, EMF, NULL, 0, slope, SLOPES};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

static void waves_at(const hci_wave *w, size_t count, double theta, double abc[3])
{
    abc[0] = abc[1] = abc[2] = 0.0;
    for (size_t k = 0; k < count; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = w[k].order * theta - w[k].sequence * 2.0 * REF_PI * s / 3.0;
            abc[s] += w[k].sine * sin(x) + w[k].cosine * cos(x);
        }
}

/* e·i and ½iᵀL'i */
static void torque_at(double theta, const double i[3], double *mutual, double *reluctance)
{
    static const int ENTRY[3][3] = {
        {HCI_AA, HCI_AB, HCI_CA}, {HCI_AB, HCI_BB, HCI_BC}, {HCI_CA, HCI_BC, HCI_CC}};
    double e[3];
    waves_at(emf, EMF, theta, e);
    *mutual = *reluctance = 0.0;
    for (int r = 0; r < 3; ++r) {
        *mutual += e[r] * i[r];
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < SLOPES; ++k) {
                const int q = ENTRY[r][c];
                *reluctance += 0.5 * i[r] * i[c] *
                               (slope[k].sine[q] * sin(slope[k].order * theta) +
                                slope[k].cosine[q] * cos(slope[k].order * theta));
            }
    }
}

static double total_at(double theta, const double i[3])
{
    double mutual, reluctance;
    torque_at(theta, i, &mutual, &reluctance);
    return mutual + reluctance;
}

/* A quadratic has no error in a central difference but rounding: 1e-9 of some 10 N·m/A. */
static void test_gradient_is_the_difference_of_the_torque(void)
{
    hci_wave_list g;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_gradient(&machine, current, WAVES, 0.0, &g, NULL));
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = 0.1 + 2.0 * REF_PI * k / ANGLES;
        double i[3], found[3];
        waves_at(current, WAVES, theta, i);
        waves_at(g.wave, g.count, theta, found);
        for (int s = 0; s < 3; ++s) {
            double up[3] = {i[0], i[1], i[2]}, down[3] = {i[0], i[1], i[2]};
            up[s] += 0.5;
            down[s] -= 0.5;
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, total_at(theta, up) - total_at(theta, down), found[s]);
        }
    }
    hci_memory_free(g.wave);
}

static void test_secant_times_the_current_is_the_torque(void)
{
    hci_wave_list h;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_secant(&machine, current, WAVES, 0.0, &h, NULL));
    for (int k = 0; k < ANGLES; ++k) {
        const double theta = 0.1 + 2.0 * REF_PI * k / ANGLES;
        double i[3], found[3];
        waves_at(current, WAVES, theta, i);
        waves_at(h.wave, h.count, theta, found);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, total_at(theta, i),
                                  found[0] * i[0] + found[1] * i[1] + found[2] * i[2]);
    }
    hci_memory_free(h.wave);
}

/* Without current, and without reluctance, both are the back-EMF. */
static void test_back_emf_alone(void)
{
    hci_wave_list none, smooth;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_gradient(&machine, current, 0, 0.0, &none, NULL));
    machine.slope_count = 0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_secant(&machine, current, WAVES, 0.0, &smooth, NULL));
    TEST_ASSERT_EQUAL_UINT(EMF, none.count);
    TEST_ASSERT_EQUAL_UINT(EMF, smooth.count);
    for (int k = 0; k < EMF; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(emf[k].sine, none.wave[k].sine);
        TEST_ASSERT_EQUAL_DOUBLE(emf[k].cosine, smooth.wave[k].cosine);
    }
    hci_memory_free(none.wave);
    hci_memory_free(smooth.wave);
}

static void test_small_waves_are_dropped(void)
{
    hci_wave_list all, large;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_gradient(&machine, current, WAVES, 0.0, &all, NULL));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_gradient(&machine, current, WAVES, 0.5, &large, NULL));
    TEST_ASSERT_TRUE(large.count > 0 && large.count < all.count);
    hci_memory_free(all.wave);
    hci_memory_free(large.wave);
}

static void test_memory_that_runs_out(void)
{
    hci_wave_list g = {emf, 1};
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_torque_gradient(&machine, current, WAVES, 0.0, &g, NULL));
    TEST_ASSERT_NULL(g.wave);
    TEST_ASSERT_EQUAL_UINT(0, g.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gradient_is_the_difference_of_the_torque);
    RUN_TEST(test_secant_times_the_current_is_the_torque);
    RUN_TEST(test_back_emf_alone);
    RUN_TEST(test_small_waves_are_dropped);
    RUN_TEST(test_memory_that_runs_out);
    return UNITY_END();
}
