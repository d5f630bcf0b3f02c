/* `simulate --table`: torque ripple through the current loop over the speed. Uses command and terminal. */
#ifndef HCI_CLI_SIMULATE_SPEEDS_H
#define HCI_CLI_SIMULATE_SPEEDS_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"

/* What stands on the command line. */
typedef struct {
    const char *machine, *drive;
    const char *const *table; /* folders of solutions */
    size_t table_count;
    const char *speeds;   /* rpm, separated by commas */
    double torque_Nm;     /* NAN: of the table's last level */
    double error_percent; /* 0: not asked */
    const char *out;      /* folder, or NULL */
    bool per_torque;      /* levels −T and T of one folder */
    bool report, json;
    hci_order_base order_base; /* of the machine's tables */
} cli_speeds_words;

/* All of it, to the last file and word. */
hci_status cli_simulate_speeds(const cli_speeds_words *words, hci_note *note);

#endif
