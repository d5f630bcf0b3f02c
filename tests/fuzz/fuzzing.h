/* What the fuzz targets share. An input is a folder as text: files one after the other, each behind a line
 * `@@ NAME`. It is unpacked into an empty folder, which is the current one while the target works. */
#ifndef FUZZING_H
#define FUZZING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cli/command/option.h"
#include "hci/host/base/note.h"

/* What libFuzzer, AFL++ and the replaying main in replay.c call. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A promise that has to hold whatever the input is; else the process is aborted with this text. */
void fuzz_require(bool promise, const char *text);

/* Makes the files of an input the only ones of the working folder. Names are relative and have no `..`. */
void fuzz_unpack(const uint8_t *data, size_t size);

/* Text of a file of the working folder, for the target to free; NULL when there is none. size: out. */
char *fuzz_read(const char *path, size_t *size);

bool fuzz_exists(const char *path);

/* A text may be shown on a terminal: UTF-8 without control characters. */
void fuzz_check_shown(const char *text);

/* Errors of a reader have a note that can be shown, and are of its input or of memory. */
void fuzz_check_note(hci_status status, const hci_note *note);

/* Runs a command on words, up to NULL, and on those of the input's file `options`. Aborts where what it says,
 * what it leaves in the folder `out` or its exit code is not as docs/files.md promises. Returns the code. */
int fuzz_command(const cli_command *command, const char *const *words);

#endif
