/* Reading one decimal number, fast and without regard to the locale. */
#ifndef HCI_SRC_HOST_BASE_NUMBER_READ_H
#define HCI_SRC_HOST_BASE_NUMBER_READ_H

#include <stdbool.h>

typedef enum { HCI_NUMBER_FINITE, HCI_NUMBER_NOT_FINITE, HCI_NUMBER_NONE } hci_number_kind;

/* What the whole of `text` is. comma: whether ',' is a decimal mark too. value: out when finite, the nearest
 * double; mark: out, the decimal mark that was found or 0. A number too large for a double, nan and inf are
 * "not finite"; one that is too small is 0. */
hci_number_kind hci_number_read(const char *text, bool comma, double *value, char *mark);

#endif
