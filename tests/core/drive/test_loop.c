/* hci/loop.h, the code of the target, against the same in double precision and complex numbers. */
#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "core/drive/table_code.h"
#include "hci/loop.h"
#include "support/draws.h"
#include "unity.h"

enum { ORDERS = 4, LEVELS_MOST = 5 };

static const double complex J = (double complex)I;

static const uint16_t orders[ORDERS] = {0, 1, 3, 8};
static hci_loop_range ranges[ORDERS];
static hci_loop_wave waves[ORDERS * LEVELS_MOST];
static hci_loop_f32 loop;
static hci_loop_tables tables;
static float *memory;

/* A table of six periods in the turn with drawn orders at each level. */
static void draw_loop(uint32_t levels)
{
    uint64_t state = levels;
    for (uint32_t k = 0; k < ORDERS * levels; ++k)
        for (int a = 0; a < 2; ++a) {
            hci_loop_pair *pair[] = {&waves[k].current_A[a], &waves[k].voltage_Vs[a], &waves[k].own_Vs[a]};
            for (int q = 0; q < 3; ++q) {
                pair[q]->c = (float)ref_uniform(&state, -1.0, 1.0);
                pair[q]->s = k < levels ? 0.0f : (float)ref_uniform(&state, -1.0, 1.0);
            }
        }
    for (int k = 0; k < ORDERS; ++k)
        ranges[k] = (hci_loop_range){1e6f, 2e6f};
    loop = (hci_loop_f32){.waves = waves,
                          .orders = orders,
                          .ranges = ranges,
                          .order_count = ORDERS,
                          .levels = levels,
                          .points = 96,
                          .repeats = 6,
                          .period_turns = 1,
                          .base_order = 6.0f,
                          .torque_low_Nm = -2.0f,
                          .torque_high_Nm = 6.0f,
                          .resistance_ohm = 0.7f,
                          .inductance_H = {2e-3f, 3e-3f},
                          .proportional_ohm = {5.0f, 4.0f},
                          .integral_ohm_per_s = {1400.0f, 900.0f},
                          .filter = 0.6f,
                          .sample_s = 1e-4f,
                          .delay_s = 1.5e-4f,
                          .whole_rad_per_s = 1e6f,
                          .lead_s = 5e-4f};
    loop.crc32 = hci_loop_crc32(&loop);
}

static void make(hci_loop_remedy remedy, float speed_rad_per_s)
{
    free(memory); /* as much as is said, for the address sanitizer */
    memory = malloc(hci_loop_floats(&loop, remedy) * sizeof *memory);
    TEST_ASSERT_NOT_NULL(memory);
    hci_loop_start(&tables, &loop, remedy, memory);
    hci_loop_make(&tables, speed_rad_per_s);
}

static double complex number(hci_loop_pair x)
{
    return (double)x.c - J * (double)x.s;
}

/* ---- arithmetic ---- */

static void test_sine_and_cosine(void)
{
    for (uint32_t k = 0; k < 100000; ++k) {
        const uint32_t angle = k * 2654435769u;
        float s, c;
        hci_angle_sine_cosine(angle, &s, &c);
        TEST_ASSERT_DOUBLE_WITHIN(2e-7, sin(2.0 * REF_PI * angle / 4294967296.0), (double)s);
        TEST_ASSERT_DOUBLE_WITHIN(2e-7, cos(2.0 * REF_PI * angle / 4294967296.0), (double)c);
    }
    for (double x = 1e-4; x < 0.5 * REF_PI; x += 1e-3)
        TEST_ASSERT_DOUBLE_WITHIN(3e-7, sin(x) / x, (double)hci_loop_sinc((float)x));
}

/* ---- reading ---- */

/* Σ over the orders of a level, straight from their coordinates. */
static double exact(uint32_t level, int axis, double theta_rad)
{
    double sum = 0.0;
    for (uint32_t k = 0; k < ORDERS; ++k)
        sum += creal(number(waves[k * loop.levels + level].current_A[axis]) *
                     cexp(J * orders[k] * 6.0 * theta_rad));
    return sum;
}

static void test_a_table_is_its_orders(void)
{
    double worst = 0.0;
    draw_loop(1);
    make(HCI_LOOP_TABLE, 0.0f);
    for (uint32_t k = 0; k < 5000; ++k) {
        const uint32_t angle = k * 2654435769u;
        const hci_loop_reference r = hci_loop_at(&tables, angle, 1.0f, 0.0f);
        worst = fmax(worst, fabs((double)r.id_A - exact(0, 0, 2.0 * REF_PI * angle / 4294967296.0)));
        worst = fmax(worst, fabs((double)r.iq_A - exact(0, 1, 2.0 * REF_PI * angle / 4294967296.0)));
        TEST_ASSERT_EQUAL_FLOAT(0.0f, r.vd_V);
    }
    /* a quadratic spline with 12 points to the highest order, of amplitude 1.4 at most */
    TEST_ASSERT_TRUE(worst < 1.4 * 8e-3);
    TEST_ASSERT_TRUE(worst > 1e-5);
}

static void test_lead_reads_ahead(void)
{
    draw_loop(1);
    make(HCI_LOOP_TABLE, 0.0f);
    const hci_loop_reference late = hci_loop_at(&tables, 1000000000u + 83443027u, 0.0f, 0.0f);
    make(HCI_LOOP_LEAD, 0.0f);
    /* 244.140625 rad/s · 0.5 ms = 0.1220703 rad = 83 443 027 of 2^32 */
    const hci_loop_reference ahead = hci_loop_at(&tables, 1000000000u, 0.0f, 244.140625f);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, late.id_A, ahead.id_A);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, late.iq_A, ahead.iq_A);
}

/* Currents that are quadratic in the torque are met exactly, whatever the torque. */
static void test_levels_are_parabolas(void)
{
    draw_loop(5);
    for (uint32_t k = 0; k < ORDERS; ++k)
        for (uint32_t l = 0; l < 5; ++l)
            for (int a = 0; a < 2; ++a) {
                const float t = -2.0f + 2.0f * (float)l;
                const float scale = 0.3f + 0.2f * t - 0.1f * t * t;
                hci_loop_pair *x = &waves[k * 5 + l].current_A[a];
                x->c = scale * (float)(k + 1);
                x->s = k > 0 ? scale : 0.0f;
            }
    make(HCI_LOOP_TABLE, 0.0f);
    const hci_loop_reference one = hci_loop_at(&tables, 12345u, 0.0f, 0.0f); /* a level: t = 0, scale 0.3 */
    for (float t = -2.0f; t <= 6.0f; t += 0.0625f) {
        const float scale = 0.3f + 0.2f * t - 0.1f * t * t;
        const hci_loop_reference r = hci_loop_at(&tables, 12345u, t, 0.0f);
        TEST_ASSERT_FLOAT_WITHIN(3e-5f, one.iq_A * scale / 0.3f, r.iq_A);
        TEST_ASSERT_FLOAT_WITHIN(3e-5f, one.id_A * scale / 0.3f, r.id_A);
    }
}

/* Levels that have nothing to do with each other: at its own torque each is alone. */
static void test_at_its_torque_a_level_is_alone(void)
{
    static const uint32_t LEVELS[] = {1, 2, 3, 5};
    for (int n = 0; n < 4; ++n) {
        const uint32_t levels = LEVELS[n];
        draw_loop(levels);
        loop.points = 400;
        make(HCI_LOOP_TABLE, 0.0f);
        for (uint32_t l = 0; l < levels; ++l)
            for (uint32_t k = 0; k < 50; ++k) {
                const uint32_t angle = k * 2654435769u;
                const float torque_Nm = levels > 1 ? -2.0f + 8.0f * (float)l / (float)(levels - 1) : 0.5f;
                const hci_loop_reference r = hci_loop_at(&tables, angle, torque_Nm, 0.0f);
                const double theta_rad = 2.0 * REF_PI * angle / 4294967296.0;
                TEST_ASSERT_DOUBLE_WITHIN(1e-3, exact(l, 0, theta_rad), (double)r.id_A);
                TEST_ASSERT_DOUBLE_WITHIN(1e-3, exact(l, 1, theta_rad), (double)r.iq_A);
            }
    }
}

/* Two levels are the ends of a straight line. */
static void test_between_two_levels(void)
{
    draw_loop(2);
    loop.points = 400;
    make(HCI_LOOP_TABLE, 0.0f);
    for (uint32_t k = 0; k < 50; ++k) {
        const uint32_t angle = k * 2654435769u;
        const double theta_rad = 2.0 * REF_PI * angle / 4294967296.0;
        const hci_loop_reference r = hci_loop_at(&tables, angle, 0.0f, 0.0f);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.75 * exact(0, 1, theta_rad) + 0.25 * exact(1, 1, theta_rad),
                                  (double)r.iq_A);
    }
}

/* No jump while the torque slews, and nothing beyond the ends. */
static void test_torque_slews_without_a_bump_and_is_clamped(void)
{
    static const uint32_t LEVELS[] = {1, 2, 3, 5};
    for (int n = 0; n < 4; ++n) {
        draw_loop(LEVELS[n]);
        make(HCI_LOOP_FEEDFORWARD, 900.0f);
        hci_loop_reference last = hci_loop_at(&tables, 777u, -3.0f, 900.0f);
        const hci_loop_reference low = hci_loop_at(&tables, 777u, -2.0f, 900.0f);
        TEST_ASSERT_EQUAL_FLOAT(low.iq_A, last.iq_A);
        TEST_ASSERT_EQUAL_FLOAT(hci_loop_at(&tables, 777u, 0.0f, 900.0f).iq_A,
                                hci_loop_at(&tables, 777u, NAN, 900.0f).iq_A);
        for (float t = -3.0f; t < 8.0f; t += 1.0f / 1024.0f) {
            const hci_loop_reference r = hci_loop_at(&tables, 777u, t, 900.0f);
            TEST_ASSERT_FLOAT_WITHIN(0.2f, last.iq_A, r.iq_A);
            TEST_ASSERT_FLOAT_WITHIN(20.0f, last.vq_V, r.vq_V);
            last = r;
        }
        TEST_ASSERT_EQUAL_FLOAT(hci_loop_at(&tables, 777u, 6.0f, 900.0f).iq_A, last.iq_A);
        /* what is no number is no current where none is not among the levels */
        loop.torque_low_Nm += 9.0f;
        loop.torque_high_Nm += 9.0f;
        const hci_loop_reference none = hci_loop_at(&tables, 777u, NAN, 900.0f);
        loop.torque_low_Nm -= 9.0f;
        loop.torque_high_Nm -= 9.0f;
        TEST_ASSERT_TRUE(!(none.id_A * none.id_A + none.iq_A * none.iq_A > 0.0f));
        TEST_ASSERT_TRUE(!(none.vd_V * none.vd_V + none.vq_V * none.vq_V > 0.0f));
    }
}

/* ---- one order at one speed, in complex numbers ---- */

typedef struct {
    double complex reference[2], voltage[2]; /* voltage: at the angle of the sample */
} answer;

static double sinc(double x)
{
    return x == 0.0 ? 1.0 : sin(x) / x;
}

/* By the circular components d + jq and d − jq: held for a sample in the stator, at ν + ω and ν − ω. */
static void unhold(const double complex v[2], double nu, double w, double complex u[2])
{
    const double half = 0.5e-4;
    const double complex ahead = (v[0] + J * v[1]) / sinc((nu + w) * half) * cexp(J * nu * 1.5e-4),
                         behind = (v[0] - J * v[1]) / sinc((nu - w) * half) * cexp(J * nu * 1.5e-4);
    u[0] = 0.5 * (ahead + behind);
    u[1] = (ahead - behind) / (2.0 * J);
}

/* k_p + k_i T/(z − 1) of an axis, and the filter f/(1 − (1 − f)/z). */
static double complex control_of(int axis, double nu)
{
    const double complex z = cexp(J * nu * 1e-4);
    return axis == 0 ? 5.0 + 1400.0 * 1e-4 / (z - 1.0) : 4.0 + 900.0 * 1e-4 / (z - 1.0);
}

static double complex filter_of(double nu)
{
    return 0.6 / (1.0 - 0.4 * cexp(-J * nu * 1e-4));
}

static answer expect(uint32_t k, double w, bool compensated)
{
    const hci_loop_wave *x = &waves[k];
    const double nu = 6.0 * orders[k] * w, l[2] = {2e-3, 3e-3};
    double complex needed[2], u[2];
    answer out;
    for (int a = 0; a < 2; ++a)
        needed[a] = 0.7 * number(x->current_A[a]) + w * number(x->voltage_Vs[a]);
    unhold(needed, nu, w, u);
    for (int a = 0; a < 2; ++a) {
        const double image = 1.0 / pow(sinc(0.5e-4 * nu), 2.0) - 1.0;
        out.reference[a] = number(x->current_A[a]);
        if (k > 0) out.reference[a] += image * needed[a] / (J * nu * l[a]);
        out.reference[a] *= filter_of(nu);
        out.voltage[a] = u[a] - w * number(x->own_Vs[a]);
        if (compensated && k > 0) out.reference[a] += out.voltage[a] / control_of(a, nu);
    }
    return out;
}

/* Fourier sum of what comes out of the tables over a period. q: 0 … 3 are i_d, i_q, v_d, v_q. */
static double complex order_of(uint32_t order, double w, int q)
{
    enum { N = 512 };
    double complex sum = 0.0;
    for (uint32_t n = 0; n < N; ++n) {
        const hci_loop_reference r = hci_loop_at(&tables, n * (4294967295u / 6u / N + 1u), 0.0f, (float)w);
        const double value[] = {(double)r.id_A, (double)r.iq_A, (double)r.vd_V, (double)r.vq_V};
        sum += value[q] * cexp(-J * 2.0 * REF_PI * order * n / N) * (order > 0 ? 2.0 : 1.0) / N;
    }
    return sum;
}

static void compare(hci_loop_remedy remedy, double w)
{
    draw_loop(1);
    loop.points = 400;
    make(remedy, (float)w);
    for (uint32_t k = 0; k < ORDERS; ++k) {
        const answer e = expect(k, w, remedy == HCI_LOOP_COMPENSATION);
        for (int a = 0; a < 2; ++a) {
            const double complex current = order_of(orders[k], w, a), voltage = order_of(orders[k], w, 2 + a);
            TEST_ASSERT_DOUBLE_WITHIN(2e-4 * (1.0 + cabs(e.reference[a])), 0.0,
                                      cabs(current - e.reference[a]));
            if (remedy == HCI_LOOP_FEEDFORWARD)
                TEST_ASSERT_DOUBLE_WITHIN(2e-4 * (1.0 + cabs(e.voltage[a])), 0.0,
                                          cabs(voltage - e.voltage[a]));
        }
    }
}

static void test_compensation_and_feedforward_are_the_formulas(void)
{
    static const double SPEED[] = {10.0, 150.0, 400.0, -300.0};
    for (int n = 0; n < 4; ++n) {
        compare(HCI_LOOP_COMPENSATION, SPEED[n]);
        compare(HCI_LOOP_FEEDFORWARD, SPEED[n]);
    }
}

/* A response that was measured on the loop itself, 1/(C H): the references are those of the gains. */
static void test_a_measured_response_takes_the_place_of_the_gains(void)
{
    enum { N = 200 };
    static hci_loop_response response[N];
    const double w = 150.0;
    double complex by_gains[ORDERS][2];
    draw_loop(1);
    loop.points = 400;
    make(HCI_LOOP_COMPENSATION, (float)w);
    for (uint32_t k = 0; k < ORDERS; ++k)
        for (int a = 0; a < 2; ++a)
            by_gains[k][a] = order_of(orders[k], w, a);
    for (int k = 0; k < N; ++k) {
        const double nu = 50.0 * (k + 1);
        const double complex held = sinc(0.5e-4 * nu) * cexp(-J * nu * 1.5e-4);
        for (int a = 0; a < 2; ++a) {
            response[k].re[a] = (float)creal(1.0 / (control_of(a, nu) * held));
            response[k].im[a] = (float)cimag(1.0 / (control_of(a, nu) * held));
        }
        response[k].frequency_rad_per_s = (float)nu;
    }
    loop.responses = response;
    loop.response_count = N;
    make(HCI_LOOP_COMPENSATION, (float)w);
    for (uint32_t k = 0; k < ORDERS; ++k)
        for (int a = 0; a < 2; ++a)
            TEST_ASSERT_DOUBLE_WITHIN(2e-3 * (1.0 + cabs(by_gains[k][a])), 0.0,
                                      cabs(order_of(orders[k], w, a) - by_gains[k][a]));
}

/* ---- speed ---- */

static void test_orders_fade_each_by_itself(void)
{
    draw_loop(1);
    ranges[1] = (hci_loop_range){400.0f, 500.0f};
    ranges[3] = (hci_loop_range){100.0f, 200.0f};
    make(HCI_LOOP_TABLE, 150.0f);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, cabs(number(waves[1].current_A[0])), cabs(order_of(1, 150.0, 0)));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.5 * cabs(number(waves[3].current_A[0])), cabs(order_of(8, 150.0, 0)));
    make(HCI_LOOP_FEEDFORWARD, -450.0f);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.5 * cabs(expect(1, -450.0, false).reference[0]),
                              cabs(order_of(1, -450.0, 0)));
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.0, cabs(order_of(8, -450.0, 0)));
    TEST_ASSERT_DOUBLE_WITHIN(2e-2, 0.0, cabs(order_of(8, -450.0, 2)));
}

static void test_tables_say_when_they_are_old(void)
{
    draw_loop(1);
    loop.whole_rad_per_s = 1000.0f;
    make(HCI_LOOP_COMPENSATION, 500.0f);
    TEST_ASSERT_FALSE(hci_loop_is_old(&tables, 505.0f));
    TEST_ASSERT_TRUE(hci_loop_is_old(&tables, 510.0f));
    TEST_ASSERT_TRUE(hci_loop_is_old(&tables, -500.0f));
    make(HCI_LOOP_LEAD, 0.0f);
    TEST_ASSERT_FALSE(hci_loop_is_old(&tables, 900.0f));
    TEST_ASSERT_TRUE(hci_loop_is_old(&tables, 1100.0f));
}

/* A standstill, a speed that is no number, an angle anywhere: finite currents. */
static void test_nothing_is_infinite(void)
{
    draw_loop(3);
    for (int remedy = HCI_LOOP_TABLE; remedy <= HCI_LOOP_FEEDFORWARD; ++remedy) {
        make((hci_loop_remedy)remedy, 0.0f);
        const hci_loop_reference r = hci_loop_at(&tables, 4294967295u, 3.0f, NAN);
        TEST_ASSERT_TRUE(isfinite(r.id_A) && isfinite(r.iq_A) && isfinite(r.vd_V) && isfinite(r.vq_V));
    }
}

static void test_a_damaged_table_is_noticed(void)
{
    draw_loop(2);
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_GOOD, hci_loop_check(&loop));
    waves[3].voltage_Vs[1].s += 1e-3f;
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_BAD_CRC, hci_loop_check(&loop));
    loop.levels = 4;
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_BAD_SHAPE, hci_loop_check(&loop));
}

/* Numbers with which reading it would divide by zero or run over 32 bits. */
static void test_numbers_that_no_table_has(void)
{
    draw_loop(2);
    loop.torque_high_Nm = loop.torque_low_Nm;
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_BAD_SHAPE, hci_loop_check(&loop));
    draw_loop(2);
    loop.points = 65537u;
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_BAD_SHAPE, hci_loop_check(&loop));
    draw_loop(2);
    loop.repeats = 0u;
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_BAD_SHAPE, hci_loop_check(&loop));
    draw_loop(2);
    TEST_ASSERT_EQUAL_INT(HCI_TABLE_GOOD, hci_loop_check(&loop));
}

void setUp(void)
{
}

void tearDown(void)
{
    free(memory);
    memory = NULL;
}

/* What no table has is refused before its sum is taken. */
/* Each by what it is alone: all else is as it should be. */
static void test_shapes_that_no_loop_has(void)
{
    static const uint16_t OTHER[ORDERS] = {6, 12, 18, 24};
    enum { SHAPES = 11 };
    draw_loop(3);
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_loop_check(&loop));
    hci_loop_f32 bad[SHAPES];
    for (int k = 0; k < SHAPES; ++k)
        bad[k] = loop;
    bad[0].order_count = 0;
    bad[1].levels = 0;
    bad[2].points = 0;
    bad[3].orders = OTHER;
    bad[4].levels = 4;
    bad[5].response_count = 1;
    bad[6].points = HCI_LOOP_TABLE_MOST_POINTS + 1u;
    bad[7].repeats = 0;
    bad[8].period_turns = 0;
    bad[9].torque_high_Nm = bad[9].torque_low_Nm;
    bad[10].torque_low_Nm = NAN;
    for (int k = 0; k < SHAPES; ++k)
        TEST_ASSERT_EQUAL_MESSAGE(HCI_TABLE_BAD_SHAPE, hci_loop_check(&bad[k]), "of the list above");
    loop.points = HCI_LOOP_TABLE_MOST_POINTS;
    loop.response_count = 2;
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_loop_check(&loop));
    draw_loop(2);
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_loop_check(&loop));
    draw_loop(1);
    loop.torque_high_Nm = loop.torque_low_Nm; /* one level is for any torque */
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_loop_check(&loop));
}

/* ---- on a simulated drive ---- */

/* Any angle, forwards and back, with an encoder or without: the table at the angle of its own periods. */
static void test_a_simulated_drive_reads_the_table(void)
{
    hci_table_code code = {.pole_pairs = 6, .sine_A = 2.5f};
    draw_loop(3);
    loop.period_turns = 2;
    make(HCI_LOOP_FEEDFORWARD, 900.0f);
    code.tables = tables;
    for (int k = 0; k < 200; ++k) {
        const hci_measurement m = {{0.0, 0.0, 0.0}, 0.37 * (k - 100), k % 3 * 150.0};
        const double turns = m.theta_m_rad / (2.0 * REF_PI);
        hci_reference_dq r = {{9.0, 9.0}, {9.0, 9.0}};
        code.counts = k % 2 ? 1000 : 0;
        const double periods = 3.0 * (k % 2 ? floor(turns * 1000.0 + 0.5) / 1000.0 : turns);
        const hci_loop_reference expected =
            hci_loop_at(&tables, (uint32_t)((periods - floor(periods)) * 4294967295.0), 1.7f,
                        (float)(6.0 * m.speed_rad_per_s));
        hci_table_code_at(&code, &m, 1.7, &r);
        /* both angles are cut to 2^-32 of a turn of their own: 1e-9 turns of 24 waves of 40 A, or V */
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, (double)expected.id_A, r.i_A[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, (double)expected.iq_A, r.i_A[1]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-2, (double)expected.vd_V, r.v_V[0]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-2, (double)expected.vq_V, r.v_V[1]);
    }
}

static void test_without_a_table_a_sine(void)
{
    hci_table_code code = {.pole_pairs = 6, .sine_A = 2.5f};
    const hci_measurement m = {{0.0, 0.0, 0.0}, 0.4, 10.0};
    hci_reference_dq r = {{0.0, 0.0}, {0.0, 0.0}};
    hci_table_code_at(&code, &m, 1.7, &r);
    TEST_ASSERT_TRUE(r.i_A[0] == 0.0 && r.i_A[1] == 2.5 && r.v_V[0] == 0.0 && r.v_V[1] == 0.0);
}

/* Straight from 0 at a standstill to the first point, between the points, and as at the last one above; the
 * other way round the conjugate. */
static void test_a_measured_response_between_its_points(void)
{
    static const hci_loop_response RESPONSE[2] = {
        {.frequency_rad_per_s = 40.0f, .re = {2.0f, 3.0f}, .im = {1.0f, -4.0f}},
        {.frequency_rad_per_s = 100.0f, .re = {5.0f, -6.0f}, .im = {7.0f, 8.0f}}};
    static const float NU[] = {20.0f, 70.0f, 500.0f}, FIRST[] = {0.5f, 0.5f, 0.0f},
                       SECOND[] = {0.0f, 0.5f, 1.0f};
    const hci_loop_f32 measured = {.responses = RESPONSE, .response_count = 2};
    const hci_loop_pair x = {1.5f, -0.5f};
    for (int k = 0; k < 3; ++k)
        for (int a = 0; a < 2; ++a)
            for (int way = -1; way <= 1; way += 2) {
                const float re = FIRST[k] * RESPONSE[0].re[a] + SECOND[k] * RESPONSE[1].re[a];
                const float im = FIRST[k] * RESPONSE[0].im[a] + SECOND[k] * RESPONSE[1].im[a];
                const hci_loop_pair expected = hci_loop_times(x, re, (float)way * im);
                const hci_loop_pair found = hci_loop_measured(&measured, (float)way * NU[k], a, x);
                TEST_ASSERT_FLOAT_WITHIN(1e-5f, expected.c, found.c);
                TEST_ASSERT_FLOAT_WITHIN(1e-5f, expected.s, found.s);
            }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sine_and_cosine);
    RUN_TEST(test_a_table_is_its_orders);
    RUN_TEST(test_lead_reads_ahead);
    RUN_TEST(test_levels_are_parabolas);
    RUN_TEST(test_at_its_torque_a_level_is_alone);
    RUN_TEST(test_between_two_levels);
    RUN_TEST(test_torque_slews_without_a_bump_and_is_clamped);
    RUN_TEST(test_compensation_and_feedforward_are_the_formulas);
    RUN_TEST(test_a_measured_response_takes_the_place_of_the_gains);
    RUN_TEST(test_orders_fade_each_by_itself);
    RUN_TEST(test_tables_say_when_they_are_old);
    RUN_TEST(test_nothing_is_infinite);
    RUN_TEST(test_a_damaged_table_is_noticed);
    RUN_TEST(test_numbers_that_no_table_has);
    RUN_TEST(test_shapes_that_no_loop_has);
    RUN_TEST(test_a_simulated_drive_reads_the_table);
    RUN_TEST(test_without_a_table_a_sine);
    RUN_TEST(test_a_measured_response_between_its_points);
    return UNITY_END();
}
