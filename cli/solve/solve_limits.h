/* Limits on the command line of `solve` and `sweep`. */
#ifndef HCI_CLI_SOLVE_LIMITS_H
#define HCI_CLI_SOLVE_LIMITS_H

#include "cli/command/option.h"
#include "hci/host/base/note.h"
#include "hci/host/solve/solve.h"

/* What both have, in the same words: keys of the enum of options, and the options. */
#define CLI_LIMIT_KEYS                                                                                       \
    LIMIT_CURRENT, LIMIT_RMS, LIMIT_COPPER, LIMIT_VOLTAGE, VOLTAGE_RESERVE, DEAD_TIME, PWM_FREQUENCY,        \
        IGNORE_RATINGS
#define CLI_LIMIT_OPTIONS                                                                                    \
    [LIMIT_CURRENT] = {"limit-current", 0, CLI_TEXT, "A[,PHASE=A]",                                          \
                       .help = "largest phase current, peak; such as 12, a=10 or 12,a=0 (a is open)"},       \
    [LIMIT_RMS] = {"limit-rms", 0, CLI_TEXT, "A[,PHASE=A]", .help = "largest rms current of a phase"},       \
    [LIMIT_COPPER] = {"limit-copper", 0, CLI_TEXT, "W",                                                      \
                      .help = "largest copper loss; 1.2x: over that of the plain sine"},                     \
    [LIMIT_VOLTAGE] = {"limit-voltage",                                                                      \
                       0,                                                                                    \
                       CLI_NUMBER,                                                                           \
                       "V",                                                                                  \
                       .help = "dc link, which line voltages stay below; with a speed",                      \
                       .low = 1e-9,                                                                          \
                       .high = 1e9},                                                                         \
    [VOLTAGE_RESERVE] = {"voltage-reserve",                                                                  \
                         0,                                                                                  \
                         CLI_NUMBER,                                                                         \
                         "SHARE",                                                                            \
                         .help = "of the dc link that is left for the control (0)",                          \
                         .low = 0.0,                                                                         \
                         .high = 0.9},                                                                       \
    [DEAD_TIME] = {"dead-time",                                                                              \
                   0,                                                                                        \
                   CLI_NUMBER,                                                                               \
                   "S",                                                                                      \
                   .help = "of a leg, which takes voltage; with --pwm-frequency",                            \
                   .low = 0.0,                                                                               \
                   .high = 1e-2},                                                                            \
    [PWM_FREQUENCY] = {"pwm-frequency",                                                                      \
                       0,                                                                                    \
                       CLI_NUMBER,                                                                           \
                       "HZ",                                                                                 \
                       .help = "switching frequency of a leg, for --dead-time",                              \
                       .low = 50.0,                                                                          \
                       .high = 1e9},                                                                         \
    [IGNORE_RATINGS] = {"ignore-ratings", 0, CLI_FLAG, NULL,                                                 \
                        .help = "max_current and dc_link_voltage of machine.csv are no limits"}

/* Words of --minimise, in the order of hci_minimise. */
extern const cli_choice cli_minimise_choices[];

/* What CLI_LIMIT_OPTIONS say, and --minimise, into the options of a solve. table: that of the command.
 * HCI_ERROR_ARGUMENT. */
hci_status cli_limits_take(const cli_option *table, const cli_arguments *arguments,
                           hci_solve_options *options, hci_note *note);

#endif
