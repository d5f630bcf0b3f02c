/* The reference of all commands, from the tables that the parser uses: man page, Markdown pages, completion.
 */
#include "cli/reference/book.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "hci/version.h"

/* ---- texts ---- */

reference_span reference_line(const char **text)
{
    const reference_span line = {*text, strcspn(*text, "\n")};
    *text = (*text)[line.length] == '\n' ? *text + line.length + 1 : NULL;
    return line;
}

reference_span reference_title(const cli_command *command)
{
    const char *text = command->does;
    reference_span title = reference_line(&text);
    if (title.length > 0 && title.text[title.length - 1] == '.') --title.length;
    return title;
}

/* What follows a mark in a text that has it, else NULL. */
static const char *after(const char *text, const char *mark)
{
    const char *at = strstr(text, mark);
    return at ? at + strlen(mark) : NULL;
}

static const char EXIT_CODES[] = "\nExit codes: ";

/* The guide of a command among the documents, or NULL. */
static const char *guide_of(const char *command)
{
    static const char *const GUIDES[][2] = {{"simulate", "simulate.md"}, {"diagnose", "diagnose.md"},
                                            {"init", "init.md"},         {"harmonics", "measuring.md"},
                                            {"predict", "measuring.md"}, {"check", "check.md"}};
    for (size_t k = 0; k < sizeof GUIDES / sizeof GUIDES[0]; ++k)
        if (strcmp(GUIDES[k][0], command) == 0) return GUIDES[k][1];
    return NULL;
}

/* "--name VALUE" of an option, VALUE in brackets where it may be left out. */
static void print_option(const cli_option *o, const char *value_begins, const char *value_ends,
                         void (*print)(reference_span))
{
    const bool optional = o->kind == CLI_COUNT_OPTIONAL;
    print((reference_span){"--", 2});
    print((reference_span){o->name, strlen(o->name)});
    if (!o->value_name) return;
    printf(" %s%s", optional ? "[" : "", value_begins);
    print((reference_span){o->value_name, strlen(o->value_name)});
    printf("%s%s", value_ends, optional ? "]" : "");
}

/* ---- Markdown ---- */

static void print_plain(reference_span span)
{
    printf("%.*s", (int)span.length, span.text);
}

/* In a cell of a table a bar would be its end, and words in angles a tag. */
static void print_cell(reference_span span)
{
    for (size_t k = 0; k < span.length; ++k) {
        if (strchr("|<*", span.text[k])) putchar('\\');
        putchar(span.text[k]);
    }
}

static void markdown_options(const cli_option *o)
{
    printf("\n## Options\n\n| option | |\n|---|---|\n");
    for (; o->name; ++o) {
        printf("| `");
        if (o->letter) printf("-%c`, `", o->letter);
        print_option(o, "", "", print_plain);
        printf("` | ");
        print_cell((reference_span){o->help, strlen(o->help)});
        printf(" |\n");
    }
}

static void markdown_example(const char *example)
{
    const char *end = strstr(example, EXIT_CODES);
    printf("\n## Example\n\n```sh\n");
    while (example && (!end || example < end)) {
        reference_span line = reference_line(&example);
        const size_t indent = line.length >= 2 && strncmp(line.text, "  ", 2) == 0 ? 2 : 0;
        if (line.length > 0) printf("%.*s\n", (int)(line.length - indent), line.text + indent);
    }
    printf("```\n");
}

/* "0 done; 2 command line; …" */
static void markdown_exit_codes(const char *codes)
{
    if (!codes) return;
    printf("\n## Exit codes\n\n| code | |\n|---|---|\n");
    while (*codes) {
        const size_t length = strcspn(codes, ";\n");
        printf("| %c | ", codes[0]);
        print_cell((reference_span){codes + 2, length - 2});
        printf(" |\n");
        codes += length;
        codes += strspn(codes, "; \n");
    }
}

/* Lines of what a command does, as they stand, up to the one that begins with `end`. */
static const char *markdown_lines(const char *text, const char *end)
{
    while (text && strncmp(text, end, strlen(end)) != 0) {
        print_plain(reference_line(&text));
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

static void markdown_page(const cli_command *c)
{
    const char *guide = guide_of(c->name), *written;
    printf("<!-- From the program's own tables: change cli/%s.c and run scripts/reference. -->\n"
           "# hci-solve %s\n\n",
           c->name, c->name);
    written = strstr(c->does, "\nWrites ");
    markdown_lines(c->does, written ? "Writes " : "\n");
    printf("\n```\nhci-solve %s %s [OPTIONS]\n```\n", c->name, c->words);
    markdown_options(c->options);
    markdown_written(c, written ? written + 1 : NULL);
    markdown_example(c->example);
    markdown_exit_codes(after(c->example, EXIT_CODES));
    if (guide) printf("\nMore: [%s](../%s).\n", guide, guide);
}

static void markdown_index(const reference_book *book)
{
    printf("<!-- From the program's own tables: run scripts/reference. -->\n# Reference\n\n"
           "The same as `hci-solve COMMAND --help` and the man page.\n\n| command | |\n|---|---|\n");
    for (size_t k = 0; k < book->count; ++k) {
        const char *name = book->command[k]->name;
        printf("| [`%s`](%s.md) | ", name, name);
        print_cell(reference_title(book->command[k]));
        printf(" |\n");
    }
}

/* ---- the man page ---- */

/* Hyphens as they are typed, and letters beyond ASCII by their number: every formatter reads that alike. */
static void print_roff(reference_span span)
{
    if (span.length > 0 && (span.text[0] == '.' || span.text[0] == '\'')) printf("\\&");
    for (size_t k = 0, bytes = 1; k < span.length && bytes > 0; k += bytes) {
        uint32_t code;
        bytes = hci_utf8_decode(span.text + k, &code);
        if (code == '-')
            printf("\\-");
        else if (code == '\\')
            printf("\\e");
        else if (code < 0x80)
            putchar((int)code);
        else
            printf("\\[u%04lX]", (unsigned long)code);
    }
}

static void roff_lines(const char *text, const char *end)
{
    while (text && (!end || text < end)) {
        const reference_span line = reference_line(&text);
        if (line.length == 0) continue;
        print_roff(line);
        putchar('\n');
    }
}

static void roff_option(const cli_option *o)
{
    printf(".TP\n\\fB");
    if (o->letter) printf("\\-%c\\fR, \\fB", o->letter);
    print_option(o, "\\fI", "", print_roff);
    printf("\\fR\n");
    print_roff((reference_span){o->help, strlen(o->help)});
    putchar('\n');
}

static void roff_command(const cli_command *c)
{
    const char *end = strstr(c->example, EXIT_CODES);
    printf(".SS %s\n.B hci\\-solve %s\n", c->name, c->name);
    print_roff((reference_span){c->words, strlen(c->words)});
    printf("\n[\\fIoptions\\fR]\n.PP\n");
    roff_lines(c->does, NULL);
    for (const cli_option *o = c->options; o->name; ++o)
        roff_option(o);
    printf(".PP\nExample:\n.PP\n.EX\n");
    roff_lines(c->example, end);
    printf(".EE\n");
    if (end) {
        printf(".PP\n");
        roff_lines(end + 1, NULL);
    }
    if (strcmp(c->name, "simulate") == 0) {
        printf(".PP\n.EX\n");
        cli_print_scenario_names();
        printf(".EE\n");
    }
}

static void roff_head(void)
{
    printf(".\\\" From the program's own tables, by `hci-solve reference man`.\n"
           ".TH HCI\\-SOLVE 1 \"\" \"hci\\-solve " HCI_VERSION_STRING "\" \"User Commands\"\n"
           ".SH NAME\nhci\\-solve \\- phase currents that make a permanent\\-magnet motor produce a wanted "
           "torque\n"
           ".SH SYNOPSIS\n.B hci\\-solve\n.I command\n[\\fIoptions\\fR]\n.br\n"
           ".B hci\\-solve\n.I command\n.B \\-\\-help\n.br\n.B hci\\-solve \\-\\-version\n"
           ".SH DESCRIPTION\n"
           "From the back\\-EMF and cogging torque of a motor and a wanted torque\n"
           "to the harmonic currents that produce it, and to the C tables of its controller;\n"
           "from recordings to what the model of the motor lacks.\n.PP\n"
           "Results go into the folder that \\fB\\-\\-out\\fR names, words to standard error,\n"
           "and with \\fB\\-\\-json\\fR a summary to standard output.\n");
}

static void roff_tail(void)
{
    printf(".SH CONVENTIONS\n"
           "The electrical rotor angle is zero at the rising zero crossing of the fundamental of the "
           "back\\-EMF of phase a;\n"
           "a\\-b\\-c is positive; currents are positive into the machine; amplitudes are peak values;\n"
           "orders are electrical; poles are counted in pairs.\n"
           "The d axis is the magnet axis, and q leads it. Clarke and Park transforms are "
           "amplitude\\-invariant.\n"
           ".SH EXIT STATUS\n"
           ".TP\n.B 0\ndone\n"
           ".TP\n.B 1\ndone, but the answer is no; the nearest result is given\n"
           ".TP\n.B 2\nwrong command line\n.TP\n.B 3\nwrong input\n.TP\n.B 4\nnumerical failure\n"
           ".TP\n.B 5\ncould not write\n"
           ".SH ENVIRONMENT\n"
           ".TP\n.B NO_COLOR\nno colour, unless \\fB\\-\\-color always\\fR asks for it\n"
           ".TP\n.B COLUMNS\nwidth of help texts and drawings; by default that of the terminal\n"
           ".SH FILES\n"
           "Guides, the formats of all files and the machines of the examples stand in\n"
           ".I share/doc/hci\\-solve\nbelow the folder that the program was installed to.\n"
           "Copy the folder\n.I data\nfrom there to where you work, and the examples above run as they "
           "stand.\n");
}

static void print_man(const reference_book *book)
{
    roff_head();
    printf(".SH COMMANDS\n");
    for (size_t k = 0; k < book->count; ++k)
        roff_command(book->command[k]);
    roff_tail();
}

/* ---- the command ---- */

static const cli_option OPTIONS[] = {
    {"help", 'h', CLI_FLAG, NULL, "this text"},
    {NULL, 0, CLI_FLAG, NULL, NULL},
};

static const cli_command REFERENCE = {
    "reference",
    "{man,bash,zsh,markdown} [COMMAND]",
    "Prints the man page, shell completion or reference pages.\n"
    "All of them come from the tables that the command line is read by. Of markdown there is a page for "
    "each\n"
    "COMMAND, and without one their list.\n"
    "Writes to standard output alone.",
    OPTIONS,
    1,
    "  hci-solve reference man >hci-solve.1\n"
    "  hci-solve reference bash >hci-solve.bash\n"
    "  hci-solve reference markdown solve\n"
    "\nExit codes: 0 done; 2 command line; 5 output\n",
    NULL};

static int fail(const char *found, const char *expected)
{
    hci_note note = {{0}};
    return cli_fail(hci_note_set(&note, HCI_ERROR_ARGUMENT,
                                 "reference: found `%.60s`, expected %s; see hci-solve reference --help",
                                 found, expected),
                    &note);
}

static int print_markdown(const reference_book *book, const char *name)
{
    if (!name) return markdown_index(book), 0;
    for (size_t k = 0; k < book->count; ++k)
        if (strcmp(book->command[k]->name, name) == 0) return markdown_page(book->command[k]), 0;
    return fail(name, "one of those that hci-solve --help names");
}

int cli_reference(const cli_command *const *commands, size_t count, int word_count, char *const *words)
{
    const char *what = word_count > 0 ? words[0] : "";
    reference_book book = {{NULL}, 0};
    for (; book.count < count && book.count + 1 < REFERENCE_MOST_COMMANDS; ++book.count)
        book.command[book.count] = commands[book.count];
    book.command[book.count++] = &REFERENCE;
    for (int k = 0; k < word_count; ++k)
        if (strcmp(words[k], "--help") == 0 || strcmp(words[k], "-h") == 0)
            return cli_print_help(&REFERENCE), 0;
    if (strcmp(what, "markdown") == 0 && word_count <= 2)
        return print_markdown(&book, word_count == 2 ? words[1] : NULL);
    if (word_count > 1) return fail(words[word_count - 1], "no further word");
    if (strcmp(what, "man") == 0) return print_man(&book), 0;
    if (strcmp(what, "bash") == 0) return reference_bash(&book), 0;
    if (strcmp(what, "zsh") == 0) return reference_zsh(&book), 0;
    return fail(what, "one of: man, bash, zsh, markdown");
}
