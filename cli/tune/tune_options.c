#include "cli/tune/tune_options.h"

#define AS_IN_INIT(name, value)                                                                              \
    {                                                                                                        \
        name, 0, CLI_TEXT, value, .help = "as in init"                                                       \
    }

const cli_option cli_tune_options[] = {
    [TUNE_POLE_PAIRS] = {"pole-pairs", 0, CLI_TEXT, "P",
                         .help = "half the number of magnets around the rotor"},
    [TUNE_POLES] = {"poles", 0, CLI_TEXT, "N", .help = "the same as magnets, 2 P"},
    [TUNE_KV] = {"kv", 0, CLI_TEXT, "RPM_PER_V",
                 .help = "strength of the magnets as Kv, or by one of the next five, as in init"},
    [TUNE_KV_OF] = AS_IN_INIT("kv-of", "WORD"),
    [TUNE_VOLT] = AS_IN_INIT("volt-per-krpm", "V"),
    [TUNE_VOLT_OF] = AS_IN_INIT("volt-of", "WORD"),
    [TUNE_CONSTANT] = AS_IN_INIT("torque-constant", "NM_PER_A"),
    [TUNE_CONSTANT_OF] = AS_IN_INIT("torque-of", "WORD"),
    [TUNE_FLUX] = AS_IN_INIT("flux", "WB"),
    [TUNE_SLOTS] = {"slots", 0, CLI_TEXT, "N", .help = "of the stator; what check holds the cogging against"},
    [TUNE_RESISTANCE] = AS_IN_INIT("resistance", "OHM"),
    [TUNE_RESISTANCE_OF] = AS_IN_INIT("resistance-of", "WORD"),
    [TUNE_INERTIA] = {"inertia", 0, CLI_TEXT, "KGM2",
                      .help = "of the rotor with what turns with it; a log of a free shaft needs it"},
    [TUNE_CURRENT] = {"rated-current", 0, CLI_TEXT, "A",
                      .help = "of a phase, peak; the currents heat no more than such a sine"},
    [TUNE_CURRENT_OF] = AS_IN_INIT("current-of", "WORD"),
    [TUNE_RATED_TORQUE] = AS_IN_INIT("rated-torque", "NM"),
    [TUNE_DC_LINK] = AS_IN_INIT("dc-link", "V"),
    [TUNE_RUNS] = {"runs", 0, CLI_FILE, "LIST", .help = "table file,role: recordings of MACHINE"},
    [TUNE_TORQUE] =
        {"torque", 0, CLI_NUMBER, "NM",
         .help = "mean torque without ripple that is solved for [the rated one, or what the logs show]",
         .low = 0.0, .high = 1e9},
    [TUNE_NAME] = {"name", 0, CLI_TEXT, "ID", .help = "of the C table [tuned]"},
    [TUNE_OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where everything goes; a new folder"},
    [TUNE_HOLDING] = CLI_HOLDING_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};
