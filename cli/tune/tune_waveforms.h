/* What recordings of tune show without a load. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_WAVEFORMS_H
#define HCI_CLI_TUNE_WAVEFORMS_H

#include "cli/tune/tune_steps.h"

/* None, or what a sensor of current makes of none. */
bool cli_tune_has_no_current(const cli_tuning *tune, const hci_run *run);

#endif
