/* The torque that grows as no known effect does: every law, its torque and its derivatives, by pow. */
#include "host/diagnose/candidates/empirical_term.h"

#include <math.h>

#include "unity.h"

static const double CURRENT[8] = {0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0}, SPEED[4] = {0.0, 0.5, 1.0, 2.0};

void setUp(void)
{
}

void tearDown(void)
{
}

/* Exponents of the current first, then of the speed, and then the same with the direction. */
static void test_every_law(void)
{
    size_t g = 0;
    for (int turns = 0; turns < 2; ++turns)
        for (int v = 0; v < 4; ++v)
            for (int c = 0; c < 8; ++c, ++g) {
                const hci_growth_law law = hci_growth_law_of(g);
                const double size = pow(2.7, CURRENT[c]) * pow(3.1, SPEED[v]);
                TEST_ASSERT_EQUAL_DOUBLE(CURRENT[c], law.current);
                TEST_ASSERT_EQUAL_DOUBLE(SPEED[v], law.speed);
                TEST_ASSERT_EQUAL(turns, law.turns_sign);
                TEST_ASSERT_DOUBLE_WITHIN(1e-13 * size, size, hci_growth_law_at(g, 2.7, 3.1));
                TEST_ASSERT_DOUBLE_WITHIN(1e-13 * size, turns ? -size : size,
                                          hci_growth_law_at(g, 2.7, -3.1));
            }
    TEST_ASSERT_EQUAL_UINT64(HCI_GROWTH_LAWS, g);
}

static void test_at_rest(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(2.7, hci_growth_law_at(4, 2.7, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_growth_law_at(32 + 4, 2.7, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_growth_law_at(4, 0.0, 5.0));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_growth_law_at(0, 0.0, 5.0));
}

/* Orders of the turn: whole powers of the current, without the speed. The mean: all that does not turn with
 * the direction, and of what does the constant, the speed and its square. */
static void test_what_known_effects_do(void)
{
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        const double c = CURRENT[g % 8], v = SPEED[g / 8 % 4];
        const bool turns = g >= 32, whole = g % 8 == 0 || g % 8 == 4 || g % 8 >= 6;
        TEST_ASSERT_EQUAL(v == 0.0 && !turns && whole, hci_growth_law_is_known(g, 5.0));
        TEST_ASSERT_EQUAL(!turns || (c == 0.0 && g / 8 % 4 != 1), hci_growth_law_is_known(g, 0.0));
    }
}

/* T = Σ value · (sin, cos)(n p θ_m) · growth: √|i| and |ω|^½ sign ω at i_d = −1.2 and i_q = 1.6 A. */
static void test_torque_and_derivatives(void)
{
    const hci_machine machine = {.pole_pairs = 3};
    const double theta_m = 0.37, theta = 3.0 * theta_m;
    hci_sample x = {.theta_m_rad = theta_m, .speed_rad_per_s = -9.0};
    hci_effect_term term[2] = {{2 * 2, 1.5, 0.3, NAN}, {2 * (32 + 8) + 1, 4.0, -0.2, NAN}};
    const hci_effect effect = {&hci_empirical_type, term, 2};
    hci_effect_torque sum = {.torque_Nm = 0.5};
    double by_value[2];
    for (int s = 0; s < 3; ++s) {
        const double angle = theta - 2.0943951023931953 * s;
        x.i_abc[s] = 1.6 * sin(angle) + 1.2 * cos(angle);
    }
    const double first = sin(1.5 * theta) * sqrt(2.0), second = -cos(4.0 * theta) * 3.0;
    hci_empirical_type.torque_of_all(&effect, &machine, &x, &sum, by_value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, first, by_value[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, second, by_value[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 + 0.3 * first - 0.2 * second, sum.torque_Nm);
    hci_empirical_type.torque_of_all(&effect, &machine, &x, &sum, NULL);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 + 0.6 * first - 0.4 * second, sum.torque_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_law);
    RUN_TEST(test_at_rest);
    RUN_TEST(test_what_known_effects_do);
    RUN_TEST(test_torque_and_derivatives);
    return UNITY_END();
}
