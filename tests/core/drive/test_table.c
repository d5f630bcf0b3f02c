/* The table runtime against double arithmetic, zlib's CRC-32 and damaged tables. */
#include <math.h>
#include <string.h>

#include "hci/table.h"
#include "support/reference.h"
#include "unity.h"

void setUp(void)
{
}
void tearDown(void)
{
}

enum { MOST_POINTS = 1000, MOST_VALUES = 6 };

static float rows[(MOST_POINTS + 1) * MOST_VALUES];

/* Random rows; the guard row repeats the first one. */
static hci_table_f32 random_table(uint64_t *seed, uint32_t points, uint32_t columns, uint32_t parts)
{
    const uint32_t values = columns * parts;
    hci_table_f32 table = {0};
    for (uint32_t k = 0; k < points * values; ++k)
        rows[k] = (float)ref_uniform(seed, -10.0, 10.0);
    memcpy(rows + points * values, rows, values * sizeof *rows);
    table.rows = rows;
    table.points = points;
    table.columns = columns;
    table.parts = parts;
    table.reference_torque_Nm = parts == 2 ? 2.0f : 0.0f;
    return table;
}

/* Column c at an angle by long division in double: the place in the table is exact, since points < 2^20. */
static double expected_value(const hci_table_f32 *table, uint32_t angle, uint32_t c)
{
    const uint32_t values = table->columns * table->parts;
    const double place = (double)angle * (double)table->points / 4294967296.0, index = floor(place);
    const double left = (double)rows[(size_t)index * values + c];
    const double right = (double)rows[((size_t)index + 1) % table->points * values + c];
    return left + (place - index) * (right - left);
}

static double expected_current(const hci_table_f32 *table, uint32_t angle, double torque_Nm, uint32_t c)
{
    if (table->parts == 1) return expected_value(table, angle, c);
    return torque_Nm * expected_value(table, angle, c) + expected_value(table, angle, table->columns + c);
}

static void compare_at(const hci_table_f32 *table, uint32_t angle, double torque_Nm)
{
    /* values up to 10·(1 + T), some ten roundings of 2^-24 */
    const double tolerance = 10.0 * (1.0 + fabs(torque_Nm)) * 10.0 / 16777216.0;
    double sum = 0.0;
    float current[3];
    hci_table_f32_currents(table, angle, (float)torque_Nm, current);
    for (uint32_t c = 0; c < table->columns; ++c) {
        sum += expected_current(table, angle, torque_Nm, c);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected_current(table, angle, torque_Nm, c),
                                  (double)current[c]);
    }
    if (table->columns == 3) return;
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * tolerance, table->frame == HCI_TABLE_ABC ? -sum : 0.0,
                              (double)current[2]);
}

static void every_shape_at(uint64_t *seed, uint32_t points)
{
    static const uint32_t corner[] = {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFF00u, 0xFFFFFFFFu};
    for (uint32_t shape = 0; shape < 6; ++shape) {
        const uint32_t columns = shape % 3 == 1 ? 3 : 2;
        hci_table_f32 table = random_table(seed, points, columns, shape < 3 ? 1 : 2);
        table.frame = shape % 3 == 2 ? HCI_TABLE_DQ : HCI_TABLE_ABC;
        for (size_t k = 0; k < sizeof corner / sizeof *corner; ++k)
            compare_at(&table, corner[k], 0.75);
        for (int k = 0; k < 500; ++k)
            compare_at(&table, (uint32_t)ref_uniform(seed, 0.0, 4294967296.0), (double)(k % 5 - 2));
    }
}

static void test_interpolates_with_any_number_of_points(void)
{
    static const uint32_t points[] = {1, 2, 3, 7, 64, 360, 1000};
    uint64_t seed = 1;
    for (size_t k = 0; k < sizeof points / sizeof *points; ++k)
        every_shape_at(&seed, points[k]);
}

/* At the angle of a row there is nothing to interpolate: the row itself comes out, to the bit. */
static void test_row_angles_give_rows(void)
{
    uint64_t seed = 2;
    const hci_table_f32 table = random_table(&seed, 256, 3, 1);
    for (uint32_t k = 0; k < 256; ++k) {
        const hci_currents_abc i = hci_table_f32_abc(&table, k << 24);
        TEST_ASSERT_EQUAL_MEMORY(&rows[3 * k], &i, sizeof i);
    }
}

static double turn_distance(uint32_t angle, double turns)
{
    const double error = (double)angle / 4294967296.0 - turns;
    return fabs(error - floor(error + 0.5));
}

static void test_radians(void)
{
    uint64_t seed = 3;
    for (int k = 0; k < 20000; ++k) {
        const float theta = (float)(ref_uniform(&seed, -1.0, 1.0) * pow(10.0, ref_uniform(&seed, -6.0, 5.0)));
        const double turns = (double)theta / (2.0 * REF_PI);
        /* product and constant are each rounded to 2^-24, the result to 2^-31 of a turn */
        const double tolerance = 2.0 * fabs(turns) / 16777216.0 + 2.0 / 4294967296.0;
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.0, turn_distance(hci_angle_from_rad(theta), turns));
    }
    TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_rad(0.0f));
    TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_rad(INFINITY));
    TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_rad(-INFINITY));
    TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_rad(NAN));
    TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_rad(3e38f));
}

/* Exact remainder in 64 bits: counts mod counts_per_turn over counts_per_turn. */
static void test_counts(void)
{
    static const uint32_t per_turn[] = {1, 3, 1000, 4096, 10000, 65536, 1000003, 4294967295u};
    uint64_t seed = 4;
    for (size_t k = 0; k < sizeof per_turn / sizeof *per_turn; ++k) {
        const int64_t n = per_turn[k];
        const uint64_t scale = hci_angle_scale(per_turn[k]);
        for (int j = 0; j < 2000; ++j) {
            const int32_t counts = (int32_t)ref_uniform(&seed, -2147483648.0, 2147483648.0);
            const double turns = (double)(((int64_t)counts % n + n) % n) / (double)n;
            /* truncation to 2^-32, and counts·2^-64 from the rounded scale */
            TEST_ASSERT_DOUBLE_WITHIN(2.0 / 4294967296.0, 0.0,
                                      turn_distance(hci_angle_from_counts(counts, scale), turns));
        }
        TEST_ASSERT_EQUAL_UINT32(0u, hci_angle_from_counts(0, scale));
    }
    TEST_ASSERT_EQUAL_UINT32(0x40000000u, hci_angle_from_counts(1024, hci_angle_scale(4096)));
    TEST_ASSERT_EQUAL_UINT32(0xC0000000u, hci_angle_from_counts(-1024, hci_angle_scale(4096)));
}

static void test_mechanical_angle_wraps(void)
{
    TEST_ASSERT_EQUAL_UINT32(0x80000000u, hci_angle_from_mechanical(0x20000000u, 4));
    TEST_ASSERT_EQUAL_UINT32(0x40000000u, hci_angle_from_mechanical(0x90000000u, 4));
    TEST_ASSERT_EQUAL_UINT32(0xFFFFFFF9u, hci_angle_from_mechanical(0xFFFFFFFFu, 7));
}

/* ---- check ---- */

static const uint32_t KNOWN_CRC = 0x3322CA60u, KNOWN_SUM = 0x0B813743u;
static const float known_rows[] = {0.0f, 1.5f, -2.25f, 1e-7f, 0.0f, 1.5f};
static const hci_table_f32_probe known_probes[] = {
    {0x00000000u, 0.0f, {0.0f, 1.5f, -1.5f}},
    {0x40000000u, 0.0f, {-1.125f, 0.75f, 0.375f}},
};

static hci_table_f32 known_table(void)
{
    hci_table_f32 table = {0};
    table.rows = known_rows;
    table.probes = known_probes;
    table.probe_count = 2;
    table.points = 2;
    table.columns = 2;
    table.parts = 1;
    table.sum32 = KNOWN_SUM;
    table.max_error_A = 1e-6f;
    return table;
}

/* Of 1 to 4 bytes, bit by bit with the reversed polynomial of IEEE 802.3. */
static void test_crc_of_some_bytes(void)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (uint32_t k = 1; k < 200; ++k) {
        const int bytes = (int)(k % 4u) + 1;
        const uint32_t bits = (k * 2654435769u) & (0xFFFFFFFFu >> (32 - 8 * bytes));
        uint32_t slow = crc ^ bits;
        for (int b = 0; b < 8 * bytes; ++b)
            slow = (slow >> 1) ^ (slow & 1u ? 0xEDB88320u : 0u);
        TEST_ASSERT_EQUAL_HEX32(slow, hci_table_crc32_bytes(crc, bits, bytes));
        if (bytes == 4) TEST_ASSERT_EQUAL_HEX32(slow, hci_table_crc32_word(crc, bits));
        crc = slow;
    }
}

/* The figure is zlib.crc32 of the six values as little-endian single precision. */
static void test_crc_is_that_of_zlib(void)
{
    const hci_table_f32 table = known_table();
    TEST_ASSERT_EQUAL_HEX32(KNOWN_CRC, hci_table_f32_crc32(&table));
}

/* The figure is s = s·(2654435761 + 2·6) + bits, s ^= s >> 15 in whole numbers modulo 2^32, from 2166136261
 * on, made with Python. */
static void test_sum_is_that_of_its_formula(void)
{
    const hci_table_f32 table = known_table();
    TEST_ASSERT_EQUAL_HEX32(KNOWN_SUM, hci_table_f32_sum32(&table));
}

static void test_check_passes_a_good_table(void)
{
    const hci_table_f32 table = known_table();
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_table_f32_check(&table));
}

static void flip(unsigned char *bytes, size_t bit)
{
    bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
}

/* One, and any two: two signs are where a sum of words is weakest. */
static void test_check_sees_every_one_and_two_flipped_bits(void)
{
    float damaged[6];
    hci_table_f32 table = known_table();
    table.rows = damaged;
    for (size_t one = 0; one < 8 * sizeof damaged; ++one)
        for (size_t other = one; other < 8 * sizeof damaged; ++other) {
            unsigned char bytes[sizeof damaged];
            memcpy(bytes, known_rows, sizeof bytes);
            flip(bytes, one);
            if (other != one) flip(bytes, other);
            memcpy(damaged, bytes, sizeof bytes);
            TEST_ASSERT_EQUAL(HCI_TABLE_BAD_CRC, hci_table_f32_check(&table));
        }
}

static void check_probe(size_t k, size_t s, float offset, hci_table_verdict verdict)
{
    hci_table_f32_probe probes[2];
    hci_table_f32 table = known_table();
    memcpy(probes, known_probes, sizeof probes);
    probes[k].expected[s] += offset;
    table.probes = probes;
    TEST_ASSERT_EQUAL(verdict, hci_table_f32_check(&table));
}

static void test_check_compares_every_probe(void)
{
    for (size_t k = 0; k < 2; ++k) {
        for (size_t s = 0; s < 3; ++s) {
            check_probe(k, s, 5e-7f, HCI_TABLE_GOOD);
            check_probe(k, s, 1e-5f, HCI_TABLE_BAD_PROBE);
            check_probe(k, s, -1e-5f, HCI_TABLE_BAD_PROBE);
            check_probe(k, s, NAN, HCI_TABLE_BAD_PROBE);
        }
    }
}

static void test_check_refuses_wrong_shapes(void)
{
    hci_table_f32 table[6];
    for (size_t k = 0; k < 6; ++k)
        table[k] = known_table();
    table[0].points = 0;
    table[1].columns = 1;
    table[2].columns = 4;
    table[3].frame = HCI_TABLE_DQ;
    table[3].columns = 3;
    table[4].parts = 0;
    table[5].parts = 3;
    for (size_t k = 0; k < 6; ++k)
        TEST_ASSERT_EQUAL(HCI_TABLE_BAD_SHAPE, hci_table_f32_check(&table[k]));
}

/* Currents beyond the reference torque were not asked for, and what is no number is no torque. */
static void test_torque_is_limited(void)
{
    uint64_t seed = 9;
    for (int frame = HCI_TABLE_ABC; frame <= HCI_TABLE_DQ; ++frame) {
        hci_table_f32 table = random_table(&seed, 7, 2, 2);
        static const float asked[] = {2.5f, 1e30f, INFINITY, -2.5f, -INFINITY, NAN};
        static const float taken[] = {2.0f, 2.0f, 2.0f, -2.0f, -2.0f, 0.0f};
        table.frame = (hci_table_frame)frame;
        for (size_t k = 0; k < sizeof asked / sizeof *asked; ++k) {
            float found[3], expected[3];
            hci_table_f32_currents(&table, 0x33333333u, asked[k], found);
            hci_table_f32_currents(&table, 0x33333333u, taken[k], expected);
            TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected, found, 3);
        }
    }
}

/* The check value of CRC-32 (ISO-HDLC). */
static void test_crc_is_that_of_the_standard(void)
{
    uint32_t by_nibbles = 0xFFFFFFFFu, by_words = 0xFFFFFFFFu;
    for (const char *c = "123456789"; *c; ++c)
        by_nibbles = hci_table_crc32_next(by_nibbles, (uint32_t)(unsigned char)*c, 2);
    by_words = hci_table_crc32_next(by_words, 0x34333231u, 8);
    by_words = hci_table_crc32_next(by_words, 0x38373635u, 8);
    by_words = hci_table_crc32_next(by_words, 0x39u, 2);
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, ~by_nibbles);
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, ~by_words);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_is_limited);
    RUN_TEST(test_interpolates_with_any_number_of_points);
    RUN_TEST(test_row_angles_give_rows);
    RUN_TEST(test_radians);
    RUN_TEST(test_counts);
    RUN_TEST(test_mechanical_angle_wraps);
    RUN_TEST(test_crc_of_some_bytes);
    RUN_TEST(test_crc_is_that_of_zlib);
    RUN_TEST(test_check_passes_a_good_table);
    RUN_TEST(test_check_sees_every_one_and_two_flipped_bits);
    RUN_TEST(test_sum_is_that_of_its_formula);
    RUN_TEST(test_check_compares_every_probe);
    RUN_TEST(test_check_refuses_wrong_shapes);
    RUN_TEST(test_crc_is_that_of_the_standard);
    return UNITY_END();
}
