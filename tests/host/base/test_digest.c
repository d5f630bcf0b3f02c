/* Digests against the vectors of FNV-1a, by Fowler, Noll and Vo, and of files against the same bytes in
 * memory. */
#include "host/base/digest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/files.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void test_published_vectors(void)
{
    static const struct {
        const char *text;
        uint64_t digest;
    } KNOWN[] = {{"", 0xcbf29ce484222325u},
                 {"a", 0xaf63dc4c8601ec8cu},
                 {"b", 0xaf63df4c8601f1a5u},
                 {"foobar", 0x85944171f73967e8u}};
    for (size_t k = 0; k < sizeof KNOWN / sizeof *KNOWN; ++k)
        TEST_ASSERT_EQUAL_HEX64(KNOWN[k].digest,
                                hci_digest_next(HCI_DIGEST_START, KNOWN[k].text, strlen(KNOWN[k].text)));
}

/* In parts as well as at once, and each byte of a file counts, of its last block too. */
static void test_files(void)
{
    enum { SIZE = 4096 + 4096 + 5 };
    static const size_t PLACE[] = {0, 1, 4095, 4096, 8191, 8192, SIZE - 1};
    static char text[SIZE + 1];
    for (size_t k = 0; k < SIZE; ++k)
        text[k] = (char)('a' + k % 23);
    const uint64_t whole = hci_digest_next(HCI_DIGEST_START, text, SIZE);
    TEST_ASSERT_EQUAL_HEX64(
        whole, hci_digest_next(hci_digest_next(HCI_DIGEST_START, text, 77), text + 77, SIZE - 77));
    for (size_t k = 0; k < sizeof PLACE / sizeof *PLACE; ++k) {
        uint64_t same = HCI_DIGEST_START, other = HCI_DIGEST_START;
        files_write(files_path("same"), text);
        TEST_ASSERT_TRUE(hci_digest_file(files_path("same"), &same));
        TEST_ASSERT_EQUAL_HEX64(whole, same);
        text[PLACE[k]] ^= 1;
        files_write(files_path("other"), text);
        TEST_ASSERT_TRUE(hci_digest_file(files_path("other"), &other));
        text[PLACE[k]] ^= 1;
        TEST_ASSERT_TRUE(other != whole);
    }
}

static void test_no_file(void)
{
    uint64_t sum = HCI_DIGEST_START;
    TEST_ASSERT_FALSE(hci_digest_file(files_path("none"), &sum));
    TEST_ASSERT_EQUAL_HEX64(HCI_DIGEST_START, sum);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_published_vectors);
    RUN_TEST(test_files);
    RUN_TEST(test_no_file);
    return UNITY_END();
}
