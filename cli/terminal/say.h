/* Results for people on standard output; errors and remarks on standard error, behind what standard output
 * got before them. Uses terminal and text. */
#ifndef HCI_CLI_SAY_H
#define HCI_CLI_SAY_H

#include "hci/host/base/note.h"

/* Part of a line, shown when the line ends; styles of text.h may stand in it. On a terminal a long line
 * `  key   words` is continued below its words. */
void cli_say(const char *format, ...) HCI_PRINTF(1, 2);
/* Words of any length as lines of at most 96 columns. */
void cli_say_paragraph(int indent, const char *text);

/* Tells an error, with --json on standard output as an object too, and returns the exit code of the status.
 */
int cli_fail(hci_status status, const hci_note *note);
/* Tells a remark, where it says something and words are wanted. */
void cli_remark(const hci_note *remark);

#endif
