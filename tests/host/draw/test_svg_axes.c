/* Axes by numbers that are worked out by hand here: where a value lies, which steps and ends an axis has, and
 * every line and number of a grid, in their order. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/svg.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

static const hci_svg_box BOX = {100.0, 20.0, 400.0, 170.0};

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void is_axis(double low, double high, double from, double to, double step, hci_svg_axis a)
{
    char text[200];
    snprintf(text, sizeof text, "%.15g … %.15g at %g … %g by %.15g", a.low, a.high, a.from, a.to, a.step);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * (1.0 + fabs(low)), low, a.low, text);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * (1.0 + fabs(high)), high, a.high, text);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.0, from, a.from, text);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.0, to, a.to, text);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * fabs(step), step, a.step, text);
}

static void test_where_a_value_lies(void)
{
    const hci_svg_axis a = {-3.0, 7.0, 50.0, 30.0, 1.0};
    TEST_ASSERT_EQUAL_DOUBLE(44.0, hci_svg_at(&a, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, hci_svg_at(&a, -3.5));
    TEST_ASSERT_EQUAL_DOUBLE(49.0, hci_svg_at(&a, -2.5));
    TEST_ASSERT_EQUAL_DOUBLE(31.0, hci_svg_at(&a, 6.5));
    TEST_ASSERT_EQUAL_DOUBLE(30.0, hci_svg_at(&a, 7.5));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, hci_svg_at(&a, NAN));
}

static void test_steps_are_1_2_or_5(void)
{
    static const double CASE[][2] = {{1.0, 1.0},  {1.001, 2.0}, {2.0, 2.0},    {2.001, 5.0},    {5.0, 5.0},
                                     {5.1, 10.0}, {9.9, 10.0},  {30.0, 50.0},  {0.0031, 0.005}, {0.7, 1.0},
                                     {0.15, 0.2}, {600.0, 1e3}, {1.5e-7, 2e-7}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * CASE[k][1], CASE[k][1], hci_svg_nice_step(CASE[k][0]));
}

/* A twentieth of the range is free at each end that is not zero. */
static void test_an_axis_over_a_range(void)
{
    is_axis(3.95, 5.05, 10.0, 90.0, 0.2, hci_svg_axis_over((hci_range){4.0, 5.0}, 10.0, 90.0, 6.0));
    is_axis(0.0, 5.25, 10.0, 90.0, 1.0, hci_svg_axis_over((hci_range){2.4, 5.0}, 10.0, 90.0, 6.0));
    is_axis(2.5 - 0.125, 5.125, 10.0, 90.0, 0.5, hci_svg_axis_over((hci_range){2.5, 5.0}, 10.0, 90.0, 6.0));
    is_axis(-5.25, 0.0, 9.0, 3.0, 2.0, hci_svg_axis_over((hci_range){-5.0, -2.4}, 9.0, 3.0, 5.0));
    is_axis(-5.125, -2.5 + 0.125, 9.0, 3.0, 0.5, hci_svg_axis_over((hci_range){-5.0, -2.5}, 9.0, 3.0, 6.0));
    is_axis(-2.3, 4.3, 0.0, 1.0, 1.0, hci_svg_axis_over((hci_range){-2.0, 4.0}, 0.0, 1.0, 8.0));
    is_axis(0.0, 4.2, 0.0, 1.0, 1.0, hci_svg_axis_over((hci_range){0.0, 4.0}, 0.0, 1.0, 5.0));
    is_axis(-4.2, 0.0, 0.0, 1.0, 1.0, hci_svg_axis_over((hci_range){-4.0, 0.0}, 0.0, 1.0, 5.0));
    is_axis(0.0, 0.525, 0.0, 1.0, 0.1, hci_svg_axis_over((hci_range){0.1, 0.5}, 0.0, 1.0, 6.0));
}

/* A point has a tenth of its size at each side; what is no range, or cannot be drawn, is −1 … 1. */
static void test_an_axis_over_what_is_no_range(void)
{
    static const hci_range NONE[] = {{1.0, -1.0}, {0.0, 0.0},    {5e-201, 1e-200}, {-1.0, 1.1e200},
                                     {NAN, 1.0},  {-1.1e200, 1}, {2.0, NAN}};
    is_axis(5.4 - 0.06, 6.6 + 0.06, 1.0, 2.0, 0.2, hci_svg_axis_over((hci_range){6.0, 6.0}, 1.0, 2.0, 7.0));
    is_axis(-6.6 - 0.06, -5.4 + 0.06, 1.0, 2.0, 0.2,
            hci_svg_axis_over((hci_range){-6.0, -6.0}, 1.0, 2.0, 7.0));
    is_axis(6.0 - 0.6 - 0.06, 6.6 + 0.06, 1.0, 2.0, 0.2,
            hci_svg_axis_over((hci_range){6.0, 6.0 * (1.0 + 0.9e-9)}, 1.0, 2.0, 7.0));
    for (size_t k = 0; k < sizeof NONE / sizeof NONE[0]; ++k)
        is_axis(-1.1, 1.1, 1.0, 2.0, 0.5, hci_svg_axis_over(NONE[k], 1.0, 2.0, 6.0));
    const hci_svg_axis fine = hci_svg_axis_over((hci_range){6.0, 6.0 * (1.0 + 1.2e-9)}, 1.0, 2.0, 7.0);
    TEST_ASSERT_TRUE(fine.low > 6.0 - 1e-9 && fine.high < 6.0 + 9e-9);
    const hci_svg_axis small = hci_svg_axis_over((hci_range){0.0, 1.1e-200}, 1.0, 2.0, 7.0);
    TEST_ASSERT_TRUE(small.high < 1.2e-200);
    const hci_svg_axis large = hci_svg_axis_over((hci_range){0.0, 0.9e200}, 1.0, 2.0, 7.0);
    TEST_ASSERT_TRUE(large.high > 0.9e200);
}

static void test_a_unit_is_as_long_on_both_axes(void)
{
    hci_svg_axis x, y;
    /* x: −1.05·… of 2 and 0.1 of margin at both ends: 3.3 over 300 pixels; y: 1.1 over 150 */
    hci_svg_equal_axes((hci_range){-1.0, 2.0}, (hci_range){-0.6, 0.4}, &BOX, &x, &y);
    is_axis(-1.15, 2.15, 100.0, 400.0, 0.5, x);
    is_axis(-0.1 - 0.825, -0.1 + 0.825, 170.0, 20.0, 0.5, y);
    /* y needs more: 6.6 over 150 pixels, and so 13.2 over 300 */
    hci_svg_equal_axes((hci_range){-1.0, 2.0}, (hci_range){-4.0, 2.0}, &BOX, &x, &y);
    is_axis(0.5 - 6.6, 0.5 + 6.6, 100.0, 400.0, 2.0, x);
    is_axis(-4.3, 2.3, 170.0, 20.0, 2.0, y);
    /* no width beside 1e-6 of the height at its ends, whose signs do not matter: it stands in the middle */
    hci_svg_equal_axes((hci_range){3.0, 3.0 + 5.9e-6}, (hci_range){-4.0, 2.0}, &BOX, &x, &y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 3.0, 0.5 * (x.low + x.high));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 13.2, x.high - x.low);
    hci_svg_equal_axes((hci_range){1e-6, 1e-6}, (hci_range){0.0, 0.0}, &BOX, &x, &y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -4.4 / 2.0 + 1.05e-6, x.low);
    hci_svg_equal_axes((hci_range){3.0, 3.0 + 5e-6}, (hci_range){1e-7, 3e-7}, &BOX, &x, &y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 - 0.25e-6, x.low); /* 5 µ and two twentieths of it */
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 + 5.25e-6, x.high);
    hci_svg_equal_axes((hci_range){3.0, 3.0}, (hci_range){1e-7, 3e-7}, &BOX, &x, &y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 - 1.1e-6, x.low); /* 1 µ at each side */
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.0 + 1.1e-6, x.high);
}

/* At most eight lines, unless it is too long for the largest step. */
static void test_steps_of_an_angle(void)
{
    static const double CASE[][2] = {
        {1.0, 60.0},        {4.0 / 3.0, 60.0}, {1.34, 90.0},     {2.0, 90.0},      {2.1, 180.0},
        {4.0, 180.0},       {8.0, 360.0},      {16.0, 720.0},    {17.0, 1800.0},   {41.0, 3600.0},
        {81.0, 7200.0},     {161.0, 18000.0},  {401.0, 36000.0}, {801.0, 72000.0}, {1601.0, 180000.0},
        {4001.0, 360000.0}, {9000.0, 360000.0}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        is_axis(0.0, 360.0 * CASE[k][0], 100.0, 400.0, CASE[k][1], hci_svg_axis_of_angle(CASE[k][0], &BOX));
}

/* ---- boxes ---- */

/* Numbers that need more than the 46 − 8 pixels at the left of a box take them from it. */
static void test_a_box_beside_wide_numbers(void)
{
    const hci_svg_axis narrow = {-0.2, 3.3, 170.0, 20.0, 1.0}, wide = {-12400.0, 3300.0, 170.0, 20.0, 2000.0},
                       edge = {-6200.0, 900.0, 170.0, 20.0, 1000.0};
    const double widest = hci_svg_text_width("quiet end", "−12000");
    hci_svg_box b = hci_svg_box_beside(BOX, &narrow);
    TEST_ASSERT_EQUAL_DOUBLE(BOX.left, b.left);
    b = hci_svg_box_beside(BOX, &wide);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, BOX.left + widest + 8.0 - 46.0, b.left);
    TEST_ASSERT_EQUAL_DOUBLE(BOX.right, b.right);
    TEST_ASSERT_EQUAL_DOUBLE(BOX.top, b.top);
    TEST_ASSERT_EQUAL_DOUBLE(BOX.bottom, b.bottom);
    b = hci_svg_box_beside(BOX, &edge); /* 10.1 and four times 7.7 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, BOX.left + 40.9 + 8.0 - 46.0, b.left);
}

static void test_a_box_beside_wide_powers(void)
{
    const hci_svg_axis narrow = {-1.0, 2.0, 170.0, 20.0, 1.0}, wide = {-1.3, 5.3, 170.0, 20.0, 1.0},
                       low = {-7.0, -2.0, 170.0, 20.0, 1.0}, end = {0.0, 5.0, 170.0, 20.0, 1.0},
                       below = {1.0, 4.99, 170.0, 20.0, 1.0};
    TEST_ASSERT_EQUAL_DOUBLE(BOX.left, hci_svg_log_box_beside(BOX, &narrow).left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 + 46.2 - 38.0,
                              hci_svg_log_box_beside(BOX, &wide).left); /* 100000 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 + 46.2 - 38.0, hci_svg_log_box_beside(BOX, &end).left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 + 38.5 - 38.0,
                              hci_svg_log_box_beside(BOX, &below).left); /* 10000 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 + 43.4 - 38.0,
                              hci_svg_log_box_beside(BOX, &low).left); /* 1e-7, 0.0001 */
}

/* ---- grids ---- */

static char *grid(const hci_svg_axis *a, bool upwards, bool is_log)
{
    hci_output *out = written_begin("g");
    (is_log ? hci_svg_log_grid : hci_svg_grid)(out, a, &BOX, upwards);
    return written_end(out, "g");
}

#define ACROSS(style, y)  "<path class=\"" style "\" d=\"M100.00 " y "L400.00 " y "\"/>\n"
#define UPRIGHT(style, x) "<path class=\"" style "\" d=\"M" x " 20.00L" x " 170.00\"/>\n"
#define LEFT(y, text)     "<text class=\"quiet end\" x=\"92.00\" y=\"" y "\">" text "</text>\n"
#define BELOW(x, text)    "<text class=\"quiet middle\" x=\"" x "\" y=\"187.00\">" text "</text>\n"

static void test_lines_across(void)
{
    const hci_svg_axis a = {-10.0, 20.0, 170.0, 20.0, 10.0};
    TEST_ASSERT_EQUAL_STRING(ACROSS("grid", "170.00") LEFT("174.00", "−10") ACROSS("axis", "120.00")
                                 LEFT("124.00", "0") ACROSS("grid", "70.00") LEFT("74.00", "10")
                                     ACROSS("grid", "20.00") LEFT("24.00", "20"),
                             grid(&a, true, false));
}

/* The last number does not reach beyond the 12 pixels at the right of the box: half of it is 11.55 wide. */
static void test_upright_lines(void)
{
    const hci_svg_axis a = {-150.0, 450.0, 100.0, 400.0, 300.0},
                       to_the_end = {0.0, 10000.0, 100.0, 400.0, 5000.0};
    TEST_ASSERT_EQUAL_STRING(UPRIGHT("axis", "175.00") BELOW("175.00", "0") UPRIGHT("grid", "325.00")
                                 BELOW("325.00", "300"),
                             grid(&a, false, false));
    TEST_ASSERT_EQUAL_STRING(UPRIGHT("grid", "100.00") BELOW("100.00", "0") UPRIGHT("grid", "250.00")
                                 BELOW("250.00", "5000") UPRIGHT("grid", "400.00") BELOW("392.75", "10000"),
                             grid(&to_the_end, false, false));
}

/* 300 pixels with 31 lines are 10 from line to line: two figures of 15.4 and 4 between need two of these. */
static void test_numbers_that_would_touch(void)
{
    const hci_svg_axis two = {0.0, 30.0, 100.0, 400.0, 1.0}, fits = {0.0, 9.0, 100.0, 400.0, 1.0},
                       minus = {-31.0, -1.0, 100.0, 400.0, 1.0};
    const char *text = grid(&two, false, false);
    TEST_ASSERT_EQUAL_INT(31, text_count("<path", text));
    TEST_ASSERT_EQUAL_INT(16, text_count("<text", text));
    text_has(BELOW("100.00", "0") UPRIGHT("grid", "110.00") UPRIGHT("grid", "120.00") BELOW("120.00", "2"),
             text);
    text = grid(&fits, false, false);
    TEST_ASSERT_EQUAL_INT(10, text_count("<text", text));
    text = grid(&minus, false, false); /* 10.1 + 15.4 + 4 are 29.5: every third */
    TEST_ASSERT_EQUAL_INT(31, text_count("<path", text));
    TEST_ASSERT_EQUAL_INT(10, text_count("<text", text));
    text_has(BELOW("110.00", "−30"), text);
    text_has(BELOW("380.00", "−3"), text);
}

/* ---- logarithmic axes ---- */

static void test_ends_of_a_logarithmic_axis(void)
{
    static const struct {
        hci_range r;
        double most, low, high;
    } CASE[] = {
        {{0.03, 7.0}, 6.0, 0.02, 10.0},   {{0.02, 5.0}, 6.0, 0.02, 5.0},    {{0.19, 1.9}, 6.0, 0.1, 2.0},
        {{0.6, 40.0}, 6.0, 0.5, 50.0},    {{3.0, 3.5}, 6.0, 0.5, 5.0},      {{-2.0, 300.0}, 3.0, 0.2, 500.0},
        {{1e-9, 300.0}, 3.0, 0.2, 500.0}, {{2.0, 2.0}, 6.0, 0.2, 2.0},      {{0.001, 1.0}, 6.0, 0.001, 1.0},
        {{0.0, 100.0}, 2.0, 1.0, 100.0},  {{4.9, 1100.0}, 6.0, 2.0, 2000.0}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        is_axis(log10(CASE[k].low), log10(CASE[k].high), 5.0, 3.0, 1.0,
                hci_svg_log_axis(CASE[k].r, 5.0, 3.0, CASE[k].most));
    is_axis(-1.0, 0.0, 5.0, 3.0, 1.0, hci_svg_log_axis((hci_range){-2.0, 1e-200}, 5.0, 3.0, 4.0));
    is_axis(-1.0, 0.0, 5.0, 3.0, 1.0, hci_svg_log_axis((hci_range){-2.0, 1e200}, 5.0, 3.0, 4.0));
    is_axis(-1.0, 0.0, 5.0, 3.0, 1.0, hci_svg_log_axis((hci_range){-2.0, NAN}, 5.0, 3.0, 4.0));
    is_axis(-201.0, log10(2e-200), 5.0, 3.0, 1.0,
            hci_svg_log_axis((hci_range){1e-201, 1.1e-200}, 5.0, 3.0, 4.0));
}

static void test_where_a_value_lies_on_a_logarithmic_axis(void)
{
    const hci_svg_axis a = {-1.0, 3.0, 170.0, 20.0, 1.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 132.5, hci_svg_log_at(&a, 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 57.5, hci_svg_log_at(&a, 100.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 170.0, hci_svg_log_at(&a, 0.01));
    TEST_ASSERT_EQUAL_DOUBLE(170.0, hci_svg_log_at(&a, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(170.0, hci_svg_log_at(&a, -5.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 170.0 - 1.2 * 37.5, hci_svg_log_at(&a, pow(10.0, 0.2)));
}

/* Where a decade has 3·26 pixels upwards, or 3·52 to the right, its 2 and 5 are there too. */
static void test_lines_of_a_decade(void)
{
    const hci_svg_axis up = {log10(0.2), log10(5.0), 170.0, 20.0, 1.0}, right = {1.0, 2.0, 100.0, 400.0, 1.0};
    char *text = grid(&up, true, true);
    TEST_ASSERT_EQUAL_INT(5, text_count("<path", text));
    text_has(ACROSS("grid", "170.00") LEFT("174.00", "0.2") ACROSS("grid", "127.30") LEFT("131.30", "0.5"),
             text);
    text_has(ACROSS("grid", "95.00") LEFT("99.00", "1") ACROSS("grid", "62.70") LEFT("66.70", "2"), text);
    text_has(ACROSS("grid", "20.00") LEFT("24.00", "5"), text);
    text = grid(&right, false, true);
    TEST_ASSERT_EQUAL_STRING(UPRIGHT("grid", "100.00") BELOW("100.00", "10") UPRIGHT("grid", "190.31")
                                 BELOW("190.31", "20") UPRIGHT("grid", "309.69") BELOW("309.69", "50")
                                     UPRIGHT("grid", "400.00") BELOW("400.00", "100"),
                             text);
}

/* Two decades over 150 pixels are 6 lines of 25: too many; 5.77 rooms are 3·1.92. */
static void test_decades_alone(void)
{
    const hci_svg_axis up = {-1.0, 1.0, 170.0, 20.0, 1.0}, still = {0.0, 1.92, 170.0, 20.0, 1.0},
                       many = {-3.0, 4.0, 170.0, 20.0, 1.0}, right = {-3.0, 9.0, 100.0, 400.0, 1.0},
                       none = {-1.0, 2.0, 30.0, 20.0, 1.0};
    TEST_ASSERT_EQUAL_STRING(ACROSS("grid", "170.00") LEFT("174.00", "0.1") ACROSS("grid", "95.00")
                                 LEFT("99.00", "1") ACROSS("grid", "20.00") LEFT("24.00", "10"),
                             grid(&up, true, true));
    TEST_ASSERT_EQUAL_INT(6, text_count("<path", grid(&still, true, true))); /* 1, 2, 5, 10, 20, 50 */
    /* 7 decades have room for 5.77: every second, from 0.001 */
    TEST_ASSERT_EQUAL_INT(4, text_count("<path", grid(&many, true, true)));
    text_has(LEFT("174.00", "0.001"), files_read(files_path("g")));
    text_has(LEFT("131.14", "0.1"), files_read(files_path("g")));
    /* 12 decades and 300/52 = 5.77: every third */
    TEST_ASSERT_EQUAL_INT(5, text_count("<path", grid(&right, false, true)));
    text_has(UPRIGHT("grid", "175.00") BELOW("175.00", "1"), files_read(files_path("g")));
    /* less than one has room: as with one, every third decade */
    TEST_ASSERT_EQUAL_INT(2, text_count("<path", grid(&none, true, true)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_where_a_value_lies);
    RUN_TEST(test_steps_are_1_2_or_5);
    RUN_TEST(test_an_axis_over_a_range);
    RUN_TEST(test_an_axis_over_what_is_no_range);
    RUN_TEST(test_a_unit_is_as_long_on_both_axes);
    RUN_TEST(test_steps_of_an_angle);
    RUN_TEST(test_a_box_beside_wide_numbers);
    RUN_TEST(test_a_box_beside_wide_powers);
    RUN_TEST(test_lines_across);
    RUN_TEST(test_upright_lines);
    RUN_TEST(test_numbers_that_would_touch);
    RUN_TEST(test_ends_of_a_logarithmic_axis);
    RUN_TEST(test_where_a_value_lies_on_a_logarithmic_axis);
    RUN_TEST(test_lines_of_a_decade);
    RUN_TEST(test_decades_alone);
    return UNITY_END();
}
