/* What a set of files still has to rename, kept in its folder while it does so. Who comes to the folder after
 * a process was killed, or the power failed, brings it to its end: so the folder holds the older set or the
 * newer. */
#ifndef HCI_SRC_HOST_BASE_JOURNAL_H
#define HCI_SRC_HOST_BASE_JOURNAL_H

#include <stdbool.h>
#include <stdio.h>

/* Begins to write one. NULL, with errno, where that cannot be. */
FILE *hci_journal_open(const char *folder);

/* `temporary` is to become `target`, or `target` is to go where is_removed; `backup` is to go. Names in the
 * folder, or all three in one folder within it. */
void hci_journal_step(FILE *journal, bool is_removed, const char *temporary, const char *backup,
                      const char *target);

/* Puts it into the folder, on the disk. False, with errno, where it cannot be written; there is none then. */
bool hci_journal_begin(const char *folder, FILE *journal);

/* Takes it away. */
void hci_journal_end(const char *folder);

/* Does what a journal in the folder says, if there is one, and takes it away. Only for who has locked the
 * folder. False, with errno, where a step cannot be done: all is left for the next who tries. */
bool hci_journal_finish(const char *folder);

/* Whether the folder has one. */
bool hci_journal_exists(const char *folder);

#endif
