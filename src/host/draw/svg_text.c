/* Numbers as text without the locale, and how wide a text is. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/draw/svg.h"

/* ---- numbers ---- */

void hci_svg_fixed_text(char text[HCI_SVG_NUMBER_SIZE], double value, int decimals)
{
    const double power = pow(10.0, decimals);
    const long long scaled = llround(fmin(fabs(value) * power, 1e15)), unit = llround(power);
    const char *sign = value < 0.0 && scaled > 0 ? "−" : "";
    if (decimals == 0)
        snprintf(text, HCI_SVG_NUMBER_SIZE, "%s%lld", sign, scaled);
    else
        snprintf(text, HCI_SVG_NUMBER_SIZE, "%s%lld.%0*lld", sign, scaled / unit, decimals, scaled % unit);
}

enum { MOST_DECIMALS = 12 };

static int decade(double value)
{
    return isfinite(value) && value != 0.0 ? (int)floor(log10(fabs(value)) + 1e-9) : 0;
}

void hci_svg_tick_text(char text[HCI_SVG_NUMBER_SIZE], double value, double step, double largest)
{
    const bool plain = (step >= 1e-4 || largest >= 1e-3) && largest < 1e6;
    const int exponent = plain ? 0 : decade(fmax(largest, step)), decimals = exponent - decade(step);
    if (fabs(value) < 0.5 * step) value = 0.0;
    hci_svg_fixed_text(text, value / pow(10.0, exponent),
                       decimals < 0                    ? 0
                       : value == 0.0 && exponent != 0 ? 0
                       : decimals < MOST_DECIMALS      ? decimals
                                                       : MOST_DECIMALS);
    if (value != 0.0 && exponent != 0)
        snprintf(text + strlen(text), HCI_SVG_NUMBER_SIZE - strlen(text), "e%d", exponent);
}

void hci_svg_short_text(char text[HCI_SVG_NUMBER_SIZE], double value)
{
    const int exponent = fabs(value) >= 1e-6 ? decade(value) : 0;
    hci_svg_fixed_text(text, value, exponent < 3 ? 3 - exponent : 0);
    if (!strchr(text, '.')) return;
    for (char *end = text + strlen(text) - 1; *end == '0' || *end == '.'; --end) {
        const bool point = *end == '.';
        *end = '\0';
        if (point) return;
    }
}

void hci_svg_quantity_text(char text[HCI_SVG_NUMBER_SIZE], double value, const char *unit)
{
    static const char *const PREFIX[] = {"p", "n", "µ", "m", "", "k", "M"};
    int k = 4;
    if (!isfinite(value) || fabs(value) >= 1e9) {
        snprintf(text, HCI_SVG_NUMBER_SIZE, "> 1000 M%s", unit);
    } else if (value != 0.0 && fabs(value) < 1e-12) {
        snprintf(text, HCI_SVG_NUMBER_SIZE, "< 1 p%s", unit);
    } else {
        for (; fabs(value) >= 1000.0 && k < 6; ++k)
            value /= 1000.0;
        for (; fabs(value) < 0.1 && value != 0.0 && k > 0; --k)
            value *= 1000.0;
        hci_svg_short_text(text, value);
        snprintf(text + strlen(text), HCI_SVG_NUMBER_SIZE - strlen(text), " %s%s", PREFIX[k], unit);
    }
}

#define LEAST_PLAIN 1e-5
#define MOST_PLAIN  1e5

void hci_svg_axis_text(char text[HCI_SVG_NUMBER_SIZE], double value, const char *unit)
{
    const bool has_axis = strcmp(unit, "N·m") == 0 || strcmp(unit, "A") == 0 || strcmp(unit, "V") == 0;
    if (!has_axis || !(fabs(value) >= LEAST_PLAIN && fabs(value) < MOST_PLAIN)) {
        hci_svg_quantity_text(text, value, unit);
        return;
    }
    hci_svg_short_text(text, value);
    snprintf(text + strlen(text), HCI_SVG_NUMBER_SIZE - strlen(text), " %s", unit);
}

/* ---- widths: those of the widest of the common fonts, so that what has room here has it anywhere ---- */

#define BOLD 1.22 /* of a heading, which is larger too */

static double character_width(const char *c)
{
    if (!hci_utf8_begins(*c)) return 0.0; /* within a character */
    if (strncmp(c, "·", strlen("·")) == 0) return 3.9;
    if (strncmp(c, "−", strlen("−")) == 0) return 10.1;
    if ((unsigned char)*c >= 0x80) return 12.0;
    if (strchr("mwMW%@", *c)) return 11.9;
    if (*c >= 'A' && *c <= 'Z') return 9.5;
    return strchr("fijlrt.,:;/()[]|!' -", *c) ? 4.9 : 7.7;
}

double hci_svg_text_width(const char *style, const char *text)
{
    double width = 0.0;
    for (; *text; ++text)
        width += character_width(text);
    return width * (strncmp(style, "head", 4) == 0 || strncmp(style, "no", 2) == 0 ? BOLD : 1.0);
}
