/* The flash of an OpenFFBoard byte by byte, and what of a map its numbers can hold. */
#include "host/foreign/openffboard.c"

#include "unity.h"

static hci_foreign_map map;

void setUp(void)
{
    memset(&map, 0, sizeof map);
    map.counts_per_A = 400.0;
    map.term[0] = (hci_foreign_term){.order = 6.0, .amplitude = 0.1, .phase_rad = 7.0};
    map.term[1] = (hci_foreign_term){.order = 300.0, .amplitude = 0.25, .phase_rad = -0.5};
    map.terms = 2;
}

void tearDown(void)
{
}

/* Amplitudes are floats of counts, phases floats within ±π; of the first term as of the last. */
static void test_what_the_numbers_hold(void)
{
    fit(&map);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 / 400.0, map.unit);
    TEST_ASSERT_EQUAL_DOUBLE((double)(float)(0.1 * 400.0) / 400.0, map.term[0].amplitude);
    TEST_ASSERT_EQUAL_DOUBLE((double)(float)(7.0 - 2.0 * HCI_PI), map.term[0].phase_rad);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, map.term[1].amplitude);
    TEST_ASSERT_EQUAL_DOUBLE(-0.5, map.term[1].phase_rad);
    map.term[1] = (hci_foreign_term){.order = 300.0, .amplitude = 0.1, .phase_rad = 7.0};
    map.terms = 1; /* what is behind the terms stays as it is */
    fit(&map);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, map.term[1].amplitude);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, map.term[1].phase_rad);
}

/* 100 counts are 0x42C80000, −0.5 is 0xBF000000, 300 is 0x012C, the lowest byte first; all else is 0. */
static void test_the_image(void)
{
    static const uint8_t SECOND[TERM_BYTES] = {0x00, 0x00, 0xC8, 0x42, 0x00, 0x00,
                                               0x00, 0xBF, 0x2C, 0x01, 0,    0};
    uint8_t bytes[BYTES];
    memset(bytes, 0x5a, sizeof bytes);
    image(&map, bytes);
    TEST_ASSERT_EQUAL_UINT8(6, bytes[8]);
    TEST_ASSERT_EQUAL_UINT8(0, bytes[9]);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(SECOND, bytes + TERM_BYTES, TERM_BYTES);
    for (size_t k = 2 * TERM_BYTES; k < BYTES; ++k)
        TEST_ASSERT_EQUAL_UINT8(0, bytes[k]);
}

/* Whole counts toward 0 are added, and the sum of both is cut to ±32767 of them. */
static void test_what_is_added(void)
{
    double add[2] = {9.0, 9.0};
    map.terms = 0;
    at(&map, 0.0, 1.0, add);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, add[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, add[1]);
    for (int sign = -1; sign <= 1; sign += 2) {
        at(&map, 0.0, sign * 100.0, add);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign * (32767.0 / 400.0 - 100.0), add[1]);
    }
}

/* Whole ones that two bytes hold. */
static void test_orders_that_are_read(void)
{
    static const char *const TERM[] = {"1:40.5:0.5\n",     "65535:40.5:0.5\n", "65536:40.5:0.5\n",
                                       "98000:40.5:0.5\n", "0:40.5:0.5\n",     "6.5:40.5:0.5\n"};
    for (size_t k = 0; k < 6; ++k) {
        hci_note note = {{0}};
        map.terms = 0;
        TEST_ASSERT_EQUAL(k < 2 ? HCI_OK : HCI_ERROR_INPUT, read("map", TERM[k], &map, &note));
        TEST_ASSERT_EQUAL_UINT64(k < 2, map.terms);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_the_numbers_hold);
    RUN_TEST(test_the_image);
    RUN_TEST(test_what_is_added);
    RUN_TEST(test_orders_that_are_read);
    return UNITY_END();
}
