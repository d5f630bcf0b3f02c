/* Numbers as text: every reading is that of glibc's strtod to the last bit, every writing the shortest that
 * reads back. */
#include "hci/host/base/number.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static size_t below(uint64_t *seed, size_t limit)
{
    return (size_t)ref_uniform(seed, 0, (double)limit) % limit;
}

static bool often(uint64_t *seed)
{
    return below(seed, 2) == 0;
}

/* Pieces that a reader may trip over. No blanks at the ends: they are trimmed. */
/* glibc's strtod rounds correctly whatever the length, and the tests run in the C locale. */
static void test_parsing_agrees_with_strtod_to_the_last_bit(void)
{
    uint64_t seed = 11;
    for (int trial = 0; trial < 200000; trial++) {
        char text[64] = "";
        size_t used = 0;
        const size_t digits = 1 + below(&seed, 24), point = below(&seed, 26);
        if (often(&seed)) text[used++] = '-';
        for (size_t k = 0; k < digits; k++) {
            if (k == point) text[used++] = '.';
            text[used++] = (char)('0' + below(&seed, 10));
        }
        if (often(&seed)) snprintf(text + used, sizeof text - used, "e%d", (int)below(&seed, 80) - 40);
        double value = 0;
        const double reference = strtod(text, NULL);
        TEST_ASSERT_TRUE_MESSAGE(hci_number_parse(text, &value), text);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&reference, &value, sizeof value, text);
    }
}

/* Middles between two doubles, a unit in the last digit above and below, and what has 16 to 19 digits: where
 * a rounding of a rounding goes wrong. */
static void test_numbers_near_the_middle_between_two_doubles_are_rounded_once(void)
{
    uint64_t seed = 12;
    for (int trial = 0; trial < 300000; trial++) {
        char text[64];
        const double value = ldexp(ref_uniform(&seed, 1, 2), (int)below(&seed, 280) - 140);
        const double middle_digits[] = {16, 17, 18, 19, 40};
        const double digits = middle_digits[below(&seed, 5)];
        const long double middle = (long double)value + ((long double)nextafter(value, 1e300) - value) / 2;
        snprintf(text, sizeof text, "%.*Le", (int)digits - 1, middle);
        double read = 0;
        const double reference = strtod(text, NULL);
        TEST_ASSERT_TRUE_MESSAGE(hci_number_parse(text, &read), text);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&reference, &read, sizeof read, text);
    }
}

static void test_texts_that_are_no_numbers_are_refused(void)
{
    static const char *const no[] = {"",    " ",    "-",      "+",      ".",
                                     "e5",  "1e",   "1e+",    "1 ",     " 1",
                                     "1,5", "0x1",  "1f",     "1..2",   "--1",
                                     "+-1", "nan",  "inf",    "1e309",  "1d5",
                                     "1_0", "1e5.", "-1e999", "NaN(1)", "1e99999999999999999999"};
    for (size_t k = 0; k < sizeof no / sizeof *no; k++) {
        double value = 7;
        TEST_ASSERT_FALSE_MESSAGE(hci_number_parse(no[k], &value), no[k]);
        TEST_ASSERT_EQUAL_DOUBLE(7, value);
    }
}

static void test_numbers_are_written_as_short_as_they_can_be(void)
{
    static const struct {
        double value;
        const char *text;
    } known[] = {
        {0.0, "0"},
        {-0.0, "-0"},
        {1.0, "1"},
        {0.1, "0.1"},
        {-2.5, "-2.5"},
        {100000, "100000"},
        {1e22, "1e22"},
        {1e-7, "1e-7"},
        {1.0 / 3, "0.3333333333333333"},
        {0.1 + 0.2, "0.30000000000000004"},
        {21.93, "21.93"},
        {0x1p-1074, "5e-324"},
        {0x1p-24, "5.960464477539063e-8"},
        {0x1p-791, "7.678447687145631e-239"},
        {DBL_MAX, "1.7976931348623157e308"},
        {DBL_MIN, "2.2250738585072014e-308"},
        {9007199254740993.0, "9007199254740992"},
        {-1.2345678901234568e-300, "-1.2345678901234568e-300"},
    };
    char text[32];
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        hci_number_text(known[k].value, text);
        TEST_ASSERT_EQUAL_STRING(known[k].text, text);
    }
}

static double from_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void test_what_is_written_reads_back_to_the_same_bits(void)
{
    uint64_t seed = 3;
    for (int trial = 0; trial < 100000; trial++) {
        const uint64_t high = (uint64_t)ref_uniform(&seed, 0, 4294967296.0);
        const double value = from_bits(high << 32 | (uint64_t)ref_uniform(&seed, 0, 4294967296.0));
        double back = 0;
        char text[32];
        if (!isfinite(value)) continue;
        hci_number_text(value, text);
        TEST_ASSERT_TRUE_MESSAGE(hci_number_parse(text, &back), text);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&value, &back, sizeof value, text);
        back = strtod(text, NULL);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&value, &back, sizeof value, text);
    }
}

static void test_a_locale_with_a_decimal_comma_changes_nothing(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "it_IT.UTF-8"};
    const char *set = NULL;
    for (size_t k = 0; k < sizeof names / sizeof *names && set == NULL; k++)
        set = setlocale(LC_ALL, names[k]);
    if (set == NULL) TEST_IGNORE_MESSAGE("no locale with a decimal comma here");
    char text[32], printed[8];
    double value = 0;
    snprintf(printed, sizeof printed, "%.1f", 0.5);
    hci_number_text(0.1 + 0.2, text);
    const bool parsed = hci_number_parse("0.30000000000000004", &value);
    setlocale(LC_ALL, "C");
    TEST_ASSERT_EQUAL_STRING("0,5", printed);
    TEST_ASSERT_EQUAL_STRING("0.30000000000000004", text);
    TEST_ASSERT_TRUE(parsed);
    TEST_ASSERT_TRUE(value == 0.1 + 0.2);
}

static void percent_is(const char *text, double percent, int digits)
{
    TEST_ASSERT_EQUAL_STRING(text, HCI_PERCENT(percent, digits));
}

static void test_percentages_have_no_exponent(void)
{
    percent_is("120", 123.4, 2);
    percent_is("100", 99.7, 2);
    percent_is("12", 12.34, 2);
    percent_is("99.7", 99.7, 3);
    percent_is("-1200", -1234.0, 2);
    percent_is("12300000", 12345678.0, 3);
    percent_is("0.000012", 1.23e-5, 2);
    percent_is("0.00005", 5e-5, 2);
    percent_is("< 0.000001", 1e-9, 2);
    percent_is("> -0.000001", -1e-9, 3);
    percent_is("> 1000000000", 1e200, 2);
    percent_is("0", 0.0, 2);
}

/* Whatever it is: two numbers with the same first digits, and never an `e`. */
static void test_percentages_of_all_sizes(void)
{
    uint64_t seed = 3;
    for (int trial = 0; trial < 20000; ++trial) {
        const double percent = pow(10.0, ref_uniform(&seed, -5.9, 8.9));
        char text[HCI_PERCENT_SIZE];
        double back;
        TEST_ASSERT_NULL(strchr(hci_percent_text(percent, 3, text), 'e'));
        TEST_ASSERT_TRUE(hci_number_parse(text, &back));
        TEST_ASSERT_DOUBLE_WITHIN(0.00501 * percent, percent, back);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_parsing_agrees_with_strtod_to_the_last_bit);
    RUN_TEST(test_numbers_near_the_middle_between_two_doubles_are_rounded_once);
    RUN_TEST(test_texts_that_are_no_numbers_are_refused);
    RUN_TEST(test_percentages_have_no_exponent);
    RUN_TEST(test_percentages_of_all_sizes);
    RUN_TEST(test_numbers_are_written_as_short_as_they_can_be);
    RUN_TEST(test_what_is_written_reads_back_to_the_same_bits);
    RUN_TEST(test_a_locale_with_a_decimal_comma_changes_nothing);
    return UNITY_END();
}
