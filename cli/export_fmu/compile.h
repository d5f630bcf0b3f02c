/* The user's C compiler, and a folder for it to work in. Uses the folder terminal. */
#ifndef HCI_CLI_EXPORT_FMU_COMPILE_H
#define HCI_CLI_EXPORT_FMU_COMPILE_H

#include <stddef.h>

#include "hci/host/base/note.h"

enum { CLI_WORK_FOLDER_SIZE = 4096 };

/* A new folder for temporary files. HCI_ERROR_OUTPUT. */
hci_status cli_work_folder_make(char folder[CLI_WORK_FOLDER_SIZE], hci_note *note);

/* Removes it with its files. */
void cli_work_folder_remove(const char *folder);

/* An hci_fmu_compile: runs what the environment variable CC says, or `cc`. context: not used. */
hci_status cli_compile(void *context, const char *folder, const char *const *sources, size_t count,
                       const char *library, hci_note *note);

#endif
