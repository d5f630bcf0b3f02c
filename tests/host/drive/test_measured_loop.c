/* The swing of the torque that is left where the measured answer of a loop is off, against 3/2 k_e i_q +
 * 3/2 p (L_d − L_q) i_d i_q by hand. */
#include "host/drive/measured_loop.h"

#include <math.h>

#include "unity.h"

enum { PAIRS = 4, ORDERS = 3 };

static const double K_E = 0.2, RESISTANCE_OHM = 0.5, L_D_H = 1e-3, L_Q_H = 3e-3;

/* d and q, cosine and sine, of the mean and of two orders. */
static const hci_loop_wave WAVES[ORDERS] = {
    {.current_A = {{-3.0f, 0.0f}, {7.0f, 0.0f}}},
    {.current_A = {{0.4f, 0.3f}, {-0.5f, 1.2f}}},
    {.current_A = {{0.0f, 0.1f}, {0.2f, 0.0f}}, .voltage_Vs = {{0.02f, 0.0f}}}};
static const uint16_t ORDER[ORDERS] = {0, 6, 12};
static const hci_loop_range RANGES[ORDERS] = {{1e6f, 2e6f}, {1e6f, 2e6f}, {40.0f, 80.0f}};

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_swing_of_what_is_missed(void)
{
    const hci_wave emf = {1.0, 1, K_E, 0.0};
    const hci_machine machine = {.pole_pairs = PAIRS, .back_emf = &emf, .back_emf_count = 1};
    const hci_loop_f32 loop = {.waves = WAVES,
                               .orders = ORDER,
                               .ranges = RANGES,
                               .order_count = ORDERS,
                               .levels = 1,
                               .base_order = 1.0f,
                               .resistance_ohm = (float)RESISTANCE_OHM,
                               .inductance_H = {(float)L_D_H, (float)L_Q_H}};
    const double speed = 60.0,
                 saliency = 1.5 * PAIRS * (L_D_H - L_Q_H); /* of which half of order 12 is left */
    const double per_A[2] = {fabs(saliency * 7.0), fabs(1.5 * K_E - saliency * 3.0)};
    const double missed_A[2][2] = {
        {RESISTANCE_OHM * 0.5 / hypot(RESISTANCE_OHM, 6.0 * speed * L_D_H),
         RESISTANCE_OHM * 1.3 / hypot(RESISTANCE_OHM, 6.0 * speed * L_Q_H)},
        {hypot(speed * 0.02, RESISTANCE_OHM * 0.1) / hypot(RESISTANCE_OHM, 12.0 * speed * L_D_H),
         RESISTANCE_OHM * 0.2 / hypot(RESISTANCE_OHM, 12.0 * speed * L_Q_H)}};
    for (int axis = 0; axis < 2; ++axis) {
        const double error[2] = {axis == 0 ? 0.1 : 0.0, axis == 1 ? 0.3 : 0.0};
        const double expected =
            2.0 * per_A[axis] * error[axis] * (missed_A[0][axis] + 0.5 * missed_A[1][axis]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * expected, expected,
                                  hci_measured_loop_swing_Nm(&loop, &machine, error, 0, speed));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_swing_of_what_is_missed);
    return UNITY_END();
}
