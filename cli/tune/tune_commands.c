#include "cli/tune/tune_commands.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/command/command.h"
#include "cli/command/parse.h"
#include "cli/terminal/terminal.h"
#include "cli/tune/tune_options.h"

void cli_tune_note(cli_tuning *t, const char *format, ...)
{
    const size_t used = strlen(t->tuning.commands);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(t->tuning.commands + used, sizeof t->tuning.commands - used, format, arguments);
    va_end(arguments);
}

bool cli_tune_is_plain(const char *word)
{
    return *word && strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,=:") ==
                        strlen(word);
}

static void note_quoted(cli_tuning *t, const char *word)
{
    cli_tune_note(t, "'");
    for (; *word; ++word)
        cli_tune_note(t, *word == '\'' ? "'\\''" : "%c", *word);
    cli_tune_note(t, "'");
}

/* What begins with the folder of the results goes into the folder of the repetition; a name may be the same
 * word. */
void cli_tune_note_word(cli_tuning *t, const char *word, bool is_name)
{
    const size_t length = strlen(t->out);
    const bool is_out =
        !is_name && strncmp(word, t->out, length) == 0 && (word[length] == '/' || word[length] == '\0');
    cli_tune_note(t, is_out ? " \"$OUT\"" : " ");
    word += is_out ? length : 0;
    if (cli_tune_is_plain(word))
        cli_tune_note(t, "%s", word);
    else if (!is_out || *word)
        note_quoted(t, word);
}

void cli_tune_add(cli_tune_line *c, const char *word)
{
    if (c->count < CLI_TUNE_MOST_WORDS) c->word[c->count++] = word;
}

void cli_tune_add_option(cli_tune_line *c, const char *name, const char *value)
{
    static char dashed[2 * CLI_TUNE_MOST_WORDS][40];
    static size_t used;
    char *text = dashed[used++ % (2 * CLI_TUNE_MOST_WORDS)];
    snprintf(text, sizeof dashed[0], "--%s", name);
    cli_tune_add(c, text);
    if (value) cli_tune_add(c, value);
}

const char *cli_tune_offset(const cli_tuning *t)
{
    return t->offset[0] ? t->offset : t->arguments->value[ANGLE_OFFSET];
}

void cli_tune_add_reading(cli_tune_line *c, const cli_tuning *t)
{
    const cli_arguments *a = t->arguments;
    for (size_t k = 0; k < a->repeats; ++k)
        cli_tune_add_option(c, "column", a->repeated[k]);
    if (cli_tune_offset(t)) cli_tune_add_option(c, "angle-offset", cli_tune_offset(t));
    if (a->given[STRICT]) cli_tune_add_option(c, "strict", NULL);
}

void cli_tune_note_line(cli_tuning *t, const cli_tune_line *c, bool may_be_no)
{
    cli_tune_note(t, "hci-solve");
    for (size_t k = 0; k < c->count; ++k)
        if (k == 0)
            cli_tune_note(t, " %s", c->word[k]);
        else
            cli_tune_note_word(t, c->word[k], strcmp(c->word[k - 1], "--name") == 0);
    cli_tune_note(t, may_be_no ? " || [ $? -eq 1 ]\n" : "\n");
}

/* Runs it here, without words. */
hci_status cli_tune_run(cli_tuning *t, const cli_command *command, cli_tune_line *c, hci_note *note)
{
    char *words[CLI_TUNE_MOST_WORDS + 1];
    cli_tune_note_line(t, c, false);
    for (size_t k = 1; k < c->count; ++k)
        words[k - 1] = (char *)(size_t)c->word[k];
    words[c->count - 1] = "-q";
    const int code = cli_command_run(command, (int)c->count, words);
    const cli_arguments *a = t->arguments;
    cli_terminal_begin(a->given[QUIET], a->given[JSON], (cli_color)a->choice[COLOR]);
    if (code == 0) return HCI_OK;
    return hci_note_set(note,
                        code == 2   ? HCI_ERROR_ARGUMENT
                        : code == 3 ? HCI_ERROR_INPUT
                        : code == 5 ? HCI_ERROR_OUTPUT
                                    : HCI_ERROR_NUMERIC,
                        "tune: the step `%s` failed, for the reason above; correct that and give the same "
                        "call again",
                        c->word[0]);
}

void cli_tune_path(const cli_tuning *t, const char *name, char path[CLI_TUNE_PATH])
{
    snprintf(path, CLI_TUNE_PATH, "%.1900s/%s", t->out, name);
}
