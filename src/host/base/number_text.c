#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"

/* "1e+09" of printf, in any locale, as "1e9". */
static void tidy(const char *printed, char *text)
{
    bool mark = false;
    for (; *printed != '\0' && *printed != 'e'; printed++) {
        if ((*printed >= '0' && *printed <= '9') || *printed == '-') {
            *text++ = *printed;
        } else if (!mark) {
            *text++ = '.';
            mark = true;
        }
    }
    if (*printed == 'e') {
        *text++ = *printed++;
        if (*printed == '-') *text++ = '-';
        while (*printed == '-' || *printed == '+' || *printed == '0')
            printed++;
    }
    memcpy(text, printed, strlen(printed) + 1);
}

static bool reads_back(const char *text, double value)
{
    double back = 0;
    return hci_number_parse(text, &back) && !(back < value) && !(back > value);
}

/* Doubles are closer below a power of two than above it. So the nearest 16 digits may fall below too far, and
 * the next ones up be near enough. */
static bool next_16_digits_read_back(double power_of_two, char *text)
{
    char printed[40];
    snprintf(printed, sizeof printed, "%.15e", power_of_two);
    char *last = printed + strcspn(printed, "e") - 1;
    if (*last == '9') return false;
    ++*last;
    tidy(printed, text);
    return reads_back(text, power_of_two);
}

static bool is_power_of_two(double value)
{
    int exponent;
    const double fraction = fabs(frexp(value, &exponent));
    return !(fraction > 0.5) && !(fraction < 0.5);
}

void hci_number_text(double value, char text[32])
{
    char printed[40];
    if (!isfinite(value)) {
        snprintf(text, 32, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
        return;
    }
    /* 15 digits survive the way through a normal double, so no shorter try can find a shorter text. */
    for (int precision = fabs(value) < DBL_MIN ? 1 : 15; precision <= 17; precision++) {
        snprintf(printed, sizeof printed, "%.*g", precision, value);
        tidy(printed, text);
        if (reads_back(text, value)) return;
        if (precision == 16 && is_power_of_two(value) && next_16_digits_read_back(value, text)) return;
    }
}

/* ---- percentages ---- */

#define LEAST_PERCENT 1e-6
#define MOST_PERCENT  1e9

/* "0.00050" as "0.0005", whatever the decimal mark. */
static void drop_zeros(char *text)
{
    for (size_t n = strlen(text); n > 1 && text[n - 1] == '0'; --n)
        text[n - 1] = '\0';
}

const char *hci_percent_text(double percent, int digits, char text[HCI_PERCENT_SIZE])
{
    snprintf(text, HCI_PERCENT_SIZE, "%.*g", digits, percent);
    const char *exponent = strchr(text, 'e');
    if (exponent == NULL) return text;
    const int place = atoi(exponent + 1) - digits + 1; /* of the last digit */
    if (fabs(percent) < LEAST_PERCENT)
        snprintf(text, HCI_PERCENT_SIZE, "%s0.000001", percent < 0.0 ? "> -" : "< ");
    else if (fabs(percent) > MOST_PERCENT)
        snprintf(text, HCI_PERCENT_SIZE, "%s1000000000", percent < 0.0 ? "< -" : "> ");
    else
        snprintf(text, HCI_PERCENT_SIZE, "%.*f", place < 0 ? -place : 0,
                 round(percent / pow(10.0, place)) * pow(10.0, place));
    if (fabs(percent) < 1.0) drop_zeros(text);
    return text;
}
