/* Ctrl-C and its like. Uses terminal. */
#ifndef HCI_CLI_SIGNALS_H
#define HCI_CLI_SIGNALS_H

#include <stdbool.h>

/* From now on a signal that ends the program erases the line of progress and the files that are half
 * written, and then ends it as it would have. */
void cli_signals_catch(void);

/* From now on the first Ctrl-C, SIGTERM or SIGHUP is only remembered, until cli_signals_catch; the second one
 * ends the program. One that the program was told to ignore stays ignored. */
void cli_signals_defer(void);

/* Whether there was one that is remembered; an hci_stop. context: not used. */
bool cli_signals_deferred(void *context);

/* Ends the program as that signal would have, with what was said so far; nothing happens where there was
 * none. */
void cli_signals_obey(void);

#endif
