#include "cli/command/option.h"

#include <stdio.h>
#include <string.h>

#include "cli/terminal/terminal.h"
#include "hci/host/csv/csv.h"

const cli_choice cli_color_choices[] = {
    [CLI_COLOR_AUTO] = {"auto", "auto (default: on a terminal)"},
    [CLI_COLOR_ALWAYS] = {"always", NULL},
    [CLI_COLOR_NEVER] = {"never", NULL},
    {NULL, NULL},
};

const cli_choice cli_order_bases[] = {
    [HCI_ORDER_ELECTRICAL] = {"electrical", "electrical (default)"},
    [HCI_ORDER_MECHANICAL] = {"mechanical", NULL},
    {NULL, NULL},
};

int cli_option_find(const cli_option *options, const char *name, size_t length)
{
    for (int k = 0; options[k].name; ++k)
        if (strlen(options[k].name) == length && strncmp(options[k].name, name, length) == 0) return k;
    return -1;
}

bool cli_option_takes_value(const cli_option *option)
{
    return option->kind != CLI_FLAG;
}

static void append(char text[CLI_HELP_SIZE], const char *more)
{
    const size_t used = strlen(text);
    snprintf(text + used, CLI_HELP_SIZE - used, "%s", more);
}

/* What stands between a choice and the one before it. A help that brings its own begins with it. */
static const char *separator(const cli_choice *choice, bool is_first)
{
    if (choice->help && strchr(",; ", choice->help[0])) return "";
    return is_first ? "" : choice[1].word ? ", " : " or ";
}

const char *cli_option_help(const cli_option *option, char text[CLI_HELP_SIZE])
{
    snprintf(text, CLI_HELP_SIZE, "%s", option->help ? option->help : "");
    if (!option->choices) return text;
    if (text[0]) append(text, " ");
    for (const cli_choice *c = option->choices; c->word; ++c) {
        append(text, separator(c, c == option->choices));
        append(text, c->help ? c->help : c->word);
    }
    return text;
}

const char *cli_command_exit_codes(const cli_command *command)
{
    const char *codes = strstr(command->example, "\nExit codes: ");
    return codes ? codes + 1 : NULL;
}
