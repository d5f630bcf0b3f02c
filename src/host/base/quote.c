#include "host/base/quote.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"

/* Control characters drive terminals: C0, DEL, and C1 (U+0080 to U+009F, 0xC2 0x80 …). */
static bool is_control(const char *text)
{
    const unsigned char c = (unsigned char)text[0];
    return c < 0x20 || c == 0x7F || (c == 0xC2 && (unsigned char)text[1] < 0xA0);
}

/* Appends `text` to out[used] until it ends or out[limit] would be passed; returns the new length. */
static size_t append_safe(char *out, size_t used, size_t limit, const char **text)
{
    while (**text != '\0') {
        size_t length = hci_utf8_length(*text);
        const bool plain = length > 0 && !is_control(*text);
        const size_t room = plain ? length : 4;
        if (used + room > limit) break;
        if (plain) {
            memcpy(out + used, *text, length);
        } else {
            snprintf(out + used, room + 1, "\\x%02x", (unsigned)(unsigned char)**text);
            length = 1;
        }
        used += room;
        *text += length;
    }
    return used;
}

static const char ellipsis[] = "\xE2\x80\xA6";

const char *hci_quote(const char *text, char out[HCI_QUOTE_SIZE])
{
    out[0] = '`';
    const size_t used = append_safe(out, 1, HCI_QUOTE_SIZE - sizeof ellipsis - 1, &text);
    snprintf(out + used, HCI_QUOTE_SIZE - used, "%s`", *text != '\0' ? ellipsis : "");
    return out;
}

const char *hci_quote_path(const char *path, char out[HCI_QUOTE_PATH_SIZE])
{
    const size_t keep = HCI_QUOTE_PATH_SIZE / 2, length = strlen(path);
    size_t used = 0;
    if (length > keep) {
        used = sizeof ellipsis - 1;
        memcpy(out, ellipsis, used);
        path += length - keep;
        while (!hci_utf8_begins(*path))
            path++;
    }
    used = append_safe(out, used, HCI_QUOTE_PATH_SIZE - 1, &path);
    out[used] = '\0';
    return out;
}

void hci_quote_mask(char *text)
{
    while (*text != '\0') {
        const size_t length = hci_utf8_length(text);
        const bool plain = length > 0 && !is_control(text);
        if (!plain) memset(text, '?', length > 0 ? length : 1);
        text += length > 0 ? length : 1;
    }
}
