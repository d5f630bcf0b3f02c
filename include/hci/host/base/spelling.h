/* Which name a word was probably meant to be. */
#ifndef HCI_HOST_BASE_SPELLING_H
#define HCI_HOST_BASE_SPELLING_H

#ifdef __cplusplus
extern "C" {
#endif

/* Of NULL-ended names the one that begins with `word`, or the nearest by letters to put in, take out, change
 * or swap; NULL where that is more than one in three letters. */
const char *hci_nearest(const char *word, const char *const *names);

#ifdef __cplusplus
}
#endif

#endif
