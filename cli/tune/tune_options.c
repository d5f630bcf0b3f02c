#include "cli/tune/tune_options.h"

#define OF_SHEET(name, value, words)                                                                         \
    {                                                                                                        \
        name, 0, CLI_TEXT, value, .help = words                                                              \
    }

const cli_option cli_tune_options[] = {
    [TUNE_POLE_PAIRS] = {"pole-pairs", 0, CLI_TEXT, "P",
                         .help = "half the number of magnets around the rotor"},
    [TUNE_POLES] = {"poles", 0, CLI_TEXT, "N", .help = "the same as magnets, 2 P"},
    [TUNE_KV] = {"kv", 0, CLI_TEXT, "RPM_PER_V", .help = "strength of the magnets as Kv, rpm per volt"},
    [TUNE_KV_OF] = OF_SHEET("kv-of", "WORD", "... of: line-peak (default), line-rms, phase-peak"),
    [TUNE_VOLT] = OF_SHEET("volt-per-krpm", "V", "or as back-EMF at 1000 rpm"),
    [TUNE_VOLT_OF] =
        OF_SHEET("volt-of", "WORD", "... of: line-rms (default), line-peak, phase-peak, phase-rms"),
    [TUNE_CONSTANT] = OF_SHEET("torque-constant", "NM_PER_A", "or as torque per ampere"),
    [TUNE_CONSTANT_OF] = OF_SHEET("torque-of", "WORD", "... of: peak (default), rms, dc"),
    [TUNE_FLUX] = OF_SHEET("flux", "WB", "or as flux linkage of a phase, peak"),
    [TUNE_SLOTS] = {"slots", 0, CLI_TEXT, "N", .help = "of the stator; what check holds the cogging against"},
    [TUNE_RESISTANCE] = OF_SHEET("resistance", "OHM", "of the winding"),
    [TUNE_RESISTANCE_OF] = OF_SHEET("resistance-of", "WORD", "... of: phase (default), line"),
    [TUNE_INDUCTANCE_D] =
        OF_SHEET("inductance-d", "H", "along the magnets, of a phase: half of that between two terminals"),
    [TUNE_INDUCTANCE_Q] =
        OF_SHEET("inductance-q", "H", "... across the magnets: with both, the reluctance torque is declared"),
    [TUNE_INERTIA] = {"inertia", 0, CLI_TEXT, "KGM2",
                      .help = "of the rotor with what turns with it; a log of a free shaft needs it"},
    [TUNE_CURRENT] = {"rated-current", 0, CLI_TEXT, "A",
                      .help = "of a phase, peak; the currents heat no more than such a sine"},
    [TUNE_CURRENT_OF] = OF_SHEET("current-of", "WORD", "... of: peak (default), rms"),
    [TUNE_RATED_TORQUE] = OF_SHEET("rated-torque", "NM", "of the shaft; solved for where no log shows less"),
    [TUNE_DC_LINK] = OF_SHEET("dc-link", "V", "of the inverter"),
    [TUNE_RUNS] = {"runs", 0, CLI_FILE, "LIST", .help = "table file,role: recordings of MACHINE"},
    [TUNE_TORQUE] =
        {"torque", 0, CLI_NUMBER, "NM",
         .help = "mean torque without ripple that is solved for [the rated one, or what the logs show]",
         .low = 0.0, .high = 1e9},
    [TUNE_BANDWIDTH] = {"bandwidth", 0, CLI_NUMBER, "HZ",
                        .help = "of the current loop: up to which speed it adds little to the ripple",
                        .low = 1e-3, .high = 1e6},
    [TUNE_SPEED] = {"speed", 0, CLI_NUMBER, "RPM",
                    .help = "with --bandwidth: mechanical, at which the bound has what the loop adds",
                    .low = -1e7, .high = 1e7},
    [TUNE_WORK] =
        {"work", 0, CLI_NUMBER, "TIMES",
         .help =
             "how much the search for effects may do: times the usual of diagnose, some 5 s [" CLI_TUNE_WORK
             "]",
         .low = 0.01, .high = 1e4},
    [TUNE_NAME] = {"name", 0, CLI_TEXT, "ID", .help = "of the C table [tuned]"},
    [TUNE_OUT] = {"out", 'o', CLI_FOLDER, "FOLDER", .help = "where everything goes; a new folder"},
    [TUNE_HOLDING] = CLI_HOLDING_OPTION,
    CLI_READING_OPTIONS,
    CLI_COMMON_OPTIONS};
