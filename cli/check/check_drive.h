/* `check --drive`: the current loop of a drive before anything runs. Uses the folders command and terminal.
 */
#ifndef HCI_CLI_CHECK_DRIVE_H
#define HCI_CLI_CHECK_DRIVE_H

#include <stdbool.h>

#include "hci/host/machine/machine.h"

typedef struct {
    const char *machine, *drive;
    hci_order_base order_base;
    double speed_rad_per_s; /* mechanical; 0: none */
    const char *out;        /* folder of summary.json; NULL: none */
    bool json;
} cli_check_drive_words;

/* All of it; returns the exit code. */
int cli_check_drive(const cli_check_drive_words *words);

#endif
