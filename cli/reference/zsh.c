#include "cli/reference/zsh.h"

#include <stdio.h>
#include <string.h>

/* Inside single quotes, and where `[explanation]:message:action` is read. */
static void zsh_text(cli_span span)
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

static void zsh_value(const cli_option *o)
{
    if (!o->value_name) return;
    printf("%s:%s:", o->kind == CLI_COUNT_OPTIONAL ? ":" : "", o->value_name);
    switch (o->kind) {
    case CLI_CHOICE:
        putchar('(');
        cli_print_choices(o);
        putchar(')');
        break;
    case CLI_FILE:
        printf("_files");
        break;
    case CLI_FOLDER:
        printf("_files -/");
        break;
    default:
        break;
    }
}

static void zsh_option(const cli_option *o)
{
    char help[CLI_HELP_SIZE];
    cli_option_help(o, help);
    for (int form = o->letter ? 0 : 1; form < 2; ++form) {
        printf("            '");
        if (o->letter) printf("(-%c --%s)", o->letter, o->name);
        if (form == 0)
            printf("-%c[", o->letter);
        else
            printf("--%s%s[", o->name, o->value_name ? "=" : "");
        zsh_text(cli_span_of(help));
        putchar(']');
        zsh_value(o);
        printf("' \\\n");
    }
}

static void zsh_command(const cli_book *book, const cli_command *c)
{
    printf("        %s)\n            _arguments \\\n", c->name);
    for (const cli_option *o = c->options; o->name; ++o)
        zsh_option(o);
    if (cli_is_reference(c)) {
        printf("            '1:text:(" CLI_REFERENCE_KINDS ")' \\\n            '2:command:(");
        cli_print_command_names(book);
        printf(")' ;;\n");
    } else {
        printf("            '*:%s:%s' ;;\n", c->word_kind == CLI_FILE ? "file" : "name",
               c->word_kind == CLI_FILE ? "_files" : "");
    }
}

void cli_print_zsh(const cli_book *book)
{
    printf("#compdef hci-solve\n# Completion of hci-solve for zsh, by `hci-solve reference zsh`.\n"
           "_hci_solve()\n{\n"
           "    local curcontext=$curcontext state line\n    typeset -A opt_args\n    local -a commands\n"
           "    commands=(\n");
    for (size_t k = 0; k < book->count; ++k) {
        printf("        '%s:", book->command[k]->name);
        zsh_text(cli_span_title(book->command[k]));
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
