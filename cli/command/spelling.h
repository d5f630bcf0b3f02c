/* Which name a word was probably meant to be. Uses nothing of cli. */
#ifndef HCI_CLI_SPELLING_H
#define HCI_CLI_SPELLING_H

/* Of NULL-ended names the one that begins with `word`, or the nearest by letters to put in, take out, change
 * or swap; NULL where that is more than one in three letters. */
const char *cli_nearest(const char *word, const char *const *names);

#endif
