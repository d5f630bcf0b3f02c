#include "cli/command/command.h"

#include <stdio.h>
#include <string.h>

#include "cli/command/help.h"
#include "cli/command/parse.h"
#include "cli/command/written.h"
#include "cli/terminal/say.h"
#include "cli/terminal/terminal.h"
#include "hci/host/report/summary.h"

bool cli_asks_for_help(int count, char *const *words)
{
    for (int k = 0; k < count; ++k)
        if (strcmp(words[k], "--help") == 0 || strcmp(words[k], "-h") == 0) return true;
    return false;
}

static int place(const cli_command *command, const char *name)
{
    return cli_option_find(command->options, name, strlen(name));
}

/* What --quiet, --json and --color ask for, before anything is said. */
static hci_status begin_terminal(const cli_command *command, cli_arguments *a, hci_note *note)
{
    const int color = place(command, "color");
    const hci_status status = cli_parse_value(command->options, color, a, note);
    cli_terminal_begin(a->given[place(command, "quiet")], a->given[place(command, "json")],
                       status ? CLI_COLOR_AUTO : (cli_color)a->choice[color]);
    return status;
}

/* What a command has written is named at its end. */
static int run(const cli_command *command, const cli_arguments *arguments)
{
    cli_written_begin();
    const int code = command->run(arguments);
    if (code <= hci_status_exit_code(HCI_NOT_REACHED) && !command->names_files) cli_written_say();
    cli_written_end();
    return code;
}

int cli_command_run(const cli_command *command, int count, char *const *words)
{
    cli_arguments arguments;
    hci_note note = {{0}};
    hci_status status;
    if (cli_asks_for_help(count, words)) return cli_print_help(command), 0;
    status = cli_parse_words(command, count, words, &arguments, &note);
    if (!status) status = begin_terminal(command, &arguments, &note);
    if (!status) status = cli_parse_values(command->options, &arguments, &note);
    return status ? cli_fail(status, &note) : run(command, &arguments);
}

hci_status cli_print_json(char *json, hci_note *note)
{
    if (!json) return hci_note_memory(note, NULL, "the summary");
    puts(json);
    hci_text_free(json);
    return HCI_OK;
}
