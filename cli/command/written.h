/* Names the files that a command wrote. Uses the folder terminal. */
#ifndef HCI_CLI_WRITTEN_H
#define HCI_CLI_WRITTEN_H

/* From now on the files that are written are remembered, each once; also those of a command within a command.
 */
void cli_written_begin(void);
/* Says them, a line for each folder, where words are wanted. */
void cli_written_say(void);
/* Removes them and the folders from `root` on that are empty then: of a command that failed in the middle. */
void cli_written_remove(const char *root);
/* Forgets those in a folder of temporary files; "": none. */
void cli_written_forget(const char *folder);
/* Ends what the last begin has begun; the outermost forgets them. */
void cli_written_end(void);

#endif
