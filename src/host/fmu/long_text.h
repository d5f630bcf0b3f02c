/* A text that grows. */
#ifndef HCI_SRC_HOST_FMU_LONG_TEXT_H
#define HCI_SRC_HOST_FMU_LONG_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"

/* Start with {0}; to be given to hci_long_text_release. */
typedef struct {
    char *text; /* NULL while there is none */
    size_t size, room;
    bool failed; /* memory was out: the text is not whole */
} hci_long_text;

void hci_long_text_add(hci_long_text *text, const char *format, ...) HCI_PRINTF(2, 3);

/* A number that reads back to the same double, as C and XML have it; what is not finite as 0. */
void hci_long_text_number(hci_long_text *text, double value);

void hci_long_text_release(hci_long_text *text);

#endif
