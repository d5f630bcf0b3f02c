#include "cli/reference/bash.h"

#include <stdio.h>

static void bash_option(const cli_command *c, const cli_option *o)
{
    if (!cli_option_takes_value(o) || o->kind == CLI_COUNT_OPTIONAL) return;
    printf("        %s:--%s", c->name, o->name);
    if (o->letter) printf(" | %s:-%c", c->name, o->letter);
    switch (o->kind) {
    case CLI_CHOICE:
        printf(") offer='");
        cli_print_choices(o);
        printf("' ;;\n");
        break;
    case CLI_FILE:
        printf(") paths=file ;;\n");
        break;
    case CLI_FOLDER:
        printf(") paths=directory ;;\n");
        break;
    default:
        printf(") return ;;\n");
        break;
    }
}

static void bash_command(const cli_command *c)
{
    for (const cli_option *o = c->options; o->name; ++o)
        bash_option(c, o);
    printf("        %s:*)\n            %s\n            [[ $word != -* ]] || offer='", c->name,
           c->word_kind == CLI_FILE ? "paths=file" : "paths=");
    for (const cli_option *o = c->options; o->name; ++o)
        printf("%s--%s", o == c->options ? "" : " ", o->name);
    printf("' ;;\n");
}

void cli_print_bash(const cli_book *book)
{
    printf("# Completion of hci-solve for bash, by `hci-solve reference bash`.\n"
           "_hci_solve()\n{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} offer= paths=\n"
           "    COMPREPLY=()\n"
           "    # bash takes --option=value apart at the equals sign\n"
           "    if [[ $word == = ]]; then\n        word=\n"
           "    elif [[ $before == = ]]; then\n        before=${COMP_WORDS[COMP_CWORD - 2]}\n    fi\n"
           "    if ((COMP_CWORD == 1)); then\n        offer='");
    cli_print_command_names(book);
    printf(" --help --version'\n    else\n        case ${COMP_WORDS[1]}:$before in\n"
           "        reference:reference) offer='" CLI_REFERENCE_KINDS " --help' ;;\n"
           "        reference:markdown) offer='");
    cli_print_command_names(book);
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
