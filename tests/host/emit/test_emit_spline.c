/* Tables of 16-bit knots against waves by their sine formula in double: errors as stated and no smaller than
 * they have to be, what of a period is kept, integers and amperes, two parts, and limits of the arithmetic.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/emit/spline.h"
#include "support/current_waves.h"
#include "unity.h"

static int16_t knots[HCI_SPLINE_MOST_VALUES];
static double knots_A[HCI_SPLINE_MOST_VALUES];
static int8_t knots_i8[HCI_SPLINE_MOST_VALUES];
static hci_tabulation waves;
static hci_spline_room room;

void setUp(void)
{
    memset(&waves, 0, sizeof waves);
}

void tearDown(void)
{
}

/* T·a + b, a may be NULL. */
static void take(const currents *a, const currents *b, double torque_Nm, hci_table_frame frame, bool neutral)
{
    waves = (hci_tabulation){.constant = b->wave,
                             .constant_count = b->count,
                             .per_Nm = a ? a->wave : NULL,
                             .per_Nm_count = a ? a->count : 0,
                             .frame = frame,
                             .columns = neutral ? 3 : 2,
                             .parts = a ? 2 : 1,
                             .period_turns = 1,
                             .torque_Nm = a ? torque_Nm : 0.0};
    room = (hci_spline_room){&waves, hci_symmetry_of(&waves), knots, knots_A, knots_i8, 16};
}

typedef struct {
    double ampere, integer;
} errors;

/* Largest error at random angles and torques. */
static errors worst_of(const hci_table_i16 *x, const currents *a, const currents *b)
{
    uint64_t seed = 11;
    errors worst = {0.0, 0.0};
    for (int k = 0; k < 20000; ++k) {
        const uint32_t angle = (uint32_t)ref_uniform(&seed, 0.0, 4294967296.0);
        const int16_t share = (int16_t)(k % 3 == 0   ? 32767
                                        : k % 3 == 1 ? -32767
                                                     : ref_uniform(&seed, -32767.0, 32767.0));
        const double torque = share / 32768.0 * (double)x->reference_torque_Nm;
        double constant[3], slope[3] = {0.0, 0.0, 0.0};
        float ampere[3];
        int16_t unit[3];
        reference_currents(b, x->frame, 2.0 * REF_PI * angle / 4294967296.0, constant);
        if (a) reference_currents(a, x->frame, 2.0 * REF_PI * angle / 4294967296.0, slope);
        hci_table_i16_currents(x, angle, (float)torque, ampere);
        hci_table_i16_currents_q15(x, angle, share, unit);
        for (int s = 0; s < 3; ++s) {
            const double exact = constant[s] + torque * slope[s];
            worst.ampere = ref_worse(worst.ampere, (double)ampere[s] - exact);
            worst.integer = ref_worse(worst.integer, unit[s] * (double)x->unit_A - exact);
        }
    }
    return worst;
}

static void check(const hci_table_i16 *x, const currents *a, const currents *b, double tightness)
{
    char text[120];
    const errors worst = worst_of(x, a, b);
    snprintf(text, sizeof text, "degree %u, %u intervals: %.3g of %.3g A, integers %.3g of %.3g A",
             (unsigned)x->degree, (unsigned)x->intervals, worst.ampere, (double)x->max_error_A, worst.integer,
             (double)x->max_error_q15_A);
    TEST_ASSERT_TRUE_MESSAGE(worst.ampere <= (double)x->max_error_A, text);
    TEST_ASSERT_TRUE_MESSAGE(worst.integer <= (double)x->max_error_q15_A, text);
    TEST_ASSERT_TRUE_MESSAGE(worst.ampere >= tightness * (double)x->max_error_A, text);
}

static void test_stated_errors_hold_and_are_errors(void)
{
    static const uint32_t intervals[] = {9, 24, 60};
    const currents c = injected();
    for (int frame = HCI_TABLE_ABC; frame <= HCI_TABLE_DQ; ++frame)
        for (uint32_t degree = 1; degree <= 3; ++degree)
            for (size_t k = 0; k < 2 * sizeof intervals / sizeof *intervals; ++k) {
                hci_table_i16 x;
                take(NULL, &c, 0.0, (hci_table_frame)frame, false);
                room.knot_bits = k % 2 ? 8 : 16;
                hci_spline_make(&room, degree, intervals[k / 2], &x);
                check(&x, NULL, &c, k < 2 || degree == 1 ? 0.8 : 0.4);
            }
}

static void test_two_parts_add_up(void)
{
    const currents a = injected(), b = cogging_part();
    for (int frame = HCI_TABLE_ABC; frame <= HCI_TABLE_DQ; ++frame)
        for (uint32_t degree = 1; degree <= 3; ++degree) {
            hci_table_i16 x;
            take(&a, &b, 1.7, (hci_table_frame)frame, false);
            hci_spline_make(&room, degree, 40, &x);
            check(&x, &a, &b, 0.5);
            room.knot_bits = 8;
            hci_spline_make(&room, degree, 40, &x);
            check(&x, &a, &b, 0.5);
        }
}

/* Torque beyond the reference, and none at all. */
static void test_torque_is_limited(void)
{
    const currents a = injected(), b = cogging_part();
    hci_table_i16 x;
    float most[3], beyond[3], none[3], nan[3];
    take(&a, &b, 1.7, HCI_TABLE_ABC, false);
    hci_spline_make(&room, 2, 40, &x);
    for (uint32_t angle = 0; angle < 4000000000u; angle += 123456789u) {
        hci_table_i16_currents(&x, angle, 1.7f, most);
        hci_table_i16_currents(&x, angle, 40.0f, beyond);
        hci_table_i16_currents(&x, angle, 0.0f, none);
        hci_table_i16_currents(&x, angle, (float)NAN, nan);
        TEST_ASSERT_EQUAL_MEMORY(most, beyond, sizeof most);
        TEST_ASSERT_EQUAL_MEMORY(none, nan, sizeof none);
    }
}

/* One interval less would not do. */
static void test_fewest_intervals_for_an_error(void)
{
    const currents c = injected();
    for (uint32_t degree = 1; degree <= 3; ++degree)
        for (double error_A = 0.3; error_A > 0.003; error_A *= 0.1) {
            hci_table_i16 x, less;
            take(NULL, &c, 0.0, HCI_TABLE_ABC, false);
            TEST_ASSERT_TRUE(hci_spline_make_within(&room, degree, error_A, false, &x));
            TEST_ASSERT_TRUE((double)x.max_error_A <= error_A);
            const uint32_t intervals = x.intervals;
            hci_spline_make(&room, degree, intervals - 1, &less);
            TEST_ASSERT_TRUE((double)less.max_error_A > error_A);
        }
}

/* As above; and what 8 bits cannot keep is not kept. */
static void test_fewest_intervals_of_8_bits(void)
{
    const currents c = injected();
    for (uint32_t degree = 1; degree <= 3; ++degree) {
        hci_table_i16 fine, x;
        take(NULL, &c, 0.0, HCI_TABLE_ABC, false);
        const double error_A = 0.01 * hci_tabulation_peak_A(&waves);
        TEST_ASSERT_TRUE(hci_spline_make_within(&room, degree, error_A, true, &fine));
        room.knot_bits = 8;
        TEST_ASSERT_TRUE(hci_spline_make_i8_within(&room, degree, fine.intervals, error_A, &x));
        TEST_ASSERT_TRUE((double)x.max_error_q15_A <= error_A);
        TEST_ASSERT_TRUE(x.intervals >= fine.intervals && x.intervals <= 2 * fine.intervals);
        TEST_ASSERT_FALSE(hci_spline_make_i8_within(&room, degree, fine.intervals, 0.05 * error_A, &x));
    }
}

static void test_an_error_below_the_unit_is_not_kept(void)
{
    const currents c = injected();
    hci_table_i16 x;
    take(NULL, &c, 0.0, HCI_TABLE_ABC, false);
    TEST_ASSERT_FALSE(hci_spline_make_within(&room, 3, 1e-5, true, &x));
    TEST_ASSERT_EQUAL(HCI_TABLE_I16_MOST_INTERVALS, x.intervals);
    TEST_ASSERT_TRUE((double)x.max_error_q15_A < 2.0 * (double)x.unit_A);
}

/* ---- what is kept ---- */

static uint32_t sectors_with(double order, int sequence, hci_table_frame frame, bool neutral)
{
    currents c = injected();
    add(&c, order, sequence, 0.4, 1.1);
    take(NULL, &c, 0.0, frame, neutral);
    hci_table_i16 x;
    hci_spline_make(&room, 2, 180 / room.symmetry.sectors, &x);
    check(&x, NULL, &c, 0.0);
    TEST_ASSERT_TRUE((double)x.max_error_A < 0.05);
    return room.symmetry.sectors;
}

static void test_what_of_a_turn_is_kept(void)
{
    TEST_ASSERT_EQUAL(6, sectors_with(17, -1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(6, sectors_with(3, 0, HCI_TABLE_ABC, true));
    TEST_ASSERT_EQUAL(3, sectors_with(2, -1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(3, sectors_with(4, 1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(2, sectors_with(1, -1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(2, sectors_with(5, 1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(1, sectors_with(2, 1, HCI_TABLE_ABC, false));
    TEST_ASSERT_EQUAL(6, sectors_with(17, -1, HCI_TABLE_DQ, false));
    TEST_ASSERT_EQUAL(2, sectors_with(5, 1, HCI_TABLE_DQ, false));
    TEST_ASSERT_EQUAL(1, sectors_with(2, 1, HCI_TABLE_DQ, false));
}

/* ---- limits of the arithmetic ---- */

/* As large as they may be, and alternating: no sum overflows (the sanitizer would tell), and rounding stays.
 */
static void test_the_largest_knots_do_not_overflow(void)
{
    for (uint32_t degree = 1; degree <= 3; ++degree) {
        const int16_t most = degree == 3 ? 5400 : degree == 2 ? 16000 : 32000;
        hci_table_i16 x = {.knots = knots,
                           .knots_i8 = knots_i8,
                           .knot_bits = 16,
                           .intervals = 8,
                           .degree = degree,
                           .columns = 2,
                           .parts = 1,
                           .sectors = 1,
                           .frame = HCI_TABLE_DQ,
                           .period_turns = 1,
                           .unit_A = 1.0f};
        for (int k = 0; k < 22; ++k) {
            knots[k] = (int16_t)(k % 4 < 2 ? most : -most);
            knots_i8[k] = (int8_t)(knots[k] / 256);
        }
        for (uint32_t k = 0; k < 100000; ++k) {
            int16_t current[3];
            x.knot_bits = k % 2 ? 8 : 16;
            hci_table_i16_currents_q15(&x, k * 42949u, 0, current);
            TEST_ASSERT_TRUE(current[0] >= -most - 1 && current[0] <= most + 1);
        }
    }
}

/* Small waves of a high order beside a large one make large differences: the unit grows for them. */
static void test_steep_currents_have_a_larger_unit(void)
{
    currents c = {.count = 0};
    hci_table_i16 x;
    add(&c, 1, 1, 10.0, 0.0);
    add(&c, 7, 1, 9.0, 0.3);
    take(NULL, &c, 0.0, HCI_TABLE_ABC, false);
    hci_spline_make(&room, 3, 2, &x);
    for (uint32_t k = 2; k < (x.intervals + 3) * 2; ++k)
        TEST_ASSERT_TRUE(abs(knots[k] - knots[k - 2]) <= 10801);
    check(&x, NULL, &c, 0.5);
    room.knot_bits = 8;
    hci_spline_make(&room, 3, 2, &x);
    for (uint32_t k = 2; k < (x.intervals + 3) * 2; ++k)
        TEST_ASSERT_TRUE(abs(knots_i8[k] - knots_i8[k - 2]) <= 42);
    check(&x, NULL, &c, 0.5);
}

/* Where nothing is left to interpolate the error is that of the unit. */
static void test_a_constant_needs_one_interval(void)
{
    currents c = {.count = 0};
    hci_table_i16 x;
    add(&c, 1, 1, 10.0, 0.3);
    take(NULL, &c, 0.0, HCI_TABLE_DQ, false);
    TEST_ASSERT_TRUE(hci_spline_make_within(&room, 1, 0.001, true, &x));
    TEST_ASSERT_EQUAL(1, x.intervals);
    check(&x, NULL, &c, 0.0);
}

/* ---- check at start-up ---- */

static void test_damage_is_noticed(void)
{
    const currents c = injected();
    hci_table_i16_probe probe = {0x12345678u, 0, {0}};
    hci_table_i16 x, bad;
    take(NULL, &c, 0.0, HCI_TABLE_ABC, false);
    hci_spline_make(&room, 2, 20, &x);
    hci_table_i16_currents_q15(&x, probe.angle, 0, probe.expected);
    x.probes = &probe;
    x.probe_count = 1;
    x.crc32 = hci_table_i16_crc32(&x);
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_table_i16_check(&x));
    probe.expected[2] = (int16_t)(probe.expected[2] + 1);
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_PROBE, hci_table_i16_check(&x));
    knots[17] ^= 1;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_CRC, hci_table_i16_check(&x));
    bad = x;
    bad.degree = 4;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_SHAPE, hci_table_i16_check(&bad));
    bad = x;
    bad.intervals = 4096;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_SHAPE, hci_table_i16_check(&bad));
    bad = x;
    bad.knot_bits = 12;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_SHAPE, hci_table_i16_check(&bad));
}

/* The CRC-32 of "123456789" is CBF43926. */
static void test_crc_is_that_of_zlib(void)
{
    int16_t digits[5] = {0x3231, 0x3433, 0x3635, 0x3837, 0};
    const hci_table_i16 x = {
        .knots = digits, .knot_bits = 16, .intervals = 1, .degree = 1, .columns = 2, .parts = 1};
    const uint32_t eight = ~hci_table_i16_crc32(&x);
    const int8_t bytes[9] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    const hci_table_i16 nine = {
        .knots_i8 = bytes, .knot_bits = 8, .intervals = 2, .degree = 1, .columns = 3, .parts = 1};
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, ~hci_table_crc32_next(eight, 0x39u, 2));
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, hci_table_i16_crc32(&nine));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_stated_errors_hold_and_are_errors);
    RUN_TEST(test_two_parts_add_up);
    RUN_TEST(test_torque_is_limited);
    RUN_TEST(test_fewest_intervals_for_an_error);
    RUN_TEST(test_fewest_intervals_of_8_bits);
    RUN_TEST(test_an_error_below_the_unit_is_not_kept);
    RUN_TEST(test_what_of_a_turn_is_kept);
    RUN_TEST(test_the_largest_knots_do_not_overflow);
    RUN_TEST(test_steep_currents_have_a_larger_unit);
    RUN_TEST(test_a_constant_needs_one_interval);
    RUN_TEST(test_damage_is_noticed);
    RUN_TEST(test_crc_is_that_of_zlib);
    return UNITY_END();
}
