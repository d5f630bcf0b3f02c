/* UTF-8 (RFC 3629): the one decoder, for whoever shows, checks or cuts a text. */
#ifndef HCI_HOST_BASE_UTF8_H
#define HCI_HOST_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The character that `text` begins with; code: out, its number in Unicode. Returns its length in bytes, 1 to
 * 4, or 0 where the bytes are not UTF-8: a byte that cannot begin a character, a sequence that ends too early
 * or is longer than it need be, a surrogate, or a number above 0x10FFFF. text: ends with a NUL, which is a
 * character of its own (1 byte, number 0). */
size_t hci_utf8_decode(const char *text, uint32_t *code);

/* Its length alone. */
size_t hci_utf8_length(const char *text);

/* Whether all of a text is UTF-8. */
bool hci_utf8_valid(const char *text);

/* Whether a byte begins a character, and does not go on with one: what is counted for the width of a text,
 * and where it may be cut. */
bool hci_utf8_begins(char byte);

#ifdef __cplusplus
}
#endif

#endif
