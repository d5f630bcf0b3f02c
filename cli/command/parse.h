/* Words of a command line to arguments, by the table of a command. Uses option. */
#ifndef HCI_CLI_PARSE_H
#define HCI_CLI_PARSE_H

#include "cli/command/option.h"
#include "hci/host/base/note.h"

/* Takes the words that follow the command apart: options with their values, and other words.
 * HCI_ERROR_ARGUMENT with a note that names the word and the remedy. */
hci_status cli_parse_words(const cli_command *command, int count, char *const *words,
                           cli_arguments *arguments, hci_note *note);

/* Reads the values that were found: numbers and choices. HCI_ERROR_ARGUMENT with a note. */
hci_status cli_parse_values(const cli_option *options, cli_arguments *arguments, hci_note *note);

/* The value of one option, where it is given. */
hci_status cli_parse_value(const cli_option *options, int option, cli_arguments *arguments, hci_note *note);

/* The number of an option, or another one where none is given. */
double cli_number_or(const cli_arguments *arguments, int option, double otherwise);

#endif
