/* The commands, one file each with its table of options and its `run`. What a command reports on the terminal
 * is in <command>_words.c where that is long. Below them are the folders terminal and command, above them
 * reference and main.c. */
#ifndef HCI_CLI_COMMANDS_H
#define HCI_CLI_COMMANDS_H

#include "cli/command/option.h"

extern const cli_command cli_check, cli_diagnose, cli_emit, cli_harmonics, cli_init, cli_predict,
    cli_simulate, cli_solve, cli_sweep, cli_tune, cli_fit, cli_batch_command, cli_fleet;
extern const cli_command cli_export_fmu;

#endif
