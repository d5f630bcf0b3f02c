/* Words in files and options, compared without regard to case. */
#ifndef HCI_HOST_BASE_TEXT_H
#define HCI_HOST_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whether two words are the same but for the case of ASCII letters. */
bool hci_text_is(const char *text, const char *word);

/* Whether `text` begins with the first `length` bytes of `start`, but for the case of ASCII letters. */
bool hci_text_begins(const char *text, const char *start, size_t length);

#ifdef __cplusplus
}
#endif

#endif
