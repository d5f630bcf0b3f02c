/* Bytes of a blob are read low byte first on every processor; what is cut off or damaged in a bit is not
 * taken, and nothing is read in place where the processor has another order. */
#include "hci/blob.h"

#include <stdbool.h>
#include <string.h>

#include "unity.h"

enum { SIZE = HCI_BLOB_HEAD + 20 };

static union {
    unsigned char byte[SIZE + 4];
    float whole_words;
} memory;

void setUp(void)
{
    memset(&memory, 0, sizeof memory);
}

void tearDown(void)
{
}

static void put(uint32_t offset, uint32_t value)
{
    for (int k = 0; k < 4; ++k)
        memory.byte[offset + (uint32_t)k] = (unsigned char)(value >> (8 * k));
}

static bool is_low_byte_first(void)
{
    const uint32_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static void test_numbers_are_read_low_byte_first(void)
{
    static const unsigned char bytes[] = {0x99, 0x04, 0x83, 0x02, 0x81, 0x00, 0x00, 0xC0, 0x3F};
    TEST_ASSERT_EQUAL_HEX32(0x8304u, hci_blob_u16(bytes, 1));
    TEST_ASSERT_EQUAL_HEX32(0x81028304u, hci_blob_u32(bytes, 1));
    TEST_ASSERT_EQUAL_FLOAT(1.5f, hci_blob_float(bytes, 5));
    TEST_ASSERT_EQUAL_PTR(bytes + 3, hci_blob_at(bytes, 3));
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, hci_blob_crc32("123456789", 9));
}

static void test_it_is_read_in_place_where_words_allow_it(void)
{
    TEST_ASSERT_EQUAL_INT(is_low_byte_first(), hci_blob_is_in_place(memory.byte));
    for (int k = 1; k < 4; ++k)
        TEST_ASSERT_EQUAL_INT(0, hci_blob_is_in_place(memory.byte + k));
}

static hci_blob_verdict check(uint32_t size)
{
    return hci_blob_check_whole(memory.byte, size, HCI_BLOB_F32);
}

static void make_whole(void)
{
    put(0, 0x54494348u);
    put(4, (uint32_t)HCI_BLOB_VERSION | ((uint32_t)HCI_BLOB_F32 << 16));
    put(8, SIZE);
    put(SIZE - 4, hci_blob_crc32(memory.byte, SIZE - 4));
}

static void test_what_is_cut_off_or_damaged_is_not_taken(void)
{
    make_whole();
    TEST_ASSERT_EQUAL_INT(is_low_byte_first() ? HCI_BLOB_GOOD : HCI_BLOB_NONE, check(SIZE));
    TEST_ASSERT_EQUAL_INT(is_low_byte_first() ? HCI_BLOB_GOOD : HCI_BLOB_NONE, check(SIZE + 4));
    for (uint32_t size = 0; size < SIZE; ++size)
        TEST_ASSERT_TRUE(check(size) != HCI_BLOB_GOOD);
    for (uint32_t bit = 0; bit < 8 * SIZE; ++bit) {
        memory.byte[bit / 8] ^= (unsigned char)(1u << bit % 8);
        TEST_ASSERT_TRUE(check(SIZE) != HCI_BLOB_GOOD);
        memory.byte[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
}

static void test_another_kind_and_a_newer_version_are_told(void)
{
    make_whole();
    if (!is_low_byte_first()) TEST_IGNORE_MESSAGE("blobs are not read here");
    TEST_ASSERT_EQUAL_INT(HCI_BLOB_OTHER_KIND, hci_blob_check_whole(memory.byte, SIZE, HCI_BLOB_I16));
    put(4, ((uint32_t)HCI_BLOB_VERSION + 1u) | ((uint32_t)HCI_BLOB_F32 << 16));
    TEST_ASSERT_EQUAL_INT(HCI_BLOB_NEWER, check(SIZE));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers_are_read_low_byte_first);
    RUN_TEST(test_it_is_read_in_place_where_words_allow_it);
    RUN_TEST(test_what_is_cut_off_or_damaged_is_not_taken);
    RUN_TEST(test_another_kind_and_a_newer_version_are_told);
    return UNITY_END();
}
