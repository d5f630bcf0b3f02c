/* Limits, ramps and changes between tables, encoder counters, and field-oriented control in single precision,
 * against double precision, 64-bit integers and the core's own controller. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/counter.h"
#include "hci/drive/control.h"
#include "hci/foc.h"
#include "hci/machine/frames.h"
#include "support/draws.h"
#include "unity.h"

void setUp(void)
{
}
void tearDown(void)
{
}

static double length(hci_currents_dq i)
{
    return hypot((double)i.id_A, (double)i.iq_A);
}

/* ---- limits ---- */

static void test_a_vector_is_shortened_and_keeps_its_direction(void)
{
    uint64_t seed = 1;
    for (int k = 0; k < 20000; ++k) {
        const float size = (float)pow(10.0, ref_uniform(&seed, -6.0, 6.0));
        const hci_currents_dq i = {size * (float)ref_uniform(&seed, -1.0, 1.0),
                                   size * (float)ref_uniform(&seed, -1.0, 1.0)};
        const float most = size * (float)ref_uniform(&seed, 0.01, 1.5);
        const hci_currents_dq out = hci_guard_dq(i, most);
        const double expected = fmin(length(i), (double)most);
        TEST_ASSERT_TRUE(length(out) <= (double)most);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6 * expected, expected, length(out));
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * length(i) * length(out), 0.0,
                                  (double)i.id_A * (double)out.iq_A - (double)i.iq_A * (double)out.id_A);
    }
}

static void test_what_is_no_number_becomes_nothing(void)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 1e20f, 1e17f};
    const hci_currents_dq whole = {3.0f, 4.0f};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        const hci_currents_dq d = hci_guard_dq((hci_currents_dq){bad[k], 1.0f}, 5.0f);
        const hci_currents_dq q = hci_guard_dq((hci_currents_dq){1.0f, bad[k]}, 5.0f);
        TEST_ASSERT_TRUE(length(d) == 0.0 && length(q) == 0.0);
        for (int s = 0; s < 3; ++s) {
            float x[3] = {1.0f, -0.5f, -0.5f};
            x[s] = bad[k];
            const hci_currents_abc i = hci_guard_abc((hci_currents_abc){x[0], x[1], x[2]}, 5.0f);
            TEST_ASSERT_TRUE(i.ia_A == 0.0f && i.ib_A == 0.0f && i.ic_A == 0.0f);
        }
    }
    TEST_ASSERT_TRUE(length(hci_guard_dq(whole, NAN)) == 0.0);
    TEST_ASSERT_TRUE(length(hci_guard_dq(whole, 0.0f)) == 0.0);
    TEST_ASSERT_TRUE(length(hci_guard_dq(whole, -1.0f)) == 0.0);
}

static void test_phases_are_shortened_together(void)
{
    uint64_t seed = 2;
    for (int k = 0; k < 20000; ++k) {
        const float a = (float)ref_uniform(&seed, -20.0, 20.0), b = (float)ref_uniform(&seed, -20.0, 20.0);
        const hci_currents_abc i = {a, b, -a - b}, out = hci_guard_abc(i, 10.0f);
        const double largest = fmax(fabs((double)a), fmax(fabs((double)b), fabs((double)i.ic_A)));
        const double share = fmin(1.0, 10.0 / largest);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, share * (double)a, (double)out.ia_A);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, share * (double)b, (double)out.ib_A);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, share * (double)i.ic_A, (double)out.ic_A);
        TEST_ASSERT_TRUE(fabsf(out.ia_A) <= 10.0f && fabsf(out.ib_A) <= 10.0f && fabsf(out.ic_A) <= 10.0f);
    }
}

static int16_t any_unit(uint64_t *seed)
{
    return (int16_t)ref_uniform(seed, -32768.0, 32768.0);
}

static void test_integers_are_shortened(void)
{
    uint64_t seed = 3;
    for (int k = 0; k < 50000; ++k) {
        const uint16_t most = (uint16_t)ref_uniform(&seed, 1.0, 32768.0);
        const hci_units_dq i = {any_unit(&seed), any_unit(&seed)}, out = hci_guard_units_dq(i, most);
        const double before = hypot(i.id, i.iq), after = hypot(out.id, out.iq);
        const hci_units_abc p = {any_unit(&seed), any_unit(&seed), any_unit(&seed)};
        const hci_units_abc x = hci_guard_units_abc(p, most);
        TEST_ASSERT_TRUE(after <= (double)most);
        TEST_ASSERT_DOUBLE_WITHIN(4.0, fmin(before, most), after);
        TEST_ASSERT_TRUE(abs(x.ia) <= most && abs(x.ib) <= most && abs(x.ic) <= most);
        TEST_ASSERT_DOUBLE_WITHIN(3.0, p.ia * fmin(1.0, most / fmax(abs(p.ia), fmax(abs(p.ib), abs(p.ic)))),
                                  x.ia);
    }
    TEST_ASSERT_EQUAL_INT16(-32767, hci_guard_units_dq((hci_units_dq){-32768, 0}, 32767).id);
}

static void test_clamps(void)
{
    TEST_ASSERT_EQUAL_FLOAT(2.0f, hci_guard_clamp(5.0f, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, hci_guard_clamp(-INFINITY, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, hci_guard_clamp(NAN, -1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, hci_guard_clamp(NAN, 1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(-0.5f, hci_guard_clamp(-0.5f, -1.0f, 2.0f));
}

/* ---- ramps and changes ---- */

static void test_ramp_and_fade(void)
{
    hci_guard_ramp ramp;
    hci_guard_ramp_start(&ramp, 0.01f, 1e-4f);
    float last = 0.0f;
    int steps = 0;
    for (; last < 1.0f; ++steps) {
        const float share = hci_guard_ramp_next(&ramp, 1);
        TEST_ASSERT_TRUE(share > last && share - last < 0.0101f);
        last = share;
    }
    TEST_ASSERT_INT_WITHIN(1, 100, steps);
    TEST_ASSERT_EQUAL_FLOAT(0.99f, hci_guard_ramp_next(&ramp, 0));
    for (int k = 0; k < 200; ++k)
        last = hci_guard_ramp_next(&ramp, 0);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, last);
    hci_guard_ramp_start(&ramp, 0.0f, 1e-4f);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, hci_guard_ramp_next(&ramp, 1));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, hci_guard_fade(-99.0f, 100.0f, 200.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.25f, hci_guard_fade(-175.0f, 100.0f, 200.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, hci_guard_fade(200.0f, 100.0f, 200.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, hci_guard_fade(NAN, 100.0f, 200.0f));
}

static const float rows[2][4] = {{1.0f, 2.0f, 1.0f, 2.0f}, {-3.0f, 5.0f, -3.0f, 5.0f}};

/* No step larger than its share of the difference, and a table is free only when it is not read. */
static void test_a_change_has_no_bump(void)
{
    hci_table_f32 table[2] = {
        {.rows = rows[0], .points = 1, .columns = 2, .parts = 1, .frame = HCI_TABLE_DQ},
        {.rows = rows[1], .points = 1, .columns = 2, .parts = 1, .frame = HCI_TABLE_DQ}};
    hci_guard_change change;
    float last[3] = {1.0f, 2.0f, 0.0f}, now[3];
    hci_guard_change_start(&change, 0, 0.02f, 1e-3f);
    TEST_ASSERT_EQUAL_INT(0, hci_guard_change_is_free(&change, 0));
    TEST_ASSERT_EQUAL_INT(1, hci_guard_change_is_free(&change, 1));
    table[1].rows = NULL; /* nor is the other one read yet */
    hci_guard_change_f32(&change, table, 0u, 0.0f, now);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, now[0]);
    table[1].rows = rows[1];
    for (int k = 0; k < 100; ++k) {
        if (k == 10) hci_guard_change_to(&change, 1);
        if (k == 20) hci_guard_change_to(&change, 0); /* half way back */
        if (k == 50) hci_guard_change_to(&change, 1);
        hci_guard_change_f32(&change, table, 0x12345678u, 0.0f, now);
        TEST_ASSERT_FLOAT_WITHIN(4.0f * 0.05f + 1e-5f, last[0], now[0]);
        TEST_ASSERT_FLOAT_WITHIN(3.0f * 0.05f + 1e-5f, last[1], now[1]);
        TEST_ASSERT_TRUE(k != 15 || !hci_guard_change_is_free(&change, 0));
        TEST_ASSERT_TRUE(k != 45 || hci_guard_change_is_free(&change, 1));
        memcpy(last, now, sizeof last);
    }
    TEST_ASSERT_EQUAL_FLOAT(-3.0f, now[0]);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, now[1]);
    TEST_ASSERT_EQUAL_INT(1, hci_guard_change_is_free(&change, 0));
    TEST_ASSERT_EQUAL_INT(0, hci_guard_change_is_free(&change, 1));
    table[0].rows = NULL; /* it may be written: nothing reads it */
    hci_guard_change_f32(&change, table, 0u, 0.0f, now);
    TEST_ASSERT_EQUAL_FLOAT(-3.0f, now[0]);
}

/* ---- counters ---- */

static double turns_off(uint32_t angle, double turns)
{
    const double off = (double)angle / 4294967296.0 - turns;
    return fabs(off - floor(off + 0.5));
}

/* A shaft that goes to and fro over thousands of turns, read through counters of every width. */
static void wander(uint32_t range, uint32_t per_turn, int32_t direction, uint64_t *seed)
{
    const int64_t modulus = range > 0 ? (int64_t)range : 4294967296;
    int64_t counts = (int64_t)ref_uniform(seed, 0.0, (double)per_turn);
    double speed = 0.0, most = 0.49 * (double)modulus;
    hci_counter counter;
    if (most > 3.0 * per_turn) most = 3.0 * per_turn;
    hci_counter_start(&counter, range, per_turn, direction, (uint32_t)counts);
    for (int k = 0; k < 5000; ++k) {
        speed = fmax(-most, fmin(most, speed + ref_uniform(seed, -0.3, 0.3001) * most));
        counts += (int64_t)speed;
        const uint32_t raw = (uint32_t)(((counts % modulus) + modulus) % modulus);
        const double turns = direction * (double)(((counts % per_turn) + per_turn) % per_turn) / per_turn;
        TEST_ASSERT_DOUBLE_WITHIN(per_turn / 2.8e14 + 1.0 / 1e9, 0.0,
                                  turns_off(hci_counter_angle(&counter, raw), turns));
    }
}

static void test_counters_of_every_width(void)
{
    static const uint32_t per_turn[] = {1, 2, 3, 1000, 4000, 4096, 10000, 65536, 1000003, 2147483647};
    uint64_t seed = 4;
    for (size_t k = 0; k < sizeof per_turn / sizeof *per_turn; ++k)
        for (int32_t direction = -1; direction <= 1; direction += 2) {
            for (uint32_t bits = 8; bits <= 32; bits += 4)
                if (hci_counter_range(bits) == 0 || hci_counter_range(bits) >= per_turn[k])
                    wander(hci_counter_range(bits), per_turn[k], direction, &seed);
            if (per_turn[k] > 2) wander(per_turn[k], per_turn[k], direction, &seed);
        }
}

/* Where the rotor is known to stand at an electrical angle the table's angle there is that. */
static void test_alignment(void)
{
    hci_counter counter;
    for (int32_t direction = -1; direction <= 1; direction += 2) {
        memset(&counter, 0xA5, sizeof counter); /* nothing of what was there before is left */
        hci_counter_start(&counter, 65536u, 4000u, 5 * direction, 777u);
        TEST_ASSERT_EQUAL_INT32(direction, counter.direction); /* its sign counts */
        TEST_ASSERT_EQUAL_UINT32(hci_counter_own_angle(&counter), hci_counter_angle(&counter, 777u));
        (void)hci_counter_angle(&counter, 1234u);
        hci_counter_align(&counter, 0x31234567u, 7u);
        const uint32_t there = hci_counter_angle(&counter, 1234u);
        TEST_ASSERT_UINT32_WITHIN(7u, 0x31234567u, hci_angle_from_mechanical(there, 7u));
        const uint32_t on = hci_counter_angle(&counter, direction > 0 ? 2234u : 234u);
        TEST_ASSERT_UINT32_WITHIN(2u, 0x40000000u, on - there);
    }
    hci_counter_at_index(&counter);
    TEST_ASSERT_EQUAL_UINT32(0u, hci_counter_own_angle(&counter));
}

/* ---- frames and the controller ---- */

static void test_frames_are_those_of_the_core(void)
{
    uint64_t seed = 5;
    for (int k = 0; k < 20000; ++k) {
        const uint32_t angle = (uint32_t)ref_uniform(&seed, 0.0, 4294967296.0);
        const hci_currents_abc i = {(float)ref_uniform(&seed, -30.0, 30.0),
                                    (float)ref_uniform(&seed, -30.0, 30.0),
                                    (float)ref_uniform(&seed, -30.0, 30.0)};
        const double abc[3] = {(double)i.ia_A, (double)i.ib_A, (double)i.ic_A};
        const hci_dq exact = hci_park(hci_clarke(abc), (double)angle / 4294967296.0 * 2.0 * REF_PI);
        double back[3];
        float s, c;
        hci_angle_sine_cosine(angle, &s, &c);
        const hci_currents_dq dq = hci_foc_currents(i, s, c);
        const hci_currents_abc phases = hci_foc_phases(dq, s, c);
        hci_dq plane = exact;
        plane.zero = 0.0;
        hci_clarke_inverse(hci_park_inverse(plane, (double)angle / 4294967296.0 * 2.0 * REF_PI), back);
        TEST_ASSERT_DOUBLE_WITHIN(3e-5, exact.d, (double)dq.id_A);
        TEST_ASSERT_DOUBLE_WITHIN(3e-5, exact.q, (double)dq.iq_A);
        TEST_ASSERT_DOUBLE_WITHIN(5e-5, back[0], (double)phases.ia_A);
        TEST_ASSERT_DOUBLE_WITHIN(5e-5, back[1], (double)phases.ib_A);
        TEST_ASSERT_DOUBLE_WITHIN(5e-5, back[2], (double)phases.ic_A);
    }
}

/* With one axis the controller is that of the core, windup included. */
static void test_controller_is_that_of_the_core(void)
{
    const hci_pi reference = {5.0, 1400.0};
    const hci_voltages_dq none = {0.0f, 0.0f};
    hci_foc_pi pi = {0};
    double integral = 0.0;
    uint64_t seed = 6;
    hci_foc_gains(&pi, 5.0f, 1400.0f, 1e-4f);
    for (int k = 0; k < 5000; ++k) {
        const double error = (k / 500 % 2 ? 1.0 : -1.0) * 3.0 + ref_uniform(&seed, -1.0, 1.0);
        const double expected = hci_pi_step(&reference, &integral, (double)(float)error, 20.0, 1e-4);
        const hci_voltages_dq v = hci_foc_step(&pi, (hci_currents_dq){0.0f, (float)error}, none, 20.0f);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, expected, (double)v.vq_V);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, v.vd_V);
    }
    const hci_foc_pi before = pi;
    const hci_voltages_dq v = hci_foc_step(&pi, (hci_currents_dq){NAN, 1.0f}, none, 20.0f);
    TEST_ASSERT_TRUE(v.vd_V == 0.0f && v.vq_V == 0.0f);
    TEST_ASSERT_EQUAL_MEMORY(&before, &pi, sizeof pi);
}

/* Both axes with feed voltages, the vector limited as one: the law in double precision. */
static void test_controller_of_both_axes(void)
{
    const double kp = 4.0, ki = 900.0, h = 2e-4, most = 25.0;
    double integral[2] = {0.0, 0.0};
    int limited = 0;
    hci_foc_pi pi = {0};
    uint64_t seed = 8;
    hci_foc_gains(&pi, 4.0f, 900.0f, 2e-4f);
    for (int k = 0; k < 3000; ++k) {
        const hci_currents_dq error = {(float)ref_uniform(&seed, -3.0, 2.0),
                                       (float)ref_uniform(&seed, -2.0, 3.5)};
        const hci_voltages_dq feed = {(float)ref_uniform(&seed, -2.0, 6.0),
                                      (float)ref_uniform(&seed, -7.0, 1.0)};
        const hci_voltages_dq v = hci_foc_step(&pi, error, feed, 25.0f);
        const double e[2] = {(double)error.id_A, (double)error.iq_A};
        const double raw[2] = {kp * e[0] + integral[0] + (double)feed.vd_V,
                               kp * e[1] + integral[1] + (double)feed.vq_V};
        const double share = fmin(1.0, most / hypot(raw[0], raw[1]));
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, share * raw[0], (double)v.vd_V);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, share * raw[1], (double)v.vq_V);
        for (int a = 0; a < 2; ++a)
            integral[a] += ki * h * (e[a] + (share - 1.0) * raw[a] / kp);
        limited += share < 1.0;
    }
    TEST_ASSERT_TRUE(limited > 300 && limited < 2700);
    hci_foc_gains(&pi, 0.0f, 900.0f, 2e-4f); /* without k_p all that was cut off goes back at once */
    TEST_ASSERT_EQUAL_FLOAT(1.0f, pi.drawn);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.18f, pi.integral_ohm);
}

static void test_voltages_of_phases(void)
{
    float s, c;
    hci_angle_sine_cosine(0x40000000u, &s, &c);
    const hci_voltages_abc v = hci_foc_phase_voltages((hci_voltages_dq){0.0f, 10.0f}, s, c);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 10.0f, v.va_V);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, -5.0f, v.vb_V);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, -5.0f, v.vc_V);
    hci_angle_sine_cosine(0x2A000000u, &s, &c);
    const hci_voltages_abc x = hci_foc_phase_voltages((hci_voltages_dq){3.0f, -7.0f}, s, c);
    double abc[3];
    hci_clarke_inverse(hci_park_inverse((hci_dq){3.0, -7.0, 0.0}, 0x2A / 256.0 * 2.0 * REF_PI), abc);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, abc[0], (double)x.va_V);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, abc[1], (double)x.vb_V);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, abc[2], (double)x.vc_V);
}

static void test_between_two_tables(void)
{
    const hci_currents_dq dq =
        hci_guard_blend_dq((hci_currents_dq){1.0f, -2.0f}, (hci_currents_dq){3.0f, 6.0f}, 0.25f);
    const hci_currents_abc abc = hci_guard_blend_abc((hci_currents_abc){1.0f, -2.0f, 5.0f},
                                                     (hci_currents_abc){3.0f, 6.0f, -3.0f}, 0.25f);
    TEST_ASSERT_TRUE(dq.id_A == 1.5f && dq.iq_A == 0.0f);
    TEST_ASSERT_TRUE(abc.ia_A == 1.5f && abc.ib_A == 0.0f && abc.ic_A == 3.0f);
}

/* No limit above 0 lets nothing flow; the root of 0; a change that begins at table 1, and one that is shorter
 * than a sample. */
static void test_ends_of_what_there_is(void)
{
    const hci_currents_abc none = hci_guard_abc((hci_currents_abc){1.0f, -0.5f, -0.5f}, 0.0f);
    hci_guard_change one;
    TEST_ASSERT_TRUE(none.ia_A == 0.0f && none.ib_A == 0.0f && none.ic_A == 0.0f);
    TEST_ASSERT_EQUAL_UINT32(0, hci_guard_root(0));
    hci_guard_change_start(&one, 1, 1e-3f, 1e-3f);
    TEST_ASSERT_TRUE(one.share == 1.0f && one.step == 1.0f && one.wanted == 1u);
}

/* Half of the counter's range less a half is still forward, one count more is back. */
static void test_a_counter_turns_by_half_of_its_range(void)
{
    static const uint32_t MODULUS[] = {65536u, 1001u, 0u};
    for (size_t k = 0; k < sizeof MODULUS / sizeof *MODULUS; ++k) {
        const uint32_t per_turn = MODULUS[k] ? 100000u : 2147483647u, half = (MODULUS[k] - 1u) / 2u;
        hci_counter counter;
        hci_counter_start(&counter, MODULUS[k], per_turn, 1, 0u);
        hci_counter_angle(&counter, half);
        TEST_ASSERT_EQUAL_UINT32(half % per_turn, counter.position);
        hci_counter_start(&counter, MODULUS[k], per_turn, 1, 0u);
        hci_counter_angle(&counter, half + 1u);
        TEST_ASSERT_EQUAL_UINT32((2u * per_turn - (MODULUS[k] - half - 1u)) % per_turn, counter.position);
    }
}

/* Where constants have more digits than float, 1e15f itself may be on either side. */
static void test_numbers_are_below_1e15(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_EQUAL_INT(0, hci_guard_is_number((float)sign * nextafterf(1e15f, HUGE_VALF)));
        TEST_ASSERT_EQUAL_INT(1, hci_guard_is_number((float)sign * nextafterf(1e15f, 0.0f)));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_vector_is_shortened_and_keeps_its_direction);
    RUN_TEST(test_what_is_no_number_becomes_nothing);
    RUN_TEST(test_phases_are_shortened_together);
    RUN_TEST(test_integers_are_shortened);
    RUN_TEST(test_clamps);
    RUN_TEST(test_ramp_and_fade);
    RUN_TEST(test_a_change_has_no_bump);
    RUN_TEST(test_counters_of_every_width);
    RUN_TEST(test_alignment);
    RUN_TEST(test_frames_are_those_of_the_core);
    RUN_TEST(test_controller_is_that_of_the_core);
    RUN_TEST(test_controller_of_both_axes);
    RUN_TEST(test_voltages_of_phases);
    RUN_TEST(test_between_two_tables);
    RUN_TEST(test_ends_of_what_there_is);
    RUN_TEST(test_a_counter_turns_by_half_of_its_range);
    RUN_TEST(test_numbers_are_below_1e15);
    return UNITY_END();
}
