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

/* Text to double; the whole text must be a finite number. */
bool hci_number_parse(const char *text, double *value);

#ifdef __cplusplus
}
#endif

#endif
