#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "hci/version.h"

static const cli_command *const COMMANDS[] = {&cli_harmonics, &cli_solve, &cli_predict, &cli_simulate,
                                              &cli_diagnose,  &cli_emit,  &cli_init};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0] };

static int print_usage(FILE *stream)
{
    fprintf(stream, "hci-solve COMMAND [OPTIONS]\n\nPhase currents that make a permanent-magnet motor "
                    "produce the torque you want.\n\n");
    for (size_t k = 0; k < COMMAND_COUNT; ++k) {
        const char *end = strchr(COMMANDS[k]->does, '\n');
        const int length = end ? (int)(end - COMMANDS[k]->does) : (int)strlen(COMMANDS[k]->does);
        fprintf(stream, "  %-10s %.*s\n", COMMANDS[k]->name, length, COMMANDS[k]->does);
    }
    fprintf(stream, "\nhci-solve COMMAND --help tells more; hci-solve --version tells the version.\n");
    return 0;
}

static int run_command(const cli_command *command, int count, char *const *words)
{
    cli_arguments arguments;
    hci_note note = {{0}};
    hci_status status;
    for (int k = 0; k < count; ++k)
        if (strcmp(words[k], "--help") == 0 || strcmp(words[k], "-h") == 0) {
            cli_print_help(command);
            if (command == &cli_simulate) cli_print_scenario_names();
            return 0;
        }
    status = cli_parse(command, count, words, &arguments, &note);
    return status ? cli_fail(status, &note) : command->run(&arguments);
}

static int run(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "";
    if (strcmp(word, "--version") == 0) return puts("hci-solve " HCI_VERSION_STRING), 0;
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0)
        return print_usage(stdout);
    for (size_t k = 0; k < COMMAND_COUNT; ++k)
        if (strcmp(word, COMMANDS[k]->name) == 0) return run_command(COMMANDS[k], argc - 2, argv + 2);
    if (argc > 1) fprintf(stderr, "hci-solve: unknown command `%s`\n", word);
    print_usage(stderr);
    return hci_status_exit_code(HCI_ERROR_ARGUMENT);
}

/* A closed pipe or a full disk shows when standard output is flushed, not as a signal. */
int main(int argc, char **argv)
{
    int exit_code;
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    exit_code = run(argc, argv);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "hci-solve: standard output: %s\n", strerror(errno));
        return hci_status_exit_code(HCI_ERROR_OUTPUT);
    }
    return exit_code;
}
