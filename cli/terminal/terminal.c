#define _POSIX_C_SOURCE 200809L

#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "hci/host/base/utf8.h"

enum { UNKNOWN_WIDTH = 80, LEAST_WIDTH = 40, WIDEST_TEXT = 96, WORDS_AT = 15, LINE_SIZE = 8192 };

static struct {
    bool quiet, json;
    enum { COLOR_AUTO, COLOR_ALWAYS, COLOR_NEVER } color;
    char line[LINE_SIZE]; /* until it ends */
    size_t used;
} terminal;

/* ---- what standard error is ---- */

static const char *environment(const char *name)
{
    const char *value = getenv(name);
    return value ? value : "";
}

bool cli_is_terminal(void)
{
    const char *kind = environment("TERM");
    return isatty(STDERR_FILENO) && kind[0] != '\0' && strcmp(kind, "dumb") != 0;
}

static bool has_color(void)
{
    if (terminal.color != COLOR_AUTO) return terminal.color == COLOR_ALWAYS;
    return cli_is_terminal() && environment("NO_COLOR")[0] == '\0';
}

static bool has(const char *text, const char *part)
{
    for (; *text; ++text)
        if (strncasecmp(text, part, strlen(part)) == 0) return true;
    return false;
}

/* The locale is asked for by name, so that no function of the C library changes its ways. */
static bool is_utf8(void)
{
    const char *locale = environment("LC_ALL");
    if (locale[0] == '\0') locale = environment("LC_CTYPE");
    if (locale[0] == '\0') locale = environment("LANG");
    return has(locale, "utf-8") || has(locale, "utf8");
}

bool cli_is_ascii(void)
{
    return !cli_is_terminal() || !is_utf8();
}

int cli_width(int descriptor)
{
    struct winsize size;
    const long columns = strtol(environment("COLUMNS"), NULL, 10);
    int width = UNKNOWN_WIDTH;
    if (columns > 0 && columns < 10000)
        width = (int)columns;
    else if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        width = size.ws_col;
    return width < LEAST_WIDTH ? LEAST_WIDTH : width;
}

hci_status cli_terminal_begin(const cli_command *command, const cli_arguments *a, hci_note *note)
{
    static const char *const COLORS[] = {"auto", "always", "never", NULL};
    const int quiet = cli_option_find(command, "quiet"), json = cli_option_find(command, "json"),
              color = cli_option_find(command, "color");
    int choice = COLOR_AUTO;
    terminal.quiet = quiet >= 0 && a->given[quiet];
    terminal.json = json >= 0 && a->given[json];
    const hci_status status =
        color >= 0 && a->value[color] ? cli_choice("color", a->value[color], COLORS, &choice, note) : HCI_OK;
    terminal.color = choice == 1 ? COLOR_ALWAYS : choice == 2 ? COLOR_NEVER : COLOR_AUTO;
    return status;
}

bool cli_is_wordy(void)
{
    return !terminal.quiet && !terminal.json;
}

bool cli_is_quiet(void)
{
    return terminal.quiet;
}

/* ---- one line ---- */

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
    if (has_color()) fprintf(stream, "\033[%sm", CODES[style - 1]);
}

/* `length` bytes; what would drive a terminal is no text. */
static void put_text(const char *text, size_t length, FILE *stream)
{
    const bool ascii = isatty(fileno(stream)) && !is_utf8();
    for (size_t k = 0; k < length; ++k) {
        const char *plain = ascii && (unsigned char)text[k] >= 0x80 ? ascii_of(text + k) : NULL;
        if (text[k] >= CLI_GOOD[0] && text[k] <= CLI_PLAIN[0])
            put_style(text[k], stream);
        else if (plain)
            fputs(plain, stream);
        else
            fputc((unsigned char)text[k] < ' ' || text[k] == 0x7F ? '?' : text[k], stream);
        while (plain && k + 1 < length && !hci_utf8_begins(text[k + 1]))
            ++k;
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
    while (*text) {
        const size_t length = fitting(text, width > used ? (size_t)(width - used) : 0);
        put_text(text, length, stream);
        fputc('\n', stream);
        text += length + strspn(text + length, " ");
        used = indent;
        if (*text) fprintf(stream, "%*s", indent, "");
    }
}

/* Where a long line goes on: below its words, after a key or without one. */
static int indent_of(const char *line, size_t blanks)
{
    const bool keyed =
        blanks == 2 && strlen(line) > WORDS_AT && line[WORDS_AT - 1] == ' ' && line[WORDS_AT] != ' ';
    return keyed ? WORDS_AT : (int)blanks + 2;
}

/* A command is to be copied, and stays in one piece. */
static void show_line(const char *line)
{
    const size_t blanks = strspn(line, " ");
    const bool command = blanks > 0 && strncmp(line + blanks, "hci-solve ", 10) == 0;
    const int width = cli_is_terminal() && !command ? cli_width(STDERR_FILENO) : LINE_SIZE;
    if (*line)
        cli_print_wrapped(stderr, width, 0, indent_of(line, blanks), line);
    else
        fputc('\n', stderr);
}

void cli_say(const char *format, ...)
{
    va_list arguments;
    char *end;
    va_start(arguments, format);
    vsnprintf(terminal.line + terminal.used, LINE_SIZE - terminal.used, format, arguments);
    va_end(arguments);
    while ((end = strchr(terminal.line, '\n')) != NULL) {
        *end = '\0';
        show_line(terminal.line);
        memmove(terminal.line, end + 1, strlen(end + 1) + 1);
    }
    terminal.used = strlen(terminal.line);
}

void cli_say_paragraph(int indent, const char *text)
{
    const int width = cli_width(STDERR_FILENO);
    fprintf(stderr, "%*s", indent, "");
    cli_print_wrapped(stderr, width < WIDEST_TEXT ? width : WIDEST_TEXT, indent, indent, text);
}

/* ---- errors and remarks ---- */

int cli_fail(hci_status status, const hci_note *note)
{
    cli_progress_end();
    cli_say(CLI_BAD "hci-solve:" CLI_PLAIN " %s\n", note->text[0] ? note->text : hci_status_text(status));
    return hci_status_exit_code(status);
}

void cli_remark(const hci_note *remark)
{
    if (remark->text[0] && cli_is_wordy())
        cli_say("hci-solve: " CLI_WARN "note:" CLI_PLAIN " %s\n", remark->text);
}
