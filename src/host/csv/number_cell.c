#include "host/csv/number_cell.h"

#include <stdio.h>
#include <string.h>

#include "host/base/number_read.h"
#include "host/csv/table.h"

/* ---- marks ---- */

enum { MARKS_MOST = 12, CELL_SIZE = 64 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t digits(const char *text)
{
    return strspn(text, "0123456789");
}

/* The mark that a text begins with, and its length in bytes; 0: none. */
static char mark_at(const char *text, size_t *length)
{
    static const struct {
        const char *text;
        char mark;
    } MARKS[] = {{".", '.'},
                 {",", ','},
                 {" ", ' '},
                 {"\xC2\xA0", ' '},
                 {"'", '\''},
                 {"\xE2\x80\xAF", ' '},
                 {"\xE2\x80\x89", ' '},
                 {"\xE2\x80\x99", '\''}};
    for (size_t k = 0; k < sizeof MARKS / sizeof *MARKS; ++k) {
        *length = strlen(MARKS[k].text);
        if (strncmp(text, MARKS[k].text, *length) == 0) return MARKS[k].mark;
    }
    return 0;
}

/* Runs of digits and the marks between them. */
typedef struct {
    size_t count;               /* of marks */
    char mark[MARKS_MOST];      /* [count] */
    size_t run[MARKS_MOST + 1]; /* [count + 1], digits */
    bool leads_zero, has_exponent;
} digit_groups;

static bool read_groups(const char *cell, digit_groups *g)
{
    *g = (digit_groups){0};
    if (*cell == '-' || *cell == '+') ++cell;
    g->leads_zero = *cell == '0';
    for (;;) {
        size_t length;
        g->run[g->count] = digits(cell);
        cell += g->run[g->count];
        g->has_exponent = *cell == 'e' || *cell == 'E';
        if (*cell == '\0' || g->has_exponent) return true;
        const char mark = mark_at(cell, &length);
        if (mark == 0 || g->count == MARKS_MOST) return false;
        g->mark[g->count++] = mark;
        cell += length;
    }
}

/* Do the first `count` marks stand between thousands? */
static bool is_grouped(const digit_groups *g, size_t count)
{
    if (g->run[0] < 1 || g->run[0] > 3 || g->leads_zero) return false;
    for (size_t k = 1; k <= count; ++k)
        if (g->mark[k - 1] != g->mark[0] || (k < count && g->run[k] != 3)) return false;
    return true;
}

static bool is_decimal(char mark)
{
    return mark == '.' || mark == ',';
}

hci_marks hci_marks_of(const char *cell)
{
    digit_groups g;
    if (!read_groups(cell, &g) || g.count == 0) return (hci_marks){0};
    const char first = g.mark[0], last = g.mark[g.count - 1];
    const bool whole = is_grouped(&g, g.count) && g.run[g.count] == 3 && !g.has_exponent;
    if (g.count == 1 && is_decimal(first))
        return whole ? (hci_marks){.doubtful = first} : (hci_marks){first, 0, 0};
    if (whole) return (hci_marks){.group = first};
    if (g.count < 2 || first == last || !is_decimal(last) || g.run[g.count - 1] != 3 ||
        !is_grouped(&g, g.count - 1))
        return (hci_marks){0};
    return (hci_marks){.decimal = last, .group = first};
}

bool hci_csv_grouped_number(const char *cell, char decimal, double *value)
{
    char plain[CELL_SIZE], mark;
    size_t used = 0, length;
    const hci_marks marks = hci_marks_of(cell);
    const char group = marks.doubtful != 0 ? marks.doubtful : marks.group;
    if (group == 0 || group == decimal || strlen(cell) >= sizeof plain) return false;
    if (marks.decimal != 0 && marks.decimal != decimal) return false;
    for (; *cell != '\0'; cell += length) {
        const char here = mark_at(cell, &length);
        if (here == 0) length = 1;
        if (here == 0 || here != group) plain[used++] = *cell;
    }
    plain[used] = '\0';
    return hci_number_read(plain, true, value, &mark) == HCI_NUMBER_FINITE;
}

/* ---- clock times ---- */

/* Digits, at most `most`; moves on. */
static bool read_whole(const char **at, size_t most, long *value)
{
    const size_t length = digits(*at);
    *value = 0;
    if (length == 0 || length > most) return false;
    for (size_t k = 0; k < length; ++k)
        *value = 10 * *value + ((*at)[k] - '0');
    *at += length;
    return true;
}

static bool pass(const char **at, char c)
{
    if (**at != c) return false;
    ++*at;
    return true;
}

/* Days from 1970 in the Gregorian calendar (Fliegel and van Flandern 1968). */
static double days_of(long year, long month, long day)
{
    const long a = (month - 14) / 12;
    return (double)(1461 * (year + 4800 + a) / 4 + 367 * (month - 2 - 12 * a) / 12 -
                    3 * ((year + 4900 + a) / 100) / 4 + day - 32075 - 2440588);
}

/* "2024-03-01", "2024/03/01", "01.03.2024" or "3/1/2024" with T or a blank behind it. False: it is a broken
 * one; none at all is fine. */
static bool read_date(const char **at, double *days)
{
    long first, month, last;
    const char *from = *at;
    *days = 0.0;
    if (!read_whole(at, 4, &first) || **at == '\0' || strchr("-/.", **at) == NULL) {
        *at = from;
        return true;
    }
    const char between = *(*at)++;
    const bool year_first = first > 31;
    if (!read_whole(at, 2, &month) || !pass(at, between) || !read_whole(at, 4, &last)) return false;
    if (!pass(at, 'T') && !pass(at, ' ')) return false;
    while (pass(at, ' '))
        continue;
    if (year_first || between == '.')
        *days = year_first ? days_of(first, month, last) : days_of(last, month, first);
    return true;
}

/* Seconds with a point or a comma. */
static bool read_seconds(const char **at, double *seconds)
{
    long whole;
    double place = 0.1;
    if (!read_whole(at, 2, &whole)) return false;
    *seconds = (double)whole;
    if (**at != '.' && **at != ',') return true;
    for (++*at; is_digit(**at); ++*at, place *= 0.1)
        *seconds += place * (**at - '0');
    return true;
}

/* Behind the time: AM, PM, a zone, or nothing. */
static bool read_tail(const char *at, long *hours)
{
    while (*at == ' ')
        ++at;
    if ((*at == 'A' || *at == 'P' || *at == 'a' || *at == 'p') && (at[1] == 'M' || at[1] == 'm') &&
        at[2] == '\0') {
        *hours = *hours % 12 + (*at == 'P' || *at == 'p' ? 12 : 0);
        return true;
    }
    if (*at == 'Z' && at[1] == '\0') return true;
    if (*at == '+' || *at == '-') return at[1 + strspn(at + 1, "0123456789:")] == '\0';
    return *at == '\0';
}

bool hci_csv_clock(const char *cell, double *days, double *seconds)
{
    const char *at = cell;
    long hours, minutes;
    double rest = 0.0;
    if (!read_date(&at, days)) return false;
    const bool dated = at > cell;
    if (!read_whole(&at, 2, &hours) || !pass(&at, ':')) return false;
    const char *second = at;
    if (!read_whole(&at, 2, &minutes)) return false;
    if (pass(&at, ':')) {
        if (!read_seconds(&at, &rest)) return false;
    } else if (!dated) { /* "mm:ss.f"; "hh:mm" alone could be either */
        if (*at != '.' && *at != ',') return false;
        minutes = hours;
        hours = 0;
        at = second;
        if (!read_seconds(&at, &rest)) return false;
    }
    if (!read_tail(at, &hours)) return false;
    *seconds = 3600.0 * (double)hours + 60.0 * (double)minutes + rest;
    return minutes < 60 && rest < 61.0;
}

/* ---- the rest ---- */

bool hci_csv_fraction(const char *cell, double *value)
{
    long above, below;
    if (!read_whole(&cell, 6, &above) || !pass(&cell, '/') || !read_whole(&cell, 6, &below)) return false;
    if (*cell != '\0' || below == 0) return false;
    *value = (double)above / (double)below;
    return true;
}

bool hci_csv_number_and_unit(const char *cell, double *value, char *mark, const hci_unit **unit)
{
    char number[CELL_SIZE];
    size_t length = strspn(cell, "+-.,0123456789");
    if ((cell[length] == 'e' || cell[length] == 'E') && strspn(cell + length + 1, "+-0123456789") > 0)
        length += 1 + strspn(cell + length + 1, "+-0123456789");
    if (length == 0 || length >= sizeof number) return false;
    memcpy(number, cell, length);
    number[length] = '\0';
    if (hci_number_read(number, true, value, mark) != HCI_NUMBER_FINITE) return false;
    *unit = hci_csv_cell_unit(cell + length + strspn(cell + length, " "));
    return *unit != NULL;
}

bool hci_csv_is_number(const char *cell)
{
    double value, days;
    char mark;
    if (hci_number_read(cell, true, &value, &mark) != HCI_NUMBER_NONE) return true;
    const hci_marks marks = hci_marks_of(cell);
    return marks.group != 0 || hci_csv_clock(cell, &days, &value);
}
