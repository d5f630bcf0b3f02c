/* Completion for bash and zsh: commands, options, and what their values may be. */
#include <stdio.h>
#include <string.h>

#include "cli/reference/book.h"

/* ---- what may stand where ---- */

typedef enum { TAKES_TEXT, TAKES_WORD, TAKES_FILE, TAKES_FOLDER } takes;

/* Values that are one of a few words. tests/cli/cli_reference.sh holds them against what the program accepts.
 */
static const struct {
    const char *command, *option, *words;
} CHOICES[] = {
    {"harmonics", "quantity", "back_emf cogging"},
    {"solve", "method", "auto lu umfpack qr pointwise"},
    {"solve", "strategy", "mtpa id0 cancel"},
    {"solve", "compare", "all square"},
    {"emit", "format", "f32"},
    {"emit", "frame", "abc dq"},
    {"init", "kv-of", "line-peak line-rms phase-peak"},
    {"init", "volt-of", "line-rms line-peak phase-peak phase-rms"},
    {"init", "torque-of", "peak rms dc"},
    {"init", "resistance-of", "phase line"},
    {"init", "current-of", "peak rms"},
    {"", "color", "auto always never"}, /* of every command */
};

static const char *words_of(const cli_command *command, const cli_option *option)
{
    for (size_t k = 0; k < sizeof CHOICES / sizeof CHOICES[0]; ++k)
        if (strcmp(CHOICES[k].option, option->name) == 0 &&
            (!CHOICES[k].command[0] || strcmp(CHOICES[k].command, command->name) == 0))
            return CHOICES[k].words;
    return NULL;
}

/* By the name of the value. A LIST is a file where its help speaks of one, and otherwise numbers. */
static takes taken_by(const cli_command *command, const cli_option *option)
{
    const char *name = option->value_name;
    if (words_of(command, option)) return TAKES_WORD;
    if (strcmp(name, "FOLDER") == 0) return TAKES_FOLDER;
    if (strcmp(name, "FILE") == 0 || strcmp(name, "PATH") == 0) return TAKES_FILE;
    return strcmp(name, "LIST") == 0 && strstr(option->help, "file") ? TAKES_FILE : TAKES_TEXT;
}

/* Words of a command that are no options name what is there already, but for a NAME, which is new. */
static bool words_are_files(const cli_command *command)
{
    return strncmp(command->words, "NAME", 4) != 0;
}

static bool is_reference(const cli_command *command)
{
    return strcmp(command->name, "reference") == 0;
}

static void print_names(const reference_book *book)
{
    for (size_t k = 0; k < book->count; ++k)
        printf("%s%s", k ? " " : "", book->command[k]->name);
}

/* ---- bash ---- */

static void bash_option(const cli_command *c, const cli_option *o)
{
    if (o->kind != CLI_VALUE) return;
    printf("        %s:--%s", c->name, o->name);
    if (o->letter) printf(" | %s:-%c", c->name, o->letter);
    switch (taken_by(c, o)) {
    case TAKES_WORD:
        printf(") offer='%s' ;;\n", words_of(c, o));
        break;
    case TAKES_FILE:
        printf(") paths=file ;;\n");
        break;
    case TAKES_FOLDER:
        printf(") paths=directory ;;\n");
        break;
    case TAKES_TEXT:
        printf(") return ;;\n");
        break;
    }
}

static void bash_command(const cli_command *c)
{
    for (const cli_option *o = c->options; o->name; ++o)
        bash_option(c, o);
    printf("        %s:*)\n            %s\n            [[ $word != -* ]] || offer='", c->name,
           words_are_files(c) && !is_reference(c) ? "paths=file" : "paths=");
    for (const cli_option *o = c->options; o->name; ++o)
        printf("%s--%s", o == c->options ? "" : " ", o->name);
    printf("' ;;\n");
}

void reference_bash(const reference_book *book)
{
    printf("# Completion of hci-solve for bash, by `hci-solve reference bash`.\n"
           "_hci_solve()\n{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} offer= paths=\n"
           "    COMPREPLY=()\n"
           "    # bash takes --option=value apart at the equals sign\n"
           "    if [[ $word == = ]]; then\n        word=\n"
           "    elif [[ $before == = ]]; then\n        before=${COMP_WORDS[COMP_CWORD - 2]}\n    fi\n"
           "    if ((COMP_CWORD == 1)); then\n        offer='");
    print_names(book);
    printf(" --help --version'\n    else\n        case ${COMP_WORDS[1]}:$before in\n"
           "        reference:reference) offer='man bash zsh markdown --help' ;;\n"
           "        reference:markdown) offer='");
    print_names(book);
    printf("' ;;\n");
    for (size_t k = 0; k < book->count; ++k)
        bash_command(book->command[k]);
    printf("        esac\n    fi\n"
           "    if [[ $offer ]]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$offer\" -- \"$word\")\n"
           "    elif [[ $paths ]]; then\n"
           "        compopt -o filenames 2>/dev/null # the shell then quotes blanks and ends folders with a "
           "slash\n"
           "        mapfile -t COMPREPLY < <(compgen -A \"$paths\" -- \"$word\")\n"
           "    fi\n}\ncomplete -F _hci_solve hci-solve\n");
}

/* ---- zsh ---- */

/* Inside single quotes, and where `[explanation]:message:action` is read. */
static void zsh_text(reference_span span)
{
    for (size_t k = 0; k < span.length; ++k) {
        if (span.text[k] == '\'') {
            printf("'\\''");
            continue;
        }
        if (strchr("[]:\\", span.text[k])) putchar('\\');
        putchar(span.text[k]);
    }
}

static void zsh_value(const cli_command *c, const cli_option *o)
{
    if (!o->value_name) return;
    printf("%s:%s:", o->kind == CLI_COUNT_OPTIONAL ? ":" : "", o->value_name);
    switch (taken_by(c, o)) {
    case TAKES_WORD:
        printf("(%s)", words_of(c, o));
        break;
    case TAKES_FILE:
        printf("_files");
        break;
    case TAKES_FOLDER:
        printf("_files -/");
        break;
    case TAKES_TEXT:
        break;
    }
}

static void zsh_option(const cli_command *c, const cli_option *o)
{
    const reference_span help = {o->help, strlen(o->help)};
    for (int form = o->letter ? 0 : 1; form < 2; ++form) {
        printf("            '");
        if (o->letter) printf("(-%c --%s)", o->letter, o->name);
        if (form == 0)
            printf("-%c[", o->letter);
        else
            printf("--%s%s[", o->name, o->value_name ? "=" : "");
        zsh_text(help);
        putchar(']');
        zsh_value(c, o);
        printf("' \\\n");
    }
}

static void zsh_command(const reference_book *book, const cli_command *c)
{
    printf("        %s)\n            _arguments \\\n", c->name);
    for (const cli_option *o = c->options; o->name; ++o)
        zsh_option(c, o);
    if (is_reference(c)) {
        printf("            '1:text:(man bash zsh markdown)' \\\n            '2:command:(");
        print_names(book);
        printf(")' ;;\n");
    } else {
        printf("            '*:%s:%s' ;;\n", words_are_files(c) ? "file" : "name",
               words_are_files(c) ? "_files" : "");
    }
}

void reference_zsh(const reference_book *book)
{
    printf("#compdef hci-solve\n# Completion of hci-solve for zsh, by `hci-solve reference zsh`.\n"
           "_hci_solve()\n{\n"
           "    local curcontext=$curcontext state line\n    typeset -A opt_args\n    local -a commands\n"
           "    commands=(\n");
    for (size_t k = 0; k < book->count; ++k) {
        printf("        '%s:", book->command[k]->name);
        zsh_text(reference_title(book->command[k]));
        printf("'\n");
    }
    printf("    )\n"
           "    _arguments -C '(- *)'{-h,--help}'[the commands]' '(- *)--version[the version]' \\\n"
           "        '1:command:->command' '*::argument:->argument' && return\n"
           "    case $state in\n"
           "    command) _describe command commands ;;\n"
           "    argument)\n"
           "        case $words[1] in\n");
    for (size_t k = 0; k < book->count; ++k)
        zsh_command(book, book->command[k]);
    printf("        esac ;;\n    esac\n}\n_hci_solve \"$@\"\n");
}
