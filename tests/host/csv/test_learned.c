/* What a device has learnt, byte by byte as hci/learn.h says, read as a recording: its Fourier sums are those
 * of the bytes, its noise is as large as makes the standard errors, and what is no such file is refused. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "support/reference.h"
#include "support/texts.h"
#include "unity.h"

enum { HEAD = 44, EACH = 24, MOST = 400, ROWS = 4000 };

static unsigned char blob[MOST];
static size_t size;
static hci_csv *csv;
static hci_note note;
static double theta[ROWS], speed[ROWS], current[ROWS], torque[ROWS];

void setUp(void)
{
    files_begin();
    memset(blob, 0, sizeof blob);
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_csv_free(csv);
    csv = NULL;
    files_end();
}

/* ---- the bytes ---- */

static void put(size_t at, uint32_t value, int bytes)
{
    for (int k = 0; k < bytes; ++k)
        blob[at + (size_t)k] = (unsigned char)(value >> 8 * k);
}

static void put_real(size_t at, double value)
{
    const float single = (float)value;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    put(at, bits, 4);
}

static void close_blob(void)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t k = 0; k < 8 * (size - 4); ++k) {
        const uint32_t bit = (crc ^ (uint32_t)blob[k / 8] >> k % 8) & 1u;
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0u);
    }
    put(size - 4, ~crc, 4);
}

typedef struct {
    uint32_t order;
    double forward[2], backward[2], error; /* cosine, sine */
} sums;

typedef struct {
    uint32_t turns[2], unit;
    double speed, mean[2];
    const sums *of;
    uint32_t orders;
} learnt;

static void write_blob(const learnt *x)
{
    size = HEAD + EACH * x->orders + 4;
    memcpy(blob, "HCIL", 4);
    put(4, 1, 2);
    put(6, x->orders, 2);
    put(8, (uint32_t)size, 4);
    put(12, 3, 4);
    put(16, 7, 2);
    put(18, x->unit, 2);
    put(20, x->turns[0], 4);
    put(24, x->turns[1], 4);
    put_real(28, x->speed);
    put_real(32, x->mean[0]);
    put_real(36, x->mean[1]);
    put_real(40, 0.001);
    for (uint32_t k = 0; k < x->orders; ++k) {
        const size_t at = HEAD + EACH * k;
        put(at, x->of[k].order, 4);
        for (size_t j = 0; j < 2; ++j) {
            put_real(at + 4 + 4 * j, x->of[k].forward[j]);
            put_real(at + 12 + 4 * j, x->of[k].backward[j]);
        }
        put_real(at + 20, x->of[k].error);
    }
    close_blob();
}

static hci_status read_blob(size_t bytes)
{
    FILE *file = fopen(files_path("learnt.hcil"), "wb");
    TEST_ASSERT_TRUE(file && fwrite(blob, 1, bytes, file) == bytes && fclose(file) == 0);
    hci_csv_free(csv);
    csv = NULL;
    memset(&note, 0, sizeof note);
    return hci_csv_read(files_path("learnt.hcil"), &csv, &note);
}

/* ---- the recording ---- */

static void take(size_t rows)
{
    TEST_ASSERT_EQUAL_UINT64(rows, hci_csv_rows(csv));
    TEST_ASSERT_TRUE(rows <= ROWS);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "theta_m_rad", theta, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "speed_rad_per_s", speed, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "iq_A", current, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_Nm", torque, &note));
}

/* A turn of samples from a row on: cosine and sine of an order. */
static void transform(const double *y, size_t first, size_t samples, double order, double out[2])
{
    out[0] = out[1] = 0.0;
    for (size_t k = first; k < first + samples; ++k) {
        out[0] += (order > 0.0 ? 2.0 : 1.0) / (double)samples * y[k] * cos(order * theta[k]);
        out[1] += (order > 0.0 ? 2.0 : 1.0) / (double)samples * y[k] * sin(order * theta[k]);
    }
}

/* Mean square of what is left when all that was learnt is taken out. */
static double noise_of(const double *y, size_t first, size_t samples, const learnt *x, int back, double sign)
{
    double square = 0.0;
    for (size_t k = first; k < first + samples; ++k) {
        double left = sign * y[k] - x->mean[back];
        for (uint32_t j = 0; j < x->orders; ++j) {
            const double *of = back ? x->of[j].backward : x->of[j].forward;
            left -= of[0] * cos(x->of[j].order * theta[k]) + of[1] * sin(x->of[j].order * theta[k]);
        }
        square += left * left / (double)samples;
    }
    return square;
}

static void check_turn(const learnt *x, size_t first, size_t samples, int back)
{
    const bool is_torque = x->unit == 1;
    const double *y = is_torque ? torque : current, *other = is_torque ? current : torque,
                 sign = is_torque ? -1.0 : 1.0;
    double square = 0.0, sum[2];
    for (size_t k = 0; k < samples; ++k) {
        const double at = back ? (double)(samples - 1 - k) : (double)k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 2.0 * REF_PI * at / (double)samples, theta[first + k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, back ? -x->speed : x->speed, speed[first + k]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, other[first + k]);
    }
    transform(y, first, samples, 0.0, sum);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sign * x->mean[back], sum[0]);
    for (uint32_t j = 0; j < x->orders; ++j) {
        const double *of = back ? x->of[j].backward : x->of[j].forward;
        transform(y, first, samples, x->of[j].order, sum);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, sign * of[0], sum[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, sign * of[1], sum[1]);
        if (x->of[j].error > 0.0) square += x->of[j].error * x->of[j].error / x->orders;
    }
    /* white noise of σ² a sample gives a coordinate σ²·2/samples in one turn, σ²/samples in two */
    const double expected = square * (double)samples;
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * expected + 1e-13, expected, noise_of(y, first, samples, x, back, sign));
}

static const sums THREE[] = {{1, {0.5, -0.25}, {0.4, -0.2}, 0.002},
                             {12, {1.5, 0.75}, {1.25, 1.0}, 0.004},
                             {84, {-0.125, 0.5}, {0.0, 0.5}, 0.003}};

static void test_both_directions(void)
{
    const learnt x = {{3, 4}, 0, 0.5, {0.3, -0.2}, THREE, 3};
    write_blob(&x);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_blob(size), note.text);
    TEST_ASSERT_EQUAL_INT(7, hci_csv_learned_pole_pairs(csv));
    take(2 * 16 * 84); /* sixteen in a period of the highest order */
    check_turn(&x, 0, 16 * 84, 0);
    check_turn(&x, 16 * 84, 16 * 84, 1);
}

/* At least 720 samples; an error that is not known adds no noise; without a speed a slow one. */
static void test_few_orders(void)
{
    static const sums FEW[] = {{1, {0.5, -0.25}, {0.4, -0.2}, -1.0}, {45, {1.0, 0.0}, {1.0, 0.0}, -1.0}};
    const learnt x = {{1, 1}, 0, 0.1, {0.0, 0.0}, FEW, 2};
    write_blob(&x);
    put_real(28, 0.0);
    close_blob();
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_blob(size), note.text);
    take(2 * 720);
    check_turn(&x, 0, 720, 0);
    check_turn(&x, 720, 720, 1);
}

/* The torque that holds the shaft is against that of the machine. */
static void test_one_direction_of_a_torque(void)
{
    for (uint32_t back = 0; back < 2; ++back) {
        const learnt x = {{back ? 0 : 2, back ? 2 : 0}, 1, 0.5, {0.3, -0.2}, THREE, 2};
        write_blob(&x);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_blob(size), note.text);
        take(720);
        check_turn(&x, 0, 720, (int)back);
    }
}

static void test_refusals(void)
{
    const learnt x = {{3, 4}, 0, 0.5, {0.3, -0.2}, THREE, 3};
    write_blob(&x);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_blob(size - 1));
    text_has("learnt.hcil: found the beginning of what a device has learnt, and not all of it; read it from "
             "the device again",
             note.text);
    blob[60] ^= 1;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_blob(size));
    text_has("found what a device has learnt, damaged: its CRC-32 is another; read it from the device again",
             note.text);
    write_blob(&x);
    put(4, 2, 2);
    close_blob();
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_blob(size));
    text_has("found what a device with a newer hci/learn.h has learnt; use the hci-solve of that version",
             note.text);
    const learnt none = {{0, 0}, 0, 0.5, {0.3, -0.2}, THREE, 3};
    write_blob(&none);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_blob(size));
    text_has("found no whole turn in what the device has learnt; let it turn at least once in each direction",
             note.text);
}

static void test_memory_fails_anywhere(void)
{
    const learnt x = {{3, 4}, 0, 0.5, {0.3, -0.2}, THREE, 3};
    hci_status status = HCI_ERROR_MEMORY;
    write_blob(&x);
    for (int calls = 0; status && calls < 1000; ++calls) {
        hci_memory_fail_after(calls);
        status = read_blob(size);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_both_directions);
    RUN_TEST(test_few_orders);
    RUN_TEST(test_one_direction_of_a_torque);
    RUN_TEST(test_refusals);
    RUN_TEST(test_memory_fails_anywhere);
    return UNITY_END();
}
