/* Clarke and Park: round trips, power, and the signs of theory section 1. */
#include "hci/machine/frames.h"

#include <math.h>

#include "support/draws.h"
#include "unity.h"

static const double tolerance = 1e-14; /* some ulp of values up to 10 */

static uint64_t seed;

void setUp(void)
{
    seed = 20240607u;
}

void tearDown(void)
{
}

static double draw(void)
{
    return ref_uniform(&seed, -10.0, 10.0);
}

static void draw_abc(double abc[3])
{
    for (int s = 0; s < 3; s++)
        abc[s] = draw();
}

static hci_dq to_dq(const double abc[3], double theta_rad)
{
    return hci_park(hci_clarke(abc), theta_rad);
}

static void test_round_trips(void)
{
    for (int trial = 0; trial < 200; trial++) {
        double abc[3], back[3];
        const double theta_rad = draw();
        draw_abc(abc);
        const hci_alpha_beta x = hci_clarke(abc), y = hci_park_inverse(hci_park(x, theta_rad), theta_rad);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, x.alpha, y.alpha);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, x.beta, y.beta);
        TEST_ASSERT_EQUAL_DOUBLE(x.zero, y.zero);
        hci_clarke_inverse(x, back);
        for (int s = 0; s < 3; s++)
            TEST_ASSERT_DOUBLE_WITHIN(tolerance, abc[s], back[s]);
    }
}

/* i_a = i_q sin θ − i_d cos θ, phases b and c a third and two thirds of a turn later */
static void test_phase_currents_of_a_dq_current(void)
{
    for (int trial = 0; trial < 200; trial++) {
        const hci_dq i = {draw(), draw(), draw()};
        const double theta_rad = draw();
        double abc[3];
        hci_clarke_inverse(hci_park_inverse(i, theta_rad), abc);
        for (int s = 0; s < 3; s++) {
            const double angle_rad = theta_rad - 2.0 * REF_PI * s / 3.0;
            const double expected = i.q * sin(angle_rad) - i.d * cos(angle_rad) + i.zero;
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, expected, abc[s]); /* 14 A turned by some ulp of 14 rad */
        }
    }
}

/* Σ v_s i_s = (3/2)(v_α i_α + v_β i_β) + 3 v_0 i_0 = (3/2)(v_d i_d + v_q i_q) + 3 v_0 i_0 */
static void test_power(void)
{
    for (int trial = 0; trial < 200; trial++) {
        double v[3], i[3];
        const double theta_rad = draw();
        draw_abc(v);
        draw_abc(i);
        const double power = v[0] * i[0] + v[1] * i[1] + v[2] * i[2];
        const hci_alpha_beta vs = hci_clarke(v), is = hci_clarke(i);
        const hci_dq vr = to_dq(v, theta_rad), ir = to_dq(i, theta_rad);
        const double zero = 3.0 * vs.zero * is.zero;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, power, 1.5 * (vs.alpha * is.alpha + vs.beta * is.beta) + zero);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, power, 1.5 * (vr.d * ir.d + vr.q * ir.q) + zero);
    }
}

/* A balanced set keeps its peak value, and a-b-c turns from α to β. */
static void test_amplitude_invariance_and_direction(void)
{
    for (int k = 0; k < 24; k++) {
        const double angle_rad = REF_PI * k / 12.0;
        const double abc[3] = {7.0 * cos(angle_rad), 7.0 * cos(angle_rad - 2.0 * REF_PI / 3.0),
                               7.0 * cos(angle_rad + 2.0 * REF_PI / 3.0)};
        const hci_alpha_beta x = hci_clarke(abc);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 7.0 * cos(angle_rad), x.alpha);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 7.0 * sin(angle_rad), x.beta);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.0, x.zero);
    }
    const double common[3] = {2.0, 2.0, 2.0};
    const hci_alpha_beta x = hci_clarke(common);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.alpha);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.beta);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, x.zero);
}

/* e_s = E sin(θ − 2πs/3) lies on +q; the magnets' flux λ_s = −Λ cos(θ − 2πs/3), whose change is e, lies on
 * +d. */
static void test_back_emf_is_q_and_magnets_are_d(void)
{
    for (int k = 0; k < 24; k++) {
        const double theta_rad = REF_PI * k / 12.0;
        double e[3], flux[3];
        for (int s = 0; s < 3; s++) {
            e[s] = 5.0 * sin(theta_rad - 2.0 * REF_PI * s / 3.0);
            flux[s] = -5.0 * cos(theta_rad - 2.0 * REF_PI * s / 3.0);
        }
        const hci_dq on_q = to_dq(e, theta_rad), on_d = to_dq(flux, theta_rad);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 5.0, on_q.q);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.0, on_q.d);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 5.0, on_d.d);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.0, on_d.q);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_trips);
    RUN_TEST(test_phase_currents_of_a_dq_current);
    RUN_TEST(test_power);
    RUN_TEST(test_amplitude_invariance_and_direction);
    RUN_TEST(test_back_emf_is_q_and_magnets_are_d);
    return UNITY_END();
}
