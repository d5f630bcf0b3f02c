/* Blobs byte by byte: what the head of hci/blob.h says stands where, the CRC-32 bit by bit, and the table
 * that is read from them in place against the waves by their sine formula. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/blob.h"
#include "hci/host/emit/emit.h"
#include "support/current_waves.h"
#include "support/files.h"
#include "unity.h"

enum { HEAD = 128, MOST_SIZE = 65536 };

static uint32_t words[MOST_SIZE / 4]; /* so that it begins at a multiple of four */
static unsigned char *const blob = (unsigned char *)words;
static size_t size;
static hci_emit_request request;
static currents waves, part;

void setUp(void)
{
    files_begin();
    waves = injected();
    part = cogging_part();
    request = (hci_emit_request){.name = "table",
                                 .currents = waves.wave,
                                 .current_count = waves.count,
                                 .max_error_A = 0.05,
                                 .blob = true,
                                 .input_hash = 0x0123456789ABCDEFu};
    snprintf(request.facts.machine, sizeof request.facts.machine, "motor seven");
    request.facts.pole_pairs = 7;
    request.facts.mean_torque_Nm = 2.5;
}

void tearDown(void)
{
    files_end();
}

static void emit(hci_emit_format format, hci_table_frame frame, bool per_torque)
{
    hci_note note = {{0}};
    request.format = format;
    request.frame = frame;
    if (per_torque) {
        request.per_Nm = waves.wave;
        request.per_Nm_count = waves.count;
        request.currents = part.wave;
        request.current_count = part.count;
        request.reference_torque_Nm = 1.5;
    }
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_emit(files_path("."), &request, NULL, &note), note.text);
    FILE *file = fopen(files_path("table.bin"), "rb");
    TEST_ASSERT_NOT_NULL(file);
    size = fread(blob, 1, MOST_SIZE, file);
    fclose(file);
    TEST_ASSERT_TRUE(size > HEAD && size < MOST_SIZE && size % 4 == 0);
}

static uint32_t number(size_t at, int bytes)
{
    uint32_t value = 0;
    for (int k = bytes - 1; k >= 0; --k)
        value = value << 8 | blob[at + (size_t)k];
    return value;
}

static double real(size_t at)
{
    const uint32_t bits = number(at, 4);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* x³² + x²⁶ + … + 1, a bit at a time, low bits first. */
static uint32_t crc_of(size_t count)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t k = 0; k < 8 * count; ++k) {
        const uint32_t bit = (crc ^ (uint32_t)blob[k / 8] >> k % 8) & 1u;
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/* What all kinds have; value_bytes: of a row's or a knot's value. */
static void check_head(int kind, int frame, uint32_t columns, uint32_t parts, double reference_Nm)
{
    TEST_ASSERT_EQUAL_MEMORY("HCIT", blob, 4);
    TEST_ASSERT_EQUAL_UINT32(1, number(4, 2));
    TEST_ASSERT_EQUAL_UINT32(kind, number(6, 2));
    TEST_ASSERT_EQUAL_UINT32(size, number(8, 4));
    TEST_ASSERT_EQUAL_HEX32(0x89ABCDEF, number(12, 4));
    TEST_ASSERT_EQUAL_HEX32(0x01234567, number(16, 4));
    TEST_ASSERT_EQUAL_UINT32(7, number(20, 4));
    TEST_ASSERT_EQUAL_UINT32(frame, number(24, 4));
    TEST_ASSERT_EQUAL_UINT32(columns, number(28, 4));
    TEST_ASSERT_EQUAL_UINT32(parts, number(32, 4));
    TEST_ASSERT_EQUAL_UINT32(1, number(36, 4));
    TEST_ASSERT_EQUAL_DOUBLE(reference_Nm, real(44));
    TEST_ASSERT_TRUE(real(48) > 0.0 && real(48) <= 0.05);
    TEST_ASSERT_EQUAL_DOUBLE(2.5, real(52));
    TEST_ASSERT_EQUAL_UINT32(8, number(60, 4));
    TEST_ASSERT_EQUAL_STRING("motor seven", (const char *)blob + 92);
    for (size_t k = 92 + 11; k < HEAD; ++k)
        TEST_ASSERT_EQUAL_UINT8(0, blob[k]);
    TEST_ASSERT_EQUAL_HEX32(crc_of(size - 4), number(size - 4, 4));
}

/* Currents of both parts at an angle. */
static void expect(hci_table_frame frame, double torque_Nm, double theta_rad, double out[3])
{
    reference_currents(request.per_Nm ? &part : &waves, frame, theta_rad, out);
    double by[3];
    reference_currents(&waves, frame, theta_rad, by);
    for (int k = 0; k < 3 && request.per_Nm; ++k)
        out[k] += torque_Nm * by[k];
}

static void check_currents(hci_table_frame frame, double torque_Nm, const float got[3], uint32_t angle)
{
    double expected[3];
    expect(frame, torque_Nm, 2.0 * REF_PI * angle / 4294967296.0, expected);
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(real(48) + 1e-4, expected[k], (double)got[k]);
}

/* ---- rows of floats ---- */

static void check_rows(hci_table_frame frame, bool per_torque)
{
    hci_table_f32 table;
    hci_blob_facts facts;
    emit(HCI_EMIT_F32, frame, per_torque);
    const uint32_t points = number(56, 4), columns = 2, parts = per_torque ? 2 : 1;
    check_head(1, frame == HCI_TABLE_ABC ? 0 : 1, columns, parts, per_torque ? 1.5 : 0.0);
    TEST_ASSERT_EQUAL_UINT64(HEAD + 4 * (points + 1) * columns * parts + 8 * 20 + 4, size);
    for (size_t k = 68; k < 92; ++k)
        TEST_ASSERT_EQUAL_UINT8(0, blob[k]); /* of knots */
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_blob_table_f32(words, (uint32_t)size, &table, &facts));
    TEST_ASSERT_EQUAL_STRING("motor seven", facts.machine);
    for (uint32_t k = 0; k < 200; ++k) {
        float got[3];
        hci_table_f32_currents(&table, k * 21474836u, 1.25f, got);
        check_currents(frame, 1.25, got, k * 21474836u);
    }
    const size_t probes = size - 4 - 8 * 20;
    for (size_t k = 0; k < 8; ++k) {
        float got[3];
        hci_table_f32_currents(&table, number(probes + 20 * k, 4), (float)real(probes + 20 * k + 4), got);
        for (size_t c = 0; c < 3; ++c)
            TEST_ASSERT_DOUBLE_WITHIN(real(48) + 1e-5, real(probes + 20 * k + 8 + 4 * c), (double)got[c]);
    }
}

static void test_rows(void)
{
    check_rows(HCI_TABLE_ABC, false);
    check_rows(HCI_TABLE_DQ, false);
    check_rows(HCI_TABLE_DQ, true);
}

/* ---- knots of integers ---- */

static void check_knots(hci_emit_format format, hci_emit_shape shape, bool per_torque)
{
    const bool small = format == HCI_EMIT_I8;
    hci_table_i16 table;
    hci_blob_facts facts;
    request.shape = shape;
    request.max_error_A = small ? 0.0 : 0.05;
    request.points = small ? 24 : 0;
    emit(format, HCI_TABLE_DQ, per_torque);
    TEST_ASSERT_EQUAL_UINT32(small ? 3 : 2, number(6, 2));
    const uint32_t degree = number(68, 4), intervals = number(56, 4), parts = per_torque ? 2 : 1;
    const size_t knots = (size_t)(intervals + degree) * 2 * parts * (small ? 1 : 2);
    if (!small) check_head(2, 1, 2, parts, per_torque ? 1.5 : 0.0);
    TEST_ASSERT_EQUAL_UINT32(shape == HCI_EMIT_LINEAR ? 1 : shape == HCI_EMIT_QUADRATIC ? 2 : 3, degree);
    TEST_ASSERT_EQUAL_UINT64(HEAD + (knots + 3) / 4 * 4 + 8 * 12 + 4, size);
    for (size_t k = knots; k % 4 != 0; ++k)
        TEST_ASSERT_EQUAL_UINT8(0, blob[HEAD + k]); /* filled up */
    TEST_ASSERT_TRUE(real(84) > 0.0);
    TEST_ASSERT_EQUAL(HCI_BLOB_GOOD, hci_blob_table_i16(words, (uint32_t)size, &table, &facts));
    TEST_ASSERT_EQUAL_UINT32(small ? 8 : 16, table.knot_bits);
    TEST_ASSERT_EQUAL_UINT32(7, facts.pole_pairs);
    for (uint32_t k = 0; k < 200 && !small; ++k) {
        const hci_currents_dq i = per_torque ? hci_table_i16_dq_torque(&table, k * 21474836u, 1.25f)
                                             : hci_table_i16_dq(&table, k * 21474836u);
        const float got[3] = {i.id_A, i.iq_A, 0.0f};
        check_currents(HCI_TABLE_DQ, 1.25, got, k * 21474836u);
    }
}

static void test_knots(void)
{
    check_knots(HCI_EMIT_I16, HCI_EMIT_LINEAR, false);
    check_knots(HCI_EMIT_I16, HCI_EMIT_CUBIC, false);
    check_knots(HCI_EMIT_Q15, HCI_EMIT_QUADRATIC, false);
    check_knots(HCI_EMIT_I8, HCI_EMIT_QUADRATIC, false);
    check_knots(HCI_EMIT_I16, HCI_EMIT_QUADRATIC, true);
}

/* 35 bytes of a name, and the zero behind them. */
static void test_a_long_name(void)
{
    snprintf(request.facts.machine, sizeof request.facts.machine, "%s",
             "a motor with a name of more than forty letters");
    request.facts.pole_pairs = 0;
    emit(HCI_EMIT_F32, HCI_TABLE_ABC, false);
    TEST_ASSERT_EQUAL_STRING("a motor with a name of more than fo", (const char *)blob + 92);
    TEST_ASSERT_EQUAL_UINT8(0, blob[HEAD - 1]);
    TEST_ASSERT_EQUAL_UINT32(0, number(20, 4));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows);
    RUN_TEST(test_knots);
    RUN_TEST(test_a_long_name);
    return UNITY_END();
}
