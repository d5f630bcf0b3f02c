#include "cli/terminal/say.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"

enum { WIDEST_TEXT = 96, WORDS_AT = 15, LINE_SIZE = 8192 };

static char line[LINE_SIZE]; /* what is said of it until it ends */
static size_t line_used;

/* Where a long line goes on: below its words, after a key or without one. */
static int indent_of(const char *text, size_t blanks)
{
    const bool keyed =
        blanks == 2 && strlen(text) > WORDS_AT && text[WORDS_AT - 1] == ' ' && text[WORDS_AT] != ' ';
    return keyed ? WORDS_AT : (int)blanks + 2;
}

/* A command is to be copied, and stays in one piece. */
static void show_line(const char *text)
{
    const size_t blanks = strspn(text, " ");
    const bool command = blanks > 0 && strncmp(text + blanks, "hci-solve ", 10) == 0;
    const int width = cli_is_terminal() && !command ? cli_width(STDERR_FILENO) : LINE_SIZE;
    if (*text)
        cli_print_wrapped(stderr, width, 0, indent_of(text, blanks), text);
    else
        fputc('\n', stderr);
}

void cli_say(const char *format, ...)
{
    va_list arguments;
    char *end;
    va_start(arguments, format);
    vsnprintf(line + line_used, LINE_SIZE - line_used, format, arguments);
    va_end(arguments);
    while ((end = strchr(line, '\n')) != NULL) {
        *end = '\0';
        show_line(line);
        memmove(line, end + 1, strlen(end + 1) + 1);
    }
    line_used = strlen(line);
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
    cli_line_erase();
    cli_say(CLI_BAD "hci-solve:" CLI_PLAIN " %s\n", note->text[0] ? note->text : hci_status_text(status));
    return hci_status_exit_code(status);
}

void cli_remark(const hci_note *remark)
{
    if (remark->text[0] && cli_is_wordy())
        cli_say("hci-solve: " CLI_WARN "note:" CLI_PLAIN " %s\n", remark->text);
}
