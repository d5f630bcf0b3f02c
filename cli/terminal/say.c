#define _POSIX_C_SOURCE 200809L

#include "cli/terminal/say.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/report/summary.h"

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

/* A command is to be copied, and stays in one piece. What went to the other stream before stands before. */
static void show_line(FILE *stream, const char *text)
{
    const size_t blanks = strspn(text, " ");
    const bool command = blanks > 0 && strncmp(text + blanks, "hci-solve ", 10) == 0;
    const int width = cli_is_terminal(fileno(stream)) && !command ? cli_width(fileno(stream)) : LINE_SIZE;
    cli_line_erase();
    if (stream == stderr) fflush(stdout);
    if (*text)
        cli_print_wrapped(stream, width, 0, indent_of(text, blanks), text);
    else
        fputc('\n', stream);
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
        show_line(stdout, line);
        memmove(line, end + 1, strlen(end + 1) + 1);
    }
    line_used = strlen(line);
}

void cli_say_paragraph(int indent, const char *text)
{
    const int width = cli_width(STDOUT_FILENO);
    cli_line_erase();
    printf("%*s", indent, "");
    cli_print_wrapped(stdout, width < WIDEST_TEXT ? width : WIDEST_TEXT, indent, indent, text);
}

/* ---- errors and remarks ---- */

int cli_fail(hci_status status, const hci_note *note)
{
    char text[HCI_NOTE_SIZE + 64];
    snprintf(text, sizeof text, CLI_BAD "hci-solve:" CLI_PLAIN " %s",
             note->text[0] ? note->text : hci_status_text(status));
    show_line(stderr, text);
    if (cli_is_json()) {
        char *json = hci_failure_json(status, note);
        if (json) puts(json);
        hci_text_free(json);
    }
    return hci_status_exit_code(status);
}

void cli_remark(const hci_note *remark)
{
    char text[HCI_NOTE_SIZE + 64];
    if (!remark->text[0] || !cli_is_wordy()) return;
    snprintf(text, sizeof text, "hci-solve: " CLI_WARN "note:" CLI_PLAIN " %s", remark->text);
    show_line(stderr, text);
}
