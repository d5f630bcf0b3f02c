#include "cli/reference/book.h"

#include <stdio.h>
#include <string.h>

cli_span cli_span_of(const char *text)
{
    return (cli_span){text, strlen(text)};
}

cli_span cli_span_line(const char **text)
{
    const cli_span line = {*text, strcspn(*text, "\n")};
    *text = (*text)[line.length] == '\n' ? *text + line.length + 1 : NULL;
    return line;
}

cli_span cli_span_title(const cli_command *command)
{
    const char *text = command->does;
    cli_span title = cli_span_line(&text);
    if (title.length > 0 && title.text[title.length - 1] == '.') --title.length;
    return title;
}

void cli_print_option_name(const cli_option *o, const char *value_mark, void (*print)(cli_span))
{
    const bool optional = o->kind == CLI_COUNT_OPTIONAL;
    print(cli_span_of("--"));
    print(cli_span_of(o->name));
    if (!o->value_name) return;
    printf(" %s%s", optional ? "[" : "", value_mark);
    print(cli_span_of(o->value_name));
    printf("%s", optional ? "]" : "");
}

bool cli_is_reference(const cli_command *command)
{
    return strcmp(command->name, "reference") == 0;
}

void cli_print_command_names(const cli_book *book)
{
    for (size_t k = 0; k < book->count; ++k)
        printf("%s%s", k ? " " : "", book->command[k]->name);
}

void cli_print_choices(const cli_option *option)
{
    for (const cli_choice *c = option->choices; c->word; ++c)
        printf("%s%s", c == option->choices ? "" : " ", c->word);
}
