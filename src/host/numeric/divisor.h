/* The greatest common divisor. */
#ifndef HCI_SRC_HOST_NUMERIC_DIVISOR_H
#define HCI_SRC_HOST_NUMERIC_DIVISOR_H

#include <stddef.h>

/* Of two numbers; with 0 the other one. */
size_t hci_common_divisor(size_t a, size_t b);

#endif
