#define _POSIX_C_SOURCE 200809L

#include "cli/command/help.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"

/* Lines that are too long are continued as far in as they begin. */
static void print_text(const char *text, int width)
{
    while (*text) {
        char line[1024];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (*line)
            cli_print_wrapped(stdout, width, 0, (int)strspn(line, " "), line);
        else
            putchar('\n');
        text += length + (text[length] == '\n');
    }
}

static void option_text(const cli_option *o, char *text, size_t size)
{
    const bool optional = o->kind == CLI_COUNT_OPTIONAL;
    snprintf(text, size, "%c%c%c --%s%s%s%s%s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ',
             o->letter ? ',' : ' ', o->name, o->value_name ? " " : "", optional ? "[" : "",
             o->value_name ? o->value_name : "", optional ? "]" : "");
}

static int widest_option(const cli_option *o)
{
    size_t widest = 0;
    for (; o->name; ++o) {
        char left[64];
        option_text(o, left, sizeof left);
        if (strlen(left) > widest) widest = strlen(left);
    }
    return (int)widest;
}

static void print_options(const cli_command *command, bool common, const char *title, int width)
{
    const int at = widest_option(command->options) + 4;
    for (const cli_option *o = command->options; o->name; ++o) {
        char left[64], help[CLI_HELP_SIZE];
        if (o->is_common != common) continue;
        if (title) printf("\n%s\n", title);
        title = NULL;
        option_text(o, left, sizeof left);
        printf("  %-*s", at - 2, left);
        cli_print_wrapped(stdout, width, at, at, cli_option_help(o, help));
    }
}

void cli_print_help(const cli_command *command)
{
    const int width = cli_width(STDOUT_FILENO);
    const char *codes = cli_command_exit_codes(command);
    const size_t length = codes ? (size_t)(codes - 1 - command->example) : strlen(command->example);
    printf("hci-solve %s %s [OPTIONS]\n\n", command->name, command->words);
    print_text(command->does, width);
    print_options(command, false, "Options", width);
    print_options(command, true, "Options of every command", width);
    printf("\nExample\n%.*s", (int)length, command->example);
    if (codes) print_text(codes - 1, width);
    if (command->more_help) command->more_help();
}
