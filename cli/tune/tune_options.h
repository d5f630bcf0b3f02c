/* The options of tune. Uses the folder command. */
#ifndef HCI_CLI_TUNE_OPTIONS_H
#define HCI_CLI_TUNE_OPTIONS_H

#include "cli/command/option.h"

/* Those up to TUNE_DC_LINK are handed on to init as they are. */
enum {
    TUNE_POLE_PAIRS,
    TUNE_POLES,
    TUNE_KV,
    TUNE_KV_OF,
    TUNE_VOLT,
    TUNE_VOLT_OF,
    TUNE_CONSTANT,
    TUNE_CONSTANT_OF,
    TUNE_FLUX,
    TUNE_SLOTS,
    TUNE_RESISTANCE,
    TUNE_RESISTANCE_OF,
    TUNE_INDUCTANCE_D,
    TUNE_INDUCTANCE_Q,
    TUNE_INERTIA,
    TUNE_CURRENT,
    TUNE_CURRENT_OF,
    TUNE_RATED_TORQUE,
    TUNE_DC_LINK,
    TUNE_RUNS,
    TUNE_TORQUE,
    TUNE_BANDWIDTH,
    TUNE_SPEED,
    TUNE_WORK,
    TUNE_NAME,
    TUNE_OUT,
    TUNE_HOLDING,
    CLI_READING_KEYS,
    CLI_COMMON_KEYS
};

/* --work where it is not given: who waits for a table waits a minute rather than for another recording. */
#define CLI_TUNE_WORK "4"

extern const cli_option cli_tune_options[];

#endif
