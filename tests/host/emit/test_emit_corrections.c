/* What the head of a table says of the sensors that a drive has to correct: one to a line. */
#include "host/emit/text.c"

#include "support/written.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static const char *written(const char *corrections)
{
    hci_emit_facts facts = {.pole_pairs = 1};
    snprintf(facts.corrections, sizeof facts.corrections, "%s", corrections);
    hci_output *out = written_begin("t.h");
    write_corrections(&facts, out);
    return written_end(out, "t.h");
}

#define HEAD                                                                                                 \
    " * Sensors: the currents are for the true angle and the true current. A drive with the\n"               \
    " *         sensors of the recordings has to correct what they read, in the order of these\n"            \
    " *         lines; the numbers are macros below:\n"

static void test_one_to_a_line(void)
{
    TEST_ASSERT_EQUAL_STRING("", written(""));
    TEST_ASSERT_EQUAL_STRING(HEAD " *           an angle of 2 deg\n", written("an angle of 2 deg"));
    TEST_ASSERT_EQUAL_STRING(HEAD " *           a, b\n *           c\n", written("a, b\nc"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_to_a_line);
    return UNITY_END();
}
