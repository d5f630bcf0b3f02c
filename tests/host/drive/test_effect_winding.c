/* What effects are to a winding, by means over the turn; and the torque per ampere of a machine whose torque
 * has harmonics. */
#include "host/drive/effect_winding.h"

#include "host/machine/torque_constant.h"
#include "support/effect_list.h"

static el_list list;
static el_machine machine;

void setUp(void)
{
    memset(&list, 0, sizeof list);
    el_machine_make(&machine);
}

void tearDown(void)
{
}

/* Without effects there is none, whatever stood there. */
static void test_no_flux_of_no_effects(void)
{
    const hci_plane_current i = {{1.0, 2.0}, {3.0, 4.0}};
    for (int which = 0; which < 2; ++which) {
        double slope_Vs[2] = {0.5, -0.5}, inductance_H[3] = {7.0, 8.0, 9.0};
        hci_effects_add_flux_slope(&machine.machine, which ? &list.list : NULL, NAN, 0.3, &i, slope_Vs,
                                   inductance_H);
        TEST_ASSERT_TRUE(slope_Vs[0] == 0.5 && slope_Vs[1] == -0.5);
        for (int k = 0; k < 3; ++k)
            TEST_ASSERT_EQUAL_DOUBLE(0.0, inductance_H[k]);
    }
}

/* The flux of L_d alone is L_d i_d along d = (cos θ, sin θ): its slope by the mechanical angle is
 * p L_d ((di_d/dθ + i_q) d + i_d q), where di/dθ is that of the currents in the plane. */
static void test_the_flux_of_an_inductance(void)
{
    const double d_H = 2e-3, theta = 0.7, c = cos(theta), s = sin(theta), p = machine.machine.pole_pairs;
    const hci_plane_current i = {{1.5, -2.0}, {0.4, 3.0}};
    const double i_d = c * i.x[0] + s * i.x[1], i_q = -s * i.x[0] + c * i.x[1],
                 along_d = c * i.slope[0] + s * i.slope[1] + i_q;
    double slope_Vs[2] = {0.5, -0.5}, inductance_H[3] = {7.0, 8.0, 9.0};
    el_add(&list, "reluctance", "dd_cosine", 0.0, d_H);
    hci_effects_add_flux_slope(&machine.machine, &list.list, NAN, theta, &i, slope_Vs, inductance_H);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, d_H * c * c, inductance_H[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, d_H * c * s, inductance_H[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, d_H * s * s, inductance_H[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 + p * d_H * (along_d * c - i_d * s), slope_Vs[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5 + p * d_H * (along_d * s + i_d * c), slope_Vs[1]);
}

/* L_d and L_q of their own; an order above 0, and what couples both, have no mean. */
static void saliency_add(double d_H, double q_H)
{
    el_add(&list, "reluctance", "dd_cosine", 0.0, d_H);
    el_add(&list, "reluctance", "dd_cosine", 6.0, 4e-4);
    el_add(&list, "reluctance", "dq_cosine", 0.0, 2e-4);
    el_add(&list, "reluctance", "qq_cosine", 6.0, -3e-4);
    if (q_H != 0.0) el_add(&list, "reluctance", "qq_cosine", 0.0, q_H);
}

static void test_mean_inductance(void)
{
    double d_H = 1.0, q_H = 1.0;
    hci_effects_mean_inductance(&machine.machine, NULL, &d_H, &q_H);
    TEST_ASSERT_TRUE(d_H == 0.0 && q_H == 0.0);
    saliency_add(7e-4, -3e-4);
    hci_effects_mean_inductance(&machine.machine, &list.list, &d_H, &q_H);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 7e-4, d_H);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -3e-4, q_H);
}

/* What effects add to both axes is no saliency. */
static void test_the_same_in_both_axes(void)
{
    double d_H = 3e-3, q_H = 5e-3;
    saliency_add(4e-4, 4e-4);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_take_saliency(&machine.machine, &list.list, &d_H, &q_H));
    TEST_ASSERT_TRUE(d_H == 3e-3 && q_H == 5e-3);
}

/* A difference that is declared and one of the effects are the same: the effects keep theirs. */
static void test_a_saliency_counts_once(void)
{
    double d_H = 3e-3, q_H = 5e-3;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_take_saliency(&machine.machine, &list.list, &d_H, &q_H));
    TEST_ASSERT_TRUE(d_H == 3e-3 && q_H == 5e-3);
    saliency_add(-2e-3, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -2e-3,
                              hci_effects_take_saliency(&machine.machine, &list.list, &d_H, &q_H));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5 * (3e-3 + 5e-3 + 2e-3), d_H);
    TEST_ASSERT_EQUAL_DOUBLE(d_H, q_H);
    d_H = q_H = 4e-3; /* none is declared */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_effects_take_saliency(&machine.machine, &list.list, &d_H, &q_H));
    TEST_ASSERT_TRUE(d_H == 4e-3 && q_H == 4e-3);
}

/* 3/2 of the fundamental of the back-EMF along q, whatever its harmonics make at each angle; a harmonic of
 * the effects changes nothing, a fundamental by 3/2. */
static void test_torque_constant(void)
{
    double by_value[8], work[8];
    const double wanted = 1.5 * 0.8 * cos(0.1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted, hci_torque_constant(&machine.machine, &list.list));
    el_add(&list, "back_emf", "sine", 7.0, 0.2);
    el_add(&list, "back_emf", "sine", 1.0, 0.04);
    el_add(&list, "friction", "coulomb", 0.0, 0.3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted + 0.06, hci_torque_constant(&machine.machine, &list.list));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted + 0.06,
                              hci_torque_constant_by_value(&machine.machine, &list.list, by_value, work));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, by_value[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, by_value[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, by_value[2]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_flux_of_no_effects);
    RUN_TEST(test_the_flux_of_an_inductance);
    RUN_TEST(test_mean_inductance);
    RUN_TEST(test_the_same_in_both_axes);
    RUN_TEST(test_a_saliency_counts_once);
    RUN_TEST(test_torque_constant);
    return UNITY_END();
}
