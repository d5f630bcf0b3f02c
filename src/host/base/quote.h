/* Text from a file or a command line, made safe to show in a message. */
#ifndef HCI_SRC_HOST_BASE_QUOTE_H
#define HCI_SRC_HOST_BASE_QUOTE_H

enum { HCI_QUOTE_SIZE = 96, HCI_QUOTE_PATH_SIZE = 320 };

/* `text` between backticks; control characters and bytes that are not UTF-8 as \xNN; cut with "…" when long.
 */
const char *hci_quote(const char *text, char out[HCI_QUOTE_SIZE]);

/* A path without backticks; a long one loses its beginning. */
const char *hci_quote_path(const char *path, char out[HCI_QUOTE_PATH_SIZE]);

/* In place: control characters and bytes that are not UTF-8 become `?`, one for each byte. */
void hci_quote_mask(char *text);

#endif
