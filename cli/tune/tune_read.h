/* The recordings of tune. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_READ_H
#define HCI_CLI_TUNE_READ_H

#include "cli/tune/tune_steps.h"

/* A recording as it was given; in a list, as that names it; of several operating points in one file, with its
 * currents. */
const char *cli_tune_name_of(const cli_tuning *tune, size_t run);

/* The log that a run is from, as it was given. */
const char *cli_tune_log_of(const cli_tuning *tune, size_t run);

/* Writes the list of the recordings that the arguments name, and notes it. */
hci_status cli_tune_list_logs(cli_tuning *tune, hci_note *note);

/* Machine and recordings anew, with the zero of the angle that is known by now. */
hci_status cli_tune_read_inputs(cli_tuning *tune, hci_note *note);

/* From here on recordings are read with another zero. */
void cli_tune_take_offset(cli_tuning *tune, double more_rad, const char *why);

#endif
