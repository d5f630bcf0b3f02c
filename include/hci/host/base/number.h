/* Numbers as text, without regard to the locale. */
#ifndef HCI_HOST_BASE_NUMBER_H
#define HCI_HOST_BASE_NUMBER_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Shortest decimal text that reads back to the same double, with a point for the decimal mark in any locale;
 * buffer of 32 bytes. */
void hci_number_text(double value, char text[32]);

enum { HCI_PERCENT_SIZE = 32 };

/* A percentage in sentences, with so many digits and never with an exponent: "120", "0.00012", "< 0.000001",
 * "> 1000000000". Returns text. */
const char *hci_percent_text(double percent, int digits, char text[HCI_PERCENT_SIZE]);

/* The same in a buffer of the block around it. */
#define HCI_PERCENT(percent, digits) hci_percent_text(percent, digits, (char[HCI_PERCENT_SIZE]){0})

/* Text to double; the whole text must be a finite number. */
bool hci_number_parse(const char *text, double *value);

#ifdef __cplusplus
}
#endif

#endif
