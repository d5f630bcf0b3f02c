#include "hci/host/base/utf8.h"

bool hci_utf8_begins(char byte)
{
    return ((unsigned char)byte & 0xC0u) != 0x80u;
}

size_t hci_utf8_decode(const char *text, uint32_t *code)
{
    static const uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char lead = (unsigned char)text[0];
    *code = lead;
    if (lead < 0x80) return 1;
    const size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
    if (length == 0 || lead > 0xF4) return 0;
    *code = lead & (0xFFu >> (length + 1));
    for (size_t i = 1; i < length; i++) {
        if (hci_utf8_begins(text[i])) return 0;
        *code = *code << 6 | ((unsigned char)text[i] & 0x3Fu);
    }
    const bool surrogate = *code >= 0xD800 && *code <= 0xDFFF;
    return *code < smallest[length] || *code > 0x10FFFF || surrogate ? 0 : length;
}

size_t hci_utf8_length(const char *text)
{
    uint32_t code;
    return hci_utf8_decode(text, &code);
}

bool hci_utf8_valid(const char *text)
{
    size_t length = 1;
    for (; *text != '\0' && length > 0; text += length)
        length = hci_utf8_length(text);
    return length > 0;
}
