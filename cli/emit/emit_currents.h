/* The currents on the command line of `emit`, and what is to be made of them. Uses the folder command and
 * emit_options. */
#ifndef HCI_CLI_EMIT_CURRENTS_H
#define HCI_CLI_EMIT_CURRENTS_H

#include "cli/command/option.h"
#include "hci/host/currents/currents.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/emit/emit.h"
#include "hci/host/machine/machine.h"

/* All of it in one place; `request` points into the rest, so that it is not to be moved. Start with {0}. */
typedef struct {
    hci_currents current, per_Nm;
    char provenance[2][HCI_SOLUTION_WORDS];
    const char *lines[2];
    hci_emit_request request;
    hci_machine_data machine; /* empty where it is not given */
} cli_emit_currents;

/* Reads it. It is to be released even after a failure. HCI_ERROR_ARGUMENT, _INPUT, _MEMORY. */
hci_status cli_emit_currents_read(const cli_arguments *arguments, cli_emit_currents *in, hci_note *note);
void cli_emit_currents_release(cli_emit_currents *in);

/* Says where currents are not what was asked of `solve`, or of another machine than the given one (NULL: none
 * is given). */
void cli_emit_remark(const cli_arguments *arguments, const hci_machine_data *machine);

/* What --angle-of-logs says of a map, whose form has no place for it. */
void cli_emit_remark_zero(const cli_arguments *arguments);

#endif
