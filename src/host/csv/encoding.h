/* From the encodings that spreadsheets save in to UTF-8. */
#ifndef HCI_SRC_HOST_CSV_ENCODING_H
#define HCI_SRC_HOST_CSV_ENCODING_H

#include <stdbool.h>
#include <stddef.h>

/* What a file was saved in. HCI_ENCODING_OTHER: bytes that are neither UTF-8 nor a text in Windows-1252; what
 * is told of them is for who finds them in a cell. */
typedef enum {
    HCI_ENCODING_UTF8,
    HCI_ENCODING_UTF16_LITTLE,
    HCI_ENCODING_UTF16_BIG,
    HCI_ENCODING_WINDOWS_1252,
    HCI_ENCODING_OTHER
} hci_encoding;

/* Of `size` bytes. UTF-16 is known by its mark, or by its zero bytes beside the first two characters. A text
 * is Windows-1252, of which Latin-1 is a part, where no byte above 127 is part of a character in UTF-8. */
hci_encoding hci_encoding_of(const char *bytes, size_t size);

/* The same text in UTF-8 without a mark, ended by a NUL, to be freed with hci_memory_free; NULL when memory
 * is out. encoding: not UTF8, not OTHER. size: in bytes; out, of what is returned. Half of a pair of UTF-16
 * becomes U+FFFD. */
char *hci_encoding_to_utf8(hci_encoding encoding, const char *bytes, size_t *size);

#endif
