/* What the marks in a number are, numbers without them, dates and times of the day, fractions. */
#include "host/csv/number_cell.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

#define NARROW "\xE2\x80\xAF"

/* ---- marks ---- */

static void test_marks(void)
{
    static const struct {
        const char *cell;
        hci_marks marks;
    } CASE[] = {
        {"12", {0, 0, 0}},
        {"", {0, 0, 0}},
        {"1.234", {0, 0, '.'}},
        {"-12,345", {0, 0, ','}},
        {"+123.456", {0, 0, '.'}},
        {"0.234", {'.', 0, 0}},
        {"1234.567", {'.', 0, 0}},
        {".234", {'.', 0, 0}},
        {"1,23", {',', 0, 0}},
        {"1,2345", {',', 0, 0}},
        {"1.234e5", {'.', 0, 0}},
        {"1.234E5", {'.', 0, 0}},
        {"1 234", {0, ' ', 0}},
        {"1'234", {0, '\'', 0}},
        {"1\xC2\xA0"
         "234",
         {0, ' ', 0}},
        {"1\xE2\x80\x89"
         "234" NARROW "567",
         {0, ' ', 0}},
        {"1\xE2\x80\x99"
         "234",
         {0, '\'', 0}},
        {"1234 567", {0, 0, 0}},
        {"012 345", {0, 0, 0}},
        {"1.234.567", {0, '.', 0}},
        {"1.2345.678", {0, 0, 0}},
        {"1.234,5", {',', '.', 0}},
        {"1,234,567.25", {'.', ',', 0}},
        {"1,234.567", {'.', ',', 0}},
        {"1 234,5", {',', ' ', 0}},
        {"1,234.5e3", {'.', ',', 0}},
        {"1.23,5", {0, 0, 0}},
        {"12.34.567,8", {0, 0, 0}},
        {"1.234.56,7", {0, 0, 0}},
        {"1.234 567,8", {0, 0, 0}},
        {"1.234,567.8", {0, 0, 0}},
        {"0.234,5", {0, 0, 0}},
        {"1.234 5", {0, 0, 0}},
        {"12,34,567", {0, 0, 0}},
        {"1.234x", {0, 0, 0}},
        {"1;234", {0, 0, 0}},
        {"1 234 567 890 234 567 890 234 567 890 234 567 890", {0, ' ', 0}},
        {"1 234 567 890 234 567 890 234 567 890 234 567 890 234", {0, 0, 0}},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        const hci_marks marks = hci_marks_of(CASE[k].cell);
        TEST_ASSERT_EQUAL_INT8_MESSAGE(CASE[k].marks.decimal, marks.decimal, CASE[k].cell);
        TEST_ASSERT_EQUAL_INT8_MESSAGE(CASE[k].marks.group, marks.group, CASE[k].cell);
        TEST_ASSERT_EQUAL_INT8_MESSAGE(CASE[k].marks.doubtful, marks.doubtful, CASE[k].cell);
    }
}

static void test_numbers_without_their_marks(void)
{
    static const struct {
        const char *cell;
        char decimal;
        double value; /* NAN: none */
    } CASE[] = {
        {"1.234,5", ',', 1234.5},   {"1.234,5", '.', NAN},         {"1,234.5", '.', 1234.5},
        {"1,234.5", ',', NAN},      {"1.234", ',', 1234.0},        {"1.234", '.', NAN},
        {"-12,345", '.', -12345.0}, {"1 234", '.', 1234.0},        {"1 234,75", ',', 1234.75},
        {"1 234,75", '.', NAN},     {"2'345'678", '.', 2345678.0}, {"12", '.', NAN},
        {"1,5", ',', NAN},          {"1,234.5e3", '.', 1234500.0},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        double value = NAN;
        TEST_ASSERT_EQUAL_MESSAGE(!isnan(CASE[k].value),
                                  hci_csv_grouped_number(CASE[k].cell, CASE[k].decimal, &value),
                                  CASE[k].cell);
        if (!isnan(CASE[k].value)) TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(CASE[k].value, value, CASE[k].cell);
    }
}

/* 63 bytes are read, 64 are not; groups of 4, 5 and 6 bytes. */
static void test_the_longest_number(void)
{
    char cell[100] = "999";
    double value;
    for (int k = 0; k < 10; ++k)
        strcat(cell, NARROW "999");
    TEST_ASSERT_EQUAL(63, strlen(cell));
    TEST_ASSERT_TRUE(hci_csv_grouped_number(cell, '.', &value));
    TEST_ASSERT_DOUBLE_WITHIN(1e18, 1e33 - 1.0, value);
    strcpy(cell, "99");
    for (int k = 0; k < 12; ++k)
        strcat(cell, k < 5 ? " 999" : NARROW "999");
    TEST_ASSERT_EQUAL(64, strlen(cell));
    TEST_ASSERT_EQUAL(' ', hci_marks_of(cell).group);
    TEST_ASSERT_FALSE(hci_csv_grouped_number(cell, '.', &value));
}

/* ---- times ---- */

static void test_times_of_the_day(void)
{
    static const struct {
        const char *cell;
        double seconds; /* NAN: none */
    } CASE[] = {
        {"12:00:01.5", 43201.5},
        {"12:00:01,25", 43201.25},
        {"1:2:3", 3723.0},
        {"00:01.5", 1.5},
        {"59:59,5", 3599.5},
        {"12:30", NAN},
        {"12:30:", NAN},
        {"12", NAN},
        {"12:", NAN},
        {"23:59:60.5", 86400.5},
        {"23:59:61", NAN},
        {"23:60:00", NAN},
        {"00:59:00", 3540.0},
        {"60:00.5", NAN},
        {"123:00:00", NAN},
        {"1:123:00", NAN},
        {"1:2:003", NAN},
        {"12:00:00 AM", 0.0},
        {"11:59:59 am", 43199.0},
        {"12:00:00 PM", 43200.0},
        {"1:00:00pm", 46800.0},
        {"1:00:00 PMx", NAN},
        {"1:00:00 P", NAN},
        {"1:00:00 XM", NAN},
        {"1:00:00 pM", 46800.0},
        {"1:00:00  Am", 3600.0},
        {"1:00:00Z", 3600.0},
        {"1:00:00.5Z", 3600.5},
        {"1:00:00Z0", NAN},
        {"1:00:00+02:00", 3600.0},
        {"1:00:00-0330", 3600.0},
        {"1:00:00+2h", NAN},
        {"1:00:00 ", 3600.0},
        {"1:00:00 x", NAN},
        {"x:00:00", NAN},
        {"00:00:00.123456", 0.123456},
        {"-1:00:00", NAN},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        double days = NAN, seconds = NAN;
        TEST_ASSERT_EQUAL_MESSAGE(!isnan(CASE[k].seconds), hci_csv_clock(CASE[k].cell, &days, &seconds),
                                  CASE[k].cell);
        if (isnan(CASE[k].seconds)) continue;
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-11, CASE[k].seconds, seconds, CASE[k].cell);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, days);
    }
}

static bool is_leap(int year)
{
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

static void check_day(int year, int month, int day, double days)
{
    static const char *const FORMAT[] = {"%1$04d-%2$02d-%3$02d 00:01", "%1$04d/%2$d/%3$d  00:01:00",
                                         "%3$02d.%2$02d.%1$04dT00:01:00Z"};
    for (int f = 0; f < 3; ++f) {
        char cell[40];
        double found = NAN, seconds = NAN;
        snprintf(cell, sizeof cell, FORMAT[f], year, month, day);
        TEST_ASSERT_TRUE_MESSAGE(hci_csv_clock(cell, &found, &seconds), cell);
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(days, found, cell);
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(60.0, seconds, cell);
    }
}

/* The first and the last day of each month, counted one month after the other. */
static void test_days_are_counted_from_1970(void)
{
    static const int LENGTH[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    double days = 0.0;
    for (int year = 1970; year <= 2110; ++year)
        for (int month = 1; month <= 12; ++month) {
            const int length = LENGTH[month - 1] + (month == 2 && is_leap(year));
            check_day(year, month, 1, days);
            check_day(year, month, length, days + length - 1);
            days += length;
        }
}

/* Which of the first two is the month is not known; a first number that is no day is a year. */
static void test_dates(void)
{
    static const struct {
        const char *cell;
        bool is_one;
        double days;
    } CASE[] = {
        {"3/1/2024 00:00:07", true, 0.0},
        {"31-12-1970 00:00:07", true, 0.0},
        {"31.12.1970 00:00:07", true, 364.0},
        {"32-01-02 00:00:07", true,
         -707839.0}, /* day 31·365 + 7 + 2 = 11324 of the proleptic calendar, less day 719163 */
        {"2024-03-01", false, 0.0},
        {"2024-03-01 ", false, 0.0},
        {"2024-03/01 00:00:07", false, 0.0},
        {"2024-003-01 00:00:07", false, 0.0},
        {"2024-03-00001 00:00:07", false, 0.0},
        {"02024-03-01 00:00:07", false, 0.0},
        {"2024-03-01x00:00:07", false, 0.0},
        {"2024-03-01T", false, 0.0},
        {"2024:03:01 00:00:07", false, 0.0},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        double days = NAN, seconds = NAN;
        TEST_ASSERT_EQUAL_MESSAGE(CASE[k].is_one, hci_csv_clock(CASE[k].cell, &days, &seconds), CASE[k].cell);
        if (!CASE[k].is_one) continue;
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(CASE[k].days, days, CASE[k].cell);
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(7.0, seconds, CASE[k].cell);
    }
}

/* ---- the rest ---- */

static void test_fractions(void)
{
    double value = 0.0;
    TEST_ASSERT_TRUE(hci_csv_fraction("24/7", &value));
    TEST_ASSERT_EQUAL_DOUBLE(24.0 / 7.0, value);
    TEST_ASSERT_TRUE(hci_csv_fraction("0/5", &value));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, value);
    TEST_ASSERT_TRUE(hci_csv_fraction("999999/1", &value));
    TEST_ASSERT_TRUE(hci_csv_fraction("1/999999", &value));
    static const char *const NONE[] = {"5/0",  "1/2x", "1/2 ", "1000000/1", "1/1000000",
                                       "-1/2", "1",    "/2",   "1/",        ""};
    for (size_t k = 0; k < sizeof NONE / sizeof *NONE; ++k)
        TEST_ASSERT_FALSE_MESSAGE(hci_csv_fraction(NONE[k], &value), NONE[k]);
}

static void test_what_is_a_number(void)
{
    static const char *const YES[] = {"1.5", "1,5", "nan", "-inf", "1 234", "1.234.567", "12:00:01", "2e-3"};
    static const char *const NO[] = {"A", "time_s", "1.5 A", "1.23.4", "12:61:00", "12:00"};
    for (size_t k = 0; k < sizeof YES / sizeof *YES; ++k)
        TEST_ASSERT_TRUE_MESSAGE(hci_csv_is_number(YES[k]), YES[k]);
    for (size_t k = 0; k < sizeof NO / sizeof *NO; ++k)
        TEST_ASSERT_FALSE_MESSAGE(hci_csv_is_number(NO[k]), NO[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_marks);
    RUN_TEST(test_numbers_without_their_marks);
    RUN_TEST(test_the_longest_number);
    RUN_TEST(test_times_of_the_day);
    RUN_TEST(test_days_are_counted_from_1970);
    RUN_TEST(test_dates);
    RUN_TEST(test_fractions);
    RUN_TEST(test_what_is_a_number);
    return UNITY_END();
}
