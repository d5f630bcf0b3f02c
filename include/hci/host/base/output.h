/* A set of output files that appears whole or not at all. Files are written under temporary names in their
 * folder and renamed together by hci_output_commit; hci_output_discard removes them. */
#ifndef HCI_HOST_BASE_OUTPUT_H
#define HCI_HOST_BASE_OUTPUT_H

#include <stddef.h>

#include "hci/host/base/note.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A set of files that is being written. */
typedef struct hci_output hci_output;

/* Opens a set of files in `folder`, which is made (with its parents) if it is missing, and locked until the
 * set has ended: another process that opens one there waits for up to two seconds, and is refused then. What
 * a process that was killed has begun there is ended first. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_output_open(const char *folder, hci_output **output, hci_note *note);

/* Starts the next file; `name` has no folder part. What is written from now on goes into it. A target that is
 * there already must be a plain file that may be written. HCI_ERROR_ARGUMENT for a name with a folder part or
 * a second time, HCI_ERROR_OUTPUT, _MEMORY; discard the set then. */
hci_status hci_output_file(hci_output *output, const char *name, hci_note *note);

/* A set of one file: hci_output_open with the folder of the path, hci_output_file with its last part. *output
 * is to be committed or discarded after a failure too, unless it is NULL. */
hci_status hci_output_open_file(const char *path, hci_output **output, hci_note *note);

/* A file that the set does not have: one of this name that an earlier run left is removed by the commit. */
hci_status hci_output_without(hci_output *output, const char *name, hci_note *note);

/* Appends to the current file. Write errors (disk full, …) are remembered and reported by the commit. */
void hci_output_text(hci_output *output, const char *format, ...) HCI_PRINTF(2, 3);

/* Appends bytes as they are. */
void hci_output_bytes(hci_output *output, const void *bytes, size_t count);

/* One CSV number: shortest text that reads back to the same double, followed by `end` (',' or '\n'). A value
 * that is not finite is remembered, and the commit fails with HCI_ERROR_NOT_FINITE. */
void hci_output_number(hci_output *output, double value, char end);

/* Ends the last file and tells what the commit would find wrong with what was written: for sets in several
 * folders that are to appear together. HCI_ERROR_OUTPUT, _NOT_FINITE; discard the set then. */
hci_status hci_output_check(hci_output *output, hci_note *note);

/* Shows name and checksum of each file so far, but for those that the set does not have, and ends the last.
 * The checksum is what the POSIX command `cksum` prints: a number, a blank, the size in bytes.
 * HCI_ERROR_OUTPUT. */
hci_status hci_output_checksums(hci_output *output,
                                void (*show)(void *context, const char *name, const char *checksum),
                                void *context, hci_note *note);

/* Flushes, checks and renames every file, and frees `output` in any case. On failure no file of the set is
 * left, and files that were there before are untouched: each is kept by a second link until the last rename
 * has succeeded; signals wait until then. When the process is killed or the power fails between the first and
 * the last rename, the next set that is opened there, or hci_output_finish_interrupted, does the rest; until
 * then the folder has a hidden `.hci-journal`. HCI_ERROR_OUTPUT, _NOT_FINITE, _MEMORY, which is also where
 * an allocation has failed since the last commit, and something of what is written may not be what it is
 * else. */
hci_status hci_output_commit(hci_output *output, hci_note *note);

/* The same for sets whose files belong together: all of them appear, or none. The last one's folder has the
 * folders of the others within it, each by its name alone. */
hci_status hci_output_commit_together(hci_output *const set[], size_t count, hci_note *note);

/* Removes the temporary files and frees. output may be NULL. */
void hci_output_discard(hci_output *output);

/* Ends what a process has begun in a folder that was killed between two renames; for who is going to read
 * there. A folder that cannot be written stays as it is. */
void hci_output_finish_interrupted(const char *folder);

/* What is told of each file that a commit has put into place; path: folder/name, valid during the call. */
typedef void hci_output_told(void *context, const char *path);

/* From now on each commit tells its files, in their order; NULL: none does. For programs of one thread. */
void hci_output_tell(hci_output_told *told, void *context);

/* For the handler of a signal that ends the program, and safe there: removes what all sets that are open have
 * written and the folders that they have made. Their memory stays. For programs of one thread. */
void hci_output_abandon(void);

#ifdef __cplusplus
}
#endif

#endif
