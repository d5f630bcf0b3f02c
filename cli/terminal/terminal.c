#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/terminal.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { UNKNOWN_WIDTH = 80, LEAST_WIDTH = 40 };

static struct {
    bool quiet, json;
    cli_color color;
    volatile sig_atomic_t line_is_shown;
} terminal;

/* ---- what the streams are ---- */

static const char *environment(const char *name)
{
    const char *value = getenv(name);
    return value ? value : "";
}

bool cli_is_terminal(int descriptor)
{
    const char *kind = environment("TERM");
    return isatty(descriptor) && kind[0] != '\0' && strcmp(kind, "dumb") != 0;
}

bool cli_has_color(int descriptor)
{
    if (terminal.color != CLI_COLOR_AUTO) return terminal.color == CLI_COLOR_ALWAYS;
    return cli_is_terminal(descriptor) && environment("NO_COLOR")[0] == '\0';
}

/* Whether a part stands in a text, in capitals or not. */
static bool contains(const char *text, const char *part)
{
    for (; *text; ++text)
        if (strncasecmp(text, part, strlen(part)) == 0) return true;
    return false;
}

/* The locale is asked for by name, so that no function of the C library changes its ways. */
bool cli_is_utf8(void)
{
    const char *locale = environment("LC_ALL");
    if (locale[0] == '\0') locale = environment("LC_CTYPE");
    if (locale[0] == '\0') locale = environment("LANG");
    return contains(locale, "utf-8") || contains(locale, "utf8");
}

bool cli_is_ascii(int descriptor)
{
    return !cli_is_terminal(descriptor) || !cli_is_utf8();
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

void cli_terminal_begin(bool quiet, bool json, cli_color color)
{
    terminal.quiet = quiet;
    terminal.json = json;
    terminal.color = color;
}

bool cli_is_wordy(void)
{
    return !terminal.quiet && !terminal.json;
}

bool cli_is_quiet(void)
{
    return terminal.quiet;
}

bool cli_is_json(void)
{
    return terminal.json;
}

/* ---- a line that the next one replaces ---- */

static const char ERASE[] = "\r\033[K";

void cli_line_show(const char *line)
{
    terminal.line_is_shown = 1;
    fprintf(stderr, "%s%s", ERASE, line);
}

bool cli_line_is_shown(void)
{
    return terminal.line_is_shown;
}

void cli_line_erase(void)
{
    if (terminal.line_is_shown) fputs(ERASE, stderr);
    terminal.line_is_shown = 0;
}

void cli_line_erase_in_handler(void)
{
    if (terminal.line_is_shown && write(STDERR_FILENO, ERASE, sizeof ERASE - 1) < 0)
        terminal.line_is_shown = 0;
}
