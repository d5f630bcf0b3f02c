/* A recording in a file of a temporary folder, and the run read from it. Prefix run_file_. */
#ifndef RUN_FILE_H
#define RUN_FILE_H

#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "support/files.h"

static char path[96]; /* of the file, between run_file_begin and run_file_end */
static hci_run run;
static hci_note note;

static inline void run_file_begin(void)
{
    files_begin();
    snprintf(path, sizeof path, "%s", files_path("run.csv"));
    memset(&run, 0, sizeof run);
    memset(&note, 0, sizeof note);
}

static inline void run_file_end(void)
{
    hci_run_release(&run);
    files_end();
}

#endif
