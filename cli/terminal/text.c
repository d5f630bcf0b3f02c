#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/text.h"

#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/terminal.h"
#include "hci/host/base/utf8.h"

enum { LONGEST_TEXT = 8192 };

size_t cli_text_width(const char *text)
{
    size_t width = 0;
    for (; *text; ++text)
        width += (unsigned char)*text >= ' ' && hci_utf8_begins(*text);
    return width;
}

const char *cli_text_end(const char *text, size_t most)
{
    for (size_t width = cli_text_width(text); width > most; --width)
        while (!hci_utf8_begins(*++text))
            ;
    return text;
}

/* What a terminal of another locale would show as two wrong letters. */
static const char *ascii_of(const char *text)
{
    static const char *const PAIRS[][2] = {
        {"·", "*"},     {"±", "+-"},    {"×", "x"},     {"–", "-"},  {"−", "-"},    {"…", "..."},
        {"Δ", "d"},     {"°", "deg"},   {"²", "^2"},    {"³", "^3"}, {"µ", "u"},    {"Ω", "ohm"},
        {"θ", "theta"}, {"ω", "omega"}, {"γ", "gamma"}, {"π", "pi"}, {"τ", "tau"},  {"χ", "chi"},
        {"ψ", "psi"},   {"½", "1/2"},   {"≤", "<="},    {"≥", ">="}, {"√", "sqrt"}, {"→", "->"},
        {"“", "\""},    {"”", "\""},
    };
    for (size_t k = 0; k < sizeof PAIRS / sizeof *PAIRS; ++k)
        if (strncmp(text, PAIRS[k][0], strlen(PAIRS[k][0])) == 0) return PAIRS[k][1];
    return "?";
}

static void put_style(char style, FILE *stream)
{
    static const char *const CODES[] = {"32;1", "33;1", "31;1", "0"};
    if (cli_has_color(fileno(stream))) fprintf(stream, "\033[%sm", CODES[style - 1]);
}

/* A text in ASCII; what does not fit into `size` bytes is left out. */
static const char *in_ascii(const char *text, char *plain, size_t size)
{
    size_t used = 0;
    for (; *text; ++text) {
        const char letter[] = {*text, '\0'};
        const char *part = (unsigned char)*text < 0x80 ? letter : ascii_of(text);
        if (hci_utf8_begins(*text) && used + strlen(part) < size) used += strlen(strcpy(plain + used, part));
    }
    plain[used] = '\0';
    return plain;
}

/* Whether the character that a text begins with drives a terminal (C0, DEL, C1), or is none. */
static bool is_no_text(const char *text)
{
    uint32_t code;
    return hci_utf8_decode(text, &code) == 0 || code < 0x20 || (code >= 0x7F && code < 0xA0);
}

/* `length` bytes, whole characters; what would drive a terminal is no text. */
static void put_text(const char *text, size_t length, FILE *stream)
{
    for (size_t k = 0; k < length;) {
        const size_t bytes = hci_utf8_length(text + k);
        if (text[k] >= CLI_GOOD[0] && text[k] <= CLI_PLAIN[0])
            put_style(text[k], stream);
        else if (is_no_text(text + k))
            fputc('?', stream);
        else
            fwrite(text + k, 1, bytes, stream);
        k += bytes > 0 ? bytes : 1;
    }
}

/* Bytes of a text up to the last blank within `width` columns; a word that is too long stays whole. */
static size_t fitting(const char *text, size_t width)
{
    size_t columns = 0, best = 0, k = strspn(text, " ");
    for (columns = k; text[k]; ++k) {
        if (text[k] == ' ' && (columns <= width || best == 0)) best = k;
        if (columns > width && best > 0) return best;
        columns += (unsigned char)text[k] >= ' ' && hci_utf8_begins(text[k]);
    }
    return columns > width && best > 0 ? best : k;
}

void cli_print_wrapped(FILE *stream, int width, int used, int indent, const char *text)
{
    char plain[LONGEST_TEXT] = "";
    if (isatty(fileno(stream)) && !cli_is_utf8()) text = in_ascii(text, plain, sizeof plain);
    while (*text) {
        const size_t length = fitting(text, width > used ? (size_t)(width - used) : 0);
        put_text(text, length, stream);
        fputc('\n', stream);
        text += length + strspn(text + length, " ");
        used = indent;
        if (*text) fprintf(stream, "%*s", indent, "");
    }
}
