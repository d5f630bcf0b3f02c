#include "host/csv/encoding.h"

#include <stdint.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/base/memory.h"

/* ---- which it is ---- */

static hci_encoding utf16_of(const char *bytes, size_t size)
{
    if (size < 2) return HCI_ENCODING_UTF8;
    if (memcmp(bytes, "\xFF\xFE", 2) == 0) return HCI_ENCODING_UTF16_LITTLE;
    if (memcmp(bytes, "\xFE\xFF", 2) == 0) return HCI_ENCODING_UTF16_BIG;
    if (size < 4 || size % 2 != 0) return HCI_ENCODING_UTF8;
    const bool zero[4] = {!bytes[0], !bytes[1], !bytes[2], !bytes[3]};
    if (!zero[0] && zero[1] && !zero[2] && zero[3]) return HCI_ENCODING_UTF16_LITTLE;
    return zero[0] && !zero[1] && zero[2] && !zero[3] ? HCI_ENCODING_UTF16_BIG : HCI_ENCODING_UTF8;
}

/* Unicode of the bytes 0x80 to 0x9F; 0: none. */
static const uint16_t WINDOWS_1252[32] = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                          0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                          0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                          0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

static uint32_t of_windows_1252(unsigned char byte)
{
    return byte >= 0x80 && byte <= 0x9F ? WINDOWS_1252[byte - 0x80] : byte;
}

static bool is_control(unsigned char byte)
{
    return byte < 0x20 && (byte == 0 || strchr("\t\n\v\f\r", byte) == NULL);
}

static hci_encoding of_bytes(const char *bytes, size_t size)
{
    bool above = false, text = true, utf8 = false;
    for (size_t k = 0; k < size && !(k > 0 && bytes[k] == '\0');) {
        const unsigned char byte = (unsigned char)bytes[k];
        const size_t length = byte < 0x80 ? 1 : hci_utf8_length(bytes + k);
        above = above || length == 0;
        utf8 = utf8 || length > 1;
        text = text && !is_control(byte) && of_windows_1252(byte) != 0;
        k += length == 0 ? 1 : length;
    }
    if (!above) return HCI_ENCODING_UTF8;
    return text && !utf8 ? HCI_ENCODING_WINDOWS_1252 : HCI_ENCODING_OTHER;
}

hci_encoding hci_encoding_of(const char *bytes, size_t size)
{
    const hci_encoding utf16 = utf16_of(bytes, size);
    return utf16 != HCI_ENCODING_UTF8 ? utf16 : of_bytes(bytes, size);
}

/* ---- to UTF-8 ---- */

enum { REPLACEMENT = 0xFFFD };

static size_t put(char *out, uint32_t code)
{
    if (code < 0x80) {
        *out = (char)code;
        return 1;
    }
    const size_t length = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t k = length - 1; k > 0; --k, code >>= 6)
        out[k] = (char)(0x80u | (code & 0x3Fu));
    out[0] = (char)((0xF00u >> length & 0xF0u) | code);
    return length;
}

static uint32_t unit_at(bool big, const char *bytes, size_t k)
{
    const uint32_t first = (unsigned char)bytes[k], second = (unsigned char)bytes[k + 1];
    return big ? first << 8 | second : second << 8 | first;
}

/* One character of UTF-16; *k: moved on. */
static uint32_t utf16_at(bool big, const char *bytes, size_t size, size_t *k)
{
    const uint32_t high = unit_at(big, bytes, *k);
    *k += 2;
    if (high < 0xD800 || high > 0xDFFF) return high;
    const uint32_t low = high < 0xDC00 && *k + 1 < size ? unit_at(big, bytes, *k) : 0;
    if (low < 0xDC00 || low > 0xDFFF) return REPLACEMENT;
    *k += 2;
    return 0x10000 + ((high - 0xD800) << 10 | (low - 0xDC00));
}

static size_t convert(hci_encoding encoding, const char *bytes, size_t size, char *out)
{
    const bool wide = encoding != HCI_ENCODING_WINDOWS_1252, big = encoding == HCI_ENCODING_UTF16_BIG;
    size_t used = 0, k = wide && unit_at(big, bytes, 0) == 0xFEFF ? 2 : 0;
    while (k + (wide ? 1 : 0) < size)
        used += put(out + used,
                    wide ? utf16_at(big, bytes, size, &k) : of_windows_1252((unsigned char)bytes[k++]));
    out[used] = '\0';
    return used;
}

char *hci_encoding_to_utf8(hci_encoding encoding, const char *bytes, size_t *size)
{
    char *out = hci_memory_new(*size + 1, 3);
    if (out != NULL) *size = convert(encoding, bytes, *size, out);
    return out;
}
