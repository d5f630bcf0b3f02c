/* Orders for a drive as bytes: what the head of hci/loop_blob.h says stands where, and all of it read back.
 */
#include <stdio.h>
#include <string.h>

#include "hci/loop_blob.h"
#include "host/emit/blob_loop.h"
#include "support/written.h"
#include "unity.h"

enum { ORDERS = 5, LEVELS = 3, RESPONSES = 4, MOST = 4096 };

static uint32_t words[MOST / 4]; /* so that it begins at a multiple of four */
static uint32_t size;

static hci_loop_wave wave[ORDERS * LEVELS];
static hci_loop_range range[ORDERS];
static hci_loop_response response[RESPONSES];
static uint16_t order[ORDERS];
static hci_loop_f32 loop;
static hci_emit_loop_request request;

/* Every number another one. */
static float next(void)
{
    static float value = 0.5f;
    return value += 0.25f;
}

static void fill_arrays(void)
{
    for (int k = 0; k < ORDERS * LEVELS; ++k)
        for (int a = 0; a < 2; ++a) {
            wave[k].current_A[a] = (hci_loop_pair){next(), next()};
            wave[k].voltage_Vs[a] = (hci_loop_pair){next(), next()};
            wave[k].own_Vs[a] = (hci_loop_pair){next(), next()};
        }
    for (int k = 0; k < ORDERS; ++k) {
        range[k] = (hci_loop_range){next(), next()};
        order[k] = (uint16_t)(300 * k);
    }
    for (int k = 0; k < RESPONSES; ++k)
        response[k] = (hci_loop_response){next(), {next(), next()}, {next(), next()}};
}

void setUp(void)
{
    files_begin();
    fill_arrays();
    loop = (hci_loop_f32){.waves = wave,
                          .orders = order,
                          .ranges = range,
                          .responses = response,
                          .order_count = ORDERS,
                          .response_count = RESPONSES,
                          .levels = LEVELS,
                          .points = 48,
                          .repeats = 6,
                          .period_turns = 4,
                          .base_order = 1.5f,
                          .torque_low_Nm = -2.5f,
                          .torque_high_Nm = next(),
                          .resistance_ohm = next(),
                          .inductance_H = {next(), next()},
                          .proportional_ohm = {next(), next()},
                          .integral_ohm_per_s = {next(), next()},
                          .filter = 0.125f,
                          .sample_s = next(),
                          .delay_s = next(),
                          .whole_rad_per_s = next(),
                          .lead_s = next()};
    loop.crc32 = hci_loop_crc32(&loop);
    memset(&request, 0, sizeof request);
    request.input_hash = 0x0123456789ABCDEFu;
    request.facts.pole_pairs = 7;
    snprintf(request.facts.machine, sizeof request.facts.machine, "motor seven");
}

void tearDown(void)
{
    files_end();
}

static void emit(void)
{
    hci_output *out = written_begin("loop.bin");
    hci_note note = {{0}};
    hci_emit_loop_blob(&loop, &request, out);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_commit(out, &note), note.text);
    FILE *file = fopen(files_path("loop.bin"), "rb");
    TEST_ASSERT_NOT_NULL(file);
    size = (uint32_t)fread(words, 1, MOST, file);
    fclose(file);
}

static void check_read(void)
{
    hci_loop_f32 read;
    hci_blob_facts facts;
    TEST_ASSERT_EQUAL_INT(HCI_BLOB_GOOD, hci_loop_blob_read(words, size, &read, &facts));
    TEST_ASSERT_EQUAL_MEMORY(wave, read.waves, sizeof *wave * loop.order_count * LEVELS);
    TEST_ASSERT_EQUAL_MEMORY(range, read.ranges, sizeof *range * loop.order_count);
    TEST_ASSERT_EQUAL_MEMORY(order, read.orders, sizeof *order * loop.order_count);
    TEST_ASSERT_EQUAL_MEMORY(response, read.responses, sizeof response);
    read.waves = loop.waves;
    read.ranges = loop.ranges;
    read.orders = loop.orders;
    read.responses = loop.responses;
    TEST_ASSERT_EQUAL_UINT32(loop.order_count, read.order_count);
    TEST_ASSERT_EQUAL_UINT32(RESPONSES, read.response_count);
    TEST_ASSERT_EQUAL_UINT32(LEVELS, read.levels);
    TEST_ASSERT_EQUAL_UINT32(48, read.points);
    TEST_ASSERT_EQUAL_UINT32(6, read.repeats);
    TEST_ASSERT_EQUAL_UINT32(4, read.period_turns);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, read.base_order);
    TEST_ASSERT_EQUAL_MEMORY(&loop.torque_low_Nm, &read.torque_low_Nm, sizeof(float));
    TEST_ASSERT_EQUAL_FLOAT(loop.torque_high_Nm, read.torque_high_Nm);
    TEST_ASSERT_EQUAL_FLOAT(loop.resistance_ohm, read.resistance_ohm);
    for (int a = 0; a < 2; ++a) {
        TEST_ASSERT_EQUAL_FLOAT(loop.inductance_H[a], read.inductance_H[a]);
        TEST_ASSERT_EQUAL_FLOAT(loop.proportional_ohm[a], read.proportional_ohm[a]);
        TEST_ASSERT_EQUAL_FLOAT(loop.integral_ohm_per_s[a], read.integral_ohm_per_s[a]);
    }
    TEST_ASSERT_EQUAL_FLOAT(loop.filter, read.filter);
    TEST_ASSERT_EQUAL_FLOAT(loop.sample_s, read.sample_s);
    TEST_ASSERT_EQUAL_FLOAT(loop.delay_s, read.delay_s);
    TEST_ASSERT_EQUAL_FLOAT(loop.whole_rad_per_s, read.whole_rad_per_s);
    TEST_ASSERT_EQUAL_FLOAT(loop.lead_s, read.lead_s);
    TEST_ASSERT_EQUAL_STRING("motor seven", facts.machine);
    TEST_ASSERT_EQUAL_UINT32(7, facts.pole_pairs);
    TEST_ASSERT_EQUAL_HEX32(0x89ABCDEFu, facts.input_low);
    TEST_ASSERT_EQUAL_HEX32(0x01234567u, facts.input_high);
}

/* With an odd number of orders, which two bytes fill up, and an even one. */
static void test_what_is_read_back(void)
{
    emit();
    check_read();
    loop.order_count = ORDERS - 1;
    loop.crc32 = hci_loop_crc32(&loop);
    emit();
    check_read();
}

/* Low bytes first, at the places that the head of the header names. */
static void test_bytes(void)
{
    const unsigned char *byte = (const unsigned char *)words;
    float value;
    emit();
    TEST_ASSERT_EQUAL_UINT32(128 + 15 * 48 + 5 * 8 + 4 * 20 + 12 + 12 + 4, size);
    TEST_ASSERT_EQUAL_MEMORY("HCIT", byte, 4);
    TEST_ASSERT_EQUAL_UINT8(size & 255u, byte[8]);
    TEST_ASSERT_EQUAL_UINT8(size >> 8, byte[9]);
    TEST_ASSERT_EQUAL_UINT8(7, byte[20]);
    TEST_ASSERT_EQUAL_UINT8(ORDERS, byte[24]);
    TEST_ASSERT_EQUAL_UINT8(RESPONSES, byte[28]);
    TEST_ASSERT_EQUAL_UINT8(LEVELS, byte[32]);
    memcpy(&value, byte + 48, sizeof value);
    TEST_ASSERT_EQUAL_FLOAT(-2.5f, value);
    memcpy(&value, byte + 88, sizeof value);
    TEST_ASSERT_EQUAL_FLOAT(loop.lead_s, value);
    TEST_ASSERT_EQUAL_STRING("motor seven", (const char *)byte + 92);
    TEST_ASSERT_EQUAL_UINT8(300 & 255, byte[128 + 15 * 48 + 5 * 8 + 4 * 20 + 2]); /* the second order */
    TEST_ASSERT_EQUAL_UINT8(300 >> 8, byte[128 + 15 * 48 + 5 * 8 + 4 * 20 + 3]);
}

/* A bit that falls over, anywhere, and an end that is missing. */
static void test_what_is_damaged_is_refused(void)
{
    hci_loop_f32 read;
    emit();
    for (uint32_t bit = 0; bit < 8u * size; bit += 7) {
        ((unsigned char *)words)[bit / 8] ^= (unsigned char)(1u << bit % 8);
        TEST_ASSERT_TRUE(hci_loop_blob_read(words, size, &read, NULL) != HCI_BLOB_GOOD);
        ((unsigned char *)words)[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    for (uint32_t cut = 0; cut < size; cut += 5)
        TEST_ASSERT_TRUE(hci_loop_blob_read(words, cut, &read, NULL) != HCI_BLOB_GOOD);
    TEST_ASSERT_EQUAL_INT(HCI_BLOB_GOOD, hci_loop_blob_read(words, size, &read, NULL));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_read_back);
    RUN_TEST(test_bytes);
    RUN_TEST(test_what_is_damaged_is_refused);
    return UNITY_END();
}
