#include "hci/host/base/note.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "host/base/quote.h"

static bool is_continuation(char c)
{
    return ((unsigned char)c & 0xC0u) == 0x80u;
}

size_t hci_utf8_length(const char *text)
{
    static const uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char lead = (unsigned char)text[0];
    if (lead < 0x80) return 1;
    const size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    if (length == 0 || lead > 0xF4) return 0;
    uint32_t code = lead & (0xFFu >> (length + 1));
    for (size_t i = 1; i < length; i++) {
        if (!is_continuation(text[i])) return 0;
        code = code << 6 | ((unsigned char)text[i] & 0x3Fu);
    }
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    return code < smallest[length] || code > 0x10FFFF || surrogate ? 0 : length;
}

bool hci_utf8_valid(const char *text)
{
    size_t length = 1;
    for (; *text != '\0' && length > 0; text += length)
        length = hci_utf8_length(text);
    return length > 0;
}

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
        while (is_continuation(*path))
            path++;
    }
    used = append_safe(out, used, HCI_QUOTE_PATH_SIZE - 1, &path);
    out[used] = '\0';
    return out;
}

/* Drops a UTF-8 sequence that vsnprintf has cut in two. */
static void mend_end(char *text)
{
    size_t lead = strlen(text);
    while (lead > 0 && is_continuation(text[lead - 1]))
        lead--;
    if (lead > 0 && hci_utf8_length(text + lead - 1) == 0) text[lead - 1] = '\0';
}

hci_status hci_note_set(hci_note *note, hci_status status, const char *format, ...)
{
    if (note == NULL || note->text[0] != '\0') return status;
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(note->text, sizeof note->text, format, arguments);
    va_end(arguments);
    if (length < 0) note->text[0] = '\0';
    if (length >= (int)sizeof note->text) mend_end(note->text);
    return status;
}

void hci_note_add(hci_note *remark, const char *format, ...)
{
    char *text = remark->text;
    const size_t used = strlen(text), size = sizeof remark->text;
    va_list arguments;
    va_start(arguments, format);
    const size_t start = used + (size_t)snprintf(text + used, size - used, "%s", used > 0 ? "; " : "");
    if (start < size) vsnprintf(text + start, size - start, format, arguments);
    va_end(arguments);
    mend_end(text);
}
