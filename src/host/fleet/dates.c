#include "host/fleet/dates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    int number[3], digits[3];
    char between;
} parts;

/* Three numbers with the same sign between them, and behind them nothing or a time. */
static int split(const char *date, parts *p)
{
    char second = '\0';
    int at[3] = {0}, end = 0, from = 0;
    if (sscanf(date, "%4d%n%c%2d%n%c%n%4d%n", &p->number[0], &at[0], &p->between, &p->number[1], &at[1],
               &second, &from, &p->number[2], &end) != 5)
        return 0;
    p->digits[0] = at[0];
    p->digits[1] = at[1] - at[0] - 1;
    p->digits[2] = end - from;
    return p->between == second && strchr("-./", second) &&
           (date[end] == '\0' || date[end] == ' ' || date[end] == 'T') && date[0] != '-' && date[0] != '+';
}

hci_date_order hci_date_order_of(const char *date)
{
    parts p;
    if (!split(date, &p) || p.digits[0] > 2 || p.digits[2] != 4) return HCI_DATE_NONE;
    if (p.between == '.' || p.number[0] > 12) return HCI_DATE_DAY_FIRST;
    return p.number[1] > 12 ? HCI_DATE_MONTH_FIRST : HCI_DATE_OPEN;
}

static int days_of(int year, int month)
{
    const int is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return month == 2 ? 28 + is_leap : 30 + (month + month / 8) % 2;
}

static double day_of(int year, int month, int day)
{
    if (month < 1 || month > 12 || day < 1 || day > days_of(year, month)) return NAN;
    const int shifted = year - (month <= 2),
              in_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
    return 365.0 * shifted + shifted / 4 - shifted / 100 + shifted / 400 + in_year;
}

double hci_date_day(const char *date, hci_date_order order)
{
    parts p;
    const hci_date_order own = hci_date_order_of(date);
    if (!split(date, &p)) return NAN;
    if (p.digits[0] == 4 && p.digits[2] <= 2) return day_of(p.number[0], p.number[1], p.number[2]);
    if (own == HCI_DATE_NONE) return NAN;
    if (own == HCI_DATE_OPEN && p.number[0] != p.number[1] && order == HCI_DATE_OPEN) return NAN;
    const int is_month_first = (own == HCI_DATE_OPEN ? order : own) == HCI_DATE_MONTH_FIRST;
    return day_of(p.number[2], p.number[is_month_first ? 0 : 1], p.number[is_month_first ? 1 : 0]);
}
