#include "cli/reference/reference.h"

#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/help.h"
#include "cli/reference/bash.h"
#include "cli/reference/man.h"
#include "cli/reference/markdown.h"
#include "cli/reference/zsh.h"
#include "cli/terminal/say.h"

static const cli_option OPTIONS[] = {
    CLI_HELP_OPTION,
    CLI_END_OF_OPTIONS,
};

static const cli_command REFERENCE = {
    .name = "reference",
    .words = "{man,bash,zsh,markdown} [COMMAND]",
    .does =
        "Prints the man page, shell completion or reference pages.\n"
        "All of them come from the tables that the command line is read by. Of markdown there is a page for "
        "each\n"
        "COMMAND, and without one their list.\n"
        "Writes to standard output alone.",
    .options = OPTIONS,
    .words_needed = 1,
    .word_kind = CLI_TEXT,
    .example = "  hci-solve reference man >hci-solve.1\n"
               "  hci-solve reference bash >hci-solve.bash\n"
               "  hci-solve reference markdown solve\n"
               "\nExit codes: 0 done; 2 command line; 5 output\n",
    .source = "cli/reference/reference.c",
};

static int fail(const char *found, const char *expected)
{
    hci_note note = {{0}};
    return cli_fail(hci_note_set(&note, HCI_ERROR_ARGUMENT,
                                 "reference: found `%.60s`, expected %s; see hci-solve reference --help",
                                 found, expected),
                    &note);
}

static int print_markdown(const cli_book *book, const char *name)
{
    if (!name) return cli_print_markdown_index(book), 0;
    for (size_t k = 0; k < book->count; ++k)
        if (strcmp(book->command[k]->name, name) == 0) return cli_print_markdown_page(book->command[k]), 0;
    return fail(name, "one of those that hci-solve --help names");
}

int cli_reference(const cli_command *const *commands, size_t count, int word_count, char *const *words)
{
    const char *what = word_count > 0 ? words[0] : "";
    cli_book book = {{NULL}, 0};
    for (; book.count < count && book.count + 1 < CLI_MOST_COMMANDS; ++book.count)
        book.command[book.count] = commands[book.count];
    book.command[book.count++] = &REFERENCE;
    if (cli_asks_for_help(word_count, words)) return cli_print_help(&REFERENCE), 0;
    if (strcmp(what, "markdown") == 0 && word_count <= 2)
        return print_markdown(&book, word_count == 2 ? words[1] : NULL);
    if (word_count > 1) return fail(words[word_count - 1], "no further word");
    if (strcmp(what, "man") == 0) return cli_print_man(&book), 0;
    if (strcmp(what, "bash") == 0) return cli_print_bash(&book), 0;
    if (strcmp(what, "zsh") == 0) return cli_print_zsh(&book), 0;
    return fail(what, "one of: man, bash, zsh, markdown");
}
