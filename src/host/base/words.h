/* One sentence after the other, in a text of fixed size. */
#ifndef HCI_SRC_HOST_BASE_WORDS_H
#define HCI_SRC_HOST_BASE_WORDS_H

#include <stdarg.h>
#include <stddef.h>

#include "hci/host/base/note.h"

/* Where words go. size: of the text with its end, at least 1. */
typedef struct {
    char *text;
    size_t size;
} hci_words;

/* Appends, as printf and vprintf do. What has no room is cut off behind a whole character. */
void hci_words_say(const hci_words *words, const char *format, ...) HCI_PRINTF(2, 3);
void hci_words_say_list(const hci_words *words, const char *format, va_list arguments) HCI_PRINTF(2, 0);

#endif
