#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/command/command.h"
#include "cli/command/help.h"
#include "cli/commands.h"
#include "cli/reference/reference.h"
#include "cli/terminal/say.h"
#include "cli/terminal/signals.h"
#include "cli/terminal/start.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/text.h"
#include "hci/host/base/spelling.h"
#include "hci/version.h"

/* In the order in which one uses them. */
static const cli_command *const COMMANDS[] = {
    &cli_tune,     &cli_init,       &cli_check,   &cli_harmonics, &cli_solve, &cli_sweep,         &cli_emit,
    &cli_simulate, &cli_export_fmu, &cli_predict, &cli_diagnose,  &cli_fit,   &cli_batch_command, &cli_fleet};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0] };

static const char USE[] = "Phase currents that make a permanent-magnet motor produce the torque you want. "
                          "Commands, in the order in which one uses them:";

static const char EXAMPLE[] = "\nFrom a data sheet to C tables\n"
                              "  hci-solve init hub --poles 30 --kv 16 --slots 27 -o out/hub\n"
                              "  hci-solve solve out/hub --target data/scenarios/02/target.csv \\\n"
                              "      --auto -o out/currents\n"
                              "  hci-solve emit out/currents --name hub --frame dq -o out/firmware\n\n";

static const char COMMON[] = "Each command prints what it found on standard output (with --json as JSON), "
                             "progress, remarks and errors on standard error, "
                             "writes its files where --out says, and ends with exit code 0 when all is well. "
                             "hci-solve help COMMAND tells its options, files "
                             "and exit codes, with an example; hci-solve -V the version. A file named - is "
                             "standard input, where one table or one recording "
                             "is read.";

static const char DOCUMENTATION[] =
    "Documentation: man hci-solve; guides to each step and the formats of all files in docs/ of the "
    "sources, installed in share/doc/hci-solve.";

static void print_commands(FILE *stream, int width)
{
    for (size_t k = 0; k < COMMAND_COUNT; ++k) {
        char line[256];
        snprintf(line, sizeof line, "%.*s", (int)strcspn(COMMANDS[k]->does, "\n"), COMMANDS[k]->does);
        fprintf(stream, "  %-10s  ", COMMANDS[k]->name);
        cli_print_wrapped(stream, width, 14, 14, line);
    }
}

static int print_usage(FILE *stream)
{
    const int width = cli_width(fileno(stream));
    fprintf(stream, "hci-solve COMMAND [OPTIONS]\n\n");
    cli_print_wrapped(stream, width, 0, 0, USE);
    fputc('\n', stream);
    print_commands(stream, width);
    fprintf(stream, "%s", EXAMPLE);
    cli_print_wrapped(stream, width, 0, 0, COMMON);
    fputc('\n', stream);
    cli_print_wrapped(stream, width, 0, 0, DOCUMENTATION);
    return 0;
}

static int unknown_command(const char *word)
{
    const char *names[COMMAND_COUNT + 1] = {NULL}, *nearest;
    hci_note note = {{0}};
    for (size_t k = 0; k < COMMAND_COUNT; ++k)
        names[k] = COMMANDS[k]->name;
    nearest = hci_nearest(word, names);
    if (word[0] == '-')
        return cli_fail(
            hci_note_set(&note, HCI_ERROR_ARGUMENT,
                         "found the option `%s` in place of a command, expected one first, such as "
                         "hci-solve tune LOG %s ...; hci-solve --help lists the commands",
                         word, word),
            &note);
    return cli_fail(hci_note_set(&note, HCI_ERROR_ARGUMENT,
                                 "unknown command `%s`%s%s%s hci-solve --help lists the commands, hci-solve "
                                 "help COMMAND tells of one",
                                 word, nearest ? "; did you mean `" : ";", nearest ? nearest : "",
                                 nearest ? "`?" : ""),
                    &note);
}

static const cli_command *command_of(const char *word)
{
    for (size_t k = 0; k < COMMAND_COUNT; ++k)
        if (strcmp(word, COMMANDS[k]->name) == 0) return COMMANDS[k];
    return NULL;
}

static int help_of(const char *word)
{
    const cli_command *command = command_of(word);
    if (!command) return unknown_command(word);
    cli_print_help(command);
    return 0;
}

static bool is_one_of(const char *word, const char *a, const char *b)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

static int run(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "";
    const cli_command *command = command_of(word);
    if (is_one_of(word, "--version", "-V")) return puts("hci-solve " HCI_VERSION_STRING), 0;
    if (strcmp(word, "help") == 0 && argc > 2) return help_of(argv[2]);
    if (is_one_of(word, "--help", "-h") || strcmp(word, "help") == 0) return print_usage(stdout);
    if (command) return cli_command_run(command, argc - 2, argv + 2);
    if (strcmp(word, "reference") == 0) return cli_reference(COMMANDS, COMMAND_COUNT, argc - 2, argv + 2);
    if (argc > 1) return unknown_command(word);
    print_usage(stderr);
    return hci_status_exit_code(HCI_ERROR_ARGUMENT);
}

/* A reader such as `head` that has seen enough is no error. */
static bool is_reader_gone(void)
{
    struct pollfd out = {STDOUT_FILENO, POLLOUT, 0};
    return poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

/* Errors are JSON too where it is asked for, those of the command line included. */
static bool asks_for_json(int argc, char **argv)
{
    for (int k = 1; k < argc && strcmp(argv[k], "--") != 0; ++k)
        if (strcmp(argv[k], "--json") == 0) return true;
    return false;
}

/* A closed pipe or a full disk shows when standard output is flushed, not as a signal. */
int main(int argc, char **argv)
{
    int exit_code;
    cli_start();
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    cli_signals_catch();
    cli_terminal_begin(false, asks_for_json(argc, argv), CLI_COLOR_AUTO);
    exit_code = run(argc, argv);
    if ((fflush(stdout) != 0 || ferror(stdout)) && !is_reader_gone()) {
        fprintf(stderr, "hci-solve: standard output: %s\n", strerror(errno));
        return hci_status_exit_code(HCI_ERROR_OUTPUT);
    }
    return exit_code;
}
