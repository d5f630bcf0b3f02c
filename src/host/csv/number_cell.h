/* Numbers as they stand in cells: marks between thousands, decimal marks, clock times, fractions. */
#ifndef HCI_SRC_HOST_CSV_NUMBER_CELL_H
#define HCI_SRC_HOST_CSV_NUMBER_CELL_H

#include <stdbool.h>

#include "host/base/unit_lookup.h"

/* What the marks in a number are. Without any, or where it is no number, all are 0. */
typedef struct {
    char decimal;  /* '.' or ',': certainly the decimal mark */
    char group;    /* '.', ',', ' ' or '\'': certainly between thousands */
    char doubtful; /* '.' or ',': as in 1.234, may be either */
} hci_marks;

/* Blanks, also narrow and protected ones, and apostrophes stand between thousands only; a mark that is there
 * twice does, and then the other is decimal; groups have three digits and no 0 before them. */
hci_marks hci_marks_of(const char *cell);

/* A number whose decimal mark is known, without its marks between thousands; false: it is none, or has other
 * marks. Not finite is not a number here. */
bool hci_csv_grouped_number(const char *cell, char decimal, double *value);

/* A date and a time of the day, or a time alone, in seconds: "12:00:01.5", "00:01.5" (minutes), with AM or
 * PM, and before it "2024-03-01" with T or a blank or "01.03.2024", whose days count from 1970, or
 * "3/1/2024", whose day does not; a zone behind it does not count. */
bool hci_csv_clock(const char *cell, double *days, double *seconds);

/* "24/7": whole numbers from 0, and above 0 below the line. */
bool hci_csv_fraction(const char *cell, double *value);

/* "1.001 sec", "12 A": a number and a unit. mark: out, its decimal mark, 0: none. */
bool hci_csv_number_and_unit(const char *cell, double *value, char *mark, const hci_unit **unit);

/* Is it any of these but the last, or a plain number with either decimal mark, or nan or inf? */
bool hci_csv_is_number(const char *cell);

#endif
