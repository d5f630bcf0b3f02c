#include "cli/reference/markdown.h"

#include <stdio.h>
#include <string.h>

static void print_plain(cli_span span)
{
    printf("%.*s", (int)span.length, span.text);
}

/* In a cell of a table a bar would be its end, and words in angles a tag. */
static void print_cell(cli_span span)
{
    for (size_t k = 0; k < span.length; ++k) {
        if (strchr("|<*", span.text[k])) putchar('\\');
        putchar(span.text[k]);
    }
}

static void markdown_options(const cli_option *o)
{
    char help[CLI_HELP_SIZE];
    printf("\n## Options\n\n| option | |\n|---|---|\n");
    for (; o->name; ++o) {
        printf("| `");
        if (o->letter) printf("-%c`, `", o->letter);
        cli_print_option_name(o, "", print_plain);
        printf("` | ");
        print_cell(cli_span_of(cli_option_help(o, help)));
        printf(" |\n");
    }
}

static void markdown_example(const cli_command *command)
{
    const char *end = cli_command_exit_codes(command), *example = command->example;
    printf("\n## Example\n\n```sh\n");
    while (example && (!end || example < end)) {
        cli_span line = cli_span_line(&example);
        const size_t indent = line.length >= 2 && strncmp(line.text, "  ", 2) == 0 ? 2 : 0;
        if (line.length > 0) printf("%.*s\n", (int)(line.length - indent), line.text + indent);
    }
    printf("```\n");
}

/* "0 done; 2 command line; …" */
static void markdown_exit_codes(const cli_command *command)
{
    const char *codes = cli_command_exit_codes(command);
    if (!codes) return;
    codes += strlen("Exit codes: ");
    printf("\n## Exit codes\n\n| code | |\n|---|---|\n");
    while (*codes) {
        const size_t length = strcspn(codes, ";\n");
        printf("| %c | ", codes[0]);
        print_cell((cli_span){codes + 2, length - 2});
        printf(" |\n");
        codes += length;
        codes += strspn(codes, "; \n");
    }
}

/* Lines of what a command does, as they stand, up to the one that begins with `end`. */
static const char *markdown_lines(const char *text, const char *end)
{
    while (text && strncmp(text, end, strlen(end)) != 0) {
        print_plain(cli_span_line(&text));
        putchar('\n');
    }
    return text;
}

/* In words, or else by what is said of --out. */
static void markdown_written(const cli_command *c, const char *words)
{
    const cli_option *o = c->options;
    printf("\n## Files written\n\n");
    if (words) markdown_lines(words, "\n");
    while (!words && o->name && strcmp(o->name, "out") != 0)
        ++o;
    if (!words && o->name) printf("`--out %s`: %s.\n", o->value_name, o->help);
}

void cli_print_markdown_page(const cli_command *c)
{
    const char *written = strstr(c->does, "\nWrites ");
    printf("<!-- From the program's own tables: change %s and run scripts/reference. -->\n"
           "# hci-solve %s\n\n",
           c->source, c->name);
    markdown_lines(c->does, written ? "Writes " : "\n");
    printf("\n```\nhci-solve %s %s [OPTIONS]\n```\n", c->name, c->words);
    markdown_options(c->options);
    markdown_written(c, written ? written + 1 : NULL);
    markdown_example(c);
    markdown_exit_codes(c);
    if (c->guide) printf("\nMore: [%s](../%s).\n", c->guide, c->guide);
}

void cli_print_markdown_index(const cli_book *book)
{
    printf("<!-- From the program's own tables: run scripts/reference. -->\n# Reference\n\n"
           "The same as `hci-solve COMMAND --help` and the man page.\n\n| command | |\n|---|---|\n");
    for (size_t k = 0; k < book->count; ++k) {
        const char *name = book->command[k]->name;
        printf("| [`%s`](%s.md) | ", name, name);
        print_cell(cli_span_title(book->command[k]));
        printf(" |\n");
    }
}
