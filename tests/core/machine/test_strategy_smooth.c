/* The strategies for any smooth torque: against those for a quadric where it is one, against brute force and
 * closed forms where it is not. */
#include <math.h>
#include <stdbool.h>

#include "hci/machine/strategy.h"
#include "support/draws.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* A quadric, and cubic terms as of iron that saturates. */
typedef struct {
    hci_machine_point quadric;
    double cubic[4]; /* of x², x²y, xy², y³ times x, 1, 1, 1 */
} curve;

static unsigned asked; /* how often for a torque */

static double torque_at(const void *context, const double x[2], double gradient[2])
{
    ++asked;
    const curve *c = context;
    const double *e = c->quadric.e, *h = c->quadric.slope, *q = c->cubic, a = x[0], b = x[1];
    gradient[0] = e[0] + h[0] * a + h[1] * b + 3.0 * q[0] * a * a + 2.0 * q[1] * a * b + q[2] * b * b;
    gradient[1] = e[1] + h[1] * a + h[2] * b + q[1] * a * a + 2.0 * q[2] * a * b + 3.0 * q[3] * b * b;
    return hci_point_torque_Nm(&c->quadric, x) + q[0] * a * a * a + q[1] * a * a * b + q[2] * a * b * b +
           q[3] * b * b * b;
}

static curve draw(uint64_t *seed, double cubic)
{
    curve c;
    const double angle_rad = ref_uniform(seed, -3.0, 3.0), e = ref_uniform(seed, 0.5, 2.0);
    c.quadric.e[0] = e * cos(angle_rad);
    c.quadric.e[1] = e * sin(angle_rad);
    for (int k = 0; k < 3; ++k)
        c.quadric.slope[k] = ref_uniform(seed, -0.1, 0.1);
    c.quadric.cogging_Nm = ref_uniform(seed, -0.4, 0.4);
    for (int k = 0; k < 4; ++k)
        c.cubic[k] = cubic * ref_uniform(seed, -1.0, 1.0);
    return c;
}

static double value_at(const curve *c, double a, double b)
{
    const double x[2] = {a, b};
    double unused[2];
    return torque_at(c, x, unused);
}

/* ---- a quadric ---- */

static void test_a_quadric_is_answered_as_by_its_own_formulas(void)
{
    static const hci_strategy ALL[] = {HCI_STRATEGY_ID0, HCI_STRATEGY_CANCEL, HCI_STRATEGY_MTPA};
    uint64_t seed = 31;
    int reached = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const curve c = draw(&seed, 0.0);
        const hci_smooth_torque torque = {torque_at, &c};
        const double wanted = ref_uniform(&seed, -4.0, 4.0);
        for (int k = 0; k < 3; ++k) {
            double x[2], y[2];
            const hci_status one = hci_strategy_current(&c.quadric, ALL[k], wanted, NULL, x, NULL);
            const hci_status other =
                hci_strategy_smooth_current(&torque, &c.quadric, ALL[k], wanted, NULL, y);
            if (one != HCI_OK) continue;
            /* `cancel` looks for i_d up to four times the size of the currents */
            if (ALL[k] == HCI_STRATEGY_CANCEL &&
                hypot(x[0], x[1]) > 3.0 * fabs(wanted) / hypot(c.quadric.e[0], c.quadric.e[1]))
                continue;
            TEST_ASSERT_EQUAL_INT(HCI_OK, other);
            TEST_ASSERT_DOUBLE_WITHIN(1e-8 * hypot(x[0], x[1]), x[0], y[0]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-8 * hypot(x[0], x[1]), x[1], y[1]);
            ++reached;
        }
    }
    TEST_ASSERT_TRUE(reached > 700);
}

/* ---- saturation ---- */

/* The shortest current by brute force: the first crossing along each of many rays. */
static double shortest_by_rays(const curve *c, double wanted, double most_A)
{
    const double step_A = 0.01 * most_A;
    double best = HUGE_VAL;
    for (int k = 0; k < 720; ++k) {
        const double u = cos(REF_PI * k / 360.0), v = sin(REF_PI * k / 360.0);
        double before = c->quadric.cogging_Nm - wanted;
        for (double r = step_A; r < fmin(best, most_A) + step_A; r += step_A) {
            const double now = value_at(c, r * u, r * v) - wanted;
            if (now * before <= 0.0) best = fmin(best, r - step_A * now / (now - before));
            before = now;
        }
    }
    return best;
}

static void test_shortest_current_under_saturation(void)
{
    uint64_t seed = 32;
    for (int trial = 0; trial < 60; ++trial) {
        const curve c = draw(&seed, 0.03);
        const hci_smooth_torque torque = {torque_at, &c};
        const double wanted = (trial % 2 ? 1.0 : -1.0) * ref_uniform(&seed, 0.8, 2.0);
        double x[2], y[2], near[2];
        asked = 0;
        TEST_ASSERT_EQUAL_INT(
            HCI_OK, hci_strategy_smooth_current(&torque, &c.quadric, HCI_STRATEGY_MTPA, wanted, NULL, x));
        const unsigned asked_here = asked;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted, value_at(&c, x[0], x[1]));
        const double size = hypot(x[0], x[1]), best = shortest_by_rays(&c, wanted, 2.0 * size);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * size, best, size);
        /* where it is shortest the gradient is along it */
        double g[2];
        torque_at(&c, x, g);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * size * hypot(g[0], g[1]), 0.0, g[0] * x[1] - g[1] * x[0]);
        TEST_ASSERT_TRUE(asked_here <= 1300);
        near[0] = 1.1 * x[0] - 0.2 * x[1]; /* a neighbour's ray leads to the same */
        near[1] = 1.1 * x[1] + 0.2 * x[0];
        asked = 0;
        TEST_ASSERT_EQUAL_INT(
            HCI_OK, hci_strategy_smooth_current(&torque, &c.quadric, HCI_STRATEGY_MTPA, wanted, near, y));
        TEST_ASSERT_TRUE(asked <= 80); /* some tens */
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * size, x[0], y[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * size, x[1], y[1]);
    }
}

/* i_q = τ/e, and the shortest i_d with T = τ by small steps outwards. */
static void test_cancelling_under_saturation(void)
{
    uint64_t seed = 33;
    int reached = 0, missed = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const curve c = draw(&seed, 0.03);
        const hci_smooth_torque torque = {torque_at, &c};
        const double e = hypot(c.quadric.e[0], c.quadric.e[1]), wanted = ref_uniform(&seed, 0.8, 2.0);
        const double q[2] = {c.quadric.e[0] / e, c.quadric.e[1] / e}, iq = wanted / e;
        double x[2], first = HUGE_VAL, least = HUGE_VAL;
        const double at_zero = value_at(&c, iq * q[0], iq * q[1]) - wanted;
        for (int k = 0; k <= 8000 && !(first < HUGE_VAL); ++k)
            for (int side = -1; side <= 1; side += 2) {
                const double id = side * 2e-4 * iq * k; /* up to 1.6 i_q, which is within the search */
                const double off = value_at(&c, iq * q[0] + id * q[1], iq * q[1] - id * q[0]) - wanted;
                least = fmin(least, fabs(off));
                if (off * at_zero <= 0.0) first = fmin(first, fabs(id));
            }
        const hci_status status =
            hci_strategy_smooth_current(&torque, &c.quadric, HCI_STRATEGY_CANCEL, wanted, NULL, x);
        const double id = x[0] * q[1] - x[1] * q[0];
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, iq, x[0] * q[0] + x[1] * q[1]);
        if (first < HUGE_VAL) {
            TEST_ASSERT_EQUAL_INT(HCI_OK, status);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted, value_at(&c, x[0], x[1]));
            TEST_ASSERT_DOUBLE_WITHIN(3e-4 * iq, first, fabs(id));
            ++reached;
        } else if (status != HCI_OK) { /* then nearly the nearest that there is */
            TEST_ASSERT_TRUE(fabs(value_at(&c, x[0], x[1]) - wanted) <= 1.05 * least + 0.02);
            ++missed;
        }
    }
    TEST_ASSERT_TRUE(reached > 60 && missed > 5);
}

/* The same machine with another unit of the current: the same currents in it. */
static void test_cancelling_in_any_unit(void)
{
    const double unit = ldexp(1.0, -30);
    uint64_t seed = 34;
    for (int trial = 0; trial < 50; ++trial) {
        const curve c = draw(&seed, 0.03);
        curve small = c;
        for (int k = 0; k < 2; ++k)
            small.quadric.e[k] /= unit;
        for (int k = 0; k < 3; ++k)
            small.quadric.slope[k] /= unit * unit;
        for (int k = 0; k < 4; ++k)
            small.cubic[k] /= unit * unit * unit;
        const hci_smooth_torque torque = {torque_at, &c}, of_small = {torque_at, &small};
        const double wanted = ref_uniform(&seed, 0.8, 2.0);
        double x[2], y[2];
        TEST_ASSERT_EQUAL_INT(
            hci_strategy_smooth_current(&torque, &c.quadric, HCI_STRATEGY_CANCEL, wanted, NULL, x),
            hci_strategy_smooth_current(&of_small, &small.quadric, HCI_STRATEGY_CANCEL, wanted, NULL, y));
        for (int k = 0; k < 2; ++k) /* powers of two change no digit */
            TEST_ASSERT_DOUBLE_WITHIN(1e-12 * hypot(x[0], x[1]), x[k], y[k] / unit);
    }
}

/* Two roots that are equally long: the one nearer to what went before. i_d² = (1 − a)/… of T = e i_q + ½ h
 * i_d² + T_cog, with the d axis in any direction. */
static void test_of_two_roots_the_nearer(void)
{
    for (int k = 0; k < 12; ++k)
        for (int side = -1; side <= 1; side += 2) {
            const double u = cos(REF_PI * k / 6.0), v = sin(REF_PI * k / 6.0);
            const curve c = {{{-v, u}, {0.2 * u * u, 0.2 * u * v, 0.2 * v * v}, -0.1}, {0.0, 0.0, 0.0, 0.0}};
            const hci_smooth_torque torque = {torque_at, &c};
            const double previous[2] = {0.9 * side * u - 1.4 * v, 0.9 * side * v + 1.4 * u};
            double x[2];
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_strategy_smooth_current(&torque, &c.quadric,
                                                                      HCI_STRATEGY_CANCEL, 1.5, previous, x));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, side * u - 1.5 * v, x[0]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, side * v + 1.5 * u, x[1]);
        }
}

/* ---- a torque of few directions ---- */

/* T = r e^{400 (cos(φ − direction) − 1)}, a third of it 4° aside; and a hill beside, the other way, of less
 * than 1 N·m. */
typedef struct {
    double direction_rad, hill_Nm;
} ridge;

static double ridge_at(const void *context, const double x[2], double gradient[2])
{
    const ridge *t = context;
    const double r = hypot(x[0], x[1]), phi = atan2(x[1], x[0]) - t->direction_rad;
    const double c = r > 0.0 ? x[0] / r : 1.0, s = r > 0.0 ? x[1] / r : 0.0;
    const double f = exp(400.0 * (cos(phi) - 1.0)), across = -400.0 * sin(phi) * f;
    const double a = x[0] + 0.5 * cos(t->direction_rad), b = x[1] + 0.5 * sin(t->direction_rad);
    const double hill = t->hill_Nm * exp(-50.0 * (a * a + b * b));
    gradient[0] = f * c - across * s - 100.0 * a * hill;
    gradient[1] = f * s + across * c - 100.0 * b * hill;
    return r * f + hill;
}

/* The shortest current is along the ridge, in whichever direction that is; what comes near elsewhere, and on
 * a shorter way, does not count where the torque is reached. */
static void test_a_torque_that_few_directions_make(void)
{
    const hci_machine_point mutual = {{0.0, 1.0}, {0.0, 0.0, 0.0}, 0.0};
    for (int k = 0; k < 96; ++k) {
        const ridge t = {2.0 * REF_PI * (k % 48) / 48.0 + 0.01, k < 48 ? 0.0 : 0.99};
        const hci_smooth_torque torque = {ridge_at, &t};
        double x[2];
        TEST_ASSERT_EQUAL_INT(HCI_OK,
                              hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_MTPA, 1.0, NULL, x));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, cos(t.direction_rad), x[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sin(t.direction_rad), x[1]);
    }
}

/* ---- what cannot be ---- */

/* T = e·x/(1 + |x|²/s²): e s/2 at most. */
static double bounded(const void *context, const double x[2], double gradient[2])
{
    const double *c = context, e = c[0], s = c[1], along = e * x[1];
    const double n = 1.0 + (x[0] * x[0] + x[1] * x[1]) / (s * s);
    gradient[0] = -along * 2.0 * x[0] / (s * s) / (n * n);
    gradient[1] = e / n - along * 2.0 * x[1] / (s * s) / (n * n);
    return along / n;
}

static void test_what_is_not_reached(void)
{
    const double numbers[2] = {1.3, 2.0};
    const hci_smooth_torque torque = {bounded, numbers};
    const hci_machine_point mutual = {{0.0, 1.3}, {0.0, 0.0, 0.0}, 0.0},
                            nothing = {{0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0};
    double x[2], unused[2];
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_MTPA, 1.0, NULL, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, x[0]); /* 1.3 y = 1 + y²/4 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.6 - sqrt(2.6 * 2.6 - 4.0), x[1]);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_MTPA, 1.4, NULL, x));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.3, bounded(numbers, x, unused));
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_MTPA, 1.4, x, x));
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_smooth_current(&torque, &nothing, HCI_STRATEGY_CANCEL, 1.0, NULL, x));
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_CANCEL, 1.0, NULL, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, x[0]); /* d current makes it less still */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / 1.3, x[1]);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_CANCEL, 0.0, NULL, x));
    TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
}

/* T = −x²: no current is nearer than none. */
static double only_brakes(const void *context, const double x[2], double gradient[2])
{
    (void)context;
    gradient[0] = -2.0 * x[0];
    gradient[1] = -2.0 * x[1];
    return -x[0] * x[0] - x[1] * x[1];
}

static void test_where_no_current_helps(void)
{
    const hci_smooth_torque torque = {only_brakes, NULL};
    const hci_machine_point mutual = {{0.0, 1.3}, {0.0, 0.0, 0.0}, 0.0};
    double x[2] = {7.0, 7.0};
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED,
                          hci_strategy_smooth_current(&torque, &mutual, HCI_STRATEGY_MTPA, 1.0, NULL, x));
    TEST_ASSERT_TRUE(x[0] == 0.0 && x[1] == 0.0);
}

/* A motor of 0.1 N·m/A. */
static void test_a_small_back_emf_is_one(void)
{
    const curve c = {{{0.0, 0.1}, {0.0, 0.0, 0.0}, 0.0}, {0.0, 0.0, 0.0, 0.0}};
    const hci_smooth_torque torque = {torque_at, &c};
    double x[2];
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_strategy_smooth_current(&torque, &c.quadric, HCI_STRATEGY_CANCEL, 0.15, NULL, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, x[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_quadric_is_answered_as_by_its_own_formulas);
    RUN_TEST(test_shortest_current_under_saturation);
    RUN_TEST(test_cancelling_under_saturation);
    RUN_TEST(test_cancelling_in_any_unit);
    RUN_TEST(test_of_two_roots_the_nearer);
    RUN_TEST(test_a_torque_that_few_directions_make);
    RUN_TEST(test_what_is_not_reached);
    RUN_TEST(test_where_no_current_helps);
    RUN_TEST(test_a_small_back_emf_is_one);
    return UNITY_END();
}
