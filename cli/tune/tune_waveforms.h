/* What recordings of tune show without a load. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_WAVEFORMS_H
#define HCI_CLI_TUNE_WAVEFORMS_H

#include "cli/tune/tune_steps.h"

#endif
