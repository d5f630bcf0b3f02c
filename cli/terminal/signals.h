/* Ctrl-C and its like. Uses terminal. */
#ifndef HCI_CLI_SIGNALS_H
#define HCI_CLI_SIGNALS_H

/* From now on a signal that ends the program erases the line of progress and the files that are half
 * written, and then ends it as it would have. */
void cli_signals_catch(void);

#endif
