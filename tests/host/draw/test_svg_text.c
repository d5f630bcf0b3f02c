/* Numbers as they are written in pictures, by table, and how wide texts are. */
#include <math.h>
#include <string.h>

#include "host/draw/svg.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static char text[HCI_SVG_NUMBER_SIZE];

static void test_so_many_decimals(void)
{
    static const struct {
        double value;
        int decimals;
        const char *text;
    } CASE[] = {{12.345, 2, "12.35"},
                {-0.004, 2, "0.00"},
                {-0.006, 2, "−0.01"},
                {7.6, 0, "8"},
                {-7.4, 0, "−7"},
                {3.04, 1, "3.0"},
                {3.06, 1, "3.1"},
                {-20.5, 3, "−20.500"},
                {2e17, 0, "1000000000000000"},
                {0.4, 0, "0"},
                {2e16, 1, "100000000000000.0"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_svg_fixed_text(text, CASE[k].value, CASE[k].decimals);
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, text);
    }
}

static void test_numbers_of_an_axis(void)
{
    static const struct {
        double value, step, largest;
        const char *text;
    } CASE[] = {{0.3, 0.1, 0.7, "0.3"},
                {12.0, 2.0, 20.0, "12"},
                {30.0, 10.0, 90.0, "30"},
                {-0.25, 0.05, 0.5, "−0.25"},
                {0.049, 0.1, 0.5, "0.0"},
                {-0.051, 0.1, 0.5, "−0.1"},
                {3e-5, 1e-5, 9e-5, "3e-5"},
                {12e-5, 2e-5, 20e-5, "1.2e-4"},
                {0.0, 1e-5, 9e-5, "0"},
                {3e-4, 1e-4, 9e-4, "0.0003"},
                {0.001, 9.9e-5, 1e-3, "0.00100"},
                {9.5e-4, 9.9e-5, 9.99e-4, "9.5e-4"},
                {2e6, 1e6, 3e6, "2e6"},
                {0.5e6, 0.1e6, 1e6, "0.5e6"},
                {5e5, 1e5, 9.9e5, "500000"},
                {1.0, 1e-14, 1.0, "1.000000000000"},
                {1.0, 1e-12, 1.0, "1.000000000000"},
                {1.0, 1e-11, 1.0, "1.00000000000"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_svg_tick_text(text, CASE[k].value, CASE[k].step, CASE[k].largest);
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, text);
    }
}

static void test_four_digits(void)
{
    static const struct {
        double value;
        const char *text;
    } CASE[] = {{12.0, "12"},           {1.0 / 3.0, "0.3333"}, {-120.56, "−120.6"}, {1234.6, "1235"},
                {98765.4, "98765"},     {1e-6, "0.000001"},    {0.9e-6, "0"},       {0.0, "0"},
                {100.0, "100"},         {10.5, "10.5"},        {0.0200, "0.02"},    {1.2344e-5, "0.00001234"},
                {-2.5e-6, "−0.0000025"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_svg_short_text(text, CASE[k].value);
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, text);
    }
}

static void test_prefixes(void)
{
    static const struct {
        double value;
        const char *text;
    } CASE[] = {{12.0, "12 A"},      {0.1, "0.1 A"},      {0.0999, "99.9 mA"},  {-0.025, "−25 mA"},
                {1000.0, "1 kA"},    {999.0, "999 A"},    {2.5e6, "2.5 MA"},    {1.5e8, "150 MA"},
                {9.9e8, "990 MA"},   {1e9, "> 1000 MA"},  {-1e9, "> 1000 MA"},  {HUGE_VAL, "> 1000 MA"},
                {NAN, "> 1000 MA"},  {3e-5, "30 µA"},     {4e-8, "40 nA"},      {7e-11, "70 pA"},
                {1.2e-12, "1.2 pA"}, {0.9e-12, "< 1 pA"}, {-0.9e-12, "< 1 pA"}, {0.0, "0 A"},
                {-2000.0, "−2 kA"},  {9.9e-5, "99 µA"},   {1e-12, "1 pA"}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        hci_svg_quantity_text(text, CASE[k].value, "A");
        TEST_ASSERT_EQUAL_STRING(CASE[k].text, text);
    }
}

static void test_widths(void)
{
    static const struct {
        const char *style, *text;
        double width;
    } CASE[] = {{"quiet", "", 0.0},           {"quiet", "a1_", 23.1}, {"quiet", "AZ", 19.0},
                {"quiet", "@[", 16.8},        {"quiet", "mW%", 35.7}, {"quiet", "il.", 14.7},
                {"quiet", "−·", 14.0},        {"quiet", "θ…", 24.0},  {"head", "a", 7.7 * 1.22},
                {"heading", "a", 7.7 * 1.22}, {"hea", "a", 7.7},      {"no", "a", 7.7 * 1.22},
                {"not", "a", 7.7 * 1.22},     {"n", "a", 7.7}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9, CASE[k].width,
                                          hci_svg_text_width(CASE[k].style, CASE[k].text), CASE[k].text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_so_many_decimals);
    RUN_TEST(test_numbers_of_an_axis);
    RUN_TEST(test_four_digits);
    RUN_TEST(test_prefixes);
    RUN_TEST(test_widths);
    return UNITY_END();
}
