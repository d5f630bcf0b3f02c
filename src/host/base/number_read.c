#include "host/base/number_read.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "hci/host/base/number.h"

/* A decimal: (−1)^negative · significand · 10^exponent, exact while the significand is below
 * SIGNIFICAND_EXACT: further digits are not in it. */
#define SIGNIFICAND_EXACT UINT64_C(1000000000000000000)

typedef struct {
    bool negative;
    char mark;
    uint64_t significand;
    long long exponent;
} decimal;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_mark(char c, bool comma)
{
    return c == '.' || (comma && c == ',');
}

/* Digits and at most one decimal mark. Returns the end, or NULL without any digit. */
static const char *read_digits(const char *text, bool comma, decimal *out)
{
    bool any = false;
    for (;; text++) {
        if (is_digit(*text)) {
            any = true;
            if (out->significand < SIGNIFICAND_EXACT) {
                out->significand = out->significand * 10 + (uint64_t)(*text - '0');
                if (out->mark != 0) out->exponent--;
            } else {
                if (out->mark == 0) out->exponent++;
            }
        } else if (is_mark(*text, comma) && out->mark == 0) {
            out->mark = *text;
        } else {
            return any ? text : NULL;
        }
    }
}

/* "e-12". The clamp is far outside any double, and far inside long long whatever the number of digits. */
static const char *read_exponent(const char *text, decimal *out)
{
    const bool negative = text[1] == '-';
    text += text[1] == '-' || text[1] == '+' ? 2 : 1;
    if (!is_digit(*text)) return NULL;
    long long exponent = 0;
    for (; is_digit(*text); text++) {
        if (exponent < 1000000000000) exponent = exponent * 10 + (*text - '0');
    }
    out->exponent += negative ? -exponent : exponent;
    return text;
}

static bool read_decimal(const char *text, bool comma, decimal *out)
{
    out->negative = *text == '-';
    if (*text == '-' || *text == '+') text++;
    text = read_digits(text, comma, out);
    if (text != NULL && (*text == 'e' || *text == 'E')) text = read_exponent(text, out);
    return text != NULL && *text == '\0';
}

enum { POWER_MOST = 22 };

static const double POWER[POWER_MOST + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                             1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                             1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* Exact with one rounding: both factors are doubles without error (Clinger 1990). */
static bool convert_exactly(const decimal *number, double *value)
{
    if (FLT_EVAL_METHOD != 0 || number->significand > (UINT64_C(1) << 53)) return false;
    if (number->exponent < -POWER_MOST || number->exponent > POWER_MOST) return false;
    const double significand = (double)number->significand;
    *value =
        number->exponent < 0 ? significand / POWER[-number->exponent] : significand * POWER[number->exponent];
    return true;
}

/* a·b = high + *low without error (Dekker 1971). */
static double product(double a, double b, double *low)
{
    const double split = 134217729.0; /* 2^27 + 1 */
    const double high = a * b, ca = split * a, cb = split * b;
    const double a1 = ca - (ca - a), a2 = a - a1, b1 = cb - (cb - b), b2 = b - b1;
    *low = ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2;
    return high;
}

/* The nearest double, by way of twice as many digits, unless the exact value is so near to the middle between
 * two doubles that these do not tell (Ziv 1991). Powers up to 10^44 are exact in twice the digits. */
static bool convert_closely(const decimal *number, double *value)
{
    const long long size = number->exponent < 0 ? -number->exponent : number->exponent;
    if (FLT_EVAL_METHOD != 0 || size > 2 * POWER_MOST || number->significand >= SIGNIFICAND_EXACT)
        return false;
    const double w = (double)number->significand, first = POWER[size < POWER_MOST ? size : POWER_MOST];
    const double w2 = (double)((int64_t)number->significand - (int64_t)w);
    double p2, high, low, tail;
    const double p = product(first, POWER[size < POWER_MOST ? 0 : size - POWER_MOST], &p2);
    if (number->exponent < 0) {
        high = w / p;
        const double back = product(high, p, &tail);
        low = (((w - back) - tail) + w2 - high * p2) / p;
    } else {
        high = product(w, p, &tail);
        low = tail + (w * p2 + w2 * p);
    }
    const double doubt = high * 0x1p-96;
    *value = high + (low + doubt);
    return !(*value > high + (low - doubt));
}

/* Half-way cases of a double need at most 767 digits; what follows counts only as "not zero". */
enum { DIGITS_MAX = 800 };

/* The number as "digits e exponent" for strtod: without a decimal mark the locale has no say. */
static double convert_slowly(const char *text, const decimal *number)
{
    char digits[DIGITS_MAX + 32];
    size_t count = 0;
    long long dropped = 0, fraction = 0;
    bool sticky = false, after_mark = false;
    for (; *text != '\0' && *text != 'e' && *text != 'E'; text++) {
        if (number->mark != 0 && *text == number->mark) after_mark = true;
        if (!is_digit(*text)) continue;
        fraction += after_mark;
        if (count == 0 && *text == '0') continue;
        if (count < DIGITS_MAX) {
            digits[count++] = *text;
        } else {
            dropped++;
            sticky = sticky || *text != '0';
        }
    }
    if (sticky) digits[DIGITS_MAX - 1] = '1';
    decimal tail = {0};
    if (*text != '\0') read_exponent(text, &tail);
    snprintf(digits + count, sizeof digits - count, "e%lld", tail.exponent - fraction + dropped);
    return strtod(digits, NULL);
}

static bool is_word(const char *text, const char *word)
{
    for (; *word != '\0'; text++, word++) {
        if (*text != *word && *text != *word - 'a' + 'A') return false;
    }
    return *text == '\0';
}

static hci_number_kind kind_of_word(const char *text)
{
    if (*text == '-' || *text == '+') text++;
    const bool special = is_word(text, "nan") || is_word(text, "inf") || is_word(text, "infinity");
    return special ? HCI_NUMBER_NOT_FINITE : HCI_NUMBER_NONE;
}

hci_number_kind hci_number_read(const char *text, bool comma, double *value, char *mark)
{
    decimal number = {0};
    double magnitude = 0;
    *mark = 0;
    if (!read_decimal(text, comma, &number)) return kind_of_word(text);
    if (number.significand != 0 && !convert_exactly(&number, &magnitude) &&
        !convert_closely(&number, &magnitude))
        magnitude = convert_slowly(text, &number);
    if (!isfinite(magnitude)) return HCI_NUMBER_NOT_FINITE;
    *value = number.negative ? -magnitude : magnitude;
    *mark = number.mark;
    return HCI_NUMBER_FINITE;
}

bool hci_number_parse(const char *text, double *value)
{
    char mark;
    return hci_number_read(text, false, value, &mark) == HCI_NUMBER_FINITE;
}
