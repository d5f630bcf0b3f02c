/* What `sweep` says of its results. */
#ifndef HCI_CLI_SWEEP_WORDS_H
#define HCI_CLI_SWEEP_WORDS_H

#include "hci/host/sweep/sweep.h"

void cli_show_sweep(const hci_grid *sweep, const char *machine);

#endif
