#include "cli/reference/man.h"

#include <stdio.h>

#include "hci/host/base/utf8.h"
#include "hci/version.h"

/* Hyphens as they are typed, and letters beyond ASCII by their number: every formatter reads that alike. */
static void print_roff(cli_span span)
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
        const cli_span line = cli_span_line(&text);
        if (line.length == 0) continue;
        print_roff(line);
        putchar('\n');
    }
}

static void roff_option(const cli_option *o)
{
    char help[CLI_HELP_SIZE];
    printf(".TP\n\\fB");
    if (o->letter) printf("\\-%c\\fR, \\fB", o->letter);
    cli_print_option_name(o, "\\fI", print_roff);
    printf("\\fR\n");
    print_roff(cli_span_of(cli_option_help(o, help)));
    putchar('\n');
}

static void roff_command(const cli_command *c)
{
    const char *codes = cli_command_exit_codes(c);
    printf(".SS %s\n.B hci\\-solve %s\n", c->name, c->name);
    print_roff(cli_span_of(c->words));
    printf("\n[\\fIoptions\\fR]\n.PP\n");
    roff_lines(c->does, NULL);
    for (const cli_option *o = c->options; o->name; ++o)
        roff_option(o);
    printf(".PP\nExample:\n.PP\n.EX\n");
    roff_lines(c->example, codes);
    printf(".EE\n");
    if (codes) {
        printf(".PP\n");
        roff_lines(codes, NULL);
    }
    if (c->more_help) {
        printf(".PP\n.EX\n");
        c->more_help();
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
           ".B hci\\-solve\n.B help\n.I command\n.br\n.B hci\\-solve \\-\\-version\n"
           ".SH DESCRIPTION\n"
           "From the back\\-EMF and cogging torque of a motor and a wanted torque\n"
           "to the harmonic currents that produce it, and to the C tables of its controller;\n"
           "from recordings to what the model of the motor lacks.\n.PP\n"
           "Files go into the folder that \\fB\\-\\-out\\fR names. What was found is printed on standard "
           "output,\n"
           "with \\fB\\-\\-json\\fR as JSON; progress, remarks and errors on standard error.\n"
           "A file named \\fB\\-\\fR is standard input, where one table or one recording is read.\n");
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

void cli_print_man(const cli_book *book)
{
    roff_head();
    printf(".SH COMMANDS\n");
    for (size_t k = 0; k < book->count; ++k)
        roff_command(book->command[k]);
    roff_tail();
}
