/* The extended frame dq_x: power, the mutual torque's constant factor, the ordinary dq as its sinusoidal
 * case, and slopes of the inductances that keep the reluctance torque. References are sums over the three
 * phases. */
#include "hci/machine/frames.h"
#include "hci/machine/torque.h"

#include <math.h>
#include <stdio.h>

#include "support/reference.h"
#include "unity.h"

static uint64_t seed;

void setUp(void)
{
    seed = 20240612u;
}

void tearDown(void)
{
}

static double uniform(double low, double high)
{
    return ref_uniform(&seed, low, high);
}

enum { EMF_WAVES = 5, TRIALS = 2000 };

/* Back-EMF of orders 1, 3, 5, 7, 11, alike in each phase, at an angle. */
static void draw_back_emf(double e[3])
{
    static const double orders[EMF_WAVES] = {1.0, 3.0, 5.0, 7.0, 11.0},
                        sizes[EMF_WAVES] = {1.0, 0.3, 0.2, 0.1, 0.1};
    const double theta_rad = uniform(0.0, 2.0 * REF_PI);
    ref_wave waves[EMF_WAVES];
    for (int k = 0; k < EMF_WAVES; ++k) {
        const ref_wave w = {orders[k], orders[k], sizes[k] * uniform(0.5, 1.0), uniform(-3.0, 3.0)};
        waves[k] = w;
    }
    for (int s = 0; s < 3; ++s)
        e[s] = ref_waves_at(waves, EMF_WAVES, s, theta_rad);
}

static void draw_zero_sum(double i[3])
{
    i[0] = uniform(-9.0, 9.0);
    i[1] = uniform(-9.0, 9.0);
    i[2] = -i[0] - i[1];
}

static double product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* a_x = sqrt(3/2)/|e|, |e| over the phases without their mean */
static double expected_a_x(const double e[3])
{
    const double mean = (e[0] + e[1] + e[2]) / 3.0;
    const double part[3] = {e[0] - mean, e[1] - mean, e[2] - mean};
    return sqrt(1.5 / product(part, part));
}

/* e·i = a_x² (e_qx i_qx + e_dx i_dx), e_dx = 0, and the mutual torque is sqrt(3/2) i_qx */
static void test_power_balance(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], i[3];
        draw_back_emf(e);
        draw_zero_sum(i);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx ex = hci_dqx_from_abc(frame, e), ix = hci_dqx_from_abc(frame, i);
        const double a2 = frame.a_x * frame.a_x;
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * frame.a_x, expected_a_x(e), frame.a_x);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15 * ex.q, 0.0, ex.d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, product(e, i),
                                  a2 * (ex.q * ix.q + ex.d * ix.d)); /* rounding of 20 N·m */
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, product(e, i), sqrt(1.5) * ix.q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, sqrt(1.5), a2 * ex.q);
    }
}

/* i_qx = T/(a_x² e_qx) is 6.53 A for 8 N·m at every angle (Filho et al., Table 3 has 6.55 A), makes them, and
 * is the shortest. */
static void test_current_for_8_Nm(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], i[3], other[3];
        draw_back_emf(e);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx x = {0.0, 8.0 / (frame.a_x * frame.a_x * hci_dqx_from_abc(frame, e).q)};
        TEST_ASSERT_DOUBLE_WITHIN(0.005, 6.53, x.q);
        hci_dqx_to_abc(frame, x, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.0, i[0] + i[1] + i[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 8.0, product(e, i));
        const hci_dqx with_d = {uniform(-5.0, 5.0), x.q};
        hci_dqx_to_abc(frame, with_d, other);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8.0, product(e, other));
        TEST_ASSERT_TRUE(product(other, other) >= product(i, i));
    }
}

static void test_round_trips(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], i[3], back[3];
        draw_back_emf(e);
        draw_zero_sum(i);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx x = {uniform(-9.0, 9.0), uniform(-9.0, 9.0)};
        hci_dqx_to_abc(frame, hci_dqx_from_abc(frame, i), back);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, i[s], back[s]); /* some ulp of 18 A */
        hci_dqx_to_abc(frame, x, i);
        const hci_dqx y = hci_dqx_from_abc(frame, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, x.d, y.d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, x.q, y.q);
    }
}

/* e_s = E sin(θ − 2πs/3): the ordinary dq times sqrt(3/2)E, in which i_s = i_q sin − i_d cos of the shifted
 * angle. */
static void test_sinusoidal_back_emf_gives_ordinary_dq(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        const double theta_rad = uniform(-7.0, 7.0), size = uniform(0.1, 3.0), d = uniform(-9.0, 9.0),
                     q = uniform(-9.0, 9.0);
        const double factor = sqrt(1.5) * size;
        double e[3], i[3];
        for (int s = 0; s < 3; ++s) {
            const double angle_rad = theta_rad - 2.0 * REF_PI * s / 3.0;
            e[s] = size * sin(angle_rad);
            i[s] = q * sin(angle_rad) - d * cos(angle_rad);
        }
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx x = hci_dqx_from_abc(frame, i);
        const hci_dq park = hci_park(hci_clarke(i), theta_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 / size, 1.0 / size, frame.a_x);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * factor, factor * d, x.d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * factor, factor * q, x.q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * factor, factor * park.d, x.d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * factor, factor * park.q, x.q);
    }
}

/* The axes turn with the back-EMF vector: q ahead of d by a quarter turn in the direction a-b-c. */
static void test_axes_are_orthonormal_and_right_handed(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], d[3], q[3];
        draw_back_emf(e);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx along_d = {1.0, 0.0}, along_q = {0.0, 1.0};
        hci_dqx_to_abc(frame, along_d, d);
        hci_dqx_to_abc(frame, along_q, q);
        const double a2 = frame.a_x * frame.a_x,
                     turn = (d[0] * (q[1] - q[2]) + d[1] * (q[2] - q[0]) + d[2] * (q[0] - q[1])) / sqrt(3.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * a2, a2, product(d, d));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * a2, a2, product(q, q));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * a2, 0.0, product(d, q));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * a2, a2, turn);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0, hypot(frame.q_alpha, frame.q_beta));
    }
}

/* ---- reluctance ---------------------------------------------------------------------------------------- */

static void matrix_of(const double slope[HCI_PHASE_MATRIX], double l[3][3])
{
    l[0][0] = slope[HCI_AA];
    l[1][1] = slope[HCI_BB];
    l[2][2] = slope[HCI_CC];
    l[0][1] = l[1][0] = slope[HCI_AB];
    l[1][2] = l[2][1] = slope[HCI_BC];
    l[2][0] = l[0][2] = slope[HCI_CA];
}

static double quadratic(double l[3][3], const double x[3], const double y[3])
{
    double sum = 0.0;
    for (int r = 0; r < 3; ++r)
        for (int s = 0; s < 3; ++s)
            sum += x[r] * l[r][s] * y[s];
    return sum;
}

static double dqx_reluctance(hci_dqx_slope l, hci_dqx i)
{
    return 0.5 * l.d * i.d * i.d + l.dq * i.d * i.q + 0.5 * l.q * i.q * i.q;
}

static void test_reluctance_torque_at_every_angle(void)
{
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], i[3], slope[HCI_PHASE_MATRIX], l[3][3];
        draw_back_emf(e);
        draw_zero_sum(i);
        for (int k = 0; k < HCI_PHASE_MATRIX; ++k)
            slope[k] = uniform(-0.3, 0.3);
        matrix_of(slope, l);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const double torque_Nm = 0.5 * quadratic(l, i, i);
        const double got_Nm = dqx_reluctance(hci_dqx_slope_of(frame, slope), hci_dqx_from_abc(frame, i));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque_Nm,
                                  got_Nm); /* a hundred N·m, and the squares of e's cancellation */
    }
}

/* Rows 1 and 2 of the paper's T_dqx are the d and q axes over a_x, and of T_dqx⁻¹ the same times a_x, so that
 * its eq. (14) is T L' T⁻¹ = R L' Rᵀ without a_x²: the torque of eq. (13) comes out 1/a_x² times too large,
 * right only where a_x = 1. */
static void test_similarity_transform_of_the_paper_loses_a_x_squared(void)
{
    double least = HUGE_VAL, most = 0.0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        double e[3], i[3], axis[2][3], slope[HCI_PHASE_MATRIX], l[3][3];
        const hci_dqx ones[2] = {{1.0, 0.0}, {0.0, 1.0}};
        draw_back_emf(e);
        draw_zero_sum(i);
        for (int k = 0; k < HCI_PHASE_MATRIX; ++k)
            slope[k] = uniform(-0.3, 0.3);
        matrix_of(slope, l);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        for (int k = 0; k < 2; ++k) {
            hci_dqx_to_abc(frame, ones[k], axis[k]);
            for (int s = 0; s < 3; ++s)
                axis[k][s] /= frame.a_x;
        }
        const hci_dqx_slope paper = {quadratic(l, axis[0], axis[0]), quadratic(l, axis[0], axis[1]),
                                     quadratic(l, axis[1], axis[1])};
        const double torque_Nm = 0.5 * quadratic(l, i, i),
                     paper_Nm = dqx_reluctance(paper, hci_dqx_from_abc(frame, i));
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, torque_Nm, paper_Nm * frame.a_x * frame.a_x);
        if (fabs(torque_Nm) < 0.1) continue;
        least = fmin(least, paper_Nm / torque_Nm);
        most = fmax(most, paper_Nm / torque_Nm);
    }
    printf("reluctance torque by the similarity transform: %.2f to %.2f times the right one\n", least, most);
    TEST_ASSERT_TRUE(least < 0.7 && most > 1.3);
}

/* ---- no back-EMF --------------------------------------------------------------------------------------- */

static void check_no_frame(const double e[3])
{
    const double i[3] = {1.0, 2.0, -3.0}, slope[HCI_PHASE_MATRIX] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    const hci_dqx x = {3.0, 4.0};
    double back[3] = {1.0, 1.0, 1.0};
    const hci_dqx_frame frame = hci_dqx_frame_of(e);
    TEST_ASSERT_TRUE(frame.a_x == 0.0 && frame.q_alpha == 0.0 && frame.q_beta == 0.0);
    const hci_dqx y = hci_dqx_from_abc(frame, i);
    TEST_ASSERT_TRUE(y.d == 0.0 && y.q == 0.0);
    hci_dqx_to_abc(frame, x, back);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, back[s]);
    const hci_dqx_slope l = hci_dqx_slope_of(frame, slope);
    TEST_ASSERT_TRUE(l.d == 0.0 && l.dq == 0.0 && l.q == 0.0);
}

/* Zero, zero sequence alone, and what is too small for 1/|e| or not a number. */
static void test_without_back_emf_there_is_no_frame(void)
{
    const double zero[3] = {0.0, 0.0, 0.0}, common[3] = {0.7, 0.7, 0.7}, nothing[3] = {NAN, 0.0, 0.0};
    const double least[3] = {5e-324, 0.0, 0.0}, faint[3] = {1e-310, -1e-310, 0.0};
    check_no_frame(zero);
    check_no_frame(common);
    check_no_frame(nothing);
    check_no_frame(least);
    check_no_frame(faint);
}

/* Any size whose inverse is a number will do: the frame's mutual torque stays sqrt(3/2) i_qx. */
static void test_faint_and_huge_back_emf(void)
{
    for (int decade = -300; decade <= 300; decade += 50) {
        double e[3], i[3];
        draw_back_emf(e);
        for (int s = 0; s < 3; ++s)
            e[s] *= pow(10.0, decade);
        const hci_dqx_frame frame = hci_dqx_frame_of(e);
        const hci_dqx x = {0.0, 1e-3}; /* N·m over sqrt(3/2) */
        hci_dqx_to_abc(frame, x, i);
        TEST_ASSERT_DOUBLE_WITHIN(1e-17, 1e-3 * sqrt(1.5), product(e, i));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_power_balance);
    RUN_TEST(test_current_for_8_Nm);
    RUN_TEST(test_round_trips);
    RUN_TEST(test_sinusoidal_back_emf_gives_ordinary_dq);
    RUN_TEST(test_axes_are_orthonormal_and_right_handed);
    RUN_TEST(test_reluctance_torque_at_every_angle);
    RUN_TEST(test_similarity_transform_of_the_paper_loses_a_x_squared);
    RUN_TEST(test_without_back_emf_there_is_no_frame);
    RUN_TEST(test_faint_and_huge_back_emf);
    return UNITY_END();
}
