/* Dates as lists have them: 2026-10-05, 2026/10/5, 05.10.2026, 2026-10-05T08:00; and 05/10/2026 where one
 * date of the list says which number is the month. */
#ifndef HCI_SRC_HOST_FLEET_DATES_H
#define HCI_SRC_HOST_FLEET_DATES_H

/* What the numbers of a date with the year last are. */
typedef enum {
    HCI_DATE_OPEN,        /* either */
    HCI_DATE_DAY_FIRST,   /* one above 12 says so, or points between them */
    HCI_DATE_MONTH_FIRST, /* one above 12 says so */
    HCI_DATE_NONE         /* year first, or no date */
} hci_date_order;

hci_date_order hci_date_order_of(const char *date);

/* Days since a day long ago, of the proleptic Gregorian calendar. order: of dates that leave it open;
 * HCI_DATE_OPEN: not known. NAN: not read. */
double hci_date_day(const char *date, hci_date_order order);

#endif
