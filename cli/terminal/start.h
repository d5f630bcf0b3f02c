#ifndef HCI_CLI_TERMINAL_START_H
#define HCI_CLI_TERMINAL_START_H

/* Called by main, first of all: from here on the program ends with the exit code that main returns. Before,
 * it ends with that of HCI_ERROR_MEMORY. */
void cli_start(void);

#endif
