/* The report of `simulate` on the terminal. Uses the folder terminal. */
#ifndef HCI_CLI_SIMULATE_WORDS_H
#define HCI_CLI_SIMULATE_WORDS_H

#include "hci/host/simulate/simulate.h"

/* What was evaluated, torque, current, loss, control and the torque spectrum, on standard output. machine,
 * scenario: their paths. */
void cli_show_simulation(const hci_simulation *s, const char *machine, const char *scenario);

#endif
