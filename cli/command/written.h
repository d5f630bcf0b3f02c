/* Names the files that a command wrote. Uses the folder terminal. */
#ifndef HCI_CLI_WRITTEN_H
#define HCI_CLI_WRITTEN_H

/* From now on the files that are written are remembered, each once. */
void cli_written_begin(void);
/* Says them, a line for each folder, where words are wanted. */
void cli_written_say(void);
/* Forgets them. */
void cli_written_end(void);

#endif
