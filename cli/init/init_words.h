/* The report of `init` on the terminal. Uses the folder terminal. */
#ifndef HCI_CLI_INIT_WORDS_H
#define HCI_CLI_INIT_WORDS_H

#include "hci/host/machine/init.h"

/* What was written, the strength of the magnets in every reading, and what to do next, on standard output.
 * folder: where the tables are. */
void cli_show_sheet(const hci_sheet *s, const char *folder);

#endif
